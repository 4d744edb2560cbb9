#include "diagnose/verdict.hpp"

#include <algorithm>
#include <cmath>

namespace flexarm::diagnose {

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::adequate:
      return "adequate";
    case Verdict::explained:
      return "explained";
    case Verdict::partly_explained:
      return "partly_explained";
    case Verdict::unexplained:
      return "unexplained";
  }
  return "";
}

std::string_view definition_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::adequate:
      return "The residuals of the baseline are noise.";
    case Verdict::explained:
      return "The residuals of the extended arm are noise, its fit converged, and its numbers are "
             "plausible.";
    case Verdict::partly_explained:
      return "Effects are identified; the residuals are not noise, the fit did not converge, a "
             "number is implausible, or the search is incomplete.";
    case Verdict::unexplained:
      return "No effect is identified; neither the baseline nor plausible numbers leave noise.";
  }
  return "";
}

Verdict verdict_of(const Explanation& chosen, const Explanation& as_filed, SearchState search) {
  const bool is_plausible = std::ranges::all_of(
      chosen.fit.candidate.nuisances,
      [](double deviation) { return std::abs(deviation) <= kPlausibleDeviation; });
  const bool is_explained = chosen.leaves_noise() && chosen.fit.converged && is_plausible &&
                            search == SearchState::complete;
  if (!chosen.fit.candidate.effects.empty()) {
    return is_explained ? Verdict::explained : Verdict::partly_explained;
  }
  if (as_filed.leaves_noise()) return Verdict::adequate;
  return is_explained ? Verdict::explained : Verdict::unexplained;
}

}  // namespace flexarm::diagnose
