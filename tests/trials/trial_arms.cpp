#include "tests/trials/trial_arms.hpp"

#include "arm/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

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

TrialArm link(std::string name, arm::Beam beam, double shear_modulus_Pa, arm::Hub hub,
              double kelvin_voigt_s, double torque_N_m) {
  arm::Arm arm;
  arm.name = std::move(name);
  arm.beam = beam;
  arm.beam.shear_modulus_Pa = shear_modulus_Pa;
  arm.hub = hub;
  arm.damping.kelvin_voigt_s = kelvin_voigt_s;
  return {arm, torque_N_m};
}

TrialArm steel_link() {
  return link("steel link", arm::Beam::from_section(0.42, 0.021, 0.00085, 7850.0, 2e11), 7.7e10,
              {0.0019, 0.004}, 1.5e-4, 0.006);
}

TrialArm sandwich_link() {
  return link("sandwich link", arm::Beam::from_section(0.35, 0.03, 0.006, 1400.0, 5e9), 2e8,
              {2.5e-4, 0.003}, 5e-5, 0.012);
}

TrialArm steel_ruler() {
  return link("steel ruler", arm::Beam::from_section(0.5, 0.03, 0.001, 7850.0, 2e11), 7.7e10,
              {0.002, 0.004}, 1.5e-4, 0.008);
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
