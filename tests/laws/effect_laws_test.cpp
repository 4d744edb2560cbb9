#include "arm/input_error.hpp"
#include "arm/linear_arm.hpp"
#include "effects/registry/vocabulary.hpp"
#include "laws/effect_arms.hpp"
#include "laws/subjects.hpp"
#include "response/formulation_maker.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

namespace flexarm::laws {
namespace {

using arm::Arm;
using arm::Sensor;
using arm::SensorKind;
using Complex = std::complex<double>;

constexpr int kRoots = 5;
constexpr Sensor kTipDisplacement{SensorKind::tip_displacement, 0.0};

/// Formulations at settings fine enough for arms with effects.
std::vector<Subject> fine_formulations() {
  std::vector<Subject> fine;
  for (auto& subject : every_formulation()) {
    if (subject.root_tolerance <= 1e-11) fine.push_back(subject);
  }
  return fine;
}

std::vector<EffectArm> lawful_arms() {
  auto arms = arms_with_one_effect();
  arms.push_back(arm_with_every_effect());
  return arms;
}

using SubjectAndArm = std::tuple<Subject, EffectArm>;

class EffectLaws : public testing::TestWithParam<SubjectAndArm> {
 protected:
  response::AnyFormulation make(const Arm& arm) const { return std::get<0>(GetParam()).make(arm); }
  const Arm& arm() const { return std::get<1>(GetParam()).arm; }
  arm::LinearArm linear() const { return arm::linear_arm(arm()); }
};

TEST_P(EffectLaws, PolesAndHubZerosInterlaceFromTheLowestModeOn) {
  const auto model = make(arm());
  const auto poles = response::poles(model, kRoots);
  const auto zeros = response::zeros(model, kHubAngle, kRoots);
  double pole = std::sqrt(poles.lowest_omega_squared_rad2_per_s2);
  for (std::size_t i = 0; i < poles.omega_rad_per_s.size(); ++i) {
    EXPECT_LT(pole, zeros.s_rad_per_s[i].imag());
    pole = poles.omega_rad_per_s[i];
    EXPECT_LT(zeros.s_rad_per_s[i].imag(), pole);
  }
}

TEST_P(EffectLaws, ADampedArmTakesPowerFromTheMotorAtEveryFrequency) {
  const auto model = make(arm());
  for (double f = 0.3; f < 60.0; f *= 1.37) {
    const Complex s(0.0, 2.0 * std::numbers::pi * f);
    EXPECT_GT(response::transfer_function(model, kHubVelocity, s).real(), 0.0) << f << " Hz";
  }
}

TEST_P(EffectLaws, ARealSystemAnswersConjugatedAtTheConjugate) {
  const auto model = make(arm());
  const Complex s(2.0, 130.0);
  for (const auto& sensor : {kHubAngle, kTipDisplacement, Sensor{SensorKind::strain, 0.25}}) {
    const Complex above = response::transfer_function(model, sensor, s);
    const Complex below = response::transfer_function(model, sensor, std::conj(s));
    constexpr double kRounding = 1e-13;
    EXPECT_LE(std::abs(below - std::conj(above)), kRounding * std::abs(above));
  }
}

TEST_P(EffectLaws, SlowMotionIsThatOfTheRigidArmOnItsRestoringSprings) {
  const auto model = make(arm());
  const auto numbers = linear();
  const double reach = numbers.hub_radius_m + numbers.length_m;
  const Complex s(0.0, 1e-3);
  const Complex angle = response::transfer_function(model, kHubAngle, s);
  if (numbers.turns_freely()) {
    // Friction and air take the rate theta': c + ca int (a + x)^2 dx; the next term is (s/omega)^2.
    const double air = numbers.air_damping_N_s_per_m2 *
                       (std::pow(reach, 3) - std::pow(numbers.hub_radius_m, 3)) / 3.0;
    const Complex rigid = arm::total_inertia_kg_m2(numbers) * s * s +
                          (numbers.hub_viscous_friction_N_m_s_per_rad + air) * s;
    constexpr double kSecondTerm = 1e-5;
    EXPECT_LE(std::abs(angle * rigid - 1.0), kSecondTerm);
  } else if (numbers.gravity_m_per_s2 == 0.0) {
    constexpr double kFirstTerm = 1e-3;  // s c/ks
    EXPECT_LE(std::abs(angle * numbers.hub_spring_N_m_per_rad - 1.0), kFirstTerm);
  }
}

TEST_P(EffectLaws, TheModalSumTendsToTheTransferFunction) {
  const auto model = make(arm());
  constexpr int kModes = 12;
  const std::array sensors = {kHubAngle, kTipDisplacement};
  const arm::ModalModel modal = response::modal_model(model, kModes, sensors, {});
  // Without coupling by damping.
  const auto exact = make(response::without_damping(arm()));
  const Complex s(0.0, 50.0);
  for (std::size_t k = 0; k < sensors.size(); ++k) {
    Complex sum = 0.0;
    for (std::size_t i = 0; i < modal.modes.size(); ++i) {
      const auto& mode = modal.modes[i];
      const double omega_squared = i == 0 ? modal.lowest_omega_squared_rad2_per_s2
                                          : mode.omega_rad_per_s * mode.omega_rad_per_s;
      sum += mode.sensor_values[k] * mode.hub_slope / (s * s + omega_squared);
    }
    sum /= modal.modal_mass_kg_m2;
    const Complex expected = response::transfer_function(exact, sensors[k], s);
    // A root spring passes moments to light modes: what is cut off falls as 1/omega^2 there.
    constexpr double kTruncation = 2e-4;
    EXPECT_LE(std::abs(sum - expected), kTruncation * std::abs(expected))
        << arm::to_string(sensors[k]);
  }
}

TEST_P(EffectLaws, DampedPolesAreStableAndEachIsAPoleOfTheTransferFunction) {
  const auto model = make(arm());
  const auto pairs = response::damped_poles(model, kRoots);
  for (const auto& pair : pairs.flexible) {
    for (const Complex s : {pair.first_rad_per_s, pair.second_rad_per_s}) {
      EXPECT_LT(s.real(), 0.0);
      // 1/G vanishes at s: linear in the distance from it.
      constexpr double kBeside = 1e-4;
      const Complex at = 1.0 / response::transfer_function(model, kHubAngle, s);
      const Complex beside = 1.0 / response::transfer_function(model, kHubAngle, s * (1 + kBeside));
      constexpr double kRootError = 1e-8;
      EXPECT_LE(std::abs(at), kRootError / kBeside * std::abs(beside)) << s;
    }
  }
}

TEST_P(EffectLaws, TheDampingMatrixIsSymmetricAndTakesEnergy) {
  const auto model = make(arm());
  const arm::ModalModel modal = response::modal_model(model, kRoots, {}, {});
  const std::size_t n = modal.modes.size();
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_GE(modal.damping_rad_per_s[i * n + i], 0.0);
    for (std::size_t j = 0; j < i; ++j) {
      const double d = modal.damping_rad_per_s[i * n + j];
      EXPECT_EQ(d, modal.damping_rad_per_s[j * n + i]);
      const double bound = modal.damping_rad_per_s[i * n + i] * modal.damping_rad_per_s[j * n + j];
      EXPECT_LE(d * d, bound * (1.0 + 1e-9)) << "Cauchy-Schwarz of a positive semidefinite form";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryFormulation, EffectLaws,
                         testing::Combine(testing::ValuesIn(fine_formulations()),
                                          testing::ValuesIn(lawful_arms())),
                         [](const auto& each) {
                           return std::get<0>(each.param).name + "_" + std::get<1>(each.param).name;
                         });

class EffectLimits : public testing::TestWithParam<Subject> {
 protected:
  std::vector<double> poles(const arm::Effects& effects) const {
    Arm arm = damped_arm();
    arm.effects = effects;
    return response::poles(GetParam().make(arm), kRoots).omega_rad_per_s;
  }
};

TEST_P(EffectLimits, AnEffectOfNoSizeChangesNothing) {
  const auto plain = poles({});
  const arm::Effects neutral = {
      effects::named("hub_inertia", {{"factor", 1.0}}),
      effects::named("flexural_rigidity", {{"factor", 1.0}}),
      effects::named("linear_density", {{"factor", 1.0}}),
      effects::named("payload_mass", {{"mass", 0.0}}),
      effects::named("payload_inertia", {{"inertia", 0.0}}),
      effects::named("payload_offset", {{"offset", 0.0}}),
      effects::named("hub_radius", {{"radius", 0.0}}),
      effects::named("hub_spring", {{"stiffness", 0.0}}),
      effects::named("gravity", {{"acceleration", 0.0}}),
      effects::named("attached_mass", {{"mass", 0.0}, {"position", 0.4}}),
      effects::named(
          "tuned_mass",
          {{"mass", 0.0}, {"frequency", 14.0}, {"damping_ratio", 0.1}, {"position", 0.4}}),
      effects::named("air_damping", {{"coefficient", 0.0}})};
  for (const auto& effect : neutral) {
    EXPECT_EQ(poles({effect}), plain) << effect.first;
  }
}

TEST_P(EffectLimits, SmallEffectsMoveThePolesInProportion) {
  const auto plain = poles({});
  const std::vector<std::pair<std::string, std::map<std::string, double>>> small = {
      {"hub_radius", {{"radius", 1e-7}}},
      {"payload_offset", {{"offset", 1e-7}}},
      {"gravity", {{"acceleration", 1e-6}}},
      {"hub_spring", {{"stiffness", 1e-6}}},
      {"root_compliance", {{"stiffness", 1e7}}},
      {"drive_compliance", {{"stiffness", 1e7}, {"rotor_share", 0.5}}},
      {"root_damping", {{"stiffness", 1e7}, {"time", 1e-3}}},
      {"attached_mass", {{"mass", 1e-7}, {"position", 0.4}}},
      {"local_stiffness_loss", {{"position", 0.4}, {"stiffness", 1e7}}}};
  for (const auto& [name, parameters] : small) {
    const auto moved = poles({effects::named(name, parameters)});
    for (std::size_t i = 0; i < plain.size(); ++i) {
      const double change = std::abs(moved[i] / plain[i] - 1.0);
      EXPECT_LE(change, 2e-5) << name << " pole " << i + 1;
    }
  }
}

TEST_P(EffectLimits, AStiffHubSpringHoldsTheHub) {
  Arm arm = damped_arm();
  const auto held = response::zeros(GetParam().make(arm), kHubAngle, kRoots);
  constexpr double kStiff = 1e6;  // of EI/l: what is left of the limit is about its inverse
  effects::put(arm, "hub_spring",
               {{"stiffness", kStiff * arm.beam.flexural_rigidity_N_m2() / arm.beam.length_m}});
  const auto poles = response::poles(GetParam().make(arm), kRoots - 1);
  EXPECT_NEAR(std::sqrt(poles.lowest_omega_squared_rad2_per_s2) / held.s_rad_per_s[0].imag(), 1.0,
              10.0 / kStiff);
  for (std::size_t i = 0; i < poles.omega_rad_per_s.size(); ++i) {
    EXPECT_NEAR(poles.omega_rad_per_s[i] / held.s_rad_per_s[i + 1].imag(), 1.0, 100.0 / kStiff);
  }
}

TEST_P(EffectLimits, AStiffArmThatHangsIsAPendulum) {
  Arm arm = damped_arm();
  const double g = 9.81;
  effects::put(arm, "gravity", {{"acceleration", g}});
  effects::put(arm, "flexural_rigidity", {{"factor", 1e6}});
  const double l = arm.beam.length_m;
  const double mass = arm.beam.linear_density_kg_per_m() * l;
  const double expected =
      g * (mass * l / 2.0 + arm.payload.mass_kg * l) / arm::total_inertia_kg_m2(arm);
  const auto poles = response::poles(GetParam().make(arm), 1);
  constexpr double kElasticity = 1e-5;  // about (pendulum frequency/first pole)^2
  EXPECT_NEAR(poles.lowest_omega_squared_rad2_per_s2 / expected, 1.0, kElasticity);
}

TEST_P(EffectLimits, AnArmThatStandsUpFallsAndABucklingOneIsRefused) {
  Arm arm = damped_arm();
  effects::put(arm, "gravity", {{"acceleration", -1.0}});
  EXPECT_LT(response::poles(GetParam().make(arm), 1).lowest_omega_squared_rad2_per_s2, 0.0);
  // The first flexible mode of the free arm buckles far above the clamped column's 7.84 EI/l^2.
  const double load_unit = arm.beam.flexural_rigidity_N_m2() /
                           (std::pow(arm.beam.length_m, 3) * arm.beam.linear_density_kg_per_m());
  effects::put(arm, "gravity", {{"acceleration", -500.0 * load_unit}});
  try {
    response::poles(GetParam().make(arm), 1);
    FAIL() << "a buckled arm was accepted";
  } catch (const arm::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("effects.gravity.acceleration"), std::string::npos)
        << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(EveryFormulation, EffectLimits, testing::ValuesIn(fine_formulations()),
                         [](const auto& subject) { return subject.param.name; });

}  // namespace
}  // namespace flexarm::laws
