#include "arm/input_error.hpp"
#include "fem/fem_arm.hpp"
#include "fem/root_audit.hpp"
#include "fem/sensor_row.hpp"
#include "fem/transmission_zeros.hpp"
#include "fem/trusted_zeros.hpp"
#include "tests/reference/reference_cases.hpp"

#include <Eigen/SVD>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

namespace flexarm::fem {
namespace {

using Complex = std::complex<double>;

/// Rounding of ten-digit sums in models of some fifty coordinates.
constexpr double kZeroRounding = 1e-12;

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
    EXPECT_LE(std::abs(zeros.s_rad_per_s[i] - exact[i]), kZeroRounding * std::abs(exact[i]))
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

TEST(TransmissionZeros, OfTheTipHaveNoHoleOnModelsFinerThanTheZerosNeed) {
  // Numbers of exact_tf for the paper's arm.
  const std::vector<double> exact = {
      57.44089324679096,  310.40585583618173, 766.507747425493,   1425.3243134023264,
      2286.853676147276,  3351.095830143743,  4618.050775377672,  6087.718511849031,
      7760.099039557817,  9635.192358504033,  11712.998468687676, 13993.51737010875,
      16476.749062767252, 19162.69354666318,  22051.35082179654,  25142.72088816733};
  // What six elements of degree 15 leave of the twelfth, eight of the sixteenth.
  constexpr double kTolerance = 1e-11;
  const struct {
    int elements, degree, count;
  } kModels[] = {{8, 15, 12}, {6, 15, 12}, {8, 23, 12}, {8, 15, 16}};
  for (const auto& [elements, degree, count] : kModels) {
    SCOPED_TRACE(::testing::Message() << elements << " x " << degree);
    const FemArm model(arm::paper_arm(), {.mesh = {.elements = elements}, .degree = degree});
    const arm::ZeroSet zeros = model.zeros(arm::parse_sensor("tip_acceleration"), count);
    ASSERT_EQ(zeros.s_rad_per_s.size(), static_cast<std::size_t>(count));
    EXPECT_EQ(zeros.count.found, count);
    EXPECT_EQ(zeros.count.expected, count);
    EXPECT_TRUE(zeros.summary.converged);
    for (std::size_t i = 0; i < zeros.s_rad_per_s.size(); ++i) {
      EXPECT_LE(std::abs(zeros.s_rad_per_s[i] - exact[i]), kTolerance * exact[i])
          << "zero " << i + 1;
    }
  }
}

TEST(TransmissionZeros, OfALargeModelAreCountedToo) {
  const FemArm model(arm::paper_arm(), {.mesh = {.elements = 400}, .degree = 3});
  const arm::ZeroSet zeros = model.zeros(arm::parse_sensor("tip_acceleration"), 4);
  EXPECT_EQ(zeros.count.found, 4);
  EXPECT_EQ(zeros.count.expected, 4);
}

TEST(TransmissionZeros, OfStrainAtATipWithoutPayloadInertiaDoNotExist) {
  const FemArm model(reference::arm_of(reference::case_named("paper")));
  EXPECT_THROW(model.zeros(arm::parse_sensor("strain@0.96"), 3), arm::InputError);
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
    const double error = std::abs(zeros.s_rad_per_s[i] - exact) / exact;
    EXPECT_LE(error, model.options().zero_agreement);
    // The checking model, two degrees finer, is far more accurate: its change is the error.
    EXPECT_NEAR(zeros.relative_change[i], error, 0.1 * error + 1e-9);
  }
  EXPECT_EQ(zeros.relative_change.size(), zeros.s_rad_per_s.size());
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

/// Ten cubic elements have spurious complex roots from the fourth pair on.
struct MissingRoot : ::testing::TestWithParam<std::string> {
  static constexpr int kDegree = 3;
  static constexpr int kPoles = 19;
  static constexpr int kRoots = 10;
  static constexpr int kCount = 3;
  static constexpr double kAgreement = 1e-2;
  static constexpr double kEigenTolerance = 1e-12;
  static Discretisation of_degree(int degree) {
    return Discretisation(arm::linear_arm(loaded_arm()), {.elements = 10}, degree);
  }
  const Discretisation model = of_degree(kDegree);
  const CheckingModels checking{of_degree(kDegree + 2), of_degree(kDegree + 4)};
  const CheckedNumerators numerators{model, checking, arm::parse_sensor(GetParam()), kPoles,
                                     kEigenTolerance};
  const PencilRoots whole = pencil_roots(model, numerators.model, kRoots, kEigenTolerance);
};

TEST_P(MissingRoot, IsTold) {
  const JudgedZeros known = judge(whole, numerators, kCount, kAgreement);
  ASSERT_FALSE(known.gap);
  ASSERT_TRUE(known.zeros.summary.converged);
  for (std::size_t k = 0; k < static_cast<std::size_t>(kCount); ++k) {
    PencilRoots gapped = whole;
    gapped.w.erase(gapped.w.begin() + static_cast<std::ptrdiff_t>(k));
    const JudgedZeros judged = judge(gapped, numerators, kCount, kAgreement);
    EXPECT_TRUE(judged.gap) << k;
    EXPECT_LE(judged.complete, k);
    EXPECT_GT(judged.zeros.count.expected, judged.zeros.count.found);
    EXPECT_FALSE(judged.zeros.summary.converged);
    EXPECT_LE(judged.zeros.s_rad_per_s.size(), k);
    for (std::size_t i = 0; i < judged.zeros.s_rad_per_s.size(); ++i) {
      EXPECT_EQ(judged.zeros.s_rad_per_s[i], known.zeros.s_rad_per_s[i]);
    }
  }
}

TEST_P(MissingRoot, IsFoundBesideTheGap) {
  for (std::size_t k = 0; k + 1 < whole.w.size(); ++k) {
    PencilRoots gapped = whole;
    gapped.w.erase(gapped.w.begin() + static_cast<std::ptrdiff_t>(k));
    const RootAudit before = audit(gapped.w, gapped.w.size() - 1, numerators.model);
    ASSERT_LE(before.complete, k);
    EXPECT_TRUE(search_beside(before.complete, numerators.model, gapped)) << k;
    EXPECT_THAT(gapped.w, ::testing::Contains(::testing::Truly([&](Complex w) {
                  return std::abs(w - whole.w[k]) <= kZeroRounding * std::abs(w);
                })))
        << "root " << k + 1 << ", " << whole.w[k];
  }
}

INSTANTIATE_TEST_SUITE_P(Sensors, MissingRoot,
                         ::testing::Values("tip_displacement", "tip_deflection", "strain@0.25"),
                         [](const auto& sensor) {
                           return sensor.param.substr(0, sensor.param.find('@'));
                         });

TEST(PencilRoots, AreThoseOfTheDensePencilOfASmallModel) {
  // Two cubic elements: n = 5. The finite roots w are where det [K + wM, -e0; c^T, 0] vanishes.
  const Discretisation model(arm::linear_arm(loaded_arm()), {.elements = 2}, 3);
  const SensorRow row(model, arm::parse_sensor("tip_displacement"));
  const int n = model.size();
  const PencilRoots roots =
      pencil_roots(model, PoleFreeNumerator(model, row, n - 1, 1e-12), n - 1, 1e-12);
  ASSERT_EQ(roots.w.size(), static_cast<std::size_t>(n - 1));
  const Eigen::MatrixXd stiffness(model.stiffness());
  const Eigen::MatrixXd mass(model.mass());
  for (const Complex w : roots.w) {
    Eigen::MatrixXcd pencil = Eigen::MatrixXcd::Zero(n + 1, n + 1);
    pencil.topLeftCorner(n, n) = stiffness + w * mass;
    pencil(0, n) = -1.0;
    pencil.row(n).head(n) = row.constant().cast<Complex>().transpose();
    const Eigen::VectorXd singular = pencil.jacobiSvd().singularValues();
    EXPECT_LE(singular[n], kZeroRounding * singular[0]) << "w = " << w;
  }
}

}  // namespace
}  // namespace flexarm::fem
