#include "arm/formulation.hpp"

#include "arm/input_error.hpp"
#include "arm/linear_arm.hpp"
#include "arm/rigid_hub.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

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

/// A number of an effect beside the size that the beam gives it.
struct Size {
  const char* key;
  double value;
  const char* unit;
  double beam_size;  ///< in the same unit
  const char* beam_size_text;
};

void require_from_to(const Size& size, double least, double most) {
  if (size.value >= least * size.beam_size && size.value <= most * size.beam_size) return;
  throw out_of_range(size.key, size.value, size.unit,
                     fmt::format("from {:.6g} to {:.6g}, {} to {} times {}", least * size.beam_size,
                                 most * size.beam_size, least, most, size.beam_size_text));
}

void require_at_most(const Size& size, double most) {
  if (std::abs(size.value) <= most * size.beam_size) return;
  throw out_of_range(size.key, size.value, size.unit,
                     fmt::format("{:.6g} or less in size, {} times {}", most * size.beam_size, most,
                                 size.beam_size_text));
}

void require_moderate_drive(const Drive& drive, const LinearArm& arm) {
  const double l = arm.length_m;
  require_from_to({"effects.drive_compliance.stiffness", drive.stiffness_N_m_per_rad, "N m/rad",
                   arm.flexural_rigidity_N_m2 / l, "EI/l"},
                  kSmallestSpringRatio, kLargestSpringRatio);
  const double inertia_kg_m2 = arm.linear_density_kg_per_m * l * l * l;
  const double least = kSmallestRotorRatio * inertia_kg_m2 / arm.hub_inertia_kg_m2;
  const double share = drive.rotor_inertia_kg_m2 / arm.hub_inertia_kg_m2;
  if (!(share >= least && share <= 1.0 - kSmallestRestOfHub)) {
    throw out_of_range("effects.drive_compliance.rotor_share", share, "",
                       fmt::format("from {:.6g}, {} m l^3 over hub.inertia, to 1 - {}", least,
                                   kSmallestRotorRatio, kSmallestRestOfHub));
  }
}

/// Mp offset^2 relative to m l^3. The payload's inertia about the tip is rounded as a double, and
/// with it the part about its own centre; mode by mode a beam of this inertia magnifies that.
constexpr double kLargestOffsetInertiaRatio = 100.0;

/// Sizes of effects in units of the beam's own, within which every formulation keeps nine digits.
void require_moderate_effects(const LinearArm& arm) {
  const double l = arm.length_m;
  const double torsion_N_m = arm.flexural_rigidity_N_m2 / l;
  const auto spring = [&](const char* key, double stiffness_N_m_per_rad) {
    return Size{key, stiffness_N_m_per_rad, "N m/rad", torsion_N_m, "EI/l"};
  };
  require_at_most({"effects.hub_radius.radius", arm.hub_radius_m, "m", l, "the length"},
                  kLargestLengthRatio);
  if (arm.payload_mass_kg > 0.0) {
    require_at_most({"effects.payload_offset.offset",
                     arm.payload_first_moment_kg_m / arm.payload_mass_kg, "m", l, "the length"},
                    kLargestLengthRatio);
    const double beam_kg = arm.linear_density_kg_per_m * l;
    require_at_most(
        {"effects.payload_offset.offset", arm.payload_first_moment_kg_m / arm.payload_mass_kg, "m",
         l * std::sqrt(beam_kg / arm.payload_mass_kg), "l sqrt(m l/payload.mass)"},
        std::sqrt(kLargestOffsetInertiaRatio));
  }
  require_at_most(spring("effects.hub_spring.stiffness", arm.hub_spring_N_m_per_rad),
                  kLargestSpringRatio);
  if (arm.root_stiffness_N_m_per_rad) {
    require_from_to(spring("effects.root_compliance.stiffness", *arm.root_stiffness_N_m_per_rad),
                    kSmallestSpringRatio, kLargestSpringRatio);
  }
  if (arm.drive) require_moderate_drive(*arm.drive, arm);
  if (arm.crack) {
    require_from_to(
        spring("effects.local_stiffness_loss.stiffness", arm.crack->stiffness_N_m_per_rad),
        kSmallestSpringRatio, kLargestSpringRatio);
  }
  double mass_kg = arm.linear_density_kg_per_m * l + arm.payload_mass_kg;
  for (const MassOnBeam& mass : arm.masses) mass_kg += mass.mass_kg;
  require_at_most({"effects.gravity.acceleration", arm.gravity_m_per_s2, "m/s^2",
                   torsion_N_m / (mass_kg * l), "EI/l^2 over the mass"},
                  kLargestWeightRatio);
  if (arm.shear) {
    const double ratio = arm.shear->shear_rigidity_N * l / torsion_N_m;
    if (!(ratio >= kSmallestShearRatio)) {
      throw out_of_range("effects.shear_and_rotary_inertia: k G A l^2/EI", ratio, "",
                         fmt::format("{} or more", kSmallestShearRatio));
    }
  }
}

void require_moderate_mass(const MassOnBeam& mass, const LinearArm& arm) {
  const double beam_kg = arm.linear_density_kg_per_m * arm.length_m;
  const auto key = [&](const char* parameter) {
    return fmt::format("effects.{}_mass.{}", mass.suspension ? "tuned" : "attached", parameter);
  };
  const std::string mass_key = key("mass");
  require_at_most({mass_key.c_str(), mass.mass_kg, "kg", beam_kg, "m l"}, kLargestCarriedRatio);
  if (!mass.suspension) return;
  const double natural = std::sqrt(mass.suspension->stiffness_N_per_m / mass.mass_kg);
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const std::string frequency_key = key("frequency");
  require_from_to({frequency_key.c_str(), natural / kTurn, "Hz", omega_scale_rad_per_s(arm) / kTurn,
                   "sqrt(EI/(m l^4))/(2 pi)"},
                  kSmallestTunedRatio, kLargestTunedRatio);
  const double ratio = mass.suspension->damping_N_s_per_m / (2.0 * mass.mass_kg * natural);
  if (!(ratio <= kLargestTunedDampingRatio)) {
    throw out_of_range(key("damping_ratio"), ratio, "1",
                       fmt::format("{} or less", kLargestTunedDampingRatio));
  }
}

}  // namespace

void require_computable(const Arm& arm) {
  require_valid(arm);
  require_beam(arm, "formulation");
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
  for (const MassOnBeam& mass : linear.masses) require_moderate_mass(mass, linear);
}

void require_count(int count) {
  if (count < 1) throw out_of_range("count", count, "", "1 or more");
}

void require_stations(std::span<const double> stations_m, const Arm& arm) {
  if (stations_m.empty()) return;
  const double length_m = linear_arm(arm).length_m;
  for (const double station_m : stations_m) {
    if (!(station_m >= 0.0 && station_m <= length_m)) {
      throw out_of_range("station", station_m, "m",
                         fmt::format("from 0 to the beam's length, {} m", length_m));
    }
  }
}

}  // namespace flexarm::arm
