// The trials' own elements against the exact transfer functions: two derivations from the energies
// that share no code, so that arm::linear_arm, which all formulations of the product start from,
// does not stand by itself.
#include "effects/registry/vocabulary.hpp"
#include "exact_tf/exact_arm.hpp"
#include "tests/trials/element_modes.hpp"
#include "tests/trials/experiment_plan.hpp"
#include "tests/trials/with_effects.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace flexarm::trials {
namespace {

constexpr int kElements = 40;
constexpr int kOrders = 3;

/// Cubic elements of length h make a frequency too high by (beta h)^4/1440: the deflection that
/// they cannot bend into, x^4 within an element, is off by h^4 y''''/720 in the square of the
/// frequency. A margin of two for meshes that a crack divides and for shear strains.
double mesh_error(double omega_rad_per_s, const TrueArm& arm) {
  const double beta = std::sqrt(
      omega_rad_per_s * std::sqrt(arm.linear_density_kg_per_m / arm.flexural_rigidity_N_m2));
  const double h = arm.length_m / kElements;
  return 2.0 * std::pow(beta * h, 4) / 1440.0;
}

/// Assembled, an eigenvalue is off by up to epsilon times the largest, which grows as h^-4, with
/// shear as h^-2 k G/E (l/t)^2 more: 3e9 times the first here; a frequency by half of it.
constexpr double kRounding = 0.5 * 3e9 * std::numeric_limits<double>::epsilon();

struct LinearCase {
  std::size_t arm;
  std::vector<HiddenCause> hidden;
};

LinearCase linear_case(const std::string& name);

/// By the names of linear_names(): only what is run is computed.
class AgainstExact : public testing::TestWithParam<std::string> {
 protected:
  const TrialArm& trial_arm() const { return trial_arms()[case_.arm]; }
  World world() const {
    World made{trial_arm().arm};
    made.arm.payload = {0.3 * made.arm.beam.linear_density_kg_per_m() * made.arm.beam.length_m,
                        2e-4};
    made.hidden = case_.hidden;
    return made;
  }

 private:
  const LinearCase case_ = linear_case(GetParam());
};

TEST_P(AgainstExact, PolesAgreeWithTheirDamping) {
  const TrueArm arm = true_arm(world());
  const ElementModel model(arm, kElements);
  const auto own = damped_poles_rad_per_s(model, kOrders);
  const auto exact = exact_tf::ExactArm(with_effects(world())).damped_poles(kOrders).flexible;
  for (std::size_t i = 0; i < own.size(); ++i) {
    const std::complex<double> pole = exact[i].first_rad_per_s;
    const double size = std::abs(pole);
    EXPECT_LT(std::abs(own[i] - pole), (kRounding + mesh_error(size, arm)) * size)
        << i << ": " << own[i] << " for " << pole;
  }
}

TEST_P(AgainstExact, HubAngleZerosAgree) {
  const TrueArm arm = true_arm(world());
  const ElementModel model(arm, kElements);
  const auto own = held_omegas_rad_per_s(model, kOrders);
  const auto exact = exact_tf::ExactArm(with_effects(world()))
                         .zeros({arm::SensorKind::hub_angle, 0.0}, kOrders)
                         .s_rad_per_s;
  for (std::size_t i = 0; i < own.size(); ++i) {
    EXPECT_NEAR(own[i], std::abs(exact[i]), (kRounding + mesh_error(own[i], arm)) * own[i]) << i;
  }
}

TEST_P(AgainstExact, HubSlopesAndProjectedDampingAgree) {
  const TrueArm arm = true_arm(world());
  const ElementModes modes = undamped_modes(ElementModel(arm, kElements), kOrders);
  const auto exact = exact_tf::ExactArm(with_effects(world())).modal_model(kOrders, {}, {});
  EXPECT_NEAR(modes.modal_mass_kg_m2, exact.modal_mass_kg_m2, 1e-12 * exact.modal_mass_kg_m2);
  for (std::size_t i = 0; i < exact.modes.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const double omega = std::sqrt(std::abs(modes.omega_squared_rad2_per_s2(at)));
    // A shape errs with the frequencies of the modes that it mixes with, up to some ten times.
    constexpr double kOfShapes = 10.0;
    EXPECT_NEAR(modes.shapes(ElementModel::kHub, at), exact.modes[i].hub_slope,
                kOfShapes * (kRounding + mesh_error(omega, arm)) * exact.modes[i].hub_slope)
        << i;
  }
}

TEST_P(AgainstExact, ResponsesAgreeBelowAndBetweenThePoles) {
  const auto& sensors = planned_sensors();
  const TrueArm arm = true_arm(world());
  const ElementModel model(arm, kElements, sensors);
  const exact_tf::ExactArm exact(with_effects(world()));
  const double scale = NaturalSizes(trial_arm()).omega_rad_per_s;
  // Nearly static, and off the imaginary axis, where no pole magnifies an error.
  for (const std::complex<double> part : {std::complex(0.0, 0.1), {1.0, 2.0}, {5.0, 30.0}}) {
    const std::complex<double> s = scale * part;
    const auto u = motion_per_torque(model, s);
    for (std::size_t i = 0; i < sensors.size(); ++i) {
      const auto own = std::pow(s, arm::derivative_order(sensors[i])) * model.reading(i).of(u, s);
      const auto other = exact.transfer_function(sensors[i], s);
      constexpr double kOfResponses = 10.0;
      EXPECT_LT(std::abs(own - other),
                kOfResponses * (kRounding + mesh_error(std::abs(s), arm)) * std::abs(other))
          << arm::to_string(sensors[i]) << " at " << s;
    }
  }
}

TEST(AgainstExactWhatMustFail, ACauseOfTheWrongSignIsSeen) {
  World world{trial_arms().front().arm};
  world.arm.payload.mass_kg = 0.05;
  world.hidden = {{"payload_offset", {{"offset", 0.001}}}};
  const double exact = exact_tf::ExactArm(with_effects(world)).poles(1).omega_rad_per_s[0];
  world.hidden = {{"payload_offset", {{"offset", -0.001}}}};
  const TrueArm arm = true_arm(world);
  const ElementModes modes = undamped_modes(ElementModel(arm, kElements), 1);
  const double own = std::sqrt(modes.omega_squared_rad2_per_s2(1));
  EXPECT_GT(std::abs(own - exact), 100.0 * (kRounding + mesh_error(own, arm)) * exact);
}

/// The cause at this part of its largest size, or less, so that its poles swing.
HiddenCause hidden_in(const TrialArm& of, const Cause& cause, double part) {
  for (;; part *= 0.5) {
    const World world = with_hidden(World{of.arm}, of, cause, part * cause.largest, Chance{});
    const auto poles = damped_poles_rad_per_s(ElementModel(true_arm(world), kElements), kOrders);
    if (poles.back().imag() > std::abs(poles.back().real())) return world.hidden.front();
  }
}

constexpr std::size_t kAluminium = 0;
constexpr std::size_t kSandwich = 2;
constexpr double kPartAlone = 0.2;  // of the largest size

/// Every cause of the linear arm that the product has a name for.
std::vector<Cause> linear_causes() {
  std::vector<Cause> linear;
  for (const Cause& cause : causes()) {
    if (cause.outside || cause.acts_on > ActsOn::linear_arm) continue;
    if (effects::find(cause.name) != nullptr) linear.push_back(cause);
  }
  return linear;
}

/// All of them that do not exclude each other.
std::vector<HiddenCause> all_causes(bool with_shear) {
  std::vector<HiddenCause> all;
  for (const Cause& cause : linear_causes()) {
    if (cause.name == "root_damping") continue;  // takes the place of root_compliance
    if (!with_shear && !cause.shows_on_arm.empty()) continue;
    all.push_back(hidden_in(trial_arms()[kSandwich], cause, 0.3 * kPartAlone));
  }
  return all;
}

const std::map<std::string, std::vector<HiddenCause>> kStatedCases = {
    {"payload",
     {{"payload_offset", {{"offset", 0.05}}},
      {"payload_inertia", {{"inertia", 4e-3}}},
      {"payload_mass", {{"mass", 0.05}}},
      {"gravity", {{"acceleration", 9.81}}},
      {"hub_radius", {{"radius", 0.06}}}}},
    {"springs",
     {{"root_compliance", {{"stiffness", 20.0}}},
      {"local_stiffness_loss", {{"position", 0.333}, {"stiffness", 9.0}}},
      {"hub_spring", {{"stiffness", 1.5}}},
      {"hub_radius", {{"radius", 0.06}}}}},
    {"hanging_masses",
     {{"attached_mass", {{"mass", 0.06}, {"position", 0.5}}},
      {"tuned_mass",
       {{"mass", 0.05}, {"frequency", 9.0}, {"damping_ratio", 0.1}, {"position", 0.333}}},
      {"local_stiffness_loss", {{"position", 0.333}, {"stiffness", 9.0}}},
      {"gravity", {{"acceleration", 9.81}}},
      {"hub_radius", {{"radius", 0.06}}}}}};

/// Every cause of the linear arm at a typical size, alone and together.
std::vector<std::string> linear_names() {
  std::vector<std::string> names = {"none", "all", "all_but_shear"};
  for (const Cause& cause : linear_causes()) names.push_back(cause.name);
  for (const auto& [name, hidden] : kStatedCases) names.push_back(name);
  return names;
}

LinearCase linear_case(const std::string& name) {
  if (name == "none") return {kAluminium, {}};
  if (name == "all") return {kSandwich, all_causes(true)};
  if (name == "all_but_shear") return {kSandwich, all_causes(false)};
  const auto stated = kStatedCases.find(name);
  if (stated != kStatedCases.end()) return {kAluminium, stated->second};
  const Cause& cause = find_cause(name);
  const std::size_t arm = cause.shows_on_arm.empty() ? kAluminium : kSandwich;
  return {arm, {hidden_in(trial_arms()[arm], cause, kPartAlone)}};
}

INSTANTIATE_TEST_SUITE_P(Causes, AgainstExact, testing::ValuesIn(linear_names()),
                         [](const auto& one) { return one.param; });

}  // namespace
}  // namespace flexarm::trials
