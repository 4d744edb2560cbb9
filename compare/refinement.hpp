#pragma once

#include "arm/arm.hpp"
#include "compare/convergence.hpp"
#include "compare/features.hpp"
#include "response/any_formulation.hpp"

#include <complex>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace flexarm::compare {

/// A formulation refined in one setting, the others held.
struct Refinement {
  std::string name;           ///< "fem, cubic elements"
  std::string formulation;    ///< "fem"
  std::string setting_name;   ///< "elements", "degree", "functions"
  std::vector<int> settings;  ///< ascending
  Decay decay = Decay::algebraic;
  bool alternative = false;  ///< a second choice of its formulation, drawn apart from the first
  std::function<response::AnyFormulation(const arm::Arm&, int setting)> make;
};

/// The series that the comparison runs: fem over elements (degree 3 and 5) and over degree,
/// assumed_modes over functions in each basis, clamped shapes with payload only where the arm has
/// one; long enough for `roots` roots.
std::vector<Refinement> standard_refinements(const arm::Arm& arm, int roots);

/// The error of one root over a refinement series.
struct RefinementCurve {
  std::string refinement;  ///< Refinement::name
  std::string formulation;
  std::string setting_name;
  Decay decay = Decay::algebraic;
  bool alternative = false;  ///< Refinement::alternative
  FeatureFamily family;
  int order = 1;  ///< of the root within its family, from 1
  std::vector<RefinementPoint> points;
  Convergence convergence;
};

/// Curves for every root in `exact_s_rad_per_s` of `family`, in their order.
std::vector<RefinementCurve> refine(const arm::Arm& arm, const Refinement& refinement,
                                    const FeatureFamily& family,
                                    std::span<const std::complex<double>> exact_s_rad_per_s,
                                    double wanted_accuracy);

}  // namespace flexarm::compare
