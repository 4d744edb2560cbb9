#include "report/figures/phase.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace flexarm::report {
namespace {

using testing::ElementsAre;
using testing::IsNan;

std::vector<std::complex<double>> at_angles(const std::vector<double>& angles_deg) {
  std::vector<std::complex<double>> values;
  for (const double angle : angles_deg) {
    values.push_back(std::polar(2.0, angle * std::numbers::pi / 180.0));
  }
  return values;
}

TEST(PrincipalPhase, KeepsTheMultiplesOf90DegAwayFromTheCut) {
  const double e = 1e-6;
  const auto phase = principal_phase_deg(at_angles({0, 180 - e, 180 + e, 90 + e, -90, 134, 136}));
  const std::vector<double> expected{0, -180 - e, -180 + e, 90 + e, -90, 134, -224};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(phase[i], expected[i], 1e-9);
}

TEST(PrincipalPhase, DoesNotDependOnNeighbours) {
  auto values = at_angles({10, -100, 170, -340, 20});
  const auto phase = principal_phase_deg(values);
  std::ranges::reverse(values);
  auto reversed = principal_phase_deg(values);
  std::ranges::reverse(reversed);
  EXPECT_EQ(phase, reversed);
}

TEST(PrincipalPhase, ZeroHasNone) {
  EXPECT_THAT(principal_phase_deg({1.0, 0.0, -1.0}), ElementsAre(0, IsNan(), -180));
}

}  // namespace
}  // namespace flexarm::report
