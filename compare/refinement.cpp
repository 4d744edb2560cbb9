#include "compare/refinement.hpp"

#include "arm/linear_arm.hpp"

#include <limits>

namespace flexarm::compare {

namespace {

std::vector<int> doubling(int first, int last) {
  std::vector<int> settings;
  for (int n = first; n <= last; n *= 2) settings.push_back(n);
  return settings;
}

std::vector<int> stepping(int first, int last, int step) {
  std::vector<int> settings;
  for (int n = first; n <= last; n += step) settings.push_back(n);
  return settings;
}

Refinement fem_elements(const char* name, int degree, int most_elements) {
  return {name,
          "fem",
          "elements",
          doubling(2, most_elements),
          Decay::algebraic,
          degree != 3,
          [degree](const arm::Arm& arm, int elements) -> response::AnyFormulation {
            fem::FemArm::Options options;
            options.mesh.elements = elements;
            options.degree = degree;
            return fem::FemArm(arm, options);
          }};
}

Refinement fem_degree(int elements) {
  return {"fem, " + std::to_string(elements) + " elements of increasing degree",
          "fem",
          "degree",
          stepping(3, 13, 1),
          Decay::exponential,
          false,
          [elements](const arm::Arm& arm, int degree) -> response::AnyFormulation {
            fem::FemArm::Options options;
            options.mesh.elements = elements;
            options.degree = degree;
            return fem::FemArm(arm, options);
          }};
}

Refinement functions_of(const char* name, assumed_modes::Basis basis, Decay decay,
                        std::vector<int> settings) {
  return {name,
          "assumed_modes",
          "functions",
          std::move(settings),
          decay,
          basis != assumed_modes::Basis::legendre,
          [basis](const arm::Arm& arm, int functions) -> response::AnyFormulation {
            assumed_modes::AssumedModesOptions options;
            options.basis = basis;
            options.functions = functions;
            return assumed_modes::AssumedModesArm(arm, options);
          }};
}

}  // namespace

std::vector<Refinement> standard_refinements(const arm::Arm& arm, int roots) {
  using assumed_modes::Basis;
  // Half a wavelength an element: mode n of a beam has about n half waves.
  const int elements = roots / 2 > 3 ? roots / 2 : 3;
  const std::vector<int> shapes = stepping(4, 3 * roots + 30, 4);
  std::vector<Refinement> refinements = {
      fem_elements("fem, cubic elements", 3, 4096),
      fem_elements("fem, quintic elements", 5, 512),
      fem_degree(elements),
      functions_of("Legendre polynomials", Basis::legendre, Decay::exponential,
                   stepping(4, 2 * roots + 24, 2)),
  };
  // Shapes of a plain beam cannot bend at a crack or a soft root.
  if (!arm::linear_arm(arm).is_plain()) return refinements;
  refinements.push_back(
      functions_of("clamped-free shapes", Basis::clamped_free, Decay::algebraic, shapes));
  refinements.push_back(
      functions_of("pinned-free shapes", Basis::pinned_free, Decay::algebraic, shapes));
  // Without a payload these are the clamped-free shapes.
  if (arm.payload != arm::Payload{}) {
    refinements.push_back(functions_of("clamped shapes with payload", Basis::clamped_with_payload,
                                       Decay::algebraic, shapes));
  }
  return refinements;
}

std::vector<RefinementCurve> refine(const arm::Arm& arm, const Refinement& refinement,
                                    const FeatureFamily& family,
                                    std::span<const std::complex<double>> exact_s_rad_per_s,
                                    double wanted_accuracy) {
  std::vector<RefinementCurve> curves;
  for (std::size_t i = 0; i < exact_s_rad_per_s.size(); ++i) {
    curves.push_back({refinement.name,
                      refinement.formulation,
                      refinement.setting_name,
                      refinement.decay,
                      refinement.alternative,
                      family,
                      static_cast<int>(i) + 1,
                      {},
                      {}});
  }
  for (const int setting : refinement.settings) {
    const response::AnyFormulation model = refinement.make(arm, setting);
    const auto found = roots(model, family);
    const auto matched = match(family, exact_s_rad_per_s, found.s_rad_per_s);
    for (std::size_t i = 0; i < matched.size(); ++i) {
      const double error = matched[i] ? relative_distance(*matched[i], exact_s_rad_per_s[i])
                                      : std::numeric_limits<double>::quiet_NaN();
      curves[i].points.push_back({setting, response::degrees_of_freedom(model), error});
    }
  }
  for (auto& curve : curves) {
    curve.convergence = observe_convergence(curve.points, curve.decay, wanted_accuracy);
  }
  return curves;
}

}  // namespace flexarm::compare
