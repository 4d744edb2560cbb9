#include "fem/fem_arm.hpp"
#include "fem/sensor_row.hpp"
#include "fem/transmission_zeros.hpp"
#include "tests/reference/reference_cases.hpp"

#include <Eigen/SVD>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace flexarm::fem {
namespace {

using Complex = std::complex<double>;

/// Rounding of ten-digit sums in models of some fifty coordinates.
constexpr double kRounding = 1e-12;

/// A unit arm with payload mass 0.5 and payload inertia 0.02; strain equals curvature.
arm::Arm loaded_arm() {
  arm::Arm arm;
  arm.beam = arm::Beam::from_rigidity(1.0, 1.0, 1.0);
  arm.beam.thickness_m = 2.0;
  arm.hub.inertia_kg_m2 = 0.1;
  arm.payload = {0.5, 0.02};
  return arm;
}

void expect_zeros(const arm::ZeroSet& zeros, const std::vector<Complex>& exact) {
  ASSERT_EQ(zeros.s_rad_per_s.size(), exact.size());
  for (std::size_t i = 0; i < exact.size(); ++i) {
    EXPECT_LE(std::abs(zeros.s_rad_per_s[i] - exact[i]), kRounding * std::abs(exact[i]))
        << "zero " << i + 1 << ": " << zeros.s_rad_per_s[i] << ", exact " << exact[i];
  }
  EXPECT_EQ(zeros.count.found, zeros.count.expected);
  EXPECT_EQ(zeros.count.method, "argument principle");
  EXPECT_TRUE(zeros.summary.converged);
}

// The exact numbers below are roots of the characteristic equations of the boundary-value
// problem, computed with 40 digits.

TEST(TransmissionZeros, OfStrainBeyondTheRootLieOnBothAxes) {
  const FemArm model(loaded_arm());
  expect_zeros(model.zeros(arm::parse_sensor("strain@0.25"), 8), {{0.0, 10.6635052059752748},
                                                                  {0.0, 32.2922358636780773},
                                                                  {78.9570244041832178, 0.0},
                                                                  {0.0, 92.9744393544390318},
                                                                  {0.0, 190.989018664499631},
                                                                  {0.0, 322.619350694376042},
                                                                  {0.0, 488.908161262467209},
                                                                  {0.0, 690.492531949916289}});
}

TEST(TransmissionZeros, OfStrainAtTheRootAreThePinnedFrequencies) {
  const FemArm model(loaded_arm());
  expect_zeros(model.zeros(arm::parse_sensor("strain@0"), 6), {{0.0, 8.51664842305354571},
                                                               {0.0, 22.8309618931720247},
                                                               {0.0, 54.8752982096092099},
                                                               {0.0, 108.465720875630652},
                                                               {0.0, 182.261719164902646},
                                                               {0.0, 275.935346264254349}});
}

TEST(TransmissionZeros, OfTipDeflectionLieOnTheImaginaryAxis) {
  const FemArm model(loaded_arm());
  expect_zeros(model.zeros(arm::parse_sensor("tip_deflection"), 6), {{0.0, 11.2813783484513162},
                                                                     {0.0, 29.1213384252309455},
                                                                     {0.0, 65.9683301846021336},
                                                                     {0.0, 125.333333147618016},
                                                                     {0.0, 203.580804734655687},
                                                                     {0.0, 302.651175670197741}});
}

TEST(TransmissionZeros, OfTheTipWithPayloadInertiaHaveAnImaginaryPairBesideTheRealOnes) {
  arm::Arm arm = loaded_arm();
  arm.payload = {10.0, 0.1};
  for (const double hub_inertia : {0.0, 100.0}) {
    arm.hub.inertia_kg_m2 = hub_inertia;
    expect_zeros(FemArm(arm).zeros(arm::parse_sensor("tip_displacement"), 7),
                 {{0.0, 4.7285572540213416138},
                  {18.747542801703317087, 0.0},
                  {78.705077040096364258, 0.0},
                  {177.54054718441475741, 0.0},
                  {315.76407899212582261, 0.0},
                  {493.4397135589943234, 0.0},
                  {710.5833812166520694, 0.0}});
  }
}

TEST(TransmissionZeros, OfTheTipAreAllFoundFarBeyondTheReachOfTheEigensolver) {
  // s_n l^2 sqrt(m/EI) tends to 2 (n - 1/4)^2 pi^2 like exp(-2 n pi). The eigenvalue problem's
  // condition is about exp(n pi), 10^27 for the twentieth.
  constexpr int kCount = 20;
  constexpr double kTolerance = 1e-8;
  const FemArm model(reference::arm_of(reference::case_named("unit_pinned_free")),
                     {.mesh = {.elements = 10}, .degree = 13});
  const arm::ZeroSet zeros = model.zeros(arm::parse_sensor("tip_displacement"), kCount);
  ASSERT_EQ(zeros.s_rad_per_s.size(), static_cast<std::size_t>(kCount));
  EXPECT_EQ(zeros.count.found, zeros.count.expected);
  for (std::size_t i = 5; i < kCount; ++i) {
    const double exact = 2.0 * std::pow((static_cast<double>(i) + 0.75) * std::numbers::pi, 2);
    EXPECT_LE(std::abs(zeros.s_rad_per_s[i] - exact), kTolerance * exact) << "zero " << i + 1;
  }
}

TEST(TransmissionZeros, OfStrainAtATipWithoutPayloadInertiaDoNotExist) {
  const FemArm model(reference::arm_of(reference::case_named("paper")));
  const arm::ZeroSet zeros = model.zeros(arm::parse_sensor("strain@0.96"), 3);
  EXPECT_TRUE(zeros.s_rad_per_s.empty());
  EXPECT_TRUE(zeros.rejected.empty());
}

TEST(SpuriousZeros, OfSixteenCubicElementsSevenOfThirtyTwoTipZerosAreTrusted) {
  const reference::ReferenceCase& reference = reference::case_named("paper");
  const FemArm model(reference::arm_of(reference), {.mesh = {.elements = 16}, .degree = 3});
  const arm::ZeroSet zeros =
      model.zeros(arm::parse_sensor("tip_displacement"), model.degrees_of_freedom());
  EXPECT_EQ(model.degrees_of_freedom(), 33);
  // The pencil is of order 34.
  EXPECT_EQ(zeros.infinite, 2);
  EXPECT_EQ(zeros.s_rad_per_s.size(), 7u);
  EXPECT_EQ(zeros.rejected.size(), 25u);
  // What is trusted is within the stated agreement of the exact zeros, as far as those are listed.
  for (std::size_t i = 0; i < reference.real_tip_zero_rad_per_s.size(); ++i) {
    const double exact = reference.real_tip_zero_rad_per_s[i];
    EXPECT_LE(std::abs(zeros.s_rad_per_s[i] - exact), model.options().zero_agreement * exact);
  }
  for (const arm::RejectedZero& zero : zeros.rejected) {
    EXPECT_FALSE(zero.reason.empty());
    EXPECT_GT(zero.relative_change, 0.0);
  }
}

TEST(SpuriousZeros, AreNeverServedToFillARequest) {
  for (const char* sensor : {"tip_acceleration", "tip_deflection", "strain@0.24"}) {
    const reference::ReferenceCase& reference = reference::case_named("paper");
    const FemArm coarse(reference::arm_of(reference), {.mesh = {.elements = 10}, .degree = 3});
    const FemArm fine(reference::arm_of(reference), {.mesh = {.elements = 8}, .degree = 13});
    const arm::ZeroSet trusted =
        coarse.zeros(arm::parse_sensor(sensor), coarse.degrees_of_freedom());
    const arm::ZeroSet known = fine.zeros(arm::parse_sensor(sensor), 20);
    ASSERT_FALSE(trusted.s_rad_per_s.empty());
    ASSERT_FALSE(trusted.rejected.empty());
    for (const Complex s : trusted.s_rad_per_s) {
      EXPECT_THAT(known.s_rad_per_s, ::testing::Contains(::testing::Truly([&](Complex t) {
                    return std::abs(s - t) <= coarse.options().zero_agreement * std::abs(t);
                  })))
          << sensor << " has no zero near " << s;
    }
  }
}

TEST(PencilRoots, AreThoseOfTheDensePencilOfASmallModel) {
  // Two cubic elements: n = 5. The finite roots w are where det [K + wM, -e0; c^T, 0] vanishes.
  const Discretisation model(loaded_arm(), {.elements = 2}, 3);
  const SensorRow row = sensor_row(model, loaded_arm(), arm::parse_sensor("tip_displacement"));
  const int n = model.size();
  const PencilRoots roots =
      pencil_roots(model, Numerator(model, row.c, n - 1, 1e-12), n - 1, 1e-12);
  ASSERT_EQ(roots.w.size(), static_cast<std::size_t>(n - 1));
  const Eigen::MatrixXd stiffness(model.stiffness());
  const Eigen::MatrixXd mass(model.mass());
  for (const Complex w : roots.w) {
    Eigen::MatrixXcd pencil = Eigen::MatrixXcd::Zero(n + 1, n + 1);
    pencil.topLeftCorner(n, n) = stiffness + w * mass;
    pencil(0, n) = -1.0;
    pencil.row(n).head(n) = row.c.cast<Complex>().transpose();
    const Eigen::VectorXd singular = pencil.jacobiSvd().singularValues();
    EXPECT_LE(singular[n], kRounding * singular[0]) << "w = " << w;
  }
}

}  // namespace
}  // namespace flexarm::fem
