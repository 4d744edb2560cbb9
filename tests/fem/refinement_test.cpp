// Fine meshes: no rising of the error, cost linear in the number of elements.
#include "fem/fem_arm.hpp"
#include "tests/fem/constants.hpp"
#include "tests/reference/reference_cases.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>

namespace flexarm::fem {
namespace {

struct Errors {
  double poles = 0.0;
  double hub_zeros = 0.0;
};

/// Largest relative errors of the first ten of the paper's arm, cubic elements.
Errors errors_of(int elements) {
  const reference::ReferenceCase& reference = reference::case_named("paper");
  const FemArm model(reference::arm_of(reference), {.mesh = {.elements = elements}, .degree = 3});
  const double scale = arm::omega_scale_rad_per_s(model.arm());
  const arm::PoleSet poles = model.poles(10);
  const arm::ZeroSet zeros = model.zeros(kHubAngle, 10);
  EXPECT_TRUE(poles.summary.converged);
  EXPECT_TRUE(zeros.summary.converged);
  Errors errors;
  for (std::size_t i = 0; i < 10; ++i) {
    const double pole = scale * std::pow(reference.pole_lambda[i], 2);
    const double zero = scale * std::pow(reference.hub_zero_lambda[i], 2);
    errors.poles = std::max(errors.poles, std::abs(poles.omega_rad_per_s[i] / pole - 1.0));
    errors.hub_zeros =
        std::max(errors.hub_zeros, std::abs(zeros.s_rad_per_s[i].imag() / zero - 1.0));
  }
  return errors;
}

TEST(Refinement, ErrorsDoNotRiseWithTheNumberOfElements) {
  // An assembled stiffness would be off by 6e-6 at 1280 elements and useless at 10,000.
  constexpr double kHundredthOfTheFigure = 1e-11;
  const Errors thousand = errors_of(1000);
  const Errors ten_thousand = errors_of(10000);
  EXPECT_LE(ten_thousand.poles, kHundredthOfTheFigure);
  EXPECT_LE(ten_thousand.poles, thousand.poles);
  EXPECT_LE(ten_thousand.hub_zeros, thousand.hub_zeros);
}

TEST(Refinement, AHundredThousandElementsKeepTenPolesWithinTheFigure) {
  constexpr double kFigure = 1e-9;
  const Errors errors = errors_of(100000);
  EXPECT_LE(errors.poles, kFigure);
  EXPECT_LE(errors.hub_zeros, kFigure);
}

TEST(Refinement, TimeIsLinearInTheNumberOfElements) {
  // Ten times the elements; a quadratic cost would take a hundred times as long.
  constexpr double kWellBelowQuadratic = 30.0;
  // Processor time, since other programs may share the machine.
  const auto seconds = [](int elements) {
    double best = 1e9;
    for (int repeat = 0; repeat < 3; ++repeat) {
      const std::clock_t start = std::clock();
      errors_of(elements);
      best = std::min(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    return best;
  };
  EXPECT_LE(seconds(20000) / seconds(2000), kWellBelowQuadratic);
}

}  // namespace
}  // namespace flexarm::fem
