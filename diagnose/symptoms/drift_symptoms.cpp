#include "diagnose/symptoms/drift_symptoms.hpp"

#include "arm/unit_suffix.hpp"

#include <fmt/format.h>

#include <string>

namespace flexarm::diagnose {

std::vector<Symptom> drift_symptoms(const RunDrift& drift) {
  const auto [least, most] = drift.range();
  const std::string unit = arm::unit_suffix(drift.unit);
  Symptom one = symptom(SymptomKind::drift, "", drift.probability, 1);
  const std::string what =
      fmt::format("{} {}, estimated from each run", drift.effect, drift.parameter);
  const std::string range =
      fmt::format("{:.4g} ± {:.2g}{} (run {}) to {:.4g} ± {:.2g}{} (run {})", least.value,
                  least.std_error, unit, least.run, most.value, most.std_error, unit, most.run);
  const double spread = drift.spread();
  if (one.is_significant && spread >= kLeastSpread) {
    one.text = fmt::format(
        "{}: estimates inconsistent between runs, {}. The parameter changes between runs, or "
        "another effect is present.",
        what, range);
  } else if (one.is_significant) {
    one.is_significant = false;
    one.text = fmt::format("{}: estimates agree within {} of the size of the effect, {}.", what,
                           percent(spread), range);
  } else {
    one.text = fmt::format("{}: estimates consistent between runs, {}.", what, range);
  }
  return {one};
}

}  // namespace flexarm::diagnose
