// Orders of convergence, fitted above the rounding floor, against exact numbers.
#include "fem/fem_arm.hpp"
#include "tests/fem/constants.hpp"
#include "tests/fem/fitted_order.hpp"
#include "tests/reference/reference_cases.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace flexarm::fem {
namespace {

using reference::ReferenceCase;

constexpr arm::Sensor kTipAcceleration{arm::SensorKind::tip_acceleration};

double exact_omega(const ReferenceCase& reference, double lambda) {
  return lambda * lambda * arm::omega_scale_rad_per_s(reference::arm_of(reference));
}

FemArm model_of(const ReferenceCase& reference, int elements, int degree) {
  return FemArm(reference::arm_of(reference), {.mesh = {.elements = elements}, .degree = degree});
}

std::vector<double> relative_pole_errors(const FemArm& model, const ReferenceCase& reference,
                                         int count) {
  std::vector<double> errors;
  const arm::PoleSet poles = model.poles(count);
  for (std::size_t i = 0; i < poles.omega_rad_per_s.size(); ++i) {
    const double exact = exact_omega(reference, reference.pole_lambda[i]);
    errors.push_back(std::abs(poles.omega_rad_per_s[i] - exact) / exact);
  }
  return errors;
}

std::vector<double> relative_hub_zero_errors(const FemArm& model, const ReferenceCase& reference,
                                             int count) {
  std::vector<double> errors;
  const arm::ZeroSet zeros = model.zeros(kHubAngle, count);
  for (std::size_t i = 0; i < zeros.s_rad_per_s.size(); ++i) {
    const double exact = exact_omega(reference, reference.hub_zero_lambda[i]);
    errors.push_back(std::abs(zeros.s_rad_per_s[i] - std::complex<double>(0.0, exact)) / exact);
  }
  return errors;
}

/// Of the real zeros: with a payload inertia there are imaginary ones between them.
std::vector<double> relative_tip_zero_errors(const FemArm& model, const ReferenceCase& reference,
                                             int count) {
  std::vector<double> errors;
  for (const auto s : model.zeros(kTipAcceleration, count + 1).s_rad_per_s) {
    if (s.imag() != 0.0 || static_cast<int>(errors.size()) == count) continue;
    const double exact = reference.real_tip_zero_rad_per_s[errors.size()];
    errors.push_back(std::abs(s - exact) / exact);
  }
  return errors;
}

double largest(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

class CubicConvergence : public ::testing::TestWithParam<ReferenceCase> {
 protected:
  /// Every mode has at least 10 elements a half wave at the coarsest; errors stay above 1e-12,
  /// a hundred times the rounding of the finest.
  static inline const std::vector<int> kElements = {48, 68, 96, 136};
  /// The project's figure: order 4.0 +- 0.1.
  static constexpr double kOrder = 4.0;
  static constexpr double kOrderTolerance = 0.1;

  template <class Errors>
  static void expect_order(const Errors& errors_of, int count) {
    std::vector<std::vector<double>> series(static_cast<std::size_t>(count));
    for (const int elements : kElements) {
      const FemArm model = model_of(GetParam(), elements, 3);
      const std::vector<double> errors = errors_of(model, GetParam(), count);
      ASSERT_EQ(errors.size(), static_cast<std::size_t>(count));
      for (std::size_t i = 0; i < errors.size(); ++i) series[i].push_back(errors[i]);
    }
    for (std::size_t i = 0; i < series.size(); ++i) {
      EXPECT_NEAR(fitted_order(kElements, series[i]), kOrder, kOrderTolerance)
          << "number " << i + 1 << " of " << GetParam().name << ", finest error "
          << series[i].back();
    }
  }
};

TEST_P(CubicConvergence, PolesAreOfOrderFour) {
  expect_order(relative_pole_errors, 5);
}
TEST_P(CubicConvergence, HubZerosAreOfOrderFour) {
  expect_order(relative_hub_zero_errors, 5);
}
TEST_P(CubicConvergence, TipZerosAreOfOrderFour) {
  expect_order(relative_tip_zero_errors, 2);
}

class SmallModel : public ::testing::TestWithParam<ReferenceCase> {};

TEST_P(SmallModel, TheDefaultFindsTenPolesTenHubZerosAndSixTipZerosWithinRounding) {
  // Measured: at most 6e-15, but for heavy payloads, whose zeros lie far apart.
  constexpr double kFewHundredEpsilon = 1e-13;
  constexpr int kFigure = 60;
  const FemArm model(reference::arm_of(GetParam()));
  EXPECT_LE(model.degrees_of_freedom(), kFigure);
  EXPECT_LE(largest(relative_pole_errors(model, GetParam(), 10)), kFewHundredEpsilon);
  EXPECT_LE(largest(relative_hub_zero_errors(model, GetParam(), 10)), kFewHundredEpsilon);
  EXPECT_LE(largest(relative_tip_zero_errors(model, GetParam(), 6)), kFewHundredEpsilon);
}

TEST_P(SmallModel, ErrorsFallExponentiallyWithTheDegree) {
  // Pole 5 on three elements: every two degrees gain a factor of 50 at least, down to 1e-12.
  constexpr double kGain = 50.0;
  constexpr double kFloor = 1e-12;
  double before = 0.0;
  for (int degree = 7; degree <= 17; degree += 2) {
    const double error =
        relative_pole_errors(model_of(GetParam(), 3, degree), GetParam(), 5).back();
    if (degree > 7) {
      EXPECT_LE(error, std::max(before / kGain, kFloor)) << "degree " << degree;
    }
    before = error;
  }
  EXPECT_LE(before, kFloor);
}

INSTANTIATE_TEST_SUITE_P(Reference, CubicConvergence,
                         ::testing::ValuesIn(reference::reference_cases()),
                         reference::name_of_case);
INSTANTIATE_TEST_SUITE_P(Reference, SmallModel, ::testing::ValuesIn(reference::reference_cases()),
                         reference::name_of_case);

TEST(HeavyPayload, LeavesTenPolesAndTenHubZerosExact) {
  // Payload mass 10 m l and inertia 0.1 m l^3: the clamped frequencies span a factor of 1300, the
  // eigenvalues one of 1.8e6. lambda from the characteristic equations with 40 digits.
  constexpr std::array<double, 10> kLightHub = {
      2.2316525621679791245, 4.1155741259806501844, 7.1110305299410267184, 10.229285634872230717,
      13.363403762577657257, 16.501615182262838516, 19.641340988678628951, 22.781763441795856002,
      25.922556585287608155, 29.063568464909966909};
  constexpr std::array<double, 10> kHeavyHub = {
      0.75007790625103401002, 2.4614603500918937027, 4.8453658993926576181, 7.8865638311272272997,
      11.012157157145535067,  14.147731166598983179, 17.286452697896098243, 20.426399840302725966,
      23.566935508124681337,  26.707793500284759457};
  constexpr std::array<double, 10> kClamped = {
      0.73177923001917690492, 2.4612351066374028965, 4.8452836028217074839, 7.8865436391633970599,
      11.012149690300866636,  14.147727639642683797, 17.286450763287275398, 20.426398667440570818,
      23.566934744339594803,  26.707792975477125138};
  constexpr double kFewHundredEpsilon = 1e-13;
  arm::Arm arm = reference::arm_of(reference::case_named("unit_pinned_free"));
  arm.payload = {10.0, 0.1};
  for (const auto& [hub_inertia, lambdas] :
       {std::pair(0.0, kLightHub), std::pair(100.0, kHeavyHub)}) {
    arm.hub.inertia_kg_m2 = hub_inertia;
    const FemArm model(arm);
    const arm::PoleSet poles = model.poles(10);
    const arm::ZeroSet zeros = model.zeros(kHubAngle, 10);
    for (std::size_t i = 0; i < 10; ++i) {
      const double pole = lambdas[i] * lambdas[i];
      const double zero = kClamped[i] * kClamped[i];
      EXPECT_NEAR(poles.omega_rad_per_s[i], pole, kFewHundredEpsilon * pole);
      EXPECT_NEAR(zeros.s_rad_per_s[i].imag(), zero, kFewHundredEpsilon * zero);
    }
  }
}

TEST(HeavyPayload, OfHundredMillionKilogramsLeavesPolesAndHubZerosExact) {
  // The paper's arm. The first eigenvalue of the clamped arm's flexibility is up to 5e10 times the
  // second. Numbers of exact_tf.
  struct Case {
    double payload_mass_kg;
    std::array<double, 6> omega_rad_per_s;
    std::array<double, 6> hub_zero_rad_per_s;
  };
  constexpr std::array<Case, 3> kCases = {
      {{1e4,
        {48.68988536505403, 168.89995874754757, 318.33640883800246, 563.8938715355362,
         930.9417583015712, 1406.6620763084118},
        {0.03538114136159767, 79.16909391552757, 256.55840524569874, 535.2885454756904,
         915.3750291963117, 1396.8179083851794}},
       {1e6,
        {48.68980890002281, 168.89990060958831, 318.3363508037802, 563.893797981067,
         930.9416800258757, 1406.6619967396298},
        {0.0035381206696279556, 79.16901782707062, 256.5583245996347, 535.2884650319479,
         915.3749487438192, 1396.8178279330543}},
       {1e8,
        {48.68980813537018, 168.89990002820784, 318.33635022343736, 563.8937972455217,
         930.9416792431183, 1406.6619959439415},
        {0.00035381207349628133, 79.16901706618441, 256.5583237931731, 535.2884642275098,
         915.3749479392937, 1396.8178271285328}}}};
  constexpr double kRounding = 1e-12;
  // (lambda h)^4/1440 of the sixth, 3.2e-8, and a little.
  constexpr double kCubic = 4e-8;
  const struct {
    MeshOptions mesh;
    int degree;
    double tolerance;
  } kModels[] = {{{.elements = 4}, 15, kRounding},
                 {{.elements = 40}, 8, kRounding},
                 {{.elements = 200}, 3, kCubic}};
  for (const Case& heavy : kCases) {
    arm::Arm arm = arm::paper_arm();
    arm.payload.mass_kg = heavy.payload_mass_kg;
    for (const auto& options : kModels) {
      SCOPED_TRACE(::testing::Message()
                   << heavy.payload_mass_kg << " kg, degree " << options.degree);
      const FemArm model(arm, {.mesh = options.mesh, .degree = options.degree});
      const arm::PoleSet poles = model.poles(6);
      const arm::ZeroSet zeros = model.zeros(kHubAngle, 6);
      EXPECT_TRUE(poles.summary.converged);
      EXPECT_TRUE(zeros.summary.converged);
      EXPECT_EQ(zeros.count.expected, 6);
      for (std::size_t i = 0; i < 6; ++i) {
        const double pole = heavy.omega_rad_per_s[i];
        const double zero = heavy.hub_zero_rad_per_s[i];
        EXPECT_NEAR(poles.omega_rad_per_s[i], pole, options.tolerance * pole);
        EXPECT_NEAR(zeros.s_rad_per_s[i].imag(), zero, options.tolerance * zero);
      }
    }
  }
}

TEST(HeavyPayload, WithHeavyInertiaAndHubLeavesTheSameModesOnAnyMesh) {
  // With mass and inertia two modes swing on the beam as on a spring. The dense solver of the small
  // model and the iteration of the large one share no step but the refinement.
  constexpr double kTolerance = 1e-10;
  for (const double mass_kg : {0.0, 1e8}) {
    arm::Arm arm = arm::paper_arm();
    arm.hub.inertia_kg_m2 = 1e8;
    arm.payload = {mass_kg, 1e8};
    const FemArm small(arm, {.mesh = {.elements = 6}, .degree = 15});
    const FemArm large(arm, {.mesh = {.elements = 40}, .degree = 8});
    const arm::PoleSet a = small.poles(6);
    const arm::PoleSet b = large.poles(6);
    EXPECT_TRUE(b.summary.converged);
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_NEAR(b.omega_rad_per_s[i], a.omega_rad_per_s[i], kTolerance * a.omega_rad_per_s[i]);
    }
  }
}

TEST(GradedMesh, ConvergesToTheSameNumbersAsAUniformOne) {
  const ReferenceCase& reference = reference::case_named("paper");
  for (const Grading grading :
       {Grading::towards_root, Grading::towards_tip, Grading::towards_both}) {
    const FemArm model(
        reference::arm_of(reference),
        {.mesh = {.elements = 8, .grading = grading, .grading_ratio = 1.3}, .degree = 14});
    // The longest element, a quarter of the beam, decides.
    constexpr double kTolerance = 1e-10;
    EXPECT_LE(largest(relative_pole_errors(model, reference, 10)), kTolerance);
    EXPECT_LE(largest(relative_hub_zero_errors(model, reference, 10)), kTolerance);
    EXPECT_LE(largest(relative_tip_zero_errors(model, reference, 6)), kTolerance);
  }
}

}  // namespace
}  // namespace flexarm::fem
