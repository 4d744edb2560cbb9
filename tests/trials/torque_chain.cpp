#include "tests/trials/torque_chain.hpp"

#include <algorithm>
#include <cmath>

namespace flexarm::trials {

namespace {

/// Times are whole steps to rounding; an instant within this part of a sample counts as reached.
constexpr double kReached_samples = 1e-7;

}  // namespace

TorqueChain::TorqueChain(const TrueArm& arm, std::span<const double> torque_N_m,
                         double sample_time_s)
    : torque_N_m_(torque_N_m),
      sample_time_s_(sample_time_s),
      delay_s_(arm.torque_delay_s),
      curves_(arm.torque_curves),
      lag_s_(arm.torque_lag_s),
      bias_N_m_(arm.torque_bias_N_m) {
  std::ranges::stable_sort(curves_, {}, &TrueArm::TorqueCurve::order);
}

double TorqueChain::clipped_command(double time_s) const {
  const double sample = std::floor((time_s - delay_s_) / sample_time_s_ + kReached_samples);
  if (sample < 0.0) return 0.0;
  const std::size_t index = std::min(static_cast<std::size_t>(sample), torque_N_m_.size() - 1);
  double torque = torque_N_m_[index];
  for (const auto& curve : curves_) torque = curve.torque_N_m(torque);
  return torque;
}

double TorqueChain::mean_command(double from_s, double step_s) const {
  const double first = clipped_command(from_s);
  if (delay_s_ == 0.0) return first;
  const double into_sample = (from_s - delay_s_) / sample_time_s_ + kReached_samples;
  const double change_s = (std::ceil(into_sample) - into_sample) * sample_time_s_;
  if (change_s >= step_s) return first;
  return (first * change_s + clipped_command(from_s + step_s) * (step_s - change_s)) / step_s;
}

double TorqueChain::advance(double from_s, double step_s) {
  const double command = mean_command(from_s, step_s);
  if (lag_s_ == 0.0) return command + bias_N_m_;
  // T' = (command - T)/lag, solved exactly, and its mean.
  const double decay = std::exp(-step_s / lag_s_);
  const double start = lagged_N_m_ - command;
  lagged_N_m_ = command + start * decay;
  return command + start * (1.0 - decay) * lag_s_ / step_s + bias_N_m_;
}

double TorqueChain::now(double time_s) const {
  return bias_N_m_ + (lag_s_ == 0.0 ? clipped_command(time_s) : lagged_N_m_);
}

}  // namespace flexarm::trials
