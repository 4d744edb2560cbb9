#include "arms.hpp"
#include "assumed_modes/assumed_modes_arm.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace flexarm::assumed_modes {
namespace {

/// Rounding to double of converged values.
constexpr double kConverged = 1e-14;

void expect_more_functions_change_nothing(const arm::Arm& arm) {
  const AssumedModesArm model(arm);
  const AssumedModesArm finer(arm, {Basis::legendre, model.degrees_of_freedom() + 8});
  const auto compare = [&](const arm::Sensor& sensor, int count, double tolerance) {
    const auto zeros = model.zeros(sensor, count).s_rad_per_s;
    const auto expected = finer.zeros(sensor, count).s_rad_per_s;
    ASSERT_EQ(zeros.size(), static_cast<std::size_t>(count));
    ASSERT_EQ(expected.size(), static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < zeros.size(); ++i) {
      EXPECT_LE(std::abs(zeros[i] / expected[i] - 1.0), tolerance)
          << arm::to_string(sensor) << " zero " << i + 1;
    }
  };
  const auto poles = model.poles(10).omega_rad_per_s;
  const auto expected = finer.poles(10).omega_rad_per_s;
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_LE(std::abs(poles[i] / expected[i] - 1.0), kConverged) << "pole " << i + 1;
  }
  compare(testing_arms::kHubAngle, 10, kConverged);
  compare(testing_arms::kTipAcceleration, 6, testing_arms::kTipZeroRounding);
}

TEST(PayloadGrid, DefaultFunctionsGiveTenPolesTenHubZerosAndSixTipZerosEverywhere) {
  for (const double payload_mass : {0.0, 0.1, 1.0, 10.0}) {
    for (const double payload_inertia : {0.0, 1e-4, 1e-3, 1e-2, 0.1}) {
      for (const double hub_inertia : {0.0, 0.01, 1.0, 100.0}) {
        SCOPED_TRACE(testing::Message() << "payload " << payload_mass << ", " << payload_inertia
                                        << "; hub " << hub_inertia);
        expect_more_functions_change_nothing(
            testing_arms::unit_arm(hub_inertia, payload_mass, payload_inertia));
      }
    }
  }
}

}  // namespace
}  // namespace flexarm::assumed_modes
