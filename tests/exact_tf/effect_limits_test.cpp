#include "effect_arms.hpp"
#include "exact_tf/exact_arm.hpp"

#include <boost/math/special_functions/bessel.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace flexarm::exact_tf {
namespace {

/// EI, m, l and thickness are 1, 1, 1 and 2, so that strain at 0 is the bending moment there.
const arm::Arm kBase = unit_arm(0.1, 0.5, 0.02);
constexpr int kRoots = 8;

/// omega^2 falls by M^2/(stiffness I_T) when a hinge of that stiffness is cut into the place of the
/// bending moment M; the next term is of relative order M/stiffness, with M below 1e4 here.
void expect_first_order_shift(const arm::Arm& with_hinge, double position, double stiffness) {
  const ExactArm stiff(kBase);
  const std::vector<arm::Sensor> moment = {{arm::SensorKind::strain, position}};
  const auto modes = stiff.modes(kRoots, moment, {});
  const auto poles = ExactArm(with_hinge).poles(kRoots).omega_rad_per_s;
  const double inertia = arm::total_inertia_kg_m2(kBase);
  for (std::size_t i = 0; i < kRoots; ++i) {
    const double omega = modes[i].omega_rad_per_s;
    const double moment_here = modes[i].sensor_values[0];
    const double shift = moment_here * moment_here / (2.0 * omega * stiffness * inertia);
    // Both frequencies are rounded to doubles.
    EXPECT_NEAR(omega - poles[i], shift, 2e-5 * shift + 4e-16 * omega) << "pole " << i + 1;
  }
}

TEST(EffectLimits, AStiffRootIsRigidButForItsFirstOrderShift) {
  expect_first_order_shift(with_effect(kBase, "root_compliance", {{"stiffness", 1e7}}), 0.0, 1e7);
}

TEST(EffectLimits, AShallowCrackShiftsPolesByTheMomentSquared) {
  expect_first_order_shift(
      with_effect(kBase, "local_stiffness_loss", {{"position", 0.37}, {"stiffness", 1e7}}), 0.37,
      1e7);
}

void expect_same_roots(const ExactArm& a, const ExactArm& b, double tolerance) {
  const auto poles = a.poles(kRoots).omega_rad_per_s;
  const auto wanted = b.poles(kRoots).omega_rad_per_s;
  for (std::size_t i = 0; i < kRoots; ++i) {
    EXPECT_NEAR(poles[i] / wanted[i], 1.0, tolerance);
  }
  for (const char* name : {"hub_angle", "tip_acceleration", "tip_deflection", "strain@0.4"}) {
    const auto sensor = arm::parse_sensor(name);
    const auto zeros = a.zeros(sensor, kRoots).s_rad_per_s;
    const auto wanted_zeros = b.zeros(sensor, kRoots).s_rad_per_s;
    for (std::size_t i = 0; i < kRoots; ++i) {
      EXPECT_LE(std::abs(zeros[i] - wanted_zeros[i]), tolerance * std::abs(wanted_zeros[i]))
          << name << ", zero " << i + 1;
    }
  }
}

TEST(EffectLimits, SmallEffectsAreNone) {
  const ExactArm base(kBase);
  // Relative changes are the parameter times a number below 100.
  constexpr double kSmall = 1e-10;
  constexpr double kTolerance = 1e-8;
  expect_same_roots(ExactArm(with_effect(kBase, "hub_radius", {{"radius", kSmall}})), base,
                    kTolerance);
  expect_same_roots(ExactArm(with_effect(kBase, "payload_offset", {{"offset", kSmall}})), base,
                    kTolerance);
  expect_same_roots(ExactArm(with_effect(kBase, "hub_spring", {{"stiffness", kSmall}})), base,
                    kTolerance);
  expect_same_roots(ExactArm(with_effect(kBase, "air_damping", {{"coefficient", kSmall}})), base,
                    1e-15);
  arm::Arm thin = kBase;
  thin.beam.thickness_m = 1e-6;
  thin.beam.width_m = 1.0;
  thin.beam.shear_modulus_Pa = 1e18;
  arm::Arm slender = kBase;
  slender.beam.thickness_m = 1e-6;
  expect_same_roots(ExactArm(with_effect(thin, "shear_and_rotary_inertia", {})), ExactArm(slender),
                    kTolerance);
}

TEST(EffectLimits, AnEndlesslyStiffHubSpringClampsTheBeam) {
  // The hub's own frequency, sqrt(ks/Ih), lies far above; the clamped beam's poles are its zeros.
  constexpr double kStiffness = 1e9;
  const ExactArm held(with_effect(kBase, "hub_spring", {{"stiffness", kStiffness}}));
  const auto poles = held.poles(kRoots - 1);
  const auto zeros = ExactArm(kBase).zeros(kHub, kRoots).s_rad_per_s;
  // A clamp that yields by M/ks: relative order lambda/ks.
  constexpr double kTolerance = 1e-7;
  EXPECT_NEAR(std::sqrt(poles.lowest_omega_squared_rad2_per_s2) / zeros[0].imag(), 1.0, kTolerance);
  for (std::size_t i = 1; i < kRoots; ++i) {
    EXPECT_NEAR(poles.omega_rad_per_s[i - 1] / zeros[i].imag(), 1.0, kTolerance);
  }
}

TEST(EffectLimits, ASlackHubSpringTurnsTheRigidArm) {
  constexpr double kStiffness = 1e-9;
  const auto set = ExactArm(with_effect(kBase, "hub_spring", {{"stiffness", kStiffness}})).poles(3);
  EXPECT_NEAR(set.lowest_omega_squared_rad2_per_s2 * arm::total_inertia_kg_m2(kBase) / kStiffness,
              1.0, 10.0 * kStiffness);
}

TEST(EffectLimits, WeakGravityMakesAPendulumAndAFallingRod) {
  // 2 V = g (Mp (a + l)^2/(a + l) ...): the torque g int of mass times distance from the axis.
  constexpr double kGravity = 1e-9;
  const arm::Arm base = with_effect(with_effect(kBase, "hub_radius", {{"radius", 0.3}}),
                                    "payload_offset", {{"offset", 0.2}});
  const double moment = 1.0 * (0.3 + 0.5) + 0.5 * (0.3 + 1.0 + 0.2);
  for (const double gravity : {kGravity, -kGravity}) {
    const auto set = ExactArm(with_effect(base, "gravity", {{"acceleration", gravity}})).poles(3);
    EXPECT_NEAR(set.lowest_omega_squared_rad2_per_s2 * arm::total_inertia_kg_m2(base) / gravity,
                moment, 100.0 * kGravity);
  }
}

TEST(EffectLimits, AStandingColumnBucklesUnderTheKnownWeight) {
  // Clamped below, free above, under its own weight q per length: q l^3/EI = (9/4) j^2 with j the
  // first zero of the Bessel function of order -1/3 [Greenhill1881].
  const double j = boost::math::cyl_bessel_j_zero(-1.0 / 3.0, 1);
  const double critical = 2.25 * j * j;
  EXPECT_NEAR(critical, 7.8373, 5e-5);
  const auto lowest_zero = [](double gravity) {
    return ExactArm(with_effect(unit_arm(0.1, 0.0, 0.0), "gravity", {{"acceleration", gravity}}))
        .zeros(kHub, 1)
        .s_rad_per_s[0];
  };
  constexpr double kPart = 1e-10;
  const auto stands = lowest_zero(-critical * (1.0 - kPart));
  const auto falls = lowest_zero(-critical * (1.0 + kPart));
  EXPECT_EQ(stands.real(), 0.0);
  EXPECT_EQ(falls.imag(), 0.0);
  // omega^2 crosses 0 in a straight line.
  EXPECT_NEAR(stands.imag() / falls.real(), 1.0, 1e-3);
}

/// Determinant of the conditions at both ends of a Timoshenko beam with EI = m = l = 1, below its
/// cut-off: y(0) = 0; psi(0) = 0 (clamped) or psi'(0) = 0 (pinned); psi'(1) = 0 and y'(1) = psi(1).
/// From k^4 + k^2 omega^2 (phi + r) - omega^2 (1 - omega^2 phi r) = 0 and
/// psi' = y'' + omega^2 phi y for y = cosh bx, sinh bx, cos ax, sin ax.
double timoshenko_determinant(double omega, double phi, double r, bool clamped) {
  const long double square = static_cast<long double>(omega) * omega;
  const long double half = 0.5L * square * (phi + r);
  const long double root = std::sqrt(half * half + square * (1.0L - square * phi * r));
  const long double a = std::sqrt(half + root);
  const long double b = std::sqrt(root - half);
  const long double turn_a = a - square * phi / a;  // psi of sin ax is turn_a cos ax
  const long double turn_b = b + square * phi / b;
  using Row = std::array<long double, 4>;
  const auto y = [&](long double x) {
    return Row{std::cosh(b * x), std::sinh(b * x), std::cos(a * x), std::sin(a * x)};
  };
  const auto psi = [&](long double x) {
    return Row{turn_b * std::sinh(b * x), turn_b * std::cosh(b * x), -turn_a * std::sin(a * x),
               turn_a * std::cos(a * x)};
  };
  const auto curvature = [&](long double x) {
    return Row{b * turn_b * std::cosh(b * x), b * turn_b * std::sinh(b * x),
               -a * turn_a * std::cos(a * x), -a * turn_a * std::sin(a * x)};
  };
  Row shear = psi(1.0L);
  const Row slope = {b * std::sinh(b), b * std::cosh(b), -a * std::sin(a), a * std::cos(a)};
  for (std::size_t i = 0; i < 4; ++i) shear[i] = slope[i] - shear[i];
  std::array<Row, 4> m = {y(0.0L), clamped ? psi(0.0L) : curvature(0.0L), curvature(1.0L), shear};
  long double determinant = 1.0L;
  for (std::size_t k = 0; k < 4; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < 4; ++i) {
      if (std::abs(m[i][k]) > std::abs(m[pivot][k])) pivot = i;
    }
    if (pivot != k) {
      std::swap(m[k], m[pivot]);
      determinant = -determinant;
    }
    determinant *= m[k][k];
    for (std::size_t i = k + 1; i < 4; ++i) {
      const long double factor = m[i][k] / m[k][k];
      for (std::size_t j = k; j < 4; ++j) m[i][j] -= factor * m[k][j];
    }
  }
  return static_cast<double>(determinant);
}

TEST(EffectLimits, ATimoshenkoBeamHasTheRootsOfItsFrequencyEquation) {
  const arm::Arm arm = with_effect(stubby_arm(0.0, 0.0, 0.0), "shear_and_rotary_inertia", {});
  const ExactArm exact(arm);
  const auto& shear = exact.linear().shear.value();
  const double phi = 1.0 / shear.shear_rigidity_N;
  const double r = shear.rotary_inertia_kg_m;
  const double cut_off = 1.0 / std::sqrt(phi * r);
  // The determinant changes sign within this part of the root.
  constexpr double kPart = 1e-13;
  const auto expect_sign_change = [&](double omega, bool clamped) {
    ASSERT_LT(omega, cut_off);
    EXPECT_LT(timoshenko_determinant(omega * (1.0 - kPart), phi, r, clamped) *
                  timoshenko_determinant(omega * (1.0 + kPart), phi, r, clamped),
              0.0)
        << "omega = " << omega << (clamped ? ", clamped" : ", pinned");
  };
  for (const double omega : exact.poles(6).omega_rad_per_s) expect_sign_change(omega, false);
  for (const auto& s : exact.zeros(kHub, 6).s_rad_per_s) expect_sign_change(s.imag(), true);
  // The slender beam's eighth pole is a third higher: shear and rotary inertia matter here.
  EXPECT_LT(exact.poles(6).omega_rad_per_s[5],
            0.9 * ExactArm(unit_arm(0.0, 0.0, 0.0)).poles(6).omega_rad_per_s[5]);
}

TEST(EffectLimits, AboveTheCutOffBothSpectraOfATimoshenkoBeamAreCounted) {
  // A beam pinned at both ends has the sine waves k = n pi, two frequencies each. An arm whose
  // payload is far too heavy to move, but for its rotation, is such a beam.
  arm::Arm arm = stubby_arm(0.0, 1e9, 0.0);
  arm = with_effect(arm, "shear_and_rotary_inertia", {});
  const ExactArm exact(arm);
  const auto& shear = exact.linear().shear.value();
  const double phi = 1.0 / shear.shear_rigidity_N;
  const double r = shear.rotary_inertia_kg_m;
  std::vector<double> wanted = {1.0 / std::sqrt(phi * r)};  // pure shear, y = 0
  for (int n = 1; n < 60; ++n) {
    const double k = n * std::numbers::pi;
    const double sum = 1.0 + k * k * (phi + r);
    const double root = std::sqrt(sum * sum - 4.0 * phi * r * std::pow(k, 4));
    wanted.push_back(std::sqrt(2.0 * std::pow(k, 4) / (sum + root)));
    wanted.push_back(std::sqrt((sum + root) / (2.0 * phi * r)));
  }
  std::ranges::sort(wanted);
  constexpr int kPoles = 60;
  const auto poles = exact.poles(kPoles);
  EXPECT_EQ(poles.count.expected, kPoles);
  for (std::size_t i = 0; i < kPoles; ++i) {
    // The payload yields by 1e-9.
    EXPECT_NEAR(poles.omega_rad_per_s[i] / wanted[i], 1.0, 1e-6) << i;
  }
  EXPECT_GT(poles.omega_rad_per_s.back(), 2.0 * wanted[0] * 0.5);
}

}  // namespace
}  // namespace flexarm::exact_tf
