#include "response/time/step_table.hpp"

#include <algorithm>
#include <cmath>

namespace flexarm::response {

namespace {

/// e^(|A| dt) by its series: every term is positive, so nothing cancels.
Eigen::MatrixXd growth(const Eigen::MatrixXd& a, double step_s) {
  const Eigen::MatrixXd size = a.cwiseAbs() * step_s;
  Eigen::MatrixXd term = Eigen::MatrixXd::Identity(a.rows(), a.cols());
  Eigen::MatrixXd sum = term;
  for (int k = 1; term.maxCoeff() > 1e-17 * sum.maxCoeff(); ++k) {
    term = (term * size / k).eval();
    sum += term;
  }
  return sum;
}

}  // namespace

SagBound::SagBound(const LinearSystem& system, const Reading& reading, double step_s) {
  const double h = step_s;
  const Eigen::RowVectorXd ca = reading.state * system.a;
  const Eigen::RowVectorXd caa = (ca * system.a).cwiseAbs() * growth(system.a, h);
  const double factor = h * h / 8.0;
  by_state_ = factor * caa.transpose();
  by_torque_ =
      factor * (h * caa.dot(system.actuator.cwiseAbs()) + std::abs(ca.dot(system.actuator)));
  by_torque_change_ = h / 8.0 * std::abs(reading.state.dot(system.actuator));
  by_force_ =
      factor * (h * caa * system.force.cwiseAbs() + (ca * system.force).cwiseAbs()).transpose();
  by_force_slope_ = h / 8.0 * (reading.state * system.force).cwiseAbs().transpose();
  by_force_curvature_ = 0.125 * reading.force.cwiseAbs().transpose();
}

double SagBound::operator()(const Eigen::VectorXd& x0, const StepInputs& inputs) const {
  // A parabola through three values within +-F stays within 5/4 F; its slope is largest at an end.
  const Eigen::VectorXd force =
      1.25 * inputs.f0.cwiseAbs().cwiseMax(inputs.fm.cwiseAbs()).cwiseMax(inputs.f1.cwiseAbs());
  const Eigen::VectorXd curvature = 2.0 * inputs.force_square();
  const Eigen::VectorXd begin = inputs.force_slope();
  const Eigen::VectorXd slope = begin.cwiseAbs().cwiseMax((begin + curvature).cwiseAbs());
  return by_state_.dot(x0.cwiseAbs()) +
         by_torque_ * std::max(std::abs(inputs.u0), std::abs(inputs.u1)) +
         by_torque_change_ * std::abs(inputs.u1 - inputs.u0) + by_force_.dot(force) +
         by_force_slope_.dot(slope) + by_force_curvature_.dot(curvature.cwiseAbs());
}

StepTable step_table(const LinearSystem& system, const Reading* watched, double step_s,
                     bool forces_vary) {
  StepTable table;
  table.end = propagator(system, step_s);
  if (forces_vary) table.middle = propagator(system, step_s, 0.5);
  table.constant = table.end.constant_force().col(0);
  if (watched != nullptr) table.sag = SagBound(system, *watched, step_s);
  return table;
}

}  // namespace flexarm::response
