#include "response/time/simulator_commands.hpp"

#include "arm/input_error.hpp"
#include "response/time/simulation_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace flexarm::response {

using Eigen::Index;

ArmSimulator::Commands::Commands(const ArmSimulator& arm, std::span<const double> torque_N_m)
    : arm_(&arm), torque_N_m_(torque_N_m) {
  require_simulable(arm.parts_, torque_N_m, arm.options_);
  make_path();
}

ArmSimulator::Commands::Commands(const ArmSimulator& arm, const ClosedLoop& loop)
    : arm_(&arm), loop_(&loop), made_N_m_(loop.reference.size()), torque_N_m_(made_N_m_) {
  const auto& options = arm.options_;
  require_options(options);
  if (options.hold != TorqueHold::zero) {
    throw arm::InputError("torque hold: must be zero-order in a closed loop");
  }
  if (arm.parts_.actuator.delay_s < 0.0) {
    throw arm::out_of_range("closed loop: delay of the torque", arm.parts_.actuator.delay_s, "s",
                            "0 or more, as the command is not known before");
  }
  if (loop.reference.empty()) throw arm::InputError("reference: there are no samples");
  for (std::size_t k = 0; k < loop.reference.size(); ++k) {
    if (std::isfinite(loop.reference[k])) continue;
    throw arm::InputError(
        fmt::format("reference = {} at sample {} (from 0): must be finite", loop.reference[k], k));
  }
  arm::require_valid(loop.controller);
  for (const arm::Sensor& sensor : loop.controller.sensors) {
    const auto found = std::ranges::find(arm.sensors_, sensor);
    if (found == arm.sensors_.end()) {
      throw arm::InputError(
          fmt::format("controller: its sensor {} is not simulated", arm::to_string(sensor)));
    }
    places_.push_back(static_cast<std::size_t>(found - arm.sensors_.begin()));
  }
  period_ =
      static_cast<std::size_t>(arm::samples_per_period(loop.controller, options.sample_time_s));
  run_.emplace(loop.controller, static_cast<double>(period_) * options.sample_time_s,
               loop.controller_state);
  read_ = arm.unread(torque_N_m_.size());
  now_.resize(places_.size());
  readings_.emplace(arm.arm_, arm.parts_, arm.sensors_);
  make_path();
  plan_.emplace(arm.times_, places_, *path_, torque_N_m_.size());
}

ReadingPlan ArmSimulator::Commands::reading_plan() const {
  std::vector<std::size_t> all(arm_->sensors_.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return {arm_->times_, all, *path_, torque_N_m_.size()};
}

void ArmSimulator::Commands::make_path() {
  const auto& options = arm_->options_;
  path_.emplace(arm_->parts_.actuator, torque_N_m_, options.sample_time_s, options.hold,
                arm_->times_.cuts());
}

void ArmSimulator::Commands::look(const ReadingInstant& now, const TimeStepper& stepper) {
  if (loop_ == nullptr) return;
  plan_->at(now, stepper, *readings_, [this](std::size_t j, std::size_t k, double reading) {
    read_(static_cast<Index>(k), static_cast<Index>(j)) = reading;
  });
}

void ArmSimulator::Commands::reach(std::size_t k) {
  if (loop_ == nullptr) return;
  if (k % period_ != 0) {
    made_N_m_[k] = made_N_m_[k - 1];
    return;
  }
  for (std::size_t i = 0; i < places_.size(); ++i) {
    now_[i] = read_(static_cast<Index>(k), static_cast<Index>(places_[i]));
  }
  made_N_m_[k] = run_->command(loop_->reference[k], now_);
  const double sample_time_s = arm_->options_.sample_time_s;
  if (!std::isfinite(made_N_m_[k])) {
    throw too_large("torque of the controller", static_cast<double>(k) * sample_time_s);
  }
  require_command(arm_->parts_, made_N_m_[k], k, sample_time_s);
}

}  // namespace flexarm::response
