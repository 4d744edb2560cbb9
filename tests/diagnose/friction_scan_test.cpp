#include "diagnose/search/fit.hpp"
#include "diagnose/search/friction_scan.hpp"
#include "diagnose/search/selection_options.hpp"
#include "effects/registry/vocabulary.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>

namespace flexarm::diagnose {
namespace {

const std::map<std::string, double> kHidden = {
    {"torque", 0.008}, {"static_torque", 0.014}, {"velocity", 0.2}};

Experiment with_friction(const std::map<std::string, double>& values) {
  return simulated_experiment({effects::named("stribeck_friction", values)}, {.duration_s = 2.0});
}

Candidate start_in(const Problem& problem) {
  const Hypothesis friction = named(problem.experiment(), {"stribeck_friction"}).front();
  return problem.as_filed().with(friction, friction.middle());
}

std::optional<FrictionScan> scanned(const Problem& problem) {
  return scan_friction(problem, start_in(problem), {.evaluations = 160, .starts = 3});
}

TEST(FrictionScan, StartsFitsThatFindTheFriction) {
  const Experiment experiment = with_friction(kHidden);
  const Problem problem(experiment);
  const auto made = scanned(problem);
  ASSERT_TRUE(made);
  EXPECT_GT(made->share, SelectionOptions().least_share);
  const Candidate found = fit(problem, made->starts.front()).candidate;
  for (std::size_t i = 0; i < found.values.size(); ++i) {
    const std::string& name = found.effects.front().parameters[i].name;
    // Noise of 0.5 % leaves errors of some parts in a thousand.
    EXPECT_NEAR(found.values[i], kHidden.at(name), 0.02 * kHidden.at(name)) << name;
  }
}

TEST(FrictionScan, IsNotMadeWhereTheHubSticks) {
  // Breakaway is above the root mean square of the lower torque.
  const Experiment experiment =
      with_friction({{"torque", 0.04}, {"static_torque", 0.06}, {"velocity", 0.1}});
  EXPECT_FALSE(scanned(Problem(experiment)));
}

TEST(FrictionScan, LeavesWhatIsNoHubTorque) {
  const Experiment experiment = simulated_experiment(
      {effects::named("sensor_delay", {{"delay", 0.006}}, "tip_acceleration")});
  const auto made = scanned(Problem(experiment));
  ASSERT_TRUE(made);
  EXPECT_LT(made->share, SelectionOptions().least_friction_share);
}

TEST(FrictionScan, IsOfFrictionThatChangesWithSpeed) {
  const Experiment experiment = simulated_experiment({});
  const Problem problem(experiment);
  for (const Hypothesis& other : named(experiment, {"coulomb_friction", "torque_ripple"})) {
    const Candidate start = problem.as_filed().with(other, other.middle());
    EXPECT_FALSE(scan_friction(problem, start, {})) << other.label();
  }
}

}  // namespace
}  // namespace flexarm::diagnose
