#include "arm/given_effects.hpp"

#include "arm/compiled_formula.hpp"
#include "arm/formula_law.hpp"
#include "arm/input_error.hpp"

#include <fmt/format.h>

#include <span>
#include <utility>
#include <vector>

namespace flexarm::arm {

namespace {

std::shared_ptr<const CompiledFormula> compiled(const std::string& effect,
                                                const HubTorqueFormula& formula) {
  const std::string prefix = "effects." + effect + ".";
  std::vector<std::string> numbers;
  for (const auto& number : formula.numbers) numbers.push_back(number.name);
  try {
    return std::make_shared<const CompiledFormula>(formula.text, numbers);
  } catch (const InputError& error) {
    const std::string text = shown(formula.text, 200);
    if (!error.key().empty()) {
      throw InputError(fmt::format("{}{}: {} (hub_torque = \"{}\")", prefix, shown(error.key()),
                                   error.what(), text),
                       prefix + error.key());
    }
    throw InputError(fmt::format("{}hub_torque = \"{}\": {}", prefix, text, error.what()),
                     prefix + "hub_torque");
  }
}

}  // namespace

std::shared_ptr<const EffectDefinition> define_effect(
    const std::string& name, const HubTorqueFormula& formula,
    const std::map<std::string, double>& typical) {
  EffectDefinition made;
  made.name = name;
  made.meaning = "stated law of hub torque, " + formula.text;
  made.given = formula;
  for (const auto& number : formula.numbers) {
    made.parameters.push_back({.name = number.name,
                               .unit = number.unit.empty() ? kUnitNotGiven : number.unit,
                               .range = kAnyFinite,
                               .meaning = "number of the stated law",
                               .example = typical.at(number.name)});
  }
  const auto law_of = [shared = compiled(name, formula), name,
                       formula](const std::map<std::string, double>& values) {
    std::vector<double> numbers;
    for (const auto& number : formula.numbers) numbers.push_back(values.at(number.name));
    return FormulaLaw(name, shared, std::move(numbers));
  };
  law_of(typical).require_law();
  made.linear_term = [law_of](const Effect& effect, const Arm& /*arm*/, LinearTerms& terms) {
    const FormulaLaw law = law_of(effect.parameters);
    terms.hub_spring_N_m_per_rad += law.stiffness_N_m_per_rad();
    terms.damping.hub_N_m_s_per_rad += law.damping_N_m_s_per_rad();
  };
  made.hub_torque = [law_of](const Effect& effect) {
    return law_of(effect.parameters).beyond_slopes();
  };
  return std::make_shared<const EffectDefinition>(std::move(made));
}

std::shared_ptr<const EffectDefinition> define_effect(const HubTorqueTable& table) {
  require_valid(table);
  EffectDefinition made;
  made.name = kHubTorqueTable;
  made.meaning = "measured law of hub torque, a table over hub angle, hub velocity or both";
  made.given = table;
  made.hub_torque = [table](const Effect& /*effect*/) -> HubLaw {
    SmoothHubTorque smooth{
        [table](const HubState& hub, std::span<const double> /*z*/, std::span<double> /*rates*/) {
          const auto value = table.smooth(hub.angle_rad, hub.velocity_rad_per_s);
          return SmoothHubTorque::Value{value.torque_N_m, value.per_velocity_N_m_s};
        }};
    const DryFriction::Size friction{table.friction_N_m(), 0.0};
    if (friction.torque_N_m == 0.0) return smooth;
    return HubTorqueWithFriction{std::move(smooth),
                                 {[friction](double /*speed*/) { return friction; }}};
  };
  return std::make_shared<const EffectDefinition>(std::move(made));
}

}  // namespace flexarm::arm
