#include "compare/finding.hpp"

#include <limits>
#include <stdexcept>
#include <string_view>

namespace flexarm::compare {

namespace {

/// distance/tolerance, infinite where a value is missing: NaN fails every comparison.
double severity(const Finding& finding) {
  const double ratio = finding.distance / finding.tolerance;
  return ratio >= 0.0 ? ratio : std::numeric_limits<double>::infinity();
}

/// "hub_angle response at 48.8 Hz" without the place: of each pair it is another.
std::string_view without_place(std::string_view quantity) {
  return quantity.substr(0, quantity.find(" at "));
}

/// Whether every finding in this quantity that `name` takes part in is beyond its tolerance, and
/// every other one, of which there are some, within it.
bool differs_alone(const std::string& name, std::string_view quantity,
                   std::span<const Finding> findings) {
  bool others_agree = false;
  for (const Finding& finding : findings) {
    if (without_place(finding.quantity) != quantity) continue;
    const bool takes_part = finding.first == name || finding.second == name;
    const bool is_beyond = severity(finding) > 1.0;
    if (takes_part != is_beyond) return false;
    others_agree = others_agree || !takes_part;
  }
  return others_agree;
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
  if (verdict.agree) return verdict;
  const std::string_view quantity = without_place(verdict.worst.quantity);
  for (const std::string& name : {verdict.worst.first, verdict.worst.second}) {
    if (differs_alone(name, quantity, findings)) verdict.alone = name;
  }
  return verdict;
}

}  // namespace flexarm::compare
