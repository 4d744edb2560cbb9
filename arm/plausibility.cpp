#include "arm/plausibility.hpp"

#include "arm/linear_arm.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

namespace flexarm::arm {

namespace {

/// Length over thickness from which Euler-Bernoulli beams are good for the lowest modes
/// [HanBenaroyaWei1999].
constexpr double kLeastSlenderness = 10.0;

struct PlausibleRange {
  const char* key;
  const char* unit;
  double least;
  double most;
  const char* ends;  ///< what is there
};

/// The ends of the charts of materials [Ashby2011]; the lightest foams and osmium for the density.
constexpr PlausibleRange kModulus{"beam.youngs_modulus", "Pa", 1e6, 1.3e12, "rubber to diamond"};
constexpr PlausibleRange kDensity{"beam.density", "kg/m^3", 10.0, 2.3e4, "foam to osmium"};
constexpr PlausibleRange kThickness{"beam.thickness", "m", 1e-7, 1.0,
                                    "a force microscope's cantilever to a girder"};

std::optional<std::string> note_of(const PlausibleRange& range, std::optional<double> value,
                                   const char* from = "") {
  if (!value || (*value >= range.least && *value <= range.most)) return std::nullopt;
  return fmt::format("{} = {:.4g} {}{}: implausible; {:g} to {:g} {} ({}) is expected", range.key,
                     *value, range.unit, from, range.least, range.most, range.unit, range.ends);
}

}  // namespace

std::vector<std::string> plausibility_notes(const Arm& arm) {
  const Beam& beam = arm.beam;
  std::optional<double> modulus_Pa = beam.youngs_modulus_Pa;
  std::optional<double> density_kg_per_m3 = beam.density_kg_per_m3;
  const char* modulus_from = "";
  const char* density_from = "";
  if (beam.width_m && beam.thickness_m) {
    const double area_m2 = *beam.width_m * *beam.thickness_m;
    if (!modulus_Pa) {
      modulus_Pa =
          12.0 * beam.flexural_rigidity_N_m2() / (area_m2 * *beam.thickness_m * *beam.thickness_m);
      modulus_from = " by flexural_rigidity, width and thickness";
    }
    if (!density_kg_per_m3) {
      density_kg_per_m3 = beam.linear_density_kg_per_m() / area_m2;
      density_from = " by linear_density, width and thickness";
    }
  }
  std::vector<std::string> notes;
  for (const auto& note :
       {note_of(kThickness, beam.thickness_m), note_of(kModulus, modulus_Pa, modulus_from),
        note_of(kDensity, density_kg_per_m3, density_from)}) {
    if (note) notes.push_back(*note);
  }
  if (beam.thickness_m && !linear_terms(arm).shear &&
      beam.length_m < kLeastSlenderness * *beam.thickness_m) {
    notes.push_back(
        fmt::format("beam.length/beam.thickness = {:.4g}: not slender; {:g} or more is expected of "
                    "an Euler-Bernoulli beam; effects.shear_and_rotary_inertia makes it "
                    "Timoshenko's",
                    beam.length_m / *beam.thickness_m, kLeastSlenderness));
  }
  return notes;
}

}  // namespace flexarm::arm
