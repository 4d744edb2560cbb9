#include "response/time/propagator.hpp"

#include <unsupported/Eigen/MatrixFunctions>

namespace flexarm::response {

namespace {

/// The first `rows` rows of the exponential.
template <class Scalar>
Eigen::MatrixXd leading_exponential(const Eigen::MatrixXd& chain, Eigen::Index rows) {
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  const Matrix power = chain.cast<Scalar>().exp();
  return power.topRows(rows).template cast<double>();
}

/// More take over some tenths of a second.
constexpr Eigen::Index kMostExtendedRows = 120;

}  // namespace

Propagator propagator(const LinearSystem& system, double step_s, double until,
                      Precision precision) {
  const Eigen::Index n = system.a.rows();
  const Eigen::Index forces = system.force.cols();
  const bool has_rate = system.actuator_rate.size() > 0;
  const Eigen::Index m = 1 + forces + (has_rate ? 1 : 0);
  const double dt = step_s * until;
  Eigen::MatrixXd chain = Eigen::MatrixXd::Zero(n + 3 * m, n + 3 * m);
  chain.topLeftCorner(n, n) = system.a * dt;
  chain.block(0, n, n, 1) = system.actuator * dt;
  chain.block(0, n + 1, n, forces) = system.force * dt;
  if (has_rate) chain.col(n + m - 1).head(n) = system.actuator_rate * until;
  chain.block(n, n + m, m, m).setIdentity();
  chain.block(n + m, n + 2 * m, m, m).setIdentity();
  const bool is_extended = precision == Precision::extended && chain.rows() <= kMostExtendedRows;
  const Eigen::MatrixXd power = is_extended ? leading_exponential<long double>(chain, n)
                                            : leading_exponential<double>(chain, n);

  // An input c0 + c1 s + c2 s^2 in s = t/dt, t from 0 to dt, adds phi_1 c0 + phi_2 c1 + 2 phi_3 c2;
  // on [0, step] it is u0 + (u1 - u0) r and f0 + (-3 f0 + 4 fm - f1) r + (2 f0 - 4 fm + 2 f1) r^2
  // with r = until s.
  const auto u_constant = power.col(n);
  const auto u_linear = power.col(n + m) * until;
  const auto f_constant = power.block(0, n + 1, n, forces);
  const auto f_linear = power.block(0, n + m + 1, n, forces) * until;
  const auto f_square = power.block(0, n + 2 * m + 1, n, forces) * (2.0 * until * until);
  Propagator made;
  made.state = power.leftCols(n);
  made.actuator_begin = u_constant - u_linear;
  made.actuator_end = u_linear;
  if (has_rate) {
    // u' dt = until (u1 - u0).
    made.actuator_begin -= power.col(n + m - 1);
    made.actuator_end += power.col(n + m - 1);
  }
  made.force_begin = f_constant - 3.0 * f_linear + 2.0 * f_square;
  made.force_middle = 4.0 * (f_linear - f_square);
  made.force_end = 2.0 * f_square - f_linear;
  return made;
}

}  // namespace flexarm::response
