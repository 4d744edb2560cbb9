#include "response/time/controller_run.hpp"

#include "arm/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

namespace flexarm::response {

std::size_t controller_states(const arm::Controller& controller) {
  const auto* matrices = std::get_if<arm::StateSpaceController>(&controller.law);
  return matrices == nullptr ? 1 : matrices->a.size();
}

ControllerRun::ControllerRun(const arm::Controller& controller, double period_s,
                             std::span<const double> state)
    : controller_(&controller),
      period_s_(period_s),
      state_(state.begin(), state.end()),
      next_(controller_states(controller)) {
  if (state_.empty()) state_.assign(next_.size(), 0.0);
  if (state_.size() != next_.size()) {
    throw arm::InputError(fmt::format("state of the controller: {} numbers; must be {}",
                                      state_.size(), next_.size()));
  }
  for (const double value : state_) {
    if (!std::isfinite(value)) {
      throw arm::out_of_range("state of the controller", value, "", "finite");
    }
  }
}

double ControllerRun::command(double reference, std::span<const double> readings) {
  return std::visit([&](const auto& law) { return of(law, reference, readings); },
                    controller_->law);
}

double ControllerRun::limited(double torque_N_m) const {
  if (!controller_->limit_N_m) return torque_N_m;
  return std::clamp(torque_N_m, -*controller_->limit_N_m, *controller_->limit_N_m);
}

double ControllerRun::of(const arm::PidController& law, double reference,
                         std::span<const double> readings) {
  const double error = reference - readings.front();
  const bool is_of_error = law.derivative == arm::PidController::Derivative::error;
  const double differentiated = is_of_error ? error : -readings.front();
  const double rate = is_first_ ? 0.0 : (differentiated - last_) / period_s_;
  is_first_ = false;
  last_ = differentiated;

  double& integral_N_m = state_.front();
  const double increment_N_m = law.ki * period_s_ * error;
  const double others_N_m = law.kp * error + law.kd * rate;
  const double torque_N_m = others_N_m + (integral_N_m + increment_N_m);
  const bool is_limited = controller_->limit_N_m && std::abs(torque_N_m) > *controller_->limit_N_m;
  if (is_limited && increment_N_m * torque_N_m > 0.0) return limited(others_N_m + integral_N_m);
  integral_N_m += increment_N_m;
  return limited(torque_N_m);
}

double ControllerRun::of(const arm::StateSpaceController& law, double reference,
                         std::span<const double> readings) {
  // A row of B or D times (reference, readings), or of A or C times the state.
  const auto of_inputs = [&](const std::vector<double>& row) {
    double sum = row.front() * reference;
    for (std::size_t j = 0; j < readings.size(); ++j) sum += row[j + 1] * readings[j];
    return sum;
  };
  const auto of_state = [&](const std::vector<double>& row) {
    double sum = 0.0;
    for (std::size_t j = 0; j < state_.size(); ++j) sum += row[j] * state_[j];
    return sum;
  };
  const double torque_N_m = of_state(law.c.front()) + of_inputs(law.d.front());
  for (std::size_t i = 0; i < state_.size(); ++i) {
    next_[i] = of_state(law.a[i]) + of_inputs(law.b[i]);
  }
  std::swap(state_, next_);
  return limited(torque_N_m);
}

}  // namespace flexarm::response
