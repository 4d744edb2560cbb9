#include "tests/trials/rig_score.hpp"

#include "tests/trials/family_of.hpp"
#include "tests/trials/score.hpp"

#include <algorithm>
#include <limits>

namespace flexarm::trials {

namespace {

bool is_of_family(const NamedCause& named, const HiddenCause& hidden) {
  const std::string_view family = family_of(hidden.name);
  return !family.empty() && family == family_of(named.effect);
}

/// The program names another effect on an unstated sensor, the effect of the cause on its sensor.
bool is_confusable(const NamedCause& named, const HiddenCause& hidden) {
  if (named.confusable_with.size() >= kLargestClass) return false;
  return std::ranges::any_of(named.confusable_with, [&](const std::string& name) {
    return name == hidden.name || name == hidden.name + " on " + hidden.sensor;
  });
}

bool stands_for_cause(const NamedCause& named, const HiddenCause& hidden) {
  const bool is_same_sensor = named.sensor == hidden.sensor;
  return (is_same_sensor && (named.effect == hidden.name || is_of_family(named, hidden))) ||
         is_confusable(named, hidden);
}

}  // namespace

RigScore rig_score(const Truth& truth, const Answer& answer) {
  RigScore score;
  for (const std::string& name : truth.rig.value().leading()) {
    const HiddenCause& hidden = *truth.world.find(name);
    const bool is_named = std::ranges::any_of(
        answer.causes, [&](const NamedCause& named) { return stands_for_cause(named, hidden); });
    if (is_named) ++score.leading_named;
  }
  for (const NamedCause& named : answer.causes) {
    const bool is_right = std::ranges::any_of(truth.world.hidden, [&](const HiddenCause& hidden) {
      return stands_for_cause(named, hidden);
    });
    if (!is_right) ++score.wrong_names;
  }
  const double error = answer.validation.after;
  score.error_over_floor =
      error > 0.0 ? error / truth.rig->validation_floor : std::numeric_limits<double>::infinity();
  return score;
}

}  // namespace flexarm::trials
