#include "arm/formulation.hpp"

#include "arm/input_error.hpp"
#include "arm/linear_arm.hpp"

#include <fmt/format.h>

#include <cmath>

namespace flexarm::arm {

namespace {

void require_scale(const char* what, double value, const char* unit) {
  if (!(value >= kSmallestScale && value <= kLargestScale)) {
    throw out_of_range(what, value, unit,
                       fmt::format("from {} to {}", kSmallestScale, kLargestScale));
  }
}

void require_ratio(const char* what, double value, double largest) {
  if (!(value <= largest)) {
    throw out_of_range(what, value, "", fmt::format("{} or less", largest));
  }
}

/// Sizes of effects in units of the beam's own, within which every formulation keeps nine digits.
void require_moderate_effects(const LinearArm& arm) {
  const double l = arm.length_m;
  const double torsion_N_m = arm.flexural_rigidity_N_m2 / l;
  require_ratio("effects.hub_radius.radius/length", arm.hub_radius_m / l, kLargestLengthRatio);
  if (arm.payload_mass_kg > 0.0) {
    require_ratio("effects.payload_offset: offset/length",
                  std::abs(arm.payload_first_moment_kg_m) / (arm.payload_mass_kg * l),
                  kLargestLengthRatio);
  }
  require_ratio("effects.hub_spring: stiffness l/EI", arm.hub_spring_N_m_per_rad / torsion_N_m,
                kLargestSpringRatio);
  const auto require_spring = [&](const char* what, double stiffness_N_m_per_rad) {
    const double ratio = stiffness_N_m_per_rad / torsion_N_m;
    if (!(ratio >= kSmallestSpringRatio && ratio <= kLargestSpringRatio)) {
      throw out_of_range(what, ratio, "",
                         fmt::format("from {} to {}", kSmallestSpringRatio, kLargestSpringRatio));
    }
  };
  if (arm.root_stiffness_N_m_per_rad) {
    require_spring("spring at the root: stiffness l/EI", *arm.root_stiffness_N_m_per_rad);
  }
  if (arm.crack) {
    require_spring("effects.local_stiffness_loss: stiffness l/EI",
                   arm.crack->stiffness_N_m_per_rad);
  }
  const double weight_N =
      std::abs(arm.gravity_m_per_s2) * (arm.linear_density_kg_per_m * l + arm.payload_mass_kg);
  require_ratio("effects.gravity: weight l^2/EI", weight_N * l / torsion_N_m, kLargestWeightRatio);
  if (arm.shear) {
    const double ratio = arm.shear->shear_rigidity_N * l / torsion_N_m;
    if (!(ratio >= kSmallestShearRatio)) {
      throw out_of_range("effects.shear_and_rotary_inertia: k G A l^2/EI", ratio, "",
                         fmt::format("{} or more", kSmallestShearRatio));
    }
  }
}

}  // namespace

void require_computable(const Arm& arm) {
  require_valid(arm);
  const LinearArm linear = linear_arm(arm);
  const double l = linear.length_m;
  const double mass_kg = linear.linear_density_kg_per_m * l;
  require_scale("beam: m l", mass_kg, "kg");
  require_scale("beam: m l^3", mass_kg * l * l, "kg m^2");
  require_scale("beam: EI/l", linear.flexural_rigidity_N_m2 / l, "N m");
  require_scale("beam: sqrt(EI/(m l^4))", omega_scale_rad_per_s(linear), "rad/s");
  require_ratio("hub.inertia/(m l^3)", hub_inertia_ratio(arm), kLargestScale);
  require_ratio("payload.mass/(m l)", payload_mass_ratio(arm), kLargestPayloadRatio);
  require_ratio("payload.inertia/(m l^3)", payload_inertia_ratio(arm), kLargestPayloadRatio);
  require_moderate_effects(linear);
}

void require_count(int count) {
  if (count < 1) throw out_of_range("count", count, "", "1 or more");
}

void require_stations(std::span<const double> stations_m, const Arm& arm) {
  for (const double station_m : stations_m) {
    if (!(station_m >= 0.0 && station_m <= arm.beam.length_m)) {
      throw out_of_range("station", station_m, "m",
                         fmt::format("from 0 to the beam's length, {} m", arm.beam.length_m));
    }
  }
}

}  // namespace flexarm::arm
