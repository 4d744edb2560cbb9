#include "diagnose/search/hypothesis.hpp"

#include "arm/effects.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

namespace flexarm::diagnose {

namespace {

/// No spring is stiffer, relative to the stiffest that is looked for.
constexpr double kRigid = 1e4;

/// 0 at place 0 and `high` at 1: even steps below `low`, equal ratios above.
double growing(double place, double low, double high) {
  return low * std::expm1(std::max(0.0, place) * std::log1p(high / low));
}

double growing_place(double value, double low, double high) {
  return std::log1p(value / low) / std::log1p(high / low);
}

}  // namespace

double SearchedParameter::value(double place) const {
  switch (spacing) {
    case Spacing::linear:
      return lowest + place * (highest - lowest);
    case Spacing::logarithmic:
      return lowest * std::pow(highest / lowest, place);
    case Spacing::from_zero:
      return growing(place, lowest, highest);
    case Spacing::from_infinity:
      return 1.0 / std::max(growing(place, 1.0 / highest, 1.0 / lowest), 1.0 / (kRigid * highest));
  }
  return lowest;
}

double SearchedParameter::place(double value) const {
  switch (spacing) {
    case Spacing::linear:
      return (value - lowest) / (highest - lowest);
    case Spacing::logarithmic:
      return std::log(value / lowest) / std::log(highest / lowest);
    case Spacing::from_zero:
      return growing_place(value, lowest, highest);
    case Spacing::from_infinity:
      return growing_place(1.0 / value, 1.0 / highest, 1.0 / lowest);
  }
  return 0.0;
}

std::optional<double> SearchedParameter::neutral_place() const {
  if (spacing == Spacing::from_zero || spacing == Spacing::from_infinity) return 0.0;
  if (!neutral) return std::nullopt;
  return place(*neutral);
}

std::string Hypothesis::label() const {
  return sensor.empty() ? effect : effect + " on " + sensor;
}

bool Hypothesis::shows_in(measured::RunKind kind) const {
  switch (kind) {
    case measured::RunKind::time:
      return true;
    case measured::RunKind::frf:
      return shows != Shows::in_time;
    case measured::RunKind::modal:
      return shows == Shows::in_all;
  }
  return false;
}

std::string unit_of(const Hypothesis& hypothesis, const SearchedParameter& parameter) {
  const auto& parameters = arm::find_effect(hypothesis.effect)->parameters;
  return std::ranges::find(parameters, parameter.name, &arm::EffectParameter::name)->unit;
}

arm::Arm extended(const arm::Arm& arm, const Hypothesis& hypothesis,
                  std::span<const double> values) {
  arm::Arm made = arm;
  arm::Effect effect;
  effect.sensor = hypothesis.sensor;
  for (std::size_t i = 0; i < values.size(); ++i) {
    effect.parameters[hypothesis.parameters[i].name] = values[i];
  }
  made.effects[hypothesis.effect] = effect;
  return made;
}

Scales scales_of(const Experiment& experiment) {
  Scales scales;
  scales.beam = arm::linear_arm(experiment.arm);
  double squares = 0.0;
  double samples = 0.0;
  double speed_squares = 0.0;
  double highest_Hz = 0.0;
  double period_s = 0.0;
  const auto see = [&scales](const arm::Sensor& sensor) {
    if (std::ranges::find(scales.sensors, sensor) == scales.sensors.end()) {
      scales.sensors.push_back(sensor);
    }
  };
  for (const auto& [run, data] : experiment.runs) {
    if (const auto* record = std::get_if<measured::TimeRecord>(&data)) {
      const double step = measured::sampling_period_s(*record);
      const double inertia = arm::total_inertia_kg_m2(arm_in(experiment, run));
      period_s = period_s > 0.0 ? std::min(period_s, step) : step;
      double speed = 0.0;
      for (const double torque : record->torque_N_m) {
        squares += torque * torque;
        speed += torque * step / inertia;
        speed_squares += speed * speed;
        scales.torque_peak_N_m = std::max(scales.torque_peak_N_m, std::abs(torque));
      }
      samples += static_cast<double>(record->torque_N_m.size());
      for (const auto& channel : record->channels) see(channel.sensor);
    } else if (const auto* frequency = std::get_if<measured::FrequencyRecord>(&data)) {
      for (const auto& channel : frequency->channels) {
        see(channel.sensor);
        highest_Hz = std::max(highest_Hz, channel.frequency_Hz.back());
      }
    }
  }
  if (samples > 0.0) {
    scales.torque_rms_N_m = std::sqrt(squares / samples);
    scales.speed_rms_rad_per_s = std::sqrt(speed_squares / samples);
    scales.shortest_time_s = 0.5 * period_s;
  } else if (highest_Hz > 0.0) {
    scales.shortest_time_s = 1.0 / (20.0 * highest_Hz);
  }
  return scales;
}

}  // namespace flexarm::diagnose
