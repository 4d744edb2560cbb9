#include "compare/described_arm.hpp"

#include "arm/input_error.hpp"
#include "arm/linear_arm.hpp"
#include "arm/rigid_hub.hpp"
#include "response/arm_parts.hpp"
#include "response/formulation_maker.hpp"
#include "response/time/simulation.hpp"
#include "response/time/time_model.hpp"

#include <utility>

namespace flexarm::compare {

namespace {

/// Modes above are damped away, or folded to where the checks do not look.
constexpr int kModes = 8;

}  // namespace

measured::DescribedArm described_arm(const arm::Arm& arm) {
  response::ArmParts parts;
  parts.linear = response::take_apart(arm).linear;
  auto formulation = response::make_formulation("fem", parts.linear, kModes);
  return [parts = std::move(parts), formulation = std::move(formulation)](
             std::span<const double> torque_N_m, double period_s,
             std::span<const arm::Sensor> sensors) {
    response::SimulationOptions options;
    options.sample_time_s = period_s;
    options.energy = false;
    options.precision = response::Precision::working;
    try {
      const auto model = response::time_model(formulation, parts, kModes, sensors);
      return response::simulate(model, parts, sensors, torque_N_m, options).channels;
    } catch (const arm::InputError&) {  // strain beyond the tip, a torque that overflows
      return std::vector<std::vector<double>>();
    }
  };
}

measured::DescribedArms described_arms(const arm::Arm& arm) {
  measured::DescribedArms arms;
  arms.payload = arm.payload;
  if (arm::has_beam(arm))
    arms.beam_mass_kg = arm.beam.linear_density_kg_per_m() * arm.beam.length_m;
  arms.with = [arm](const arm::Payload& payload) {
    arm::Arm loaded = arm;
    loaded.payload = payload;
    const arm::LinearArm linear = arm::linear_arm(loaded);
    measured::DataCheckOptions options;
    if (arm::has_beam(arm)) options.length_m = linear.length_m;
    options.total_inertia_kg_m2 = arm::total_inertia_kg_m2(linear);
    try {
      options.described = described_arm(loaded);
    } catch (const arm::InputError&) {
      options.described = {};
    }
    return options;
  };
  return arms;
}

}  // namespace flexarm::compare
