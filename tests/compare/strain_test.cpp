#include "compare/comparison.hpp"
#include "tests/compare/models.hpp"

#include <gtest/gtest.h>

#include <iostream>

namespace flexarm::compare {
namespace {

/// The gauges of the paper, the root, and the sensors of displacement.
std::vector<arm::Sensor> sensors() {
  std::vector<arm::Sensor> all;
  for (const double x : {0.0, 0.05, 0.25, 0.47, 0.712}) {
    all.push_back({arm::SensorKind::strain, x});
  }
  all.push_back({arm::SensorKind::tip_deflection, 0.0});
  all.push_back({arm::SensorKind::tip_displacement, 0.0});
  return all;
}

TEST(Strain, ZerosAndResponsesAgreeOnEveryArm) {
  Options options = quick();
  options.sensors = sensors();
  for (const auto& [name, arm] : varied_arms()) {
    const auto comparison = compare(arm, options);
    const auto& worst = comparison.verdict.worst;
    std::cout << name << ": " << worst.quantity << ", " << worst.first << " and " << worst.second
              << ": " << worst.distance << " of " << worst.tolerance << "\n";
    for (const auto& finding : comparison.findings) {
      EXPECT_LE(finding.distance, finding.tolerance)
          << name << ": " << finding.quantity << ", " << finding.first << " and " << finding.second;
    }
  }
}

}  // namespace
}  // namespace flexarm::compare
