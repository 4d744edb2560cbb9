#include "arm/unit_suffix.hpp"
#include "diagnose/symptoms/hub_torque.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace flexarm::diagnose {

namespace {

/// "0.0104 ± 0.0002 N m"
std::string amount(const HubTorqueTerm& term) {
  const std::string unit = arm::unit_suffix(term.unit);
  return fmt::format("{:.4g} ± {:.2g}{}", std::abs(term.coefficient), term.std_error, unit);
}

/// What the torque does, and what would do that.
std::string meaning(const HubTorqueTerm& term) {
  const bool positive = term.coefficient > 0.0;
  switch (term.kind) {
    case HubTorqueKind::coulomb_friction:
      return fmt::format(
          "Coulomb term {}, {} the velocity ({})", amount(term),
          positive ? "opposing" : "in the direction of",
          positive ? "Coulomb friction" : "less Coulomb friction than in the arm file");
    case HubTorqueKind::viscous_friction:
      return fmt::format("viscous term {}, {} the velocity ({})", amount(term),
                         positive ? "opposing" : "in the direction of",
                         positive ? "viscous friction" : "less damping than in the arm file");
    case HubTorqueKind::inertia:
      return fmt::format("inertia term {}, {} the acceleration ({})", amount(term),
                         positive ? "opposing" : "in the direction of",
                         positive ? "larger inertia" : "smaller inertia");
    case HubTorqueKind::spring:
      return fmt::format("spring term {}, {} the angle ({})", amount(term),
                         positive ? "opposing" : "in the direction of",
                         positive ? "spring to ground" : "negative stiffness, inverted pendulum");
    case HubTorqueKind::ripple:
      return fmt::format("ripple term {}, {:.3g} cycles/rev", amount(term), term.at);
    case HubTorqueKind::bias:
      return fmt::format("constant term {}{} (bias)", positive ? "" : "−", amount(term));
    case HubTorqueKind::time:
      return fmt::format("linear drift in time {}{}", positive ? "" : "−", amount(term));
    case HubTorqueKind::gain:
      return fmt::format("gain term {}{} of the commanded torque (gain {:.4g})",
                         positive ? "" : "−", amount(term), 1.0 + term.coefficient);
    case HubTorqueKind::dead_zone:
      return fmt::format("dead-zone term {}, {} the commanded torque ({})", amount(term),
                         positive ? "opposing" : "in the direction of",
                         positive ? "dead zone" : "relay characteristic");
    case HubTorqueKind::saturation:
      return fmt::format("saturation term {} of the commanded torque above {:.2g} N m{}",
                         amount(term), term.at, positive ? "" : " (gain increases)");
  }
  return "";
}

/// What the torque depends on; empty for one that is constant.
std::string_view quantity(HubTorqueKind kind) {
  switch (kind) {
    case HubTorqueKind::coulomb_friction:
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

struct TermNames {
  HubTorqueKind kind;
  std::string_view key;   ///< in files
  std::string_view name;  ///< in tables
};
constexpr std::array kTermNames = {
    TermNames{HubTorqueKind::coulomb_friction, "coulomb_friction", "Coulomb"},
    TermNames{HubTorqueKind::viscous_friction, "viscous_friction", "viscous"},
    TermNames{HubTorqueKind::inertia, "inertia", "inertia"},
    TermNames{HubTorqueKind::spring, "spring", "spring"},
    TermNames{HubTorqueKind::ripple, "ripple", "ripple"},
    TermNames{HubTorqueKind::bias, "bias", "constant"},
    TermNames{HubTorqueKind::time, "time", "drift in time"},
    TermNames{HubTorqueKind::gain, "gain", "gain"},
    TermNames{HubTorqueKind::dead_zone, "dead_zone", "dead zone"},
    TermNames{HubTorqueKind::saturation, "saturation", "saturation"}};

const TermNames& names_of(HubTorqueKind kind) {
  return *std::ranges::find(kTermNames, kind, &TermNames::kind);
}

}  // namespace

std::string_view term_name(HubTorqueKind kind) {
  return names_of(kind).name;
}

std::string_view to_string(HubTorqueKind kind) {
  return names_of(kind).key;
}

std::vector<Symptom> hub_torque_symptoms(const HubTorque& torque) {
  std::vector<Symptom> made;
  if (torque.tests == 0) return made;
  for (const HubTorqueTerm& term : torque.terms) {
    const bool first = &term == &torque.terms.front();
    std::string text = fmt::format(
        "Residual hub torque, {}. Explains {} of the excess residual of the hub signals{}.",
        meaning(term), percent(std::min(1.0, term.share)),
        first ? "" : " in addition to the terms above");
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
          ? fmt::format("Residual hub torque: no significant dependence on {}, no constant term.",
                        others)
          : fmt::format(
                "Residual hub torque: no significant further dependence on {}. {} of the excess "
                "residual remains unexplained.",
                others, percent(1.0 - torque.share));
  made.push_back(std::move(none));
  return made;
}

}  // namespace flexarm::diagnose
