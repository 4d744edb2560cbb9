#include "compare/described_arm.hpp"

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
    const auto model = response::time_model(formulation, parts, kModes, sensors);
    return response::simulate(model, parts, sensors, torque_N_m, options).channels;
  };
}

}  // namespace flexarm::compare
