#include "app/arm_choice.hpp"

#include "app/command.hpp"
#include "app/list_option.hpp"
#include "app/screen.hpp"
#include "arm/effects.hpp"
#include "arm/input_error.hpp"
#include "arm/linear_arm.hpp"
#include "arm/plausibility.hpp"
#include "arm/rigid_hub.hpp"
#include "arm/unit_suffix.hpp"
#include "effects/registry/vocabulary.hpp"
#include "measured/files/usable_arm.hpp"
#include "response/arm_parts.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <variant>

namespace flexarm::app {

namespace {

/// "with root_compliance: stiffness 30 N m/rad".
std::string describe_effect(const std::string& name, const arm::Effect& effect) {
  std::vector<std::string> parts;
  for (const auto& parameter : effect.definition->parameters) {
    const auto value = effect.parameters.find(parameter.name);
    if (value == effect.parameters.end()) continue;
    const std::string unit = arm::unit_suffix(parameter.unit);
    parts.push_back(fmt::format("{} {:g}{}", parameter.name, value->second, unit));
  }
  if (!effect.sensor.empty()) parts.push_back(effect.sensor);
  if (const auto* formula = std::get_if<arm::HubTorqueFormula>(&effect.definition->given)) {
    parts.push_back("hub torque " + formula->text);
  }
  return fmt::format("with {}{}{}", name, parts.empty() ? "" : ": ", fmt::join(parts, ", "));
}

/// "--payload-mass 0.05 kg": what the command line has changed in the arm of the file, which was
/// usable by itself.
std::vector<std::string> changed_numbers(const ArmChoice& choice, const arm::Arm& arm) {
  std::vector<std::string> changes;
  if (!choice.payload_masses_kg.empty()) {
    changes.push_back(fmt::format("--payload-mass {} kg", arm.payload.mass_kg));
  }
  if (choice.payload_inertia_kg_m2) {
    changes.push_back(fmt::format("--payload-inertia {} kg m^2", *choice.payload_inertia_kg_m2));
  }
  if (choice.hub_inertia_kg_m2) {
    changes.push_back(fmt::format("--hub-inertia {} kg m^2", *choice.hub_inertia_kg_m2));
  }
  return changes;
}

}  // namespace

std::vector<arm::Arm> ArmChoice::arms() const {
  arm::Arm base =
      file.empty() ? arm::paper_arm() : measured::read_usable_arm(file, effects::vocabulary());
  if (payload_inertia_kg_m2) base.payload.inertia_kg_m2 = *payload_inertia_kg_m2;
  if (hub_inertia_kg_m2) base.hub.inertia_kg_m2 = *hub_inertia_kg_m2;
  std::vector<arm::Arm> arms;
  if (payload_masses_kg.empty()) arms.push_back(base);
  for (const double mass : payload_masses_kg) {
    const bool again = std::ranges::any_of(
        arms, [mass](const arm::Arm& arm) { return arm.payload.mass_kg == mass; });
    if (again) throw arm::InputError(fmt::format("--payload-mass: {} given twice", mass));
    arms.push_back(base);
    arms.back().payload.mass_kg = mass;
  }
  for (const auto& arm : arms) {
    try {
      measured::require_usable(arm);
    } catch (const arm::InputError& error) {
      throw arm::InputError(
          fmt::format("{}: {}", fmt::join(changed_numbers(*this, arm), ", "), error.what()));
    }
  }
  return arms;
}

void add_arm_choice(CLI::App& parser, ArmChoice& choice) {
  parser.add_option("ARM", choice.file, "Arm file; default: the arm of the paper")
      ->check(not_empty());
  add_list_option(parser, "--payload-mass", choice.payload_masses_kg,
                  "Payload mass [kg] instead of that in the file; several, comma-separated");
  parser.add_option(
      "--payload-inertia", choice.payload_inertia_kg_m2,
      "Payload inertia about its centre of mass [kg m^2] instead of that in the file");
  parser.add_option("--hub-inertia", choice.hub_inertia_kg_m2,
                    "Hub inertia [kg m^2] instead of that in the file");
}

std::string subject_of(const ArmChoice& choice) {
  return choice.file.empty() ? "the paper's arm" : choice.file;
}

std::filesystem::path folder_of(const std::filesystem::path& out, const arm::Arm& arm,
                                std::size_t arms) {
  return arms == 1 ? out : out / fmt::format("payload-{}kg", arm.payload.mass_kg);
}

std::string describe(const arm::Arm& arm) {
  const arm::LinearArm linear = arm::linear_arm(arm);
  std::string lines = screen_paragraph(arm.name.empty() ? "arm" : arm.name);
  if (arm::has_beam(arm)) {
    lines += screen_paragraph(
        fmt::format("l {:g} m, EI {:.6g} N m^2, m {:.6g} kg/m, I_T {:.6g} kg m^2", linear.length_m,
                    linear.flexural_rigidity_N_m2, linear.linear_density_kg_per_m,
                    arm::total_inertia_kg_m2(linear)));
    lines += screen_paragraph(
        fmt::format("Ih {:g} kg m^2 (epsilon {:.4g}), Mp {:g} kg (eta {:.4g}), Ip {:g} kg m^2",
                    linear.hub_inertia_kg_m2, arm::hub_inertia_ratio(arm), linear.payload_mass_kg,
                    arm::payload_mass_ratio(arm), linear.payload_tip_inertia_kg_m2));
    lines += screen_paragraph(fmt::format("kv {:g} s, c {:g} N m s/rad", linear.kelvin_voigt_s,
                                          linear.hub_viscous_friction_N_m_s_per_rad));
  } else {
    lines += fmt::format("rigid hub without a beam\nIh {:g} kg m^2, c {:g} N m s/rad\n",
                         linear.hub_inertia_kg_m2, linear.hub_viscous_friction_N_m_s_per_rad);
  }
  for (const auto& [name, effect] : arm.effects) {
    lines += screen_paragraph(describe_effect(name, effect), 2);
  }
  if (!arm.effects.empty()) lines += "(values include the linear effects)\n";
  for (const auto& [name, hypothesis] : arm.hypotheses) {
    if (arm.effects.contains(name)) continue;
    lines += fmt::format("not included (hypothesis, a number has no value): {}: hub torque {}\n",
                         name, hypothesis.formula.text);
  }
  for (const auto& note : arm::plausibility_notes(arm)) {
    lines += screen_note(note);
  }
  return lines;
}

std::string left_out_of_roots(const arm::Arm& arm) {
  const auto nonlinear = response::nonlinear_effects(arm);
  const auto linearised = response::linearised_effects(arm);
  std::vector<std::string> names;
  for (const auto& [name, effect] : arm.effects) {
    if (effect.definition->is_of_linear_arm()) continue;
    const bool is_linear =
        effect.definition->linear_term && std::ranges::find(nonlinear, name) == nonlinear.end();
    if (!is_linear && std::ranges::find(linearised, name) == linearised.end()) {
      names.push_back(name);
    }
  }
  std::string text;
  if (!names.empty()) {
    text += fmt::format("not included (not part of the linear equations): {}\n",
                        fmt::join(names, ", "));
  }
  if (!linearised.empty()) {
    text += fmt::format("linearised at rest: {}\n", fmt::join(linearised, ", "));
  }
  return text;
}

}  // namespace flexarm::app
