#pragma once

#include "diagnose/search/fit.hpp"
#include "diagnose/search/problem.hpp"
#include "diagnose/search/reported_work.hpp"
#include "diagnose/search/selection_options.hpp"

#include <cstddef>
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

/// The `most` of `others` that explain most beside `base`, a fit of the problem, each at its best
/// of a few values; the best first. By the Lagrange multiplier test [Rao1948, Silvey1959], without
/// refitting: with r the residuals and c the change that a value makes of them, both without their
/// parts along the derivatives J by the parameters of the base, the effect at the size a of that
/// change explains
///
///     2 a c^T r - a^2 c^T c,    c = (I - J J^+)(r_0 - r_1).
///
/// The start is where the effect does a times as much, by the first parameter that has a value at
/// which it does nothing. Each effect is tried at one to three sizes of that parameter. Those with
/// the largest (c^T r)^2 / c^T c, twice as many as are asked for, are tried again at the sizes that
/// these lead to. Of an effect that does nothing at some values these are bisected for the
/// threshold. Of a law of hub torque with several parameters the one value is that which a
/// regression on the measured motion finds (hub_law_scan.hpp, options.law_evaluations). Effects
/// that the base has, and those that no value makes an arm of, are left out. Throws Cancelled where
/// the work is cancelled.
std::vector<Addition> additions(const Problem& problem, const Fit& base,
                                std::vector<const Hypothesis*> others, std::size_t most,
                                const SelectionOptions& options, const ReportedWork& work);

}  // namespace flexarm::diagnose
