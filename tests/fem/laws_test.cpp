// Laws of the assembled matrices and of the modes built on them.
#include "fem/discretisation.hpp"
#include "fem/fem_arm.hpp"
#include "tests/fem/constants.hpp"
#include "tests/reference/reference_cases.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace flexarm::fem {
namespace {

using Complex = std::complex<double>;

class Laws : public ::testing::TestWithParam<reference::ReferenceCase> {
 protected:
  static FemArm model() {
    return FemArm(reference::arm_of(GetParam()), {.mesh = {.elements = 5}, .degree = 7});
  }
};

TEST_P(Laws, MassIsSymmetricAndPositiveDefinite) {
  const Eigen::MatrixXd mass(model().mass_kg_m2());
  EXPECT_EQ((mass - mass.transpose()).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_EQ(mass.llt().info(), Eigen::Success);
}

TEST_P(Laws, StiffnessIsSymmetricAndHasExactlyOneRigidBodyMode) {
  const FemArm fem = model();
  const Eigen::MatrixXd stiffness(fem.stiffness_N_m());
  const int n = fem.degrees_of_freedom();
  EXPECT_EQ((stiffness - stiffness.transpose()).cwiseAbs().maxCoeff(), 0.0);
  const Eigen::VectorXd scale = stiffness.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      Eigen::MatrixXd(scale.asDiagonal() * stiffness * scale.asDiagonal()));
  EXPECT_LE(std::abs(solver.eigenvalues()[0]), n * kEpsilon);
  // The next is of the order of (elements)^-4 of the largest.
  EXPECT_GE(solver.eigenvalues()[1], 1e-6);
}

TEST_P(Laws, RigidRotationHasTheTotalInertiaAndNoStrain) {
  const arm::Arm arm = reference::arm_of(GetParam());
  const Discretisation discretisation(arm::linear_arm(arm), {.elements = 5}, 7);
  const double unit = arm.beam.linear_density_kg_per_m() * std::pow(arm.beam.length_m, 3);
  const double exact = arm::total_inertia_kg_m2(arm);
  EXPECT_NEAR(discretisation.total_inertia() * unit, exact, 20.0 * kEpsilon * exact);
  const Eigen::VectorXd force = discretisation.stiffness() * discretisation.rigid_rotation();
  EXPECT_LE(force.cwiseAbs().maxCoeff(),
            20.0 * kEpsilon * discretisation.stiffness().coeffs().cwiseAbs().maxCoeff());
}

TEST_P(Laws, FactorsMultiplyToTheStiffness) {
  const Discretisation model(arm::linear_arm(reference::arm_of(GetParam())), {.elements = 5}, 7);
  const Eigen::SparseMatrix<double>& b = model.kinematics();
  const Eigen::MatrixXd product =
      Eigen::MatrixXd(b.transpose() * model.natural_stiffness().asDiagonal() * b);
  const Eigen::MatrixXd stiffness(model.stiffness());
  EXPECT_LE((product - stiffness).cwiseAbs().maxCoeff(),
            20.0 * kEpsilon * stiffness.cwiseAbs().maxCoeff());
}

TEST_P(Laws, PolesAndHubZerosInterlaceAndNoneIsMissing) {
  const FemArm fem(reference::arm_of(GetParam()));
  const arm::PoleSet poles = fem.poles(10);
  const arm::ZeroSet zeros = fem.zeros({arm::SensorKind::hub_angle}, 10);
  EXPECT_EQ(poles.count.expected, 10);
  EXPECT_EQ(zeros.count.expected, 10);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_LT(zeros.s_rad_per_s[i].imag(), poles.omega_rad_per_s[i]);
    if (i > 0) {
      EXPECT_GT(zeros.s_rad_per_s[i].imag(), poles.omega_rad_per_s[i - 1]);
    }
  }
}

TEST_P(Laws, AllModesTogetherAreTheTransferFunction) {
  // H(s) = (1/I_T) (c_0/s^2 + sum c_i phi_i'(0)/(s^2 + omega_i^2)) holds for the discrete model to
  // the last digit; its highest modes, some 10^5 above the first, set the rounding.
  constexpr double kTolerance = 1e-9;
  const FemArm fem = model();
  const arm::Arm& arm = fem.arm();
  const std::vector<arm::Sensor> sensors = {{arm::SensorKind::hub_angle},
                                            {arm::SensorKind::tip_displacement},
                                            {arm::SensorKind::tip_deflection}};
  const std::vector<double> rigid = {1.0, arm.beam.length_m, 0.0};
  const auto modes = fem.modes(fem.degrees_of_freedom(), sensors, {});
  ASSERT_EQ(static_cast<int>(modes.size()), fem.degrees_of_freedom() - 1);
  const Complex s = Complex(0.3, 1.7) * modes[0].omega_rad_per_s;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    Complex sum = rigid[i] / (s * s);
    for (const arm::Mode& mode : modes) {
      sum += mode.sensor_values[i] * mode.hub_slope /
             (s * s + mode.omega_rad_per_s * mode.omega_rad_per_s);
    }
    sum /= arm::total_inertia_kg_m2(arm);
    const Complex exact = fem.transfer_function(sensors[i], s);
    EXPECT_LE(std::abs(sum - exact), kTolerance * std::abs(exact)) << arm::to_string(sensors[i]);
  }
}

INSTANTIATE_TEST_SUITE_P(Reference, Laws, ::testing::ValuesIn(reference::reference_cases()),
                         reference::name_of_case);

/// Some hundred operations.
constexpr double kModeRounding = 1e-12;

TEST(Modes, OfAHeavyHubAreThoseOfACantilever) {
  arm::Arm arm = reference::arm_of(reference::case_named("unit_pinned_free"));
  arm.hub.inertia_kg_m2 = 1e9;
  const std::vector<double> stations = {0.0, 0.5, 1.0};
  const std::vector<arm::Sensor> sensors = {arm::parse_sensor("tip_displacement"),
                                            arm::parse_sensor("strain@0")};
  const arm::Mode mode = FemArm(arm).modes(1, sensors, stations)[0];
  // cosh - cos - ratio (sinh - sin), whose curvature at the root is 2 lambda^2.
  const double lambda = 1.8751040687119611664;
  const double s = std::sin(lambda), c = std::cos(lambda);
  const double sh = std::sinh(lambda), ch = std::cosh(lambda);
  const double ratio = (sh - s) / (ch + c);
  const auto shape = [&](double x) {
    return std::cosh(lambda * x) - std::cos(lambda * x) -
           ratio * (std::sinh(lambda * x) - std::sin(lambda * x));
  };
  constexpr double kHubStillTurns = 1e-8;  // of order m l^3/Ih
  EXPECT_NEAR(mode.displacement_m[0], 0.0, kModeRounding);
  EXPECT_NEAR(mode.displacement_m[1] / mode.displacement_m[2], shape(0.5) / shape(1.0),
              kHubStillTurns);
  EXPECT_NEAR(mode.sensor_values[0], mode.displacement_m[2],
              kModeRounding * std::abs(mode.displacement_m[2]));
  EXPECT_NEAR(mode.sensor_values[1] / mode.sensor_values[0], 2.0 * lambda * lambda / shape(1.0),
              kHubStillTurns * lambda * lambda);
}

TEST(Modes, HaveTheProjectedDampingOfBeamAndHub) {
  arm::Arm arm = reference::arm_of(reference::case_named("paper"));
  arm.damping.kelvin_voigt_s = 1e-5;
  arm.hub.viscous_friction_N_m_s_per_rad = 1e-3;
  const FemArm model(arm);
  const auto modes = model.modes(3, {}, {});
  for (const arm::Mode& mode : modes) {
    EXPECT_GT(mode.hub_slope, 0.0);
    const double w = mode.omega_rad_per_s;
    const double expected =
        (1e-5 * w * w + 1e-3 * mode.hub_slope * mode.hub_slope / arm::total_inertia_kg_m2(arm)) /
        (2.0 * w);
    EXPECT_NEAR(mode.damping_ratio, expected, kModeRounding * expected);
  }
}

TEST(Modes, HaveTheSameNumbersInOtherUnits) {
  // Lengths in mm and masses in g: EI becomes 10^12 times, m (g/mm) once, inertias 10^9 times.
  const reference::ReferenceCase& reference = reference::case_named("paper_payload_50g_inertia");
  const arm::Arm metres = reference::arm_of(reference);
  arm::Arm millimetres = metres;
  millimetres.beam = arm::Beam::from_rigidity(metres.beam.length_m * 1e3,
                                              metres.beam.flexural_rigidity_N_m2() * 1e12,
                                              metres.beam.linear_density_kg_per_m());
  millimetres.hub.inertia_kg_m2 *= 1e9;
  millimetres.payload = {metres.payload.mass_kg * 1e3, metres.payload.inertia_kg_m2 * 1e9};
  const arm::PoleSet a = FemArm(metres).poles(6);
  const arm::PoleSet b = FemArm(millimetres).poles(6);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(a.omega_rad_per_s[i], b.omega_rad_per_s[i], kModeRounding * a.omega_rad_per_s[i]);
  }
}

}  // namespace
}  // namespace flexarm::fem
