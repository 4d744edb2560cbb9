#include "compare/sweeps/sweep_parameter.hpp"

#include "arm/arm_keys.hpp"
#include "arm/effects.hpp"
#include "arm/input_error.hpp"
#include "arm/linear_arm.hpp"
#include "arm/nearest_name.hpp"
#include "effects/registry/vocabulary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>

namespace flexarm::compare {

namespace {

constexpr int kNumbers = 0;
constexpr int kEffects = 1;
constexpr int kMassRatio = 2;
constexpr int kInertiaRatio = 3;  // the payload's inertia about the tip holds its mass

bool has_section(const arm::Beam& beam) {
  return beam.width_m.has_value() && beam.thickness_m.has_value();
}

/// Leaves out what `leaf` of the beam contradicts from now on.
void drop_what_is_given_twice(arm::Beam& beam, const std::string& leaf) {
  const bool section = leaf == "width" || leaf == "thickness";
  if ((section || leaf == "youngs_modulus") && has_section(beam) && beam.youngs_modulus_Pa) {
    beam.given_flexural_rigidity_N_m2.reset();
  }
  if ((section || leaf == "density") && has_section(beam) && beam.density_kg_per_m3) {
    beam.given_linear_density_kg_per_m.reset();
  }
  if (leaf == "flexural_rigidity") beam.youngs_modulus_Pa.reset();
  if (leaf == "linear_density") beam.density_kg_per_m3.reset();
}

SweepParameter number(const arm::ArmKey& key) {
  return {key.name(), key.unit, key.range, kNumbers, [key](arm::Arm& arm, double value) {
            key.set(arm, value);
            if (key.table == "beam") drop_what_is_given_twice(arm.beam, key.leaf);
          }};
}

SweepParameter effect_parameter(const std::shared_ptr<const arm::EffectDefinition>& effect,
                                const arm::EffectParameter& parameter) {
  return {fmt::format("effects.{}.{}", effect->name, parameter.name), parameter.unit,
          parameter.range, kEffects, [effect, name = parameter.name](arm::Arm& arm, double value) {
            arm::Effect& swept = arm.effects[effect->name];
            swept.definition = effect;
            swept.parameters[name] = value;
          }};
}

/// Throws unless a body's own share, what is left of a total once effects have theirs, is possible.
double own_share(const char* ratio, double value, double share) {
  // Cancellation of equal numbers may leave a rounding error below zero.
  constexpr double kRounding = 1e-15;
  if (share < -kRounding) {
    throw arm::InputError(
        fmt::format("{} = {}: below the value that the effects alone produce", ratio, value),
        ratio);
  }
  return std::max(share, 0.0);
}

double beam_mass_kg(const arm::LinearArm& arm) {
  return arm.linear_density_kg_per_m * arm.length_m;
}

void set_payload_mass_ratio(arm::Arm& arm, double eta) {
  arm.payload.mass_kg = 0.0;
  const auto linear = arm::linear_arm(arm);
  const double mass_kg = beam_mass_kg(linear);
  const double share = own_share("payload_mass_ratio", eta, eta - linear.payload_mass_kg / mass_kg);
  arm.payload.mass_kg = share * mass_kg;
}

void set_payload_inertia_ratio(arm::Arm& arm, double ratio) {
  arm.payload.inertia_kg_m2 = 0.0;
  const auto linear = arm::linear_arm(arm);
  const double inertia_kg_m2 = beam_mass_kg(linear) * linear.length_m * linear.length_m;
  const double share = own_share("payload_inertia_ratio", ratio,
                                 ratio - linear.payload_tip_inertia_kg_m2 / inertia_kg_m2);
  arm.payload.inertia_kg_m2 = share * inertia_kg_m2;
}

void set_hub_inertia_ratio(arm::Arm& arm, double epsilon) {
  arm.hub.inertia_kg_m2 = 1.0;
  const auto linear = arm::linear_arm(arm);
  const double factor = linear.hub_inertia_kg_m2;
  arm.hub.inertia_kg_m2 =
      epsilon * beam_mass_kg(linear) * linear.length_m * linear.length_m / factor;
}

std::vector<SweepParameter> every_parameter() {
  std::vector<SweepParameter> all;
  for (const auto& key : arm::arm_keys()) all.push_back(number(key));
  all.push_back({"payload_mass_ratio", "1", arm::kNotNegative, kMassRatio, set_payload_mass_ratio});
  all.push_back(
      {"payload_inertia_ratio", "1", arm::kNotNegative, kInertiaRatio, set_payload_inertia_ratio});
  all.push_back({"hub_inertia_ratio", "1", arm::kNotNegative, kMassRatio, set_hub_inertia_ratio});
  for (const auto& effect : effects::vocabulary()) {
    if (!effect->is_of_linear_arm()) continue;
    for (const auto& parameter : effect->parameters) {
      all.push_back(effect_parameter(effect, parameter));
    }
  }
  return all;
}

std::string full_name(std::string_view typed) {
  if (typed == "eta") return "payload_mass_ratio";
  if (typed == "epsilon") return "hub_inertia_ratio";
  return std::string(typed);
}

/// " (did you mean ...?)": a symbol of the equations, a name without its table, or misspelt.
std::string meant(const std::string& typed, const std::vector<std::string>& names) {
  std::vector<std::string> likely;
  for (const auto& key : arm::arm_keys()) {
    if (key.symbol == typed) likely.push_back(key.name());
  }
  for (const auto& name : names) {
    if (name.ends_with("." + typed) || name.starts_with(typed + ".") ||
        name.starts_with("effects." + typed + ".")) {
      likely.push_back(name);
    }
  }
  return likely.empty() ? arm::did_you_mean(typed, names)
                        : fmt::format(" (did you mean {}?)", fmt::join(likely, " or "));
}

/// The effect in "effects.NAME.PARAMETER", or null.
std::shared_ptr<const arm::EffectDefinition> effect_in(const std::string& name) {
  constexpr std::string_view kTable = "effects.";
  if (!name.starts_with(kTable)) return nullptr;
  const auto rest = std::string_view(name).substr(kTable.size());
  return arm::find_effect(effects::vocabulary(), rest.substr(0, rest.find('.')));
}

}  // namespace

std::vector<std::string> sweep_parameter_names() {
  std::vector<std::string> names;
  for (const auto& parameter : every_parameter()) names.push_back(parameter.name);
  return names;
}

SweepParameter sweep_parameter(std::string_view typed) {
  static const std::vector<SweepParameter> all = every_parameter();
  const std::string name = full_name(typed);
  const auto found = std::ranges::find(all, name, &SweepParameter::name);
  if (found != all.end()) return *found;
  const auto effect = effect_in(name);
  if (effect != nullptr && !effect->is_of_linear_arm()) {
    throw arm::InputError(
        fmt::format("{}: no influence on poles and zeros: {} is not a linear effect",
                    arm::shown(name), effect->name));
  }
  throw arm::InputError(
      fmt::format("{}: unknown parameter{}; allowed: keys of an arm file (payload.mass), "
                  "effects.NAME.PARAMETER, payload_mass_ratio (eta), hub_inertia_ratio (epsilon), "
                  "payload_inertia_ratio",
                  arm::shown(name), meant(name, sweep_parameter_names())));
}

arm::Arm arm_at(const arm::Arm& base, std::span<const SweepAxis> axes,
                std::span<const double> places) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < axes.size(); ++k) order.push_back(k);
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return axes[k].parameter.stage; });
  arm::Arm arm = base;
  for (const std::size_t k : order) axes[k].parameter.set(arm, axes[k].at(places[k]));
  return arm;
}

}  // namespace flexarm::compare
