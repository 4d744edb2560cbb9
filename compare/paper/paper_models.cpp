#include "compare/paper/paper_models.hpp"

#include "compare/paper/paper_tables.hpp"
#include "compare/paper/paper_topics.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <fmt/format.h>

namespace flexarm::compare::paper {

namespace {

constexpr double kPayloadMass_kg = 0.05;
constexpr double kPayloadInertia_kg_m2 = 1e-4;
constexpr double kHubFriction_N_m_s_per_rad = 0.002;

}  // namespace

arm::Arm arm_with_payload_mass() {
  arm::Arm arm = arm::paper_arm();
  arm.payload.mass_kg = kPayloadMass_kg;
  return arm;
}

arm::Arm arm_with_payload() {
  arm::Arm arm = arm_with_payload_mass();
  arm.payload.inertia_kg_m2 = kPayloadInertia_kg_m2;
  return arm;
}

arm::Arm arm_with_damping() {
  arm::Arm arm = arm::paper_arm();
  const double omega = exact_tf::ExactArm(arm).poles(1).omega_rad_per_s[0];
  arm.damping.kelvin_voigt_s = 2.0 * tables().hub_model.damping_ratio[0].value / omega;
  return arm;
}

arm::Arm arm_with_hub_friction() {
  arm::Arm arm = arm::paper_arm();
  arm.hub.viscous_friction_N_m_s_per_rad = kHubFriction_N_m_s_per_rad;
  return arm;
}

arm::Arm arm_with_hub_inertia(double inertia_kg_m2) {
  arm::Arm arm = arm::paper_arm();
  arm.hub.inertia_kg_m2 = inertia_kg_m2;
  return arm;
}

std::string describe_arms() {
  return fmt::format(
      "All for the arm of Table 1. \"Payload mass\": {} kg at its tip; \"payload\": that mass and "
      "{} kg m^2; \"hub friction\": {} N m s/rad. \"Damped\": Kelvin-Voigt time constant {:.3g} s, "
      "which gives mode 1 the damping ratio of Table 6. Sums and products have {} terms.",
      kPayloadMass_kg, kPayloadInertia_kg_m2, kHubFriction_N_m_s_per_rad,
      arm_with_damping().damping.kelvin_voigt_s, kTerms);
}

Stations stations(double length_m) {
  constexpr int kPanels = 4;
  using Rule = boost::math::quadrature::gauss<double, 15>;
  const double half_panel_m = length_m / (2.0 * kPanels);
  Stations result;
  const auto add = [&result, half_panel_m](double middle_m, double node, double weight) {
    result.position_m.push_back(middle_m + half_panel_m * node);
    result.weight_m.push_back(half_panel_m * weight);
  };
  for (int panel = 0; panel < kPanels; ++panel) {
    const double middle_m = (2 * panel + 1) * half_panel_m;
    // The rule has an odd number of nodes: the first is 0, the others come in pairs.
    add(middle_m, 0.0, Rule::weights()[0]);
    for (std::size_t k = 1; k < Rule::abscissa().size(); ++k) {
      add(middle_m, -Rule::abscissa()[k], Rule::weights()[k]);
      add(middle_m, Rule::abscissa()[k], Rule::weights()[k]);
    }
  }
  return result;
}

}  // namespace flexarm::compare::paper
