#include "arm/uncertainties.hpp"

#include "arm/arm_keys.hpp"
#include "arm/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace flexarm::arm {

namespace {

const ArmKey& key_of(const std::string& name) {
  const auto key = std::ranges::find(arm_keys(), name, &ArmKey::name);
  if (key == arm_keys().end()) throw InputError(fmt::format("{}: unknown key", name), name);
  return *key;
}

/// The number that is used in place of `name`, where the arm gives that too; else "".
std::string used_instead(const std::string& name, const Beam& beam) {
  if (name == "beam.youngs_modulus" && beam.given_flexural_rigidity_N_m2) {
    return "beam.flexural_rigidity";
  }
  if (name == "beam.density" && beam.given_linear_density_kg_per_m) return "beam.linear_density";
  return "";
}

}  // namespace

void require_valid_uncertainties(const Arm& arm) {
  for (const auto& [name, uncertainty] : arm.relative_uncertainties) {
    const std::string key = name + std::string(kUncertaintySuffix);
    const auto value = key_of(name).get(arm);
    if (!(uncertainty > 0.0 && uncertainty < 1.0)) {
      throw InputError(
          fmt::format("{} = {}; must be above 0 and below 1, a relative standard deviation of {}",
                      key, uncertainty, name),
          key);
    }
    if (!value || !(*value > 0.0)) {
      throw InputError(
          fmt::format("{}: relative to {}, which must be given and above 0", key, name), key);
    }
    const std::string used = used_instead(name, arm.beam);
    if (!used.empty()) {
      throw InputError(fmt::format("{}: {} is given too and takes precedence; use {}{}", key, used,
                                   used, kUncertaintySuffix),
                       key);
    }
  }
}

Arm with_deviations(const Arm& arm, std::span<const double> deviations) {
  Arm made = arm;
  if (deviations.empty()) return made;
  auto deviation = deviations.begin();
  for (const auto& [name, uncertainty] : arm.relative_uncertainties) {
    const ArmKey& key = key_of(name);
    key.set(made, *key.get(arm) * std::exp(uncertainty * *deviation++));
  }
  // What a rigidity or a density is used in place of must go on agreeing with it.
  Beam& beam = made.beam;
  if (beam.width_m && beam.thickness_m) {
    const double area_m2 = *beam.width_m * *beam.thickness_m;
    if (beam.youngs_modulus_Pa && beam.given_flexural_rigidity_N_m2) {
      beam.youngs_modulus_Pa =
          *beam.given_flexural_rigidity_N_m2 * 12.0 / (area_m2 * std::pow(*beam.thickness_m, 2));
    }
    if (beam.density_kg_per_m3 && beam.given_linear_density_kg_per_m) {
      beam.density_kg_per_m3 = *beam.given_linear_density_kg_per_m / area_m2;
    }
  }
  return made;
}

}  // namespace flexarm::arm
