#include "diagnose/symptoms/hub_torque.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace flexarm::diagnose {

namespace {

/// "0.0104 ± 0.0002 N m"
std::string amount(const HubTorqueTerm& term) {
  const std::string unit = term.unit == "1" ? "" : " " + term.unit;
  return fmt::format("{:.4g} ± {:.2g}{}", std::abs(term.coefficient), term.std_error, unit);
}

/// What the torque does, and what would do that.
std::string meaning(const HubTorqueTerm& term) {
  const bool positive = term.coefficient > 0.0;
  switch (term.kind) {
    case HubTorqueKind::dry_friction:
      return fmt::format("steps by the sign of the velocity, {} {} the motion ({})", amount(term),
                         positive ? "against" : "with",
                         positive ? "as dry friction" : "less dry friction than the arm has");
    case HubTorqueKind::viscous_friction:
      return fmt::format("grows with the velocity, {} {} it ({})", amount(term),
                         positive ? "against" : "with",
                         positive ? "as viscous friction" : "less damping than the arm has");
    case HubTorqueKind::inertia:
      return fmt::format("grows with the acceleration, {} {} it ({})", amount(term),
                         positive ? "against" : "with",
                         positive ? "as more inertia" : "as less inertia");
    case HubTorqueKind::spring:
      return fmt::format("grows with the angle, {} {} it ({})", amount(term),
                         positive ? "against" : "with",
                         positive ? "as a spring" : "as of what stands up");
    case HubTorqueKind::ripple:
      return fmt::format("comes back with the angle, {} at {:.3g} cycles/rad (as ripple)",
                         amount(term), term.at);
    case HubTorqueKind::bias:
      return fmt::format("is constant, {}{} (as a bias)", positive ? "" : "−", amount(term));
    case HubTorqueKind::time:
      return fmt::format("drifts with time, {}{}", positive ? "" : "−", amount(term));
    case HubTorqueKind::gain:
      return fmt::format("follows the commanded torque, {}{} of it (as a gain of {:.4g})",
                         positive ? "" : "−", amount(term), 1.0 + term.coefficient);
    case HubTorqueKind::dead_zone:
      return fmt::format("steps by the sign of the commanded torque, {} {} it ({})", amount(term),
                         positive ? "against" : "with",
                         positive ? "as a dead zone" : "as of a relay");
    case HubTorqueKind::saturation:
      return fmt::format("takes {} of the commanded torque beyond {:.2g} N m {} (as saturation)",
                         amount(term), term.at, positive ? "away" : "more");
  }
  return "";
}

/// What the torque depends on; empty for one that is constant.
std::string_view quantity(HubTorqueKind kind) {
  switch (kind) {
    case HubTorqueKind::dry_friction:
    case HubTorqueKind::viscous_friction:
      return "velocity";
    case HubTorqueKind::inertia:
      return "acceleration";
    case HubTorqueKind::spring:
    case HubTorqueKind::ripple:
      return "angle";
    case HubTorqueKind::bias:
      return "";
    case HubTorqueKind::time:
      return "time";
    case HubTorqueKind::gain:
    case HubTorqueKind::dead_zone:
    case HubTorqueKind::saturation:
      return "the commanded torque";
  }
  return "";
}

/// Quantities that no term depends on.
std::vector<std::string_view> quantities_without(const std::vector<HubTorqueTerm>& terms) {
  std::vector<std::string_view> others = {"velocity", "acceleration", "angle", "time",
                                          "the commanded torque"};
  for (const HubTorqueTerm& term : terms) std::erase(others, quantity(term.kind));
  return others;
}

}  // namespace

std::string_view to_string(HubTorqueKind kind) {
  switch (kind) {
    case HubTorqueKind::dry_friction:
      return "dry_friction";
    case HubTorqueKind::viscous_friction:
      return "viscous_friction";
    case HubTorqueKind::inertia:
      return "inertia";
    case HubTorqueKind::spring:
      return "spring";
    case HubTorqueKind::ripple:
      return "ripple";
    case HubTorqueKind::bias:
      return "bias";
    case HubTorqueKind::time:
      return "time";
    case HubTorqueKind::gain:
      return "gain";
    case HubTorqueKind::dead_zone:
      return "dead_zone";
    case HubTorqueKind::saturation:
      return "saturation";
  }
  return "";
}

std::vector<Symptom> hub_torque_symptoms(const HubTorque& torque) {
  std::vector<Symptom> made;
  if (torque.tests == 0) return made;
  for (const HubTorqueTerm& term : torque.terms) {
    const bool first = &term == &torque.terms.front();
    std::string text =
        fmt::format("hub: the torque that is {} {}; it accounts for {} of the hub's error{}.",
                    first ? "missing" : "still missing", meaning(term),
                    percent(std::min(1.0, term.share)), first ? "" : " beside the others");
    made.push_back(
        symptom(SymptomKind::hub_torque, std::move(text), term.probability, torque.tests));
  }
  double least_probability = 1.0;
  for (const HubTorqueTerm& term : torque.left_over) {
    least_probability = std::min(least_probability, term.probability);
  }
  // Below kLeastHubShare a dependence is no more than a part of a misfit of another kind.
  Symptom none = symptom(SymptomKind::hub_torque, "", least_probability, torque.tests);
  none.is_significant = false;
  const std::string others = fmt::format("{}", fmt::join(quantities_without(torque.terms), ", "));
  none.text =
      torque.terms.empty()
          ? fmt::format("hub: no residual torque depends on {}, nor is it constant.", others)
          : fmt::format(
                "hub: no residual torque depends on {}; {} of the error is "
                "left.",
                others, percent(1.0 - torque.share));
  made.push_back(std::move(none));
  return made;
}

}  // namespace flexarm::diagnose
