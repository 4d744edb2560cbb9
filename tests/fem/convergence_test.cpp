// Orders of convergence, fitted above the rounding floor, against exact numbers.
#include "fem/fem_arm.hpp"
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

constexpr arm::Sensor kHubAngle{arm::SensorKind::hub_angle};
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

/// Slope of log(error) over log(1/elements) by least squares.
double fitted_order(const std::vector<double>& elements, const std::vector<double>& errors) {
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  const double n = static_cast<double>(elements.size());
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const double x = -std::log(elements[i]);
    const double y = std::log(errors[i]);
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

class CubicConvergence : public ::testing::TestWithParam<ReferenceCase> {
 protected:
  /// Every mode has at least 10 elements a half wave at the coarsest; errors stay above 1e-12,
  /// a hundred times the rounding of the finest.
  static inline const std::vector<double> kElements = {48, 68, 96, 136};
  /// The project's figure: order 4.0 +- 0.1.
  static constexpr double kOrder = 4.0;
  static constexpr double kOrderTolerance = 0.1;

  template <class Errors>
  static void expect_order(const Errors& errors_of, int count) {
    std::vector<std::vector<double>> series(static_cast<std::size_t>(count));
    for (const double elements : kElements) {
      const FemArm model = model_of(GetParam(), static_cast<int>(elements), 3);
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
