#include "compare/described_arm.hpp"

#include "arm/input_error.hpp"
#include "arm/linear_arm.hpp"
#include "arm/rigid_hub.hpp"
#include "effects/registry/vocabulary.hpp"
#include "response/arm_parts.hpp"
#include "response/formulation_maker.hpp"
#include "response/time/arm_simulator.hpp"
#include "response/time/simulation.hpp"
#include "response/time/time_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::compare {

namespace {

/// Modes above are damped away, or folded to where the checks do not look.
constexpr int kModes = 8;

/// An effect with the parameter that says how large it is.
struct VariedEffect {
  std::string name;
  std::vector<effects::SearchedParameter> parameters;
  std::size_t sized = 0;
};

effects::Scales scales_of(const arm::Arm& arm, std::span<const double> torque_N_m,
                          double period_s) {
  effects::Scales scales;
  scales.arm = arm;
  scales.beam = arm::linear_arm(arm);
  scales.has_payload_mass = arm.payload.mass_kg > 0.0;
  scales.shortest_time_s = 0.5 * period_s;
  effects::TorqueScales torques;
  torques.add(torque_N_m, period_s, arm::total_inertia_kg_m2(scales.beam));
  torques.put(scales);
  return scales;
}

bool acts_on_a_recording(const arm::EffectDefinition& effect) {
  return std::ranges::any_of(effect.ports(), [](arm::Port port) {
    return port == arm::Port::torque_path || port == arm::Port::sensor_path ||
           port == arm::Port::sensor_place;
  });
}

std::vector<VariedEffect> varied_effects(const effects::Scales& scales) {
  std::vector<VariedEffect> varied;
  for (const effects::Entry& entry : effects::entries()) {
    const std::string& name = entry.definition->name;
    if (acts_on_a_recording(*entry.definition) || scales.arm.effects.contains(name)) continue;
    if (entry.applies && !entry.applies(scales)) continue;
    VariedEffect effect{name, entry.search(scales)};
    const auto sized = std::ranges::find_if(
        effect.parameters,
        [](const effects::SearchedParameter& one) { return one.neutral_coordinate().has_value(); });
    if (sized == effect.parameters.end()) continue;
    effect.sized = static_cast<std::size_t>(sized - effect.parameters.begin());
    varied.push_back(std::move(effect));
  }
  return varied;
}

arm::Arm with_effect(arm::Arm arm, const VariedEffect& effect, double size) {
  std::vector<double> places(effect.parameters.size(), 0.5);
  places[effect.sized] = size;
  const std::vector<double> values = effects::values_at(effect.parameters, places);
  std::map<std::string, double> parameters;
  for (std::size_t i = 0; i < values.size(); ++i) {
    parameters[effect.parameters[i].name] = values[i];
  }
  effects::put(arm, effect.name, parameters);
  return arm;
}

/// With its laws of the hub and its forces along the beam, as the simulation of a fit.
measured::DescribedArm varied_arm(const arm::Arm& arm) {
  response::ArmParts parts = response::take_apart(arm);
  parts.actuator = {};
  parts.sensor_chains = {};
  return [parts = std::move(parts)](std::span<const double> torque_N_m, double period_s,
                                    std::span<const arm::Sensor> sensors) {
    const auto options = response::options_of_fit(period_s, response::TorqueHold::zero);
    std::vector<std::vector<double>> readings;
    try {
      const auto model =
          response::time_model(response::formulation_of_fit(parts.linear), parts, kModes, sensors);
      readings = response::simulate(model, parts, sensors, torque_N_m, options).channels;
    } catch (const std::runtime_error&) {
      // An arm that is none, or whose equations no step solves.
    }
    return readings;
  };
}

}  // namespace

measured::ArmVariations arm_variations(const arm::Arm& arm, std::span<const double> torque_N_m,
                                       double period_s) {
  auto varied = varied_effects(scales_of(arm, torque_N_m, period_s));
  const std::size_t count = varied.size();
  return {count,
          [arm, varied = std::move(varied)](
              std::span<const measured::ArmVariation> variations) -> measured::DescribedArm {
            try {
              arm::Arm made = arm;
              for (const auto& [effect, size] : variations) {
                made = with_effect(std::move(made), varied[effect], size);
              }
              return varied_arm(made);
            } catch (const arm::InputError&) {
              return {};
            }
          }};
}

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
      options.variations = [loaded](std::span<const double> torque_N_m, double period_s) {
        return arm_variations(loaded, torque_N_m, period_s);
      };
    } catch (const arm::InputError&) {
      options.described = {};
    }
    return options;
  };
  return arms;
}

}  // namespace flexarm::compare
