#include "response/time/reading_bound.hpp"

#include "response/time/orthogonal_complement.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace flexarm::response {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// The entries of X from `first` on whose second derivative is not 0 and that the reading depends
/// on: not W, and neither the angle of an arm without a spring nor a settled Z, each of which would
/// make a double eigenvalue 0.
std::vector<Index> watched_entries(const LinearSystem& system, const Reading& reading,
                                   Index first) {
  std::vector<Index> entries;
  for (Index i = first; i < system.a.rows(); ++i) {
    const bool is_curved = !system.a.row(i).isZero(0.0) || system.actuator(i) != 0.0 ||
                           !system.force.row(i).isZero(0.0);
    const double others = system.a.col(i).cwiseAbs().sum() - std::abs(system.a(i, i));
    if (is_curved && (others > 0.0 || reading.state(i) != 0.0)) entries.push_back(i);
  }
  return entries;
}

/// Orthonormal columns that span X'' but for the entries that do not count. While the hub is held
/// its acceleration b p' is 0, and with it that of its angle b (q/sigma).
MatrixXd basis_of_second_derivative(const ModalDynamics& arm, bool is_held,
                                    const Reading& reading) {
  const LinearSystem& system = is_held ? arm.held : arm.turning;
  const Index held = is_held ? 2 * (arm.modes - 1) : 0;
  const auto entries = watched_entries(system, reading, is_held ? 2 * arm.modes : 0);
  MatrixXd basis = MatrixXd::Zero(arm.size(), held + static_cast<Index>(entries.size()));
  if (is_held) {
    const Index n = arm.modes;
    basis.block(0, 0, n, n - 1) =
        orthogonal_complement(arm.hub_slope.cwiseQuotient(arm.scale_rad_per_s));
    basis.block(n, n - 1, n, n - 1) = orthogonal_complement(arm.hub_slope);
  }
  for (std::size_t k = 0; k < entries.size(); ++k) {
    basis(entries[k], held + static_cast<Index>(k)) = 1.0;
  }
  return basis;
}

MatrixXd parts(const Eigen::MatrixXcd& rows) {
  MatrixXd made(2 * rows.rows(), rows.cols());
  made << rows.real(), rows.imag();
  return made;
}

/// sum over k of factor_k |a_k|, `parts` being the real parts of a and behind them the imaginary
/// ones.
double sum_of_sizes(const Eigen::ArrayXd& factors, const Eigen::VectorXd& parts) {
  const Index count = factors.size();
  const auto squares = parts.head(count).array().square() + parts.tail(count).array().square();
  return (factors * squares.sqrt()).sum();
}

}  // namespace

ReadingModes::ReadingModes(const ModalDynamics& arm, bool is_held, const Reading& watched)
    : reading(watched) {
  const LinearSystem& system = is_held ? arm.held : arm.turning;
  const Index n = arm.size();
  const Index m = system.force.cols();
  // X'' = A (A X + b u + r u' + B f) + b u' + B f', X''' = A X'' + B f''.
  MatrixXd curvature(n, n + 2 + 2 * m);
  const Eigen::VectorXd rate =
      system.actuator_rate.size() > 0 ? system.actuator_rate : Eigen::VectorXd::Zero(n).eval();
  curvature << system.a * system.a, system.a * system.actuator, system.a * rate + system.actuator,
      system.a * system.force, system.force;

  const MatrixXd basis = basis_of_second_derivative(arm, is_held, reading);
  second.setZero(0, curvature.cols());
  third_by_force.setZero(0, m);
  if (basis.cols() == 0) return;
  const Eigen::EigenSolver<MatrixXd> solver(MatrixXd(basis.transpose() * system.a * basis));
  if (solver.info() != Eigen::Success) {
    rates.setConstant(1, std::numeric_limits<double>::quiet_NaN());
    gains.setOnes(1);
    second.setZero(2, curvature.cols());
    third_by_force.setZero(2, m);
    return;
  }
  const Eigen::MatrixXcd vectors = solver.eigenvectors();
  const Eigen::MatrixXcd into = Eigen::PartialPivLU<Eigen::MatrixXcd>(vectors).solve(
      basis.transpose().cast<std::complex<double>>());
  const Eigen::RowVectorXcd out = (reading.state * basis) * vectors;
  std::vector<Index> upper;
  for (Index k = 0; k < basis.cols(); ++k) {
    if (solver.eigenvalues()(k).imag() >= 0.0) upper.push_back(k);
  }
  rates = solver.eigenvalues()(upper);
  gains = (rates.imag().array() > 0.0).select(2.0, Eigen::ArrayXd::Ones(rates.size())) *
          out(upper).cwiseAbs().transpose().array();
  second = parts(into(upper, Eigen::all) * curvature);
  third_by_force = parts(into(upper, Eigen::all) * system.force);
}

ReadingBound::ReadingBound(std::shared_ptr<const ReadingModes> modes, double step_s,
                           bool forces_vary)
    : modes_(std::move(modes)), step_s_(step_s), forces_vary_(forces_vary) {
  const Eigen::ArrayXd speed = modes_->rates.cwiseAbs();
  const Eigen::ArrayXd growth = (modes_->rates.real().array().max(0.0) * step_s).exp();
  const Eigen::ArrayXd kappa = speed.inverse().min(step_s);
  const double chord = step_s * step_s / 8.0;
  by_second_ = modes_->gains.array() * growth * (2.0 * speed.square().inverse()).min(chord);
  if (growth.size() > 0) growth_ = growth.maxCoeff();
  const Index states = modes_->second.cols() - 2 - 2 * modes_->third_by_force.cols();
  per_torque_ = sum_of_sizes(by_second_, modes_->second.col(states));
  by_third_ = kappa * (by_second_ + modes_->gains.array() * growth * chord);
}

template <class Slope>
double ReadingBound::by_modes(const Eigen::VectorXd& x0, double u, double u_rate,
                              const Eigen::VectorXd& f, const Slope& f_rate,
                              Workspace& workspace) const {
  const Index n = x0.size();
  const Index m = f.size();
  Eigen::VectorXd& z = workspace.known;
  z.resize(n + 2 + 2 * m);
  z.head(n) = x0;
  z(n) = u;
  z(n + 1) = u_rate;
  z.segment(n + 2, m) = f;
  z.tail(m) = f_rate;
  workspace.parts.noalias() = modes_->second * z;
  return sum_of_sizes(by_second_, workspace.parts);
}

ReadingBound::Departure ReadingBound::departure(const Eigen::VectorXd& x0, double u,
                                                const Eigen::VectorXd& f,
                                                Workspace& workspace) const {
  const auto none = Eigen::VectorXd::Zero(f.size());
  return {by_modes(x0, u, 0.0, f, none, workspace), per_torque_, growth_};
}

ReadingBound::Range ReadingBound::operator()(const Eigen::VectorXd& x0, const Eigen::VectorXd& x1,
                                             const StepInputs& inputs, Workspace& workspace) const {
  const Reading& reading = modes_->reading;
  const double u_rate = (inputs.u1 - inputs.u0) / step_s_;
  double sag = 0.0;
  if (forces_vary_) {
    workspace.bend = inputs.force_square() * (2.0 / (step_s_ * step_s_));
    workspace.parts.noalias() = modes_->third_by_force * workspace.bend;
    sag = sum_of_sizes(by_third_, workspace.parts) +
          std::abs(reading.force.dot(workspace.bend)) * step_s_ * step_s_ / 8.0;
    sag += by_modes(x0, inputs.u0, u_rate, inputs.f0, inputs.force_slope() / step_s_, workspace);
  } else {
    const auto none = Eigen::VectorXd::Zero(inputs.f0.size());
    sag = by_modes(x0, inputs.u0, u_rate, inputs.f0, none, workspace);
  }
  const double begin =
      reading.state.dot(x0) + reading.actuator * inputs.u0 + reading.force.dot(inputs.f0);
  const double end =
      reading.state.dot(x1) + reading.actuator * inputs.u1 + reading.force.dot(inputs.f1);
  return {std::min(begin, end) - sag, std::max(begin, end) + sag};
}

}  // namespace flexarm::response
