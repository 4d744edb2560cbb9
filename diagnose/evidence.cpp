#include "diagnose/evidence.hpp"

namespace flexarm::diagnose {

std::string_view to_string(Grade grade) {
  switch (grade) {
    case Grade::candidate:
      return "candidate";
    case Grade::supported:
      return "supported";
    case Grade::established:
      return "established";
  }
  return "";
}

Grade grade_of(const EffectEvidence& evidence, bool has_rival, bool leaves_noise,
               const Policy& policy) {
  const bool is_supported = evidence.held_out && *evidence.held_out >= policy.beyond_doubt &&
                            evidence.error_increase > 2.0 * evidence.error_increase_std_error;
  if (!is_supported) return Grade::candidate;
  const bool is_consistent = evidence.agreement >= policy.least_agreement;
  return is_consistent && !has_rival && leaves_noise ? Grade::established : Grade::supported;
}

}  // namespace flexarm::diagnose
