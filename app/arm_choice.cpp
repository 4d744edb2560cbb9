#include "app/arm_choice.hpp"

#include "app/command.hpp"
#include "arm/arm_file.hpp"
#include "arm/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace flexarm::app {

std::vector<arm::Arm> ArmChoice::arms() const {
  arm::Arm base = file.empty() ? arm::paper_arm() : arm::read_arm_file(file);
  if (payload_inertia_kg_m2) base.payload.inertia_kg_m2 = *payload_inertia_kg_m2;
  if (hub_inertia_kg_m2) base.hub.inertia_kg_m2 = *hub_inertia_kg_m2;
  std::vector<arm::Arm> arms;
  if (payload_masses_kg.empty()) arms.push_back(base);
  for (const double mass : payload_masses_kg) {
    const bool again = std::ranges::any_of(
        arms, [mass](const arm::Arm& arm) { return arm.payload.mass_kg == mass; });
    if (again) throw arm::InputError(fmt::format("--payload-mass: {} is given twice", mass));
    arms.push_back(base);
    arms.back().payload.mass_kg = mass;
  }
  for (const auto& arm : arms) arm::require_valid(arm);
  return arms;
}

void add_arm_choice(CLI::App& parser, ArmChoice& choice) {
  parser.add_option("ARM", choice.file, "Arm file; the paper's arm when left out")
      ->check(not_empty());
  parser
      .add_option("--payload-mass", choice.payload_masses_kg,
                  "Payload mass [kg] in place of the file's; several separated by commas")
      ->delimiter(',')
      ->check(not_empty())
      ->allow_extra_args(false);
  parser.add_option("--payload-inertia", choice.payload_inertia_kg_m2,
                    "Payload inertia about the tip [kg m^2] in place of the file's");
  parser.add_option("--hub-inertia", choice.hub_inertia_kg_m2,
                    "Hub inertia [kg m^2] in place of the file's");
}

std::filesystem::path folder_of(const std::filesystem::path& out, const arm::Arm& arm,
                                std::size_t arms) {
  return arms == 1 ? out : out / fmt::format("payload-{}kg", arm.payload.mass_kg);
}

std::string describe(const arm::Arm& arm) {
  return fmt::format(
      "{}\n"
      "l {:g} m, EI {:.6g} N m^2, m {:.6g} kg/m, I_T {:.6g} kg m^2\n"
      "Ih {:g} kg m^2 (epsilon {:.4g}), Mp {:g} kg (eta {:.4g}), Ip {:g} kg m^2\n"
      "kv {:g} s, c {:g} N m s/rad\n",
      arm.name.empty() ? "arm" : arm.name, arm.beam.length_m, arm.beam.flexural_rigidity_N_m2(),
      arm.beam.linear_density_kg_per_m(), arm::total_inertia_kg_m2(arm), arm.hub.inertia_kg_m2,
      arm::hub_inertia_ratio(arm), arm.payload.mass_kg, arm::payload_mass_ratio(arm),
      arm.payload.inertia_kg_m2, arm.damping.kelvin_voigt_s,
      arm.hub.viscous_friction_N_m_s_per_rad);
}

}  // namespace flexarm::app
