#include "measured/modal/fitted_transfer.hpp"

#include <cmath>
#include <utility>

namespace flexarm::measured {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Kind = SensorColumn::Kind;

/// s^power, its derivative for `order` 1; both 0 where the power is.
Complex power_of(Complex s, int power, int order = 0) {
  Complex value = 1.0;
  for (int i = 0; i < power - order; ++i) value *= s;
  return order == 0 ? value : static_cast<double>(power) * (power > 0 ? value : 0.0);
}

}  // namespace

FittedTransfer::FittedTransfer(BlockSet blocks, SensorModel model, Eigen::VectorXd beta)
    : blocks_(std::move(blocks)), model_(std::move(model)), beta_(std::move(beta)) {
  model_.columns.resize(static_cast<std::size_t>(model_.shared));
}

FittedTransfer FittedTransfer::with(const Eigen::VectorXd& parameters) const {
  return {blocks_.with(parameters.head(blocks_.parameters())), model_,
          parameters.tail(beta_.size())};
}

Eigen::VectorXd FittedTransfer::values() const {
  Eigen::VectorXd values(parameters());
  values << blocks_.theta(), beta_;
  return values;
}

Complex FittedTransfer::value(Complex s) const {
  Complex sum = 0.0;
  for (Index i = 0; i < beta_.size(); ++i) {
    const SensorColumn& column = model_.columns[static_cast<std::size_t>(i)];
    sum += beta_(i) * (column.kind == Kind::remainder
                           ? power_of(s, remainder_power())
                           : power_of(s, column.power) * blocks_.blocks[column.block].value(s));
  }
  return sum;
}

Complex FittedTransfer::s_derivative(Complex s) const {
  Complex sum = 0.0;
  for (Index i = 0; i < beta_.size(); ++i) {
    const SensorColumn& column = model_.columns[static_cast<std::size_t>(i)];
    if (column.kind == Kind::remainder) {
      sum += beta_(i) * power_of(s, remainder_power(), 1);
      continue;
    }
    const SecondOrderBlock& block = blocks_.blocks[column.block];
    const Complex q = block.value(s);
    sum += beta_(i) * (power_of(s, column.power, 1) * q -
                       power_of(s, column.power) * q * q * (2.0 * s + block.a1_rad_per_s));
  }
  return sum;
}

Eigen::RowVectorXcd FittedTransfer::gradient(Complex s) const {
  Eigen::RowVectorXcd gradient = Eigen::RowVectorXcd::Zero(parameters());
  for (Index i = 0; i < beta_.size(); ++i) {
    const SensorColumn& column = model_.columns[static_cast<std::size_t>(i)];
    const Index at = blocks_.parameters() + i;
    if (column.kind == Kind::remainder) {
      gradient(at) = power_of(s, remainder_power());
      continue;
    }
    const Complex q = blocks_.blocks[column.block].value(s);
    const Complex p = power_of(s, column.power) * q * q;
    gradient(at) = power_of(s, column.power) * q;
    const Eigen::MatrixXd chain = blocks_.coefficient_derivatives(column.block);
    for (Index t = 0; t < chain.rows(); ++t) {
      gradient(blocks_.first_parameter(column.block) + t) -=
          beta_(i) * p * (chain(t, 0) * s + chain(t, 1));
    }
  }
  return gradient;
}

FittedTransfer::Numerator FittedTransfer::numerator(std::size_t block) const {
  // b1 and b0 are linear in beta.
  const Eigen::Vector2d b = numerator_gradient(block).rightCols(beta_.size()) * beta_;
  return {b(0), b(1)};
}

Eigen::Matrix2Xd FittedTransfer::numerator_gradient(std::size_t block) const {
  const int derivatives = arm::derivative_order(model_.sensor);
  const bool rigid = blocks_.is_rigid(block);
  const auto& [a1, a0] = blocks_.blocks[block];
  Eigen::Matrix2Xd gradient = Eigen::Matrix2Xd::Zero(2, parameters());
  for (Index i = 0; i < beta_.size(); ++i) {
    const SensorColumn& column = model_.columns[static_cast<std::size_t>(i)];
    if (column.kind != Kind::forced || column.block != block) continue;
    const Index at = blocks_.parameters() + i;
    if (derivatives == 0) {
      gradient(column.power == 1 ? 0 : 1, at) = 1.0;
    } else if (column.power == derivatives) {
      gradient(1, at) = 1.0;
    } else if (!rigid) {
      gradient.col(at) << -1.0 / a0, -a1 / a0;
      // Of (b1, b0) = -c (1, a1)/a0 to a1 and a0.
      Eigen::Matrix2d to_coefficients;
      to_coefficients << 0.0, 1.0 / (a0 * a0), -1.0 / a0, a1 / (a0 * a0);
      const Eigen::MatrixXd chain = blocks_.coefficient_derivatives(block);
      gradient.middleCols(blocks_.first_parameter(block), chain.rows()) +=
          beta_(i) * to_coefficients * chain.transpose();
    }
  }
  return gradient;
}

}  // namespace flexarm::measured
