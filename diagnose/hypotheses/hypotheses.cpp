#include "diagnose/hypotheses/hypotheses.hpp"

#include <algorithm>
#include <array>

namespace flexarm::diagnose {

namespace {

/// The list, but for sensor_lag, which is one hypothesis a sensor.
constexpr std::array kHypotheses = {
    hub_inertia,          flexural_rigidity,  linear_density, payload_mass,
    payload_inertia,      payload_offset,     hub_radius,     root_compliance,
    local_stiffness_loss, hub_spring,         gravity,        shear_and_rotary_inertia,
    hub_viscous_friction, structural_damping, air_damping,    quadratic_drag,
    coulomb_friction,     stribeck_friction,  torque_gain,    torque_bias,
    torque_saturation,    torque_dead_zone,   torque_ripple,  actuator_lag,
    time_delay,
};

/// Some run has a payload whose mass an offset would move.
bool has_payload_mass(const Experiment& experiment) {
  return std::ranges::any_of(experiment.runs, [&](const auto& run) {
    return arm_in(experiment, run.run).payload.mass_kg > 0.0;
  });
}

bool can_be(const Hypothesis& hypothesis, const Experiment& experiment) {
  const arm::Arm& arm = experiment.arm;
  if (arm.effects.contains(hypothesis.effect)) return false;
  if (hypothesis.effect == "shear_and_rotary_inertia" &&
      !(arm.beam.shear_modulus_Pa && arm.beam.width_m && arm.beam.thickness_m)) {
    return false;
  }
  if (hypothesis.effect == "payload_offset" && !has_payload_mass(experiment)) return false;
  return std::ranges::any_of(experiment.runs,
                             [&](const auto& run) { return hypothesis.shows_in(run.run.kind); });
}

}  // namespace

std::vector<Hypothesis> hypotheses(const Experiment& experiment) {
  const Scales scales = scales_of(experiment);
  std::vector<Hypothesis> all;
  for (const auto make : kHypotheses) all.push_back(make(scales));
  for (const arm::Sensor& sensor : scales.sensors) all.push_back(sensor_lag(scales, sensor));
  std::erase_if(all, [&](const Hypothesis& entry) { return !can_be(entry, experiment); });
  return all;
}

}  // namespace flexarm::diagnose
