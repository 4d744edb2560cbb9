#include "tests/trials/trial_arms.hpp"

#include "arm/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace flexarm::trials {

namespace {

TrialArm aluminium_link() {
  arm::Arm arm = arm::paper_arm();
  arm.name = "aluminium link";
  arm.beam.shear_modulus_Pa = 2.67e10;
  arm.hub.viscous_friction_N_m_s_per_rad = 0.002;
  arm.damping.kelvin_voigt_s = 1.2e-4;
  return {arm, 0.03};
}

TrialArm steel_link() {
  arm::Arm arm;
  arm.name = "steel link";
  arm.beam = arm::Beam::from_section(0.42, 0.021, 0.00085, 7850.0, 2e11);
  arm.beam.shear_modulus_Pa = 7.7e10;
  arm.hub = {0.0019, 0.004};
  arm.damping.kelvin_voigt_s = 1.5e-4;
  return {arm, 0.006};
}

TrialArm sandwich_link() {
  arm::Arm arm;
  arm.name = "sandwich link";
  arm.beam = arm::Beam::from_section(0.35, 0.03, 0.006, 1400.0, 5e9);
  arm.beam.shear_modulus_Pa = 2e8;
  arm.hub = {2.5e-4, 0.003};
  arm.damping.kelvin_voigt_s = 5e-5;
  return {arm, 0.012};
}

TrialArm steel_ruler() {
  arm::Arm arm;
  arm.name = "steel ruler";
  arm.beam = arm::Beam::from_section(0.5, 0.03, 0.001, 7850.0, 2e11);
  arm.beam.shear_modulus_Pa = 7.7e10;
  arm.hub = {0.002, 0.004};
  arm.damping.kelvin_voigt_s = 1.5e-4;
  return {arm, 0.008};
}

}  // namespace

const std::vector<TrialArm>& trial_arms() {
  static const std::vector<TrialArm> arms = {aluminium_link(), steel_link(), sandwich_link()};
  return arms;
}

const TrialArm& find_trial_arm(std::string_view name) {
  static const TrialArm ruler = steel_ruler();
  if (name == ruler.arm.name) return ruler;
  const auto& drawn = trial_arms();
  const auto found =
      std::ranges::find(drawn, name, [](const TrialArm& one) { return one.arm.name; });
  if (found != drawn.end()) return *found;
  throw arm::InputError(fmt::format(
      "--arm {}: must be aluminium link, steel link, sandwich link or steel ruler", name));
}

}  // namespace flexarm::trials
