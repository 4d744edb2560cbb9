#include "response/time/propagator.hpp"

#include <unsupported/Eigen/MatrixFunctions>

#include <array>
#include <cmath>
#include <cstddef>

namespace flexarm::response {

namespace {

using Eigen::Index;

/// More take over some tenths of a second.
constexpr Index kMostExtendedRows = 120;

/// Rows and columns of the chain of propagator().
Index chain_size(const LinearSystem& system) {
  const Index inputs = 1 + system.force.cols() + (system.actuator_rate.size() > 0 ? 1 : 0);
  return system.a.rows() + 3 * inputs;
}

/// The first row of the exponential of the chain over a length that can be doubled. Inputs are
/// polynomials of the time in units of the first length.
template <class Scalar>
class ChainExponential {
 public:
  ChainExponential(const LinearSystem& system, double length_s)
      : forces_(system.force.cols()),
        has_rate_(system.actuator_rate.size() > 0),
        inputs_(1 + forces_ + (has_rate_ ? 1 : 0)) {
    const Index n = system.a.rows();
    const Index m = inputs_;
    Eigen::MatrixXd chain = Eigen::MatrixXd::Zero(chain_size(system), chain_size(system));
    chain.topLeftCorner(n, n) = system.a * length_s;
    chain.block(0, n, n, 1) = system.actuator * length_s;
    chain.block(0, n + 1, n, forces_) = system.force * length_s;
    // Of an input u' times the first length.
    if (has_rate_) chain.col(n + m - 1).head(n) = system.actuator_rate;
    chain.block(n, n + m, m, m).setIdentity();
    chain.block(n + m, n + 2 * m, m, m).setIdentity();
    const Matrix power = chain.cast<Scalar>().exp();
    state_ = power.topLeftCorner(n, n);
    for (Index k = 0; k < 3; ++k) {
      of_powers_[static_cast<std::size_t>(k)] = power.block(0, n + k * m, n, m);
    }
  }

  /// [E F] [E F; 0 N] with the exponential N of the chain of integrators alone.
  void double_length() {
    const auto [one, linear, square] = of_powers_;
    const Scalar length = lengths_;
    of_powers_[0] = state_ * one + one;
    of_powers_[1] = state_ * linear + linear + one * length;
    of_powers_[2] = state_ * square + square + linear * length + one * (length * length / 2);
    state_ = state_ * state_;
    lengths_ *= 2;
  }

  /// From 0 to `until` of the step on which the inputs are defined; the present length is that.
  Propagator over(double until) const {
    // An input c0 + c1 s + c2 s^2 in s = t/dt, t from 0 to dt, adds phi_1 c0 + phi_2 c1 +
    // 2 phi_3 c2; on [0, step] it is u0 + (u1 - u0) r and f0 + (-3 f0 + 4 fm - f1) r +
    // (2 f0 - 4 fm + 2 f1) r^2 with r = until s.
    const double r = until / static_cast<double>(lengths_);
    const Eigen::MatrixXd constant = of_powers_[0].template cast<double>();
    const Eigen::MatrixXd linear = of_powers_[1].template cast<double>() * r;
    const Eigen::MatrixXd square = of_powers_[2].template cast<double>() * (2.0 * r * r);
    const auto of_force = [&](const Eigen::MatrixXd& all) { return all.middleCols(1, forces_); };
    Propagator made;
    made.state = state_.template cast<double>();
    made.actuator_begin = constant.col(0) - linear.col(0);
    made.actuator_end = linear.col(0);
    if (has_rate_) {
      // u' times the first length = r (u1 - u0).
      made.actuator_begin -= constant.col(inputs_ - 1) * r;
      made.actuator_end += constant.col(inputs_ - 1) * r;
    }
    made.force_begin = of_force(constant) - 3.0 * of_force(linear) + 2.0 * of_force(square);
    made.force_middle = 4.0 * (of_force(linear) - of_force(square));
    made.force_end = 2.0 * of_force(square) - of_force(linear);
    return made;
  }

 private:
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  Index forces_;
  bool has_rate_;
  Index inputs_;
  Scalar lengths_ = 1;  ///< the present length over the first
  Matrix state_;
  std::array<Matrix, 3> of_powers_ = {};  ///< of t^k/k! of the inputs, t in first lengths
};

template <class Scalar>
std::vector<StepPropagators> halved(const LinearSystem& system, double step_s, int halvings,
                                    bool with_middle) {
  ChainExponential<Scalar> to(system, std::ldexp(step_s, with_middle ? -halvings - 1 : -halvings));
  std::vector<StepPropagators> made(static_cast<std::size_t>(halvings) + 1);
  for (std::size_t level = made.size(); level-- > 0;) {
    if (with_middle) {
      made[level].middle = to.over(0.5);
      to.double_length();
    }
    made[level].end = to.over(1.0);
    if (!with_middle && level > 0) to.double_length();
  }
  return made;
}

}  // namespace

Propagator propagator(const LinearSystem& system, double step_s, Precision precision) {
  return halved_propagators(system, step_s, 0, false, precision).front().end;
}

std::vector<StepPropagators> halved_propagators(const LinearSystem& system, double step_s,
                                                int halvings, bool with_middle,
                                                Precision precision) {
  if (precision == Precision::extended && chain_size(system) <= kMostExtendedRows) {
    return halved<long double>(system, step_s, halvings, with_middle);
  }
  return halved<double>(system, step_s, halvings, with_middle);
}

}  // namespace flexarm::response
