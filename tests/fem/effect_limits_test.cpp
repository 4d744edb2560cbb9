// What each effect becomes where theory says: in its limits, at buckling, for little of it.
#include "arm/input_error.hpp"
#include "effects/registry/vocabulary.hpp"
#include "fem/discretisation.hpp"
#include "fem/fem_arm.hpp"
#include "fem/vibration_modes.hpp"
#include "tests/fem/constants.hpp"
#include "tests/reference/reference_cases.hpp"

#include <Eigen/Core>
#include <boost/math/special_functions/bessel.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <map>
#include <numeric>
#include <span>
#include <string>
#include <vector>

namespace flexarm::fem {
namespace {

using Complex = std::complex<double>;

/// l = m = EI = 1.
arm::Arm unit_arm() {
  arm::Arm arm;
  arm.beam = arm::Beam::from_rigidity(1.0, 1.0, 1.0);
  arm.beam.thickness_m = 2.0;
  arm.hub.inertia_kg_m2 = 0.1;
  arm.payload = {0.3, 0.01};
  return arm;
}

arm::Arm with(arm::Arm arm, const std::string& effect,
              const std::map<std::string, double>& parameters) {
  effects::put(arm, effect, parameters);
  return arm;
}

/// Largest relative difference of five poles and five hub zeros.
double difference(const arm::Arm& a, const arm::Arm& b) {
  const FemArm one(a);
  const FemArm other(b);
  const auto poles = one.poles(5).omega_rad_per_s;
  const auto other_poles = other.poles(5).omega_rad_per_s;
  const auto zeros = one.zeros(kHubAngle, 5).s_rad_per_s;
  const auto other_zeros = other.zeros(kHubAngle, 5).s_rad_per_s;
  double largest = 0.0;
  for (std::size_t i = 0; i < 5; ++i) {
    largest = std::max(largest, std::abs(poles[i] / other_poles[i] - 1.0));
    largest = std::max(largest, std::abs(zeros[i] / other_zeros[i] - 1.0));
  }
  return largest;
}

/// `arm_at(x)` tends to `limit` like x: a hundredth of x leaves a hundredth of the difference.
template <class ArmAt>
void expect_first_order(const ArmAt& arm_at, double x, const arm::Arm& limit) {
  constexpr double kSecondOrder = 0.02;
  const double large = difference(arm_at(x), limit);
  const double small = difference(arm_at(x / 100.0), limit);
  EXPECT_GT(small, 1e-9);  // far above rounding
  EXPECT_NEAR(large / small, 100.0, 100.0 * kSecondOrder);
}

TEST(EffectLimits, OfStiffSpringsAndShortHubsAreTheArmWithoutThem) {
  const arm::Arm plain = unit_arm();
  expect_first_order(
      [&](double x) {
        return with(plain, "root_compliance", {{"stiffness", 1.0 / x}});
      },
      1e-4, plain);
  expect_first_order(
      [&](double x) {
        return with(plain, "drive_compliance", {{"stiffness", 1.0 / x}, {"rotor_share", 0.5}});
      },
      1e-5, plain);
  expect_first_order(
      [&](double x) {
        return with(plain, "local_stiffness_loss", {{"position", 0.37}, {"stiffness", 1.0 / x}});
      },
      1e-4, plain);
  expect_first_order(
      [&](double x) {
        return with(plain, "hub_radius", {{"radius", x}});
      },
      1e-4, plain);
  expect_first_order(
      [&](double x) {
        return with(plain, "attached_mass", {{"mass", x}, {"position", 0.37}});
      },
      1e-4, plain);
  expect_first_order(
      [&](double x) {
        return with(plain, "payload_offset", {{"offset", x}});
      },
      1e-4, plain);
}

/// A Timoshenko beam with kGA l^2/EI = stiffness and rotary inertia m l^2/stiffness.
arm::Arm sheared(double stiffness) {
  arm::Arm arm = unit_arm();
  arm.beam.thickness_m = std::sqrt(12.0 / stiffness);
  arm.beam.width_m = 1.0;
  arm.beam.shear_modulus_Pa = stiffness / *arm.beam.thickness_m;
  effects::put(arm, "shear_and_rotary_inertia", {{"shear_coefficient", 1.0}});
  return arm;
}

TEST(EffectLimits, OfAThinBeamWithShearAreThoseOfEulerAndBernoulli) {
  expect_first_order([&](double x) { return sheared(1.0 / x); }, 1e-5, unit_arm());
}

TEST(EffectLimits, AThinBeamWithShearDoesNotLock) {
  // Coarse cubic elements have the error of Euler-Bernoulli's, (lambda h)^4/1440 and the like, not
  // one that grows with the shear rigidity.
  FemArm::Options coarse;
  coarse.mesh.elements = 20;
  coarse.degree = 3;
  const auto plain = FemArm(unit_arm(), coarse).poles(5).omega_rad_per_s;
  for (const double stiffness : {1e8, 1e12, 1e16}) {
    const arm::PoleSet poles = FemArm(sheared(stiffness), coarse).poles(5);
    EXPECT_TRUE(poles.summary.converged);
    for (std::size_t i = 0; i < plain.size(); ++i) {
      // The shear's own part, lambda^4/stiffness, and rounding.
      EXPECT_NEAR(poles.omega_rad_per_s[i] / plain[i], 1.0,
                  plain[i] * plain[i] / stiffness + 1e-11);
    }
  }
}

TEST(EffectLimits, OfAStiffHubSpringIsTheClampedArm) {
  const auto clamped = FemArm(unit_arm()).zeros(kHubAngle, 5).s_rad_per_s;
  const arm::PoleSet held = FemArm(with(unit_arm(), "hub_spring", {{"stiffness", 1e8}})).poles(4);
  constexpr double kOrder = 1e-5;  // of lambda/stiffness, times some constant
  EXPECT_NEAR(std::sqrt(held.lowest_omega_squared_rad2_per_s2), clamped[0].imag(), kOrder);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(held.omega_rad_per_s[i] / clamped[i + 1].imag(), 1.0, kOrder);
  }
}

TEST(EffectLimits, ModesBesideThatOfAHeavyHubBehindACompliantDriveAreOrthogonalToIt) {
  arm::Arm arm = unit_arm();
  arm.hub.inertia_kg_m2 = 1e9;
  arm.payload.mass_kg = 3e3;
  effects::put(arm, "drive_compliance", {{"stiffness", 2e-5}, {"rotor_share", 0.003}});
  constexpr int kModes = 10;
  for (const int degree : {11, 12, 13, 14, 15}) {
    const Discretisation model(arm::linear_arm(arm), {}, degree);
    for (const HubSupport support : {HubSupport::clamped, HubSupport::free}) {
      for (const Eigensolver eigensolver : {Eigensolver::dense, Eigensolver::lanczos}) {
        const VibrationModes modes = vibration_modes(model, support, kModes, 1e-12, eigensolver);
        EXPECT_TRUE(modes.converged);
        const Eigen::MatrixXd products = modes.shapes.transpose() * model.mass() * modes.shapes;
        EXPECT_LE((products - Eigen::MatrixXd::Identity(kModes, kModes)).cwiseAbs().maxCoeff(),
                  50.0 * kEpsilon)
            << degree;
      }
    }
  }
}

TEST(EffectLimits, AHubThatNextToNothingHoldsLeavesTheFlexibleModesAsTheyAre) {
  const auto free = FemArm(unit_arm()).poles(8).omega_rad_per_s;
  for (const double stiffness : {1e-6, 1e-12, 1e-30}) {
    const FemArm model(with(unit_arm(), "hub_spring", {{"stiffness", stiffness}}));
    const arm::PoleSet held = model.poles(8);
    EXPECT_TRUE(held.summary.converged);
    const double inertia = arm::total_inertia_kg_m2(model.arm());
    EXPECT_NEAR(held.lowest_omega_squared_rad2_per_s2, stiffness / inertia,
                stiffness * (stiffness + 1e-11) + 1e-26);
    for (std::size_t i = 0; i < free.size(); ++i) {
      EXPECT_NEAR(held.omega_rad_per_s[i] / free[i], 1.0, stiffness + 1e-12);
    }
  }
}

TEST(Gravity, MakesAStiffArmAPendulum) {
  arm::Arm arm = with(unit_arm(), "gravity", {{"acceleration", 9.81}});
  arm.beam = arm::Beam::from_rigidity(1.0, 1e8, 1.0);
  effects::put(arm, "hub_radius", {{"radius", 0.25}});
  effects::put(arm, "payload_offset", {{"offset", 0.1}});
  const double first_moment = 0.75 + 0.3 * 1.35;
  const double expected = 9.81 * first_moment / arm::total_inertia_kg_m2(arm);
  // Weight over stiffness.
  EXPECT_NEAR(FemArm(arm).poles(1).lowest_omega_squared_rad2_per_s2 / expected, 1.0, 1e-7);
}

/// The hub's lowest zero as a signed square, m = l = EI = 1 and no payload.
double clamped_omega_squared(double weight) {
  arm::Arm arm = unit_arm();
  arm.payload = {};
  const FemArm model(with(arm, "gravity", {{"acceleration", -weight}}));
  const auto zeros = model.zeros(kHubAngle, 3).s_rad_per_s;
  EXPECT_EQ(zeros.size(), 3u);
  return -(zeros[0] * zeros[0]).real();
}

TEST(Gravity, BucklesAColumnAtGreenhillsLoad) {
  // q l^3/EI = 9/4 j^2, j the first zero of J_{-1/3} [Greenhill1881].
  const double critical = 2.25 * std::pow(boost::math::cyl_bessel_j_zero(-1.0 / 3.0, 1), 2);
  EXPECT_NEAR(critical, 7.8373, 5e-5);
  constexpr double kBeside = 1e-6;
  const double before = clamped_omega_squared(critical * (1.0 - kBeside));
  const double after = clamped_omega_squared(critical * (1.0 + kBeside));
  EXPECT_GT(before, 0.0);
  EXPECT_LT(after, 0.0);
  // The straight line through both meets zero at the critical load.
  EXPECT_NEAR(before / (before - after), 0.5, 1e-4);
}

TEST(Gravity, OfAStandingArmHeldByAStiffSpringBucklesItThere) {
  const double critical = 2.25 * std::pow(boost::math::cyl_bessel_j_zero(-1.0 / 3.0, 1), 2);
  arm::Arm arm = with(unit_arm(), "hub_spring", {{"stiffness", 1e9}});
  arm.payload = {};
  const auto lowest = [&](double weight) {
    return FemArm(with(arm, "gravity", {{"acceleration", -weight}}))
        .poles(2)
        .lowest_omega_squared_rad2_per_s2;
  };
  EXPECT_GT(lowest(critical * (1.0 - 1e-6)), 0.0);
  EXPECT_LT(lowest(critical * (1.0 + 1e-6)), 0.0);
}

TEST(Gravity, RefusesAnArmWhoseFlexibleModesBuckle) {
  // Standing on a free hub: the lowest mode falls at any load, which is allowed.
  const arm::PoleSet falling =
      FemArm(with(unit_arm(), "gravity", {{"acceleration", -5.0}})).poles(3);
  EXPECT_LT(falling.lowest_omega_squared_rad2_per_s2, 0.0);
  EXPECT_EQ(falling.omega_rad_per_s.size(), 3u);
  EXPECT_EQ(falling.count.expected, 3);
  try {
    FemArm(with(unit_arm(), "gravity", {{"acceleration", -60.0}}));
    FAIL();
  } catch (const arm::InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("effects.gravity.acceleration"));
  }
}

TEST(Gravity, ShiftsEigenvaluesByTheWorkOfTheTensionToFirstOrder) {
  constexpr double kLittle = 1e-5;
  const arm::Arm hanging = with(unit_arm(), "gravity", {{"acceleration", kLittle}});
  const MeshOptions mesh{.elements = 4};
  const Discretisation plain(arm::linear_arm(unit_arm()), mesh, 15);
  const Discretisation weighted(arm::linear_arm(hanging), mesh, 15);
  constexpr double kTolerance = 1e-12;
  const VibrationModes before = vibration_modes(plain, HubSupport::free, 4, kTolerance);
  const VibrationModes after = vibration_modes(weighted, HubSupport::free, 4, kTolerance);
  for (Eigen::Index j = 0; j < 4; ++j) {
    const Eigen::VectorXd u = before.shapes.col(j);
    const double expected = u.dot(weighted.weight() * u);
    const double shift = after.omega_squared[j] - before.omega_squared[j];
    // Second order in the weight, and rounding of the eigenvalues.
    EXPECT_NEAR(shift, expected, 10.0 * kLittle * expected + 1e-12 * before.omega_squared[j]);
  }
}

TEST(Crack, NearTheRootIsARootCompliance) {
  const arm::Arm root = with(unit_arm(), "root_compliance", {{"stiffness", 2.0}});
  for (const double position : {1e-6, 1e-9, 1e-13}) {
    const arm::Arm cracked =
        with(unit_arm(), "local_stiffness_loss", {{"position", position}, {"stiffness", 2.0}});
    // The hub's share of the beam moves by the position; lambda is 16 at most.
    EXPECT_LE(difference(cracked, root), 20.0 * position + 1e-12) << position;
  }
}

TEST(Crack, NearTheTipAndBesideANodeKeepsTheAccuracy) {
  // The places differ by `kBeside`, and so do the poles; the meshes have slivers or none.
  constexpr double kBeside = 1e-8;
  for (const double position : {0.25, 0.5, 0.75, 1.0 - 2.0 * kBeside}) {
    const auto at = [&](double place) {
      return with(unit_arm(), "local_stiffness_loss", {{"position", place}, {"stiffness", 2.0}});
    };
    EXPECT_LE(difference(at(position + kBeside), at(position)), 20.0 * kBeside) << position;
    EXPECT_LE(difference(at(position - kBeside), at(position)), 20.0 * kBeside) << position;
  }
}

TEST(Crack, StrainIsTheSameOnBothSidesOfIt) {
  const FemArm model(
      with(unit_arm(), "local_stiffness_loss", {{"position", 0.3}, {"stiffness", 2.0}}));
  const std::vector<arm::Sensor> sensors = {arm::parse_sensor("strain@0.3"),
                                            arm::parse_sensor("strain@0.299999999999"),
                                            arm::parse_sensor("strain@0.300000000001")};
  for (const arm::Mode& mode : model.modes(4, sensors, {})) {
    const double at = mode.sensor_values[0];
    // The shear force times 1e-12.
    EXPECT_NEAR(mode.sensor_values[1], at, 1e-9 * std::abs(at));
    EXPECT_NEAR(mode.sensor_values[2], at, 1e-9 * std::abs(at));
  }
}

TEST(SplitMesh, HasANodeAtEveryPlace) {
  const std::vector<double> lengths(4, 0.25);
  const std::vector<double> positions = {0.3, 0.5, 0.52};
  const SplitMesh split = split_mesh(lengths, positions);
  EXPECT_EQ(split.before, std::vector<int>({2, 3, 4}));
  EXPECT_EQ(split.lengths.size(), 6u);
  for (std::size_t k = 0; k < positions.size(); ++k) {
    const auto node = split.lengths.begin() + split.before[k];
    EXPECT_NEAR(std::accumulate(split.lengths.begin(), node, 0.0), positions[k], 1e-15);
  }
  EXPECT_NEAR(std::accumulate(split.lengths.begin(), split.lengths.end(), 0.0), 1.0, 1e-15);
}

TEST(SplitMesh, CompressesBothPartsAndMakesNoSliver) {
  const std::vector<double> lengths(5, 0.2);
  const auto split_at = [&](double position) {
    return split_mesh(lengths, std::span(&position, 1));
  };
  const SplitMesh between = split_at(0.5);
  EXPECT_EQ(between.lengths.size(), 6u);
  EXPECT_EQ(between.before.front(), 3);
  for (const double length : between.lengths) EXPECT_NEAR(length, 1.0 / 6.0, 1e-15);
  const SplitMesh beside = split_at(0.4 + 1e-5);
  EXPECT_EQ(beside.before.front(), 3);
  for (const double length : beside.lengths) EXPECT_GT(length, 0.13);
  const SplitMesh on = split_at(0.4);
  EXPECT_EQ(on.lengths.size(), 5u);
  EXPECT_EQ(on.before.front(), 2);
  for (const double position : {1e-12, 0.1, 0.4 - 1e-12, 0.999, 1.0 - 1e-12}) {
    const SplitMesh split = split_at(position);
    double left = 0.0;
    double all = 0.0;
    for (std::size_t i = 0; i < split.lengths.size(); ++i) {
      if (static_cast<int>(i) < split.before.front()) left += split.lengths[i];
      all += split.lengths[i];
      EXPECT_LE(split.lengths[i], 0.2 * (1.0 + 1e-6));
    }
    EXPECT_NEAR(left, position, 1e-15);
    EXPECT_NEAR(all, 1.0, 1e-14);
  }
}

}  // namespace
}  // namespace flexarm::fem
