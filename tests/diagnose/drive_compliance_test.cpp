// A compliant drive in simulated runs, told from the soft root that it nears as rotor_share does 1.
#include "diagnose/search/selection.hpp"
#include "effects/registry/vocabulary.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace flexarm::diagnose {
namespace {

constexpr SimulatedRuns kDrivenRuns{.duration_s = 2.0};

const std::vector<std::string>& rivals_of_drive() {
  static const std::vector<std::string> names = {
      "drive_compliance", "root_compliance",   "root_damping", "hub_inertia",
      "hub_spring",       "flexural_rigidity", "torque_gain",  "sensor_lag"};
  return names;
}

TEST(DriveCompliance, IsFoundInSimulatedRuns) {
  const Experiment experiment = simulated_experiment(
      {effects::named("drive_compliance",
                      {{"stiffness", 30.0}, {"rotor_share", 0.6}, {"time", 1e-3}})},
      kDrivenRuns);
  Problem problem(experiment);
  const Selection made = select(problem, named(experiment, rivals_of_drive()), {});
  const Candidate& chosen = made.chosen.fit.candidate;
  ASSERT_EQ(chosen.label(), "drive_compliance");
  EXPECT_TRUE(made.chosen.estimation.is_noise());
  EXPECT_NEAR(chosen.values[0] / 30.0, 1.0, 0.02);
  EXPECT_NEAR(chosen.values[1], 0.6, 0.02);
  EXPECT_NEAR(chosen.values[2] / 1e-3, 1.0, 0.1);
}

TEST(DriveCompliance, IsNotNamedWhereItIsTheRoot) {
  const Experiment experiment =
      simulated_experiment({effects::named("root_compliance", {{"stiffness", 30.0}})}, kDrivenRuns);
  Problem problem(experiment);
  const Selection made = select(problem, named(experiment, rivals_of_drive()), {});
  EXPECT_EQ(made.chosen.fit.candidate.label(), "root_compliance");
}

}  // namespace
}  // namespace flexarm::diagnose
