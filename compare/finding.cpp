#include "compare/finding.hpp"

#include <limits>
#include <stdexcept>

namespace flexarm::compare {

namespace {

/// distance/tolerance, infinite where a value is missing: NaN fails every comparison.
double severity(const Finding& finding) {
  const double ratio = finding.distance / finding.tolerance;
  return ratio >= 0.0 ? ratio : std::numeric_limits<double>::infinity();
}

}  // namespace

Verdict judge(std::span<const Finding> findings) {
  if (findings.empty()) throw std::invalid_argument("no findings to judge");
  Verdict verdict;
  double worst = -1.0;
  for (const auto& finding : findings) {
    if (severity(finding) > worst) {
      worst = severity(finding);
      verdict.worst = finding;
    }
  }
  verdict.agree = worst <= 1.0;
  return verdict;
}

}  // namespace flexarm::compare
