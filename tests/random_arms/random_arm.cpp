#include "tests/random_arms/random_arm.hpp"

#include "effects/registry/vocabulary.hpp"
#include "tests/trials/random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace flexarm::random_arms {

namespace {

double spread_about(trials::Random& random, double usual) {
  return usual * std::pow(10.0, random.uniform(-kDecades / 2.0, kDecades / 2.0));
}

/// A part of the whole, or what a part leaves of it.
double part(trials::Random& random) {
  const double small = std::pow(10.0, random.uniform(-kDecades, 0.0));
  return random.uniform() < 0.5 ? small : 1.0 - small;
}

double parameter(trials::Random& random, const arm::EffectParameter& parameter, double length_m) {
  if (parameter.name == "position") return part(random) * length_m;
  if (parameter.name == "rotor_share") return part(random);
  const double size = spread_about(random, std::abs(parameter.example));
  return parameter.range.contains(-1.0) ? random.sign() * size : size;
}

std::vector<std::shared_ptr<const arm::EffectDefinition>> linear_effects() {
  std::vector<std::shared_ptr<const arm::EffectDefinition>> linear;
  for (const auto& definition : effects::vocabulary()) {
    if (definition->is_of_linear_arm() && !definition->sensor) linear.push_back(definition);
  }
  return linear;
}

}  // namespace

arm::Arm random_arm(std::uint64_t seed, std::uint64_t index) {
  trials::Random random(seed, fmt::format("arm {}", index));
  const auto about = [&random](double usual) { return spread_about(random, usual); };
  const auto half_the_time = [&](double usual) {
    const double value = about(usual);
    return random.uniform() < 0.5 ? value : 0.0;
  };

  arm::Arm arm = arm::paper_arm();
  arm.name = fmt::format("random arm {} of seed {}", index, seed);
  for (auto* number : {&arm.beam.width_m, &arm.beam.thickness_m, &arm.beam.density_kg_per_m3,
                       &arm.beam.youngs_modulus_Pa}) {
    *number = about(number->value());
  }
  arm.beam.length_m = about(arm.beam.length_m);
  arm.beam.shear_modulus_Pa = about(26e9);
  arm.beam.given_flexural_rigidity_N_m2.reset();
  arm.beam.given_linear_density_kg_per_m.reset();
  arm.hub.inertia_kg_m2 = about(arm.hub.inertia_kg_m2);
  arm.payload.mass_kg = half_the_time(0.1);
  arm.payload.inertia_kg_m2 = half_the_time(1e-4);
  arm.damping.kelvin_voigt_s = half_the_time(1e-4);
  arm.hub.viscous_friction_N_m_s_per_rad = half_the_time(1e-3);

  auto available = linear_effects();
  for (std::size_t count = random.below(kMostEffects + 1); count > 0; --count) {
    const std::size_t chosen = random.below(available.size());
    arm::Effect effect{available[chosen]};
    for (const auto& each : available[chosen]->parameters) {
      effect.parameters[each.name] = parameter(random, each, arm.beam.length_m);
    }
    arm.effects.emplace(available[chosen]->name, std::move(effect));
    available.erase(available.begin() + static_cast<std::ptrdiff_t>(chosen));
  }
  return arm;
}

}  // namespace flexarm::random_arms
