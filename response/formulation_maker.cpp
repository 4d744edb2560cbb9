#include "response/formulation_maker.hpp"

#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"
#include "arm/rigid_hub.hpp"
#include "response/arm_parts.hpp"
#include "response/settings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace flexarm::response {

void require_formulation(std::string_view key, std::string_view name) {
  if (std::ranges::find(kFormulationNames, name) != kFormulationNames.end()) return;
  const std::vector<std::string> names(kFormulationNames.begin(), kFormulationNames.end());
  throw arm::InputError(fmt::format("{} {}: unknown{}; allowed: {}", key, arm::shown(name),
                                    arm::did_you_mean(name, names), fmt::join(names, ", ")));
}

AnyFormulation make_formulation(std::string_view formulation, const arm::Arm& arm, int roots) {
  require_formulation("formulation", formulation);
  arm::require_count(roots);
  arm::Arm linear = take_apart(arm).linear;
  if (!arm::has_beam(linear)) return RigidHub(std::move(linear));
  if (formulation == exact_tf::ExactArm::kName) return exact_tf::ExactArm(std::move(linear));
  if (roots > kMostRoots) {
    throw arm::out_of_range(
        "roots", roots, "",
        fmt::format("at most {} for {}; exact_tf has no limit", kMostRoots, formulation));
  }
  if (formulation == fem::FemArm::kName) return fem::FemArm(std::move(linear), fem_settings(roots));
  return assumed_modes::AssumedModesArm(std::move(linear), assumed_modes_settings(roots));
}

AnyFormulation formulation_of_fit(const arm::Arm& arm) {
  arm::Arm linear = take_apart(arm).linear;
  if (!arm::has_beam(linear)) return RigidHub(std::move(linear));
  return exact_tf::ExactArm(std::move(linear), exact_tf::Arithmetic::working);
}

AnyFormulation with_arm(const AnyFormulation& formulation, const arm::Arm& arm) {
  const arm::Arm linear = take_apart(arm).linear;
  return std::visit(
      [&linear](const auto& f) -> AnyFormulation {
        using F = std::decay_t<decltype(f)>;
        if constexpr (std::is_same_v<F, exact_tf::ExactArm> || std::is_same_v<F, RigidHub>) {
          return F(linear);
        } else {
          return F(linear, f.options());
        }
      },
      formulation);
}

arm::Arm without_damping(const arm::Arm& arm) {
  arm::Arm undamped = arm;
  undamped.damping = {};
  undamped.hub.viscous_friction_N_m_s_per_rad = 0.0;
  for (auto& [name, effect] : undamped.effects) {
    if (!effect.definition->linear_term) continue;
    effect = arm::redefined(effect, [](arm::EffectDefinition& definition) {
      definition.linear_term = [term = definition.linear_term](const arm::Effect& of,
                                                               const arm::Arm& whole,
                                                               arm::LinearTerms& terms) {
        const arm::LinearTerms::Damping before = terms.damping;
        term(of, whole, terms);
        terms.damping = before;
        if (terms.drive) terms.drive->retardation_s = 0.0;
        for (auto& spring : terms.springs) spring.retardation_s = 0.0;
        for (auto& mass : terms.masses) {
          if (mass.suspension) mass.suspension->damping_N_s_per_m = 0.0;
        }
      };
    });
  }
  return undamped;
}

}  // namespace flexarm::response
