#include "tests/trials/rough_numbers.hpp"

#include <cmath>

namespace flexarm::trials {

namespace {

constexpr double kRoughNumbersLeast = 0.03;
constexpr double kRoughNumbersMost = 0.1;

}  // namespace

std::map<std::string, double> make_rough(arm::Arm& arm, double size, Random& random) {
  if (size == 0.0) return {};
  std::map<std::string, double> uncertainties;
  double uncertainty = 0.0;
  const auto factor = [&] {
    uncertainty = size * random.uniform(kRoughNumbersLeast, kRoughNumbersMost);
    return std::exp(uncertainty * random.normal());
  };
  // What is changed may be given by another number afterwards.
  const arm::Beam& beam = arm.beam;
  arm::scale_flexural_rigidity(arm.beam, factor());
  uncertainties[beam.given_flexural_rigidity_N_m2 ? "beam.flexural_rigidity"
                                                  : "beam.youngs_modulus"] = uncertainty;
  arm::scale_linear_density(arm.beam, factor());
  uncertainties[beam.given_linear_density_kg_per_m ? "beam.linear_density" : "beam.density"] =
      uncertainty;
  arm.hub.inertia_kg_m2 *= factor();
  uncertainties["hub.inertia"] = uncertainty;
  return uncertainties;
}

}  // namespace flexarm::trials
