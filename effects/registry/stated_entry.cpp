#include "effects/registry/stated_entry.hpp"

#include "arm/compiled_formula.hpp"
#include "arm/given_effects.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::effects {

namespace {

struct StatedLaw {
  std::vector<std::string> names;
  arm::CompiledFormula formula;

  explicit StatedLaw(const arm::HubTorqueFormula& stated)
      : names(names_of(stated)), formula(stated.text, names) {}

  static std::vector<std::string> names_of(const arm::HubTorqueFormula& stated) {
    std::vector<std::string> made;
    for (const auto& number : stated.numbers) made.push_back(number.name);
    return made;
  }

  /// Whether the law is 0 at 0 of that number, whatever the motion.
  bool vanishes_with(const std::string& number, std::map<std::string, double> values) const {
    constexpr std::array<double, 4> kSizes = {-1.3, -0.07, 0.02, 1.7};
    values[number] = 0.0;
    std::vector<double> ordered;
    for (const std::string& name : names) ordered.push_back(values.at(name));
    for (const double angle : kSizes) {
      for (const double velocity : kSizes) {
        const arm::HubState hub{angle, velocity, angle - velocity, 0.5 * velocity * velocity};
        for (const double direction : {-1.0, 1.0}) {
          if (formula(hub, direction, ordered) != 0.0) return false;
        }
      }
    }
    return true;
  }
};

SearchedParameter searched(const std::string& name, const arm::Interval& range, bool vanishes) {
  SearchedParameter made{name, range.lowest, range.highest};
  if (range.lowest > 0.0) {
    made.spacing = vanishes ? Spacing::from_zero : Spacing::logarithmic;
  } else {
    made.spacing = Spacing::linear;
    if (vanishes && range.highest >= 0.0) made.neutral = 0.0;
  }
  return made;
}

/// A spring or a dashpot of the hub is in the linear equations too.
Shows shown_by(const arm::EffectDefinition& definition,
               const std::map<std::string, double>& values) {
  const arm::Effect effect{.definition = {std::shared_ptr<void>(), &definition},
                           .parameters = values};
  arm::LinearTerms terms;
  definition.linear_term(effect, {}, terms);
  return terms == arm::LinearTerms{} ? Shows::in_time : Shows::in_all;
}

/// What the law is a function of.
std::string depends_on(const arm::CompiledFormula& formula) {
  const std::map<std::string, std::string> words = {{"omega", "the hub velocity"},
                                                    {"t", "time"},
                                                    {"tau", "the torque"},
                                                    {"theta", "the hub angle"}};
  std::vector<std::string> named;
  for (const auto& [variable, word] : words) {
    if (formula.uses(variable) || (variable == "omega" && formula.has_direction())) {
      named.push_back(word);
    }
  }
  return named.empty() ? "a constant" : fmt::format("a function of {}", fmt::join(named, " and "));
}

}  // namespace

Entry stated_entry(const std::string& name, const arm::HubTorqueHypothesis& stated) {
  const StatedLaw law(stated.formula);
  const auto typical = stated.typical();
  std::vector<SearchedParameter> parameters;
  for (const auto& [number, range] : stated.ranges) {
    parameters.push_back(searched(number, range, law.vanishes_with(number, typical)));
  }
  Entry made;
  made.definition = arm::define_effect(name, stated.formula, typical);
  made.shows = shown_by(*made.definition, typical);
  made.search = [parameters = std::move(parameters)](const Scales& /*scales*/) {
    return parameters;
  };
  made.speaks_for =
      fmt::format("residual hub torque {}, as the arm file states it", stated.formula.text);
  made.refuted_by = fmt::format("a residual hub torque that is not {}", depends_on(law.formula));
  return made;
}

}  // namespace flexarm::effects
