#pragma once

#include "diagnose/search/fit.hpp"
#include "diagnose/search/problem.hpp"
#include "diagnose/search/reported_work.hpp"
#include "diagnose/search/selection_options.hpp"

#include <vector>

namespace flexarm::diagnose {

/// An effect beside a fitted candidate, by a score test.
struct Addition {
  const Hypothesis* effect = nullptr;
  std::vector<double> values = {};  ///< a start for a fit
  /// Others, the best first: of an effect at a place along the beam, which does nearly the same at
  /// several places.
  std::vector<std::vector<double>> values_elsewhere = {};
  /// Another one, at a twentieth of that size: near the base, where the change is nearly linear.
  std::vector<double> values_near_base = {};
  double share = 0.0;  ///< of the sum of squares that it explains, to first order
};

/// Each of `others` beside `base`, a fit of the problem, at that of a few values which explains
/// most; the best first. Of an effect that does nothing at some of them these are bisected for the
/// threshold. By the Lagrange multiplier test [Rao1948, Silvey1959], without refitting:
/// with r the residuals and c the change that a value makes of them, both without their parts along
/// the derivatives J by the parameters of the base, the effect at the size a of that change
/// explains
///
///     2 a c^T r - a^2 c^T c,    c = (I - J J^+)(r_0 - r_1).
///
/// The start is where the effect does a times as much, by the first parameter that has a value at
/// which it does nothing. Of a law of hub torque with several parameters the one value is that
/// which a regression on the measured motion finds (hub_law_scan.hpp, options.law_evaluations).
/// Effects that the base has, and those that no value makes an arm of, are left out. Throws
/// Cancelled where the work is cancelled.
std::vector<Addition> additions(const Problem& problem, const Fit& base,
                                const std::vector<const Hypothesis*>& others,
                                const SelectionOptions& options, const ReportedWork& work);

}  // namespace flexarm::diagnose
