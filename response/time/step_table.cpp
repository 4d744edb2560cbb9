#include "response/time/step_table.hpp"

#include <unsupported/Eigen/MatrixFunctions>

#include <algorithm>
#include <cmath>

namespace flexarm::response {

namespace {

using Eigen::Index;

/// e^|G| by its series: every term is positive, so nothing cancels.
Eigen::MatrixXd growth(const Eigen::MatrixXd& g) {
  const Eigen::MatrixXd size = g.cwiseAbs();
  Eigen::MatrixXd term = Eigen::MatrixXd::Identity(g.rows(), g.cols());
  Eigen::MatrixXd sum = term;
  for (int k = 1; term.maxCoeff() > 1e-17 * sum.maxCoeff(); ++k) {
    term = (term * size / k).eval();
    sum += term;
  }
  return sum;
}

/// Z(0) in the units of r = t/dt.
Eigen::VectorXd extended(const Eigen::VectorXd& x0, const StepInputs& inputs, Index size) {
  const Index n = x0.size();
  const Index m = (size - n - 2) / 3;
  Eigen::VectorXd z = Eigen::VectorXd::Zero(size);
  z.head(n) = x0;
  z(n) = inputs.u0;
  z(n + 1) = inputs.u1 - inputs.u0;
  z.segment(n + 2, inputs.f0.size()) = inputs.f0;
  z.segment(n + 2 + m, inputs.f0.size()) = inputs.force_slope();
  z.segment(n + 2 + 2 * m, inputs.f0.size()) = 2.0 * inputs.force_square();
  return z;
}

}  // namespace

WatchBound::WatchBound(const LinearSystem& system, const Reading& reading, double step_s,
                       int parts) {
  const Index n = system.a.rows();
  const Index m = system.force.cols();
  const Index size = n + 2 + 3 * m;
  // Per unit of r over the whole step, then of one part.
  Eigen::MatrixXd g = Eigen::MatrixXd::Zero(size, size);
  g.topLeftCorner(n, n) = system.a * step_s;
  g.col(n).head(n) = system.actuator * step_s;
  g.block(0, n + 2, n, m) = system.force * step_s;
  // The reading does not depend on W: its rates, however large, need no bound.
  g(system.lagged_readings, Eigen::all).setZero();
  if (system.actuator_rate.size() > 0) g.col(n + 1).head(n) = system.actuator_rate;
  g(n, n + 1) = 1.0;
  g.block(n + 2, n + 2 + m, m, m).setIdentity();
  g.block(n + 2 + m, n + 2 + 2 * m, m, m).setIdentity();
  Eigen::RowVectorXd c = Eigen::RowVectorXd::Zero(size);
  c.head(n) = reading.state;
  c(n) = reading.actuator;
  c.segment(n + 2, m) = reading.force;
  g /= parts;
  const Eigen::RowVectorXd bound = ((c * g) * g).cwiseAbs() * growth(g) / 8.0;
  const Eigen::MatrixXd over = g.exp();
  values_.resize(parts + 1, size);
  sags_.resize(parts, size);
  Eigen::MatrixXd power = Eigen::MatrixXd::Identity(size, size);
  for (Index k = 0; k < parts; ++k) {
    values_.row(k) = c * power;
    sags_.row(k) = bound * power.cwiseAbs();
    power = (over * power).eval();
  }
  values_.row(parts) = c * power;
}

bool WatchBound::stays_above(double least, double sign, const Eigen::VectorXd& x0,
                             const StepInputs& inputs) const {
  const Eigen::VectorXd z = extended(x0, inputs, values_.cols());
  const Eigen::ArrayXd values = sign * (values_ * z).array();
  const Eigen::ArrayXd sags = (sags_ * z.cwiseAbs()).array();
  const Index parts = sags.size();
  return (values.head(parts).min(values.tail(parts)) - sags > least).all();
}

StepTable step_table(const LinearSystem& system, const Reading* watched, double step_s, int parts,
                     bool forces_vary, Precision precision) {
  StepTable table;
  table.end = propagator(system, step_s, 1.0, precision);
  if (forces_vary) table.middle = propagator(system, step_s, 0.5, precision);
  table.constant = table.end.constant_force().col(0);
  if (watched != nullptr) table.watched = WatchBound(system, *watched, step_s, parts);
  return table;
}

}  // namespace flexarm::response
