#include "diagnose/symptoms/symptom.hpp"

#include <boost/math/special_functions/erf.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace flexarm::diagnose {

std::string_view to_string(SymptomKind kind) {
  switch (kind) {
    case SymptomKind::error:
      return "error";
    case SymptomKind::trend:
      return "trend";
    case SymptomKind::roots:
      return "roots";
    case SymptomKind::hub_torque:
      return "hub_torque";
    case SymptomKind::distortion:
      return "distortion";
    case SymptomKind::drift:
      return "drift";
  }
  return "";
}

Symptom symptom(SymptomKind kind, std::string text, double probability, std::size_t tests) {
  constexpr double kLeastProbability = 1e-299;  // of kMostDeviate
  Symptom made{.kind = kind, .text = std::move(text)};
  made.probability = std::clamp(probability * static_cast<double>(tests), 0.0, 1.0);
  made.deviate = std::min(kMostDeviate, std::sqrt(2.0) * boost::math::erfc_inv(std::max(
                                                             kLeastProbability, made.probability)));
  made.is_significant = made.probability < kSignificantSymptom;
  return made;
}

std::string percent(double part) {
  const double value = 100.0 * part;
  if (value < 0.1) return "< 0.1 %";
  return value >= 10.0 ? fmt::format("{:.0f} %", value) : fmt::format("{:.2g} %", value);
}

void sort_by_significance(std::vector<Symptom>& symptoms) {
  std::ranges::stable_sort(symptoms, {}, [](const Symptom& one) {
    return std::tuple(!one.is_significant, -one.deviate, one.kind);
  });
}

}  // namespace flexarm::diagnose
