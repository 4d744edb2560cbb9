// drive_compliance against the arm beyond it, joined in closed form, and against its limits.
#include "arm/input_error.hpp"
#include "effects/registry/vocabulary.hpp"
#include "laws/effect_arms.hpp"
#include "response/formulation_maker.hpp"
#include "tests/effects/linear_effects.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

namespace flexarm::effects {
namespace {

using Complex = std::complex<double>;
using testing::HasSubstr;

constexpr int kDrivenRoots = 5;
constexpr arm::Sensor kRotorAngle{arm::SensorKind::hub_angle, 0.0};

struct Driven {
  double stiffness_N_m_per_rad = 40.0;
  double rotor_share = 0.6;
  double time_s = 1e-3;
};

arm::Arm with_drive(arm::Arm arm, const Driven& drive) {
  put(arm, "drive_compliance",
      {{"stiffness", drive.stiffness_N_m_per_rad},
       {"rotor_share", drive.rotor_share},
       {"time", drive.time_s}});
  return arm;
}

/// An arm with something on either side of the drive.
arm::Arm held_arm() {
  arm::Arm arm = laws::damped_arm();
  put(arm, "hub_spring", {{"stiffness", 0.8}});
  put(arm, "hub_radius", {{"radius", 0.06}});
  put(arm, "gravity", {{"acceleration", 9.81}});
  put(arm, "root_compliance", {{"stiffness", 25.0}});
  return arm;
}

/// With the load's theta = G taud, y = Y taud and the rotor's impedance Z = Jr s^2 + c s + ks,
///
///     theta_m = E taud,  E = G + 1/(kd (1 + td s)),  tau = (1 + Z E) taud.
TEST(DriveCompliance, JoinsTheRotorToTheArmBeyondIt) {
  constexpr double kAgreement = 1e-9;
  const Driven drive;
  const arm::Arm whole = with_drive(held_arm(), drive);
  const double rotor_kg_m2 = drive.rotor_share * whole.hub.inertia_kg_m2;
  arm::Arm load = held_arm();
  load.effects.erase("hub_spring");
  load.hub.inertia_kg_m2 -= rotor_kg_m2;
  load.hub.viscous_friction_N_m_s_per_rad = 0.0;
  for (const auto formulation : response::kFormulationNames) {
    const auto driven = response::make_formulation(formulation, whole, kDrivenRoots);
    const auto beyond = response::make_formulation(formulation, load, kDrivenRoots);
    for (const Complex s : {Complex(0.0, 3.0), Complex(0.0, 90.0), Complex(-4.0, 61.0),
                            Complex(25.0, 0.0), Complex(1.0, 900.0)}) {
      const Complex passing = 1.0 / (drive.stiffness_N_m_per_rad * (1.0 + drive.time_s * s));
      const Complex rotor =
          rotor_kg_m2 * s * s + whole.hub.viscous_friction_N_m_s_per_rad * s + 0.8;
      const Complex turning = response::transfer_function(beyond, kRotorAngle, s) + passing;
      const Complex angle = turning / (1.0 + rotor * turning);
      EXPECT_LE(std::abs(response::transfer_function(driven, kRotorAngle, s) - angle),
                kAgreement * std::abs(angle))
          << formulation << " at " << s;
      for (const char* name :
           {"tip_displacement", "tip_deflection", "tip_acceleration", "strain@0", "strain@0.3"}) {
        const arm::Sensor sensor = arm::parse_sensor(name);
        const Complex wanted =
            response::transfer_function(beyond, sensor, s) / (1.0 + rotor * turning);
        EXPECT_LE(std::abs(response::transfer_function(driven, sensor, s) - wanted),
                  kAgreement * std::abs(wanted))
            << formulation << " " << name << " at " << s;
      }
    }
  }
}

/// A rigid beam: two inertias on a spring, w^2 = kd (1/Jr + 1/J) and, the rotor held, kd/J.
TEST(DriveCompliance, OfARigidBeamIsTwoInertiasOnASpring) {
  constexpr double kStiffer = 1e6;
  arm::Arm arm = laws::damped_arm();
  put(arm, "flexural_rigidity", {{"factor", kStiffer}});
  const Driven drive{.rotor_share = 0.5};
  arm = with_drive(arm, drive);
  const double rotor_kg_m2 = 0.5 * arm.hub.inertia_kg_m2;
  const double load_kg_m2 = arm::total_inertia_kg_m2(arm) - rotor_kg_m2;
  const double pole =
      std::sqrt(drive.stiffness_N_m_per_rad * (1.0 / rotor_kg_m2 + 1.0 / load_kg_m2));
  const double zero = std::sqrt(drive.stiffness_N_m_per_rad / load_kg_m2);
  constexpr double kElasticity = 1e-4;  // ten times the drive's stiffness over that beam's EI/l
  for (const auto formulation : response::kFormulationNames) {
    const auto model = response::make_formulation(formulation, arm, 2);
    EXPECT_NEAR(response::poles(model, 1).omega_rad_per_s[0] / pole, 1.0, kElasticity)
        << formulation;
    EXPECT_NEAR(response::zeros(model, kRotorAngle, 1).s_rad_per_s[0].imag() / zero, 1.0,
                kElasticity)
        << formulation;
  }
}

/// The poles of a stiff drive are off by a multiple of 1/kd: a tenth of it at ten times kd.
TEST(DriveCompliance, OfAStiffDriveIsTheRigidOneToFirstOrder) {
  for (const auto formulation : response::kFormulationNames) {
    const auto rigid = pole_frequencies(formulation, held_arm(), kDrivenRoots);
    const auto off = [&](double stiffness) {
      const arm::Arm arm = with_drive(held_arm(), {.stiffness_N_m_per_rad = stiffness});
      const auto moved = pole_frequencies(formulation, arm, kDrivenRoots);
      std::vector<double> change;
      for (std::size_t i = 0; i < rigid.size(); ++i) change.push_back(1.0 - moved[i] / rigid[i]);
      return change;
    };
    const auto coarse = off(1e5);
    const auto fine = off(1e6);
    for (std::size_t i = 0; i < rigid.size(); ++i) {
      EXPECT_GT(fine[i], 0.0) << formulation << " pole " << i + 1;
      EXPECT_LT(coarse[i], 1e-2) << formulation << " pole " << i + 1;
      constexpr double kSecondOrder = 2e-2;
      EXPECT_NEAR(coarse[i] / fine[i], 10.0, 10.0 * kSecondOrder)
          << formulation << " pole " << i + 1;
    }
  }
}

/// All of the hub at the rotor and no radius: what is left between the springs is nothing.
TEST(DriveCompliance, WithTheWholeHubAtTheRotorIsARootSpring) {
  constexpr double kRest = 1e-6;
  constexpr double kFirstOrder = 1e-4;
  const Driven drive{.rotor_share = 1.0 - kRest};
  const arm::Arm driven = with_drive(laws::damped_arm(), drive);
  arm::Arm root = laws::damped_arm();
  put(root, "root_damping", {{"stiffness", drive.stiffness_N_m_per_rad}, {"time", drive.time_s}});
  for (const auto formulation : response::kFormulationNames) {
    const auto one = response::make_formulation(formulation, driven, kDrivenRoots);
    const auto other = response::make_formulation(formulation, root, kDrivenRoots);
    for (const Complex s : {Complex(0.0, 20.0), Complex(-4.0, 61.0), Complex(3.0, 300.0)}) {
      expect_same_responses(one, other, {"hub_angle", "tip_displacement", "strain@0.3"}, s,
                            kFirstOrder);
    }
  }
}

/// The drive's spring passes its torque on: it is a factor of every response beyond it.
TEST(DriveCompliance, LeavesTheZerosBeyondItAndAddsOneOfTheHub) {
  constexpr double kAgreement = 1e-9;
  const arm::Arm driven = with_drive(held_arm(), {});
  const arm::Arm rigid = held_arm();
  for (const auto formulation : response::kFormulationNames) {
    const auto one = response::make_formulation(formulation, driven, kDrivenRoots);
    const auto other = response::make_formulation(formulation, rigid, kDrivenRoots);
    for (const char* name : {"tip_displacement", "tip_acceleration", "strain@0.3"}) {
      const arm::Sensor sensor = arm::parse_sensor(name);
      const auto zeros = response::zeros(one, sensor, 4).s_rad_per_s;
      const auto before = response::zeros(other, sensor, 4).s_rad_per_s;
      ASSERT_EQ(zeros.size(), before.size()) << formulation << " " << name;
      for (std::size_t i = 0; i < zeros.size(); ++i) {
        EXPECT_LE(std::abs(zeros[i] - before[i]), kAgreement * std::abs(before[i]))
            << formulation << " " << name << " zero " << i + 1;
      }
    }
    // 1/G = 1/G0 less what is positive between the poles: zeros lie below those before.
    const auto zeros = response::zeros(one, kRotorAngle, kDrivenRoots).s_rad_per_s;
    const auto before = response::zeros(other, kRotorAngle, kDrivenRoots).s_rad_per_s;
    for (std::size_t i = 0; i < zeros.size(); ++i) {
      EXPECT_LT(zeros[i].imag(), before[i].imag()) << formulation << " zero " << i + 1;
      const double below = i > 0 ? before[i - 1].imag() : 0.0;
      EXPECT_GT(zeros[i].imag(), below) << formulation << " zero " << i + 1;
    }
  }
}

TEST(DriveCompliance, IsCounted) {
  const arm::Arm arm = with_drive(held_arm(), {.stiffness_N_m_per_rad = 4.0, .rotor_share = 0.9});
  for (const char* formulation : {"exact_tf", "fem"}) {
    const auto model = response::make_formulation(formulation, arm, kDrivenRoots);
    for (const auto& count : {response::poles(model, kDrivenRoots).count,
                              response::zeros(model, kRotorAngle, kDrivenRoots).count,
                              response::zeros(model, arm::parse_sensor("strain@0.3"), 4).count}) {
      EXPECT_EQ(count.found, count.expected) << formulation << " by " << count.method;
    }
  }
}

/// A little damping: each mode's decay by the power that the drive takes, D_ii/2.
TEST(DriveCompliance, ALittleDampsAsItsProjectionSays) {
  constexpr double kLittle = 1e-8;
  arm::Arm arm = with_drive(laws::damped_arm(), {.time_s = kLittle});
  arm.damping = {};
  arm.hub.viscous_friction_N_m_s_per_rad = 0.0;
  expect_decays_as_projected(arm, kDrivenRoots);
}

/// A rotor that vibrates by itself, all but decoupled: its mode keeps its digits. The slopes of the
/// others are small beside its own, to which modes are orthogonal within rounding.
TEST(DriveCompliance, KeepsTheSlopesOfAlmostDecoupledRotors) {
  constexpr double kAgreement = 1e-9;
  constexpr double kRoundingOfShapes = 1e-14;
  arm::Arm heavy = laws::damped_arm();
  heavy.hub.inertia_kg_m2 = 5.0;
  for (const Driven& drive : {Driven{.stiffness_N_m_per_rad = 0.02, .rotor_share = 1e-6},
                              Driven{.stiffness_N_m_per_rad = 3000.0, .rotor_share = 1e-3},
                              Driven{.stiffness_N_m_per_rad = 30.0, .rotor_share = 0.999}}) {
    const arm::Arm arm = with_drive(heavy, drive);
    const auto exact = response::modal_model(
        response::make_formulation("exact_tf", arm, kDrivenRoots), kDrivenRoots, {}, {});
    const double largest =
        std::ranges::max_element(exact.modes, {}, &arm::Mode::hub_slope)->hub_slope;
    for (const char* formulation : {"fem", "assumed_modes"}) {
      const auto modal = response::modal_model(
          response::make_formulation(formulation, arm, kDrivenRoots), kDrivenRoots, {}, {});
      for (std::size_t i = 0; i < exact.modes.size(); ++i) {
        const double wanted = exact.modes[i].hub_slope;
        EXPECT_NEAR(modal.modes[i].hub_slope, wanted,
                    kAgreement * wanted + kRoundingOfShapes * largest)
            << formulation << " mode " << i << " of rotor " << drive.rotor_share;
      }
    }
  }
}

void expect_refused(const arm::Arm& arm, const std::string& text) {
  try {
    response::make_formulation("fem", arm, 1);
    ADD_FAILURE() << "accepted; expected: " << text;
  } catch (const arm::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(text));
  }
}

TEST(DriveCompliance, RefusesHubsThatItCannotDivide) {
  expect_refused(with_drive(laws::damped_arm(), {.rotor_share = 1.0}),
                 "effects.drive_compliance.rotor_share = 1: must be above 0 and below 1");
  expect_refused(with_drive(laws::damped_arm(), {.rotor_share = 1e-12}),
                 "effects.drive_compliance.rotor_share = 1e-12: must be from");
  expect_refused(with_drive(laws::damped_arm(), {.stiffness_N_m_per_rad = 1e12}),
                 "effects.drive_compliance.stiffness");
  arm::Arm without_inertia = laws::damped_arm();
  without_inertia.hub.inertia_kg_m2 = 0.0;
  expect_refused(with_drive(without_inertia, {}),
                 "effects.drive_compliance: rotor and hub share hub.inertia; must be above 0");
}

}  // namespace
}  // namespace flexarm::effects
