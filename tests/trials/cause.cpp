#include "tests/trials/cause.hpp"

#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"
#include "tests/trials/every_cause.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace flexarm::trials {

namespace {

/// Torques of a case against the lowest root mean square (experiment_plan.cpp).
constexpr double kTypicalTorque = 2.0;
constexpr double kPeakTorque = 12.0;

}  // namespace

NaturalSizes::NaturalSizes(const TrialArm& of) {
  const TrueArm arm = true_arm(of.arm);
  length_m = arm.length_m;
  thickness_m = arm.thickness_m.value();
  beam_kg = arm.linear_density_kg_per_m * length_m;
  spring_N_m_per_rad = arm.flexural_rigidity_N_m2 / length_m;
  omega_rad_per_s = std::sqrt(spring_N_m_per_rad / (beam_kg * length_m * length_m));
  inertia_kg_m2 = arm.hub_inertia_kg_m2 + beam_kg * length_m * length_m / 3.0 +
                  arm.payload_kg * length_m * length_m + arm.payload_inertia_kg_m2;
  torque_N_m = kTypicalTorque * of.low_torque_N_m;
  peak_N_m = kPeakTorque / kTypicalTorque * torque_N_m;
}

Parameters changed_factor(const NaturalSizes& /*natural*/, double size, const Chance& chance) {
  return {{"factor", std::exp(chance.sign * size)}};
}

bool Cause::shows_in(measured::RunKind kind) const {
  if (kind == measured::RunKind::frf) return shown_in != ShownIn::time;
  return kind == measured::RunKind::time || (shown_in == ShownIn::all && !acts_on_gauge);
}

const std::vector<Cause>& causes() {
  static const std::vector<Cause> all = [] {
    std::vector<Cause> made = every_cause();
    const auto key = [](const Cause& cause) {
      return std::tie(cause.outside, cause.acts_on, cause.name);
    };
    std::ranges::sort(made, [&](const Cause& a, const Cause& b) { return key(a) < key(b); });
    return made;
  }();
  return all;
}

const Cause& find_cause(const std::string& name) {
  const auto found = std::ranges::find(causes(), name, &Cause::name);
  if (found != causes().end()) return *found;
  std::vector<std::string> names;
  for (const auto& cause : causes()) names.push_back(cause.name);
  throw arm::InputError(
      fmt::format("{}: no cause that can be hidden{}", name, arm::did_you_mean(name, names)));
}

}  // namespace flexarm::trials
