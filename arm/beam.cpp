#include "arm/beam.hpp"

#include "arm/arm_keys.hpp"
#include "arm/input_error.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace flexarm::arm {

namespace {

/// E w t^3/12, when all of it is known.
std::optional<double> rigidity_of_section(const Beam& beam) {
  if (!beam.youngs_modulus_Pa || !beam.width_m || !beam.thickness_m) return std::nullopt;
  const double t = *beam.thickness_m;
  return *beam.youngs_modulus_Pa * *beam.width_m * t * t * t / 12.0;
}

/// density w t, when all of it is known.
std::optional<double> density_of_section(const Beam& beam) {
  if (!beam.density_kg_per_m3 || !beam.width_m || !beam.thickness_m) return std::nullopt;
  return *beam.density_kg_per_m3 * *beam.width_m * *beam.thickness_m;
}

void require_agreement(const char* key, std::optional<double> given,
                       std::optional<double> of_section, const char* unit) {
  if (!given || !of_section) return;
  if (std::abs(*given - *of_section) > kDescriptionAgreement * *of_section) {
    throw InputError(
        fmt::format("{} = {} {} differs from {:.6g} {} computed from dimensions and material: give "
                    "one of them, or two that agree within {:g} %",
                    key, *given, unit, *of_section, unit, 100.0 * kDescriptionAgreement),
        key);
  }
}

}  // namespace

Beam Beam::from_section(double length_m, double width_m, double thickness_m,
                        double density_kg_per_m3, double youngs_modulus_Pa) {
  Beam beam;
  beam.length_m = length_m;
  beam.width_m = width_m;
  beam.thickness_m = thickness_m;
  beam.density_kg_per_m3 = density_kg_per_m3;
  beam.youngs_modulus_Pa = youngs_modulus_Pa;
  return beam;
}

Beam Beam::from_rigidity(double length_m, double flexural_rigidity_N_m2,
                         double linear_density_kg_per_m) {
  Beam beam;
  beam.length_m = length_m;
  beam.given_flexural_rigidity_N_m2 = flexural_rigidity_N_m2;
  beam.given_linear_density_kg_per_m = linear_density_kg_per_m;
  return beam;
}

double Beam::flexural_rigidity_N_m2() const {
  if (given_flexural_rigidity_N_m2) return *given_flexural_rigidity_N_m2;
  if (const auto rigidity = rigidity_of_section(*this)) return *rigidity;
  throw InputError(
      "beam.flexural_rigidity: missing; give it [N m^2], or width, thickness and "
      "youngs_modulus",
      "beam.flexural_rigidity");
}

double Beam::linear_density_kg_per_m() const {
  if (given_linear_density_kg_per_m) return *given_linear_density_kg_per_m;
  if (const auto density = density_of_section(*this)) return *density;
  throw InputError("beam.linear_density: missing; give it [kg/m], or width, thickness and density",
                   "beam.linear_density");
}

void require_valid(const Beam& beam) {
  Arm arm;
  arm.beam = beam;
  require_in_range(arm, "beam");
  require_agreement("beam.flexural_rigidity", beam.given_flexural_rigidity_N_m2,
                    rigidity_of_section(beam), "N m^2");
  require_agreement("beam.linear_density", beam.given_linear_density_kg_per_m,
                    density_of_section(beam), "kg/m");
  // A product of allowed dimensions may still overflow or underflow.
  require_in_range("beam.flexural_rigidity", beam.flexural_rigidity_N_m2(), "N m^2", kPositive);
  require_in_range("beam.linear_density", beam.linear_density_kg_per_m(), "kg/m", kPositive);
}

void scale_flexural_rigidity(Beam& beam, double factor) {
  beam.given_flexural_rigidity_N_m2 = beam.flexural_rigidity_N_m2() * factor;
  if (beam.youngs_modulus_Pa) *beam.youngs_modulus_Pa *= factor;
}

void scale_linear_density(Beam& beam, double factor) {
  beam.given_linear_density_kg_per_m = beam.linear_density_kg_per_m() * factor;
  if (beam.density_kg_per_m3) *beam.density_kg_per_m3 *= factor;
}

}  // namespace flexarm::arm
