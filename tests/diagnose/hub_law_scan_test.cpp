#include "diagnose/search/hub_law_scan.hpp"

#include "diagnose/search/fit.hpp"
#include "diagnose/search/hub_laws.hpp"
#include "diagnose/search/selection_options.hpp"
#include "diagnose/symptoms/hub_regression.hpp"
#include "effects/registry/vocabulary.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <ostream>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::diagnose {
namespace {

struct HiddenLaw {
  std::string effect;
  std::map<std::string, double> values;
};

void PrintTo(const HiddenLaw& hidden, std::ostream* out) {
  *out << hidden.effect;
}

const HiddenLaw kFriction = {"stribeck_friction",
                             {{"torque", 0.008}, {"static_torque", 0.014}, {"velocity", 0.2}}};

Experiment with_hidden(const HiddenLaw& hidden) {
  return simulated_experiment({effects::named(hidden.effect, hidden.values)}, {.duration_s = 2.0});
}

std::optional<HubLawScan> scanned(const Problem& problem, const std::string& effect) {
  const Hypothesis law = named(problem.experiment(), {effect}).front();
  const SelectionOptions options;
  return scan_hub_law(problem, problem.as_filed().with(law, law.middle()),
                      {.evaluations = options.law_evaluations, .starts = options.scan_starts});
}

class HubLawScanOf : public testing::TestWithParam<HiddenLaw> {};

TEST_P(HubLawScanOf, StartsFitsThatFindTheLaw) {
  const HiddenLaw& hidden = GetParam();
  const Experiment experiment = with_hidden(hidden);
  const Problem problem(experiment);
  const auto made = scanned(problem, hidden.effect);
  ASSERT_TRUE(made);
  EXPECT_GT(made->share, SelectionOptions().least_share);
  std::optional<Fit> best;
  for (const Candidate& start : made->starts) {
    Fit found = fit(problem, start);
    if (!best || found.sum_of_squares < best->sum_of_squares) best = std::move(found);
  }
  const Candidate& found = best->candidate;
  for (std::size_t i = 0; i < found.values.size(); ++i) {
    const std::string& name = found.effects.front().parameters[i].name;
    const double truth = hidden.values.at(name);
    // Noise leaves errors of some parts in a thousand; another minimum is further off.
    EXPECT_NEAR(found.values[i], truth, 0.02 * truth) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Laws, HubLawScanOf,
    testing::Values(
        kFriction,
        HiddenLaw{"torque_ripple", {{"amplitude", 0.02}, {"cycles", 6.0}, {"phase", 1.1}}},
        HiddenLaw{"disturbance_torque", {{"amplitude", 0.02}, {"frequency", 3.3}, {"phase", 2.0}}},
        HiddenLaw{"hub_hardening_spring", {{"coefficient", 0.5}}},
        // With a state of its own.
        HiddenLaw{"hub_hysteresis", {{"torque", 0.012}, {"stiffness", 0.4}}},
        // A free hub drifts by it: less than the distance of the values scanned, and found.
        HiddenLaw{"friction_asymmetry", {{"coefficient", 2e-4}}}));

/// The problem by torque balance.
Problem balanced(const Experiment& experiment) {
  return Problem(experiment)
      .with_noise({.disturbance_N_m = 5e-3, .correlation_time_s = 0.02, .balance_unit_N_m = 1e-3});
}

TEST(BalancedTorque, IsWhatATorqueTakesFromTheMissingTorque) {
  constexpr double kTorque_N_m = 2e-3;
  // Sums of as many terms as samples.
  constexpr double kRounding = 1e-10;
  const Experiment experiment = simulated_experiment({}, {.duration_s = 2.0});
  const Problem problem = balanced(experiment);
  const std::vector<bool> all(experiment.runs.size(), true);
  arm::Arm pushed = experiment.arm;
  pushed.effects = {effects::named("torque_bias", {{"torque", kTorque_N_m}})};
  const auto before = problem.residuals(experiment.arm, {}, all);
  const auto after = problem.residuals(pushed, {}, all);
  ASSERT_TRUE(before && after);
  for (std::size_t r = 0; r < experiment.runs.size(); ++r) {
    const auto [first, pulse_response] = problem.predictor().balanced_torque(r);
    const auto samples = std::ssize(pulse_response);
    const std::vector<double> torque_N_m(pulse_response.size(), kTorque_N_m);
    const std::vector<double> taken = HubResponse(pulse_response).reading(torque_N_m);
    const Eigen::VectorXd expected =
        before->segment(first, samples) - Eigen::VectorXd::Map(taken.data(), samples);
    EXPECT_GT((before->segment(first, samples) - expected).norm(), 1.0) << r;
    EXPECT_LE((after->segment(first, samples) - expected).norm(),
              kRounding * after->segment(first, samples).norm())
        << r;
  }
}

class BalancedLawScanOf : public testing::TestWithParam<HiddenLaw> {};

TEST_P(BalancedLawScanOf, StartsFitsThatFindTheLaw) {
  const HiddenLaw& hidden = GetParam();
  const Experiment experiment = with_hidden(hidden);
  const Problem problem = balanced(experiment);
  const auto made = scanned(problem, hidden.effect);
  ASSERT_TRUE(made);
  EXPECT_GT(made->share, SelectionOptions().least_share);
  const Fit found = fit(problem, made->starts.front());
  for (std::size_t i = 0; i < found.candidate.values.size(); ++i) {
    const std::string& name = found.candidate.effects.front().parameters[i].name;
    const double truth = hidden.values.at(name);
    // The filter lets more noise through than a simulation; another minimum is further off.
    EXPECT_NEAR(found.candidate.values[i], truth, 0.05 * truth) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Laws, BalancedLawScanOf,
    testing::Values(kFriction,
                    HiddenLaw{"torque_ripple",
                              {{"amplitude", 0.02}, {"cycles", 6.0}, {"phase", 1.1}}},
                    HiddenLaw{"hub_hardening_spring", {{"coefficient", 0.5}}}));

TEST(HubLawScan, LeavesOutValuesAtWhichTheLawIsOfAnotherKind) {
  const Experiment experiment = with_hidden(kFriction);
  const Problem problem(experiment);
  Hypothesis law = named(experiment, {kFriction.effect}).front();
  // In the middle of the ranges both torques are equal: friction does not change with speed.
  law.parameters[0] = {"torque", 0.005, 0.015, effects::Spacing::linear};
  law.parameters[1] = {"static_torque", 0.005, 0.015, effects::Spacing::linear};
  law.parameters.pop_back();
  law.known = {{"velocity", 0.2}};
  const auto made = scan_hub_law(problem, problem.as_filed().with(law, {0.008, 0.014}),
                                 {.evaluations = {1, 1, 1}});
  ASSERT_TRUE(made);
  EXPECT_EQ(made->share, 0.0);
}

/// Without a scan: the amplitude alone is not known.
TEST(HubLawScan, SolvesForTheAmplitude) {
  constexpr double kCoefficient = 0.5;
  const Experiment experiment =
      with_hidden({"hub_hardening_spring", {{"coefficient", kCoefficient}}});
  const Problem problem(experiment);
  Hypothesis law = named(experiment, {"hub_hardening_spring"}).front();
  const double most = 10.0 * kCoefficient;
  law.parameters[0] = {"coefficient", 0.01 * most, most, effects::Spacing::from_zero};
  const auto made = scan_hub_law(problem, problem.as_filed().with(law, {most}), {});
  ASSERT_TRUE(made);
  EXPECT_NEAR(made->starts.front().values.front(), kCoefficient, 0.02 * kCoefficient);
}

/// Friction whose torques alone are not known, the first of them no more than `highest_N_m`, as a
/// grid of one place solves for them.
class TwoAmplitudes : public testing::Test {
 protected:
  std::pair<Candidate, double> solved(double highest_N_m) {
    Hypothesis law = named(experiment_, {kFriction.effect}).front();
    law.parameters.pop_back();
    law.known = {{"velocity", kFriction.values.at("velocity")}};
    law.parameters.front().lowest = 1e-2 * highest_N_m;
    law.parameters.front().highest = highest_N_m;
    const HubLawGrid* grid = laws().grid(Candidate{}.with(law, law.middle()), {});
    return grid->best(residuals(), 1).front();
  }
  HubLaws& laws() { return problem_.hub_laws(); }
  Eigen::VectorXd residuals() {
    return laws().residuals(*problem_.residuals(problem_.as_filed(), problem_.estimation_runs()));
  }

 private:
  const Experiment experiment_ = with_hidden(kFriction);
  const Problem problem_ = Problem(experiment_);
};

TEST_F(TwoAmplitudes, LeaveTheLeastSumOfSquares) {
  // The sign of a velocity is not known within its noise.
  constexpr double kNear = 0.1;
  constexpr double kSinglePrecision = 1e-5;  // of sums of thousands of products
  const double torque = kFriction.values.at("torque");
  const double static_torque = kFriction.values.at("static_torque");
  const auto [best, least] = solved(10.0 * torque);
  EXPECT_NEAR(best.values[0], torque, kNear * torque);
  EXPECT_NEAR(best.values[1], static_torque, kNear * static_torque);
  for (const double factor : {0.95, 1.05}) {
    for (const std::size_t i : {0U, 1U}) {
      Candidate other = best;
      other.values[i] *= factor;
      const auto readings = laws().regression().readings(other);
      ASSERT_TRUE(readings);
      EXPECT_GT((residuals() - *readings).squaredNorm(), (1.0 + kSinglePrecision) * least);
    }
  }
}

TEST_F(TwoAmplitudes, StayInTheirRanges) {
  const double highest = 0.5 * kFriction.values.at("torque");
  const auto [best, least] = solved(highest);
  EXPECT_DOUBLE_EQ(best.values[0], highest);
  // More of the fall takes a part of what is lacking.
  EXPECT_GT(best.values[1] - best.values[0],
            kFriction.values.at("static_torque") - kFriction.values.at("torque"));
  EXPECT_LT(least, residuals().squaredNorm());
}

TEST(HubLawScan, IsNotMadeOfFrictionWhereTheHubSticks) {
  // Breakaway is above the root mean square of the lower torque.
  const Experiment experiment = with_hidden(
      {"stribeck_friction", {{"torque", 0.04}, {"static_torque", 0.06}, {"velocity", 0.1}}});
  EXPECT_FALSE(scanned(Problem(experiment), "stribeck_friction"));
}

TEST(HubLawScan, LeavesWhatIsNoHubTorque) {
  const Experiment experiment = simulated_experiment(
      {effects::named("sensor_delay", {{"delay", 0.006}}, "tip_acceleration")});
  const Problem problem(experiment);
  for (const auto* effect : {"stribeck_friction", "torque_ripple", "disturbance_torque"}) {
    const auto made = scanned(problem, effect);
    ASSERT_TRUE(made) << effect;
    EXPECT_LT(made->share, SelectionOptions().least_law_share) << effect;
  }
}

TEST(HubLawScan, IsOfLawsThatASimulationIterates) {
  const Experiment experiment = simulated_experiment({});
  const Problem problem(experiment);
  for (const auto* effect : {"coulomb_friction", "torque_bias", "flexural_rigidity"}) {
    EXPECT_FALSE(scanned(problem, effect)) << effect;
  }
}

TEST(HubLaws, AGridComparesAsTheResponseToItsTorque) {
  // Torques are kept in single precision.
  constexpr double kSinglePrecision = 1e-5;
  const Experiment experiment =
      with_hidden({"torque_ripple", {{"amplitude", 0.02}, {"cycles", 6.0}, {"phase", 1.1}}});
  const Problem problem(experiment);
  const auto all = problem.residuals(problem.as_filed(), problem.estimation_runs());
  ASSERT_TRUE(all);
  HubLaws& laws = problem.hub_laws();
  ASSERT_TRUE(laws.are_shown());
  const Eigen::VectorXd residuals = laws.residuals(*all);
  for (const auto* effect : {"torque_ripple", "hub_hysteresis", "stribeck_friction", "tilt"}) {
    const Hypothesis law = named(experiment, {effect}).front();
    const Candidate start = Candidate{}.with(law, law.middle());
    const HubLawGrid* grid = laws.grid(start, {30, 30, 30});
    ASSERT_NE(grid, nullptr) << effect;
    EXPECT_EQ(laws.grid(start, {30, 30, 30}), grid) << effect;
    double last = 0.0;
    for (const auto& [candidate, left] : grid->best(residuals, 3)) {
      const auto readings = laws.regression().readings(candidate);
      ASSERT_TRUE(readings) << effect;
      EXPECT_NEAR(left, (residuals - *readings).squaredNorm(),
                  kSinglePrecision * residuals.squaredNorm())
          << effect;
      EXPECT_GE(left, last) << effect;
      last = left;
    }
  }
}

TEST(HubLaws, AreMadeAnewWhereTheNoiseHasChanged) {
  const Experiment experiment = with_hidden(kFriction);
  const Problem problem(experiment);
  const Problem noisier =
      problem.with_more_noise(std::vector<double>(problem.observations().channels.size(), 0.1));
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(problem.residual_count());
  const auto size = [&](const Problem& of) {
    HubLaws& laws = of.hub_laws();
    return laws.regression().hub().adjoint(laws.residuals(ones)).norm();
  };
  EXPECT_LT(size(noisier), 0.1 * size(problem));
}

TEST(HubRegression, HasTheAdjointOfItsReadings) {
  constexpr double kRounding = 1e-9;  // convolutions of a thousand numbers by transforms
  const Experiment experiment = with_hidden(kFriction);
  const Problem problem(experiment);
  HubLaws& laws = problem.hub_laws();
  const HubRegression& hub = laws.regression().hub();
  std::mt19937 random(3);
  std::normal_distribution<double> number;
  HubTorques torques;
  std::vector<double> all;
  for (const HubMotion& motion : hub.motions()) {
    auto& of_motion = torques.emplace_back(motion.time_s.size());
    std::ranges::generate(of_motion, [&] { return number(random); });
    all.insert(all.end(), of_motion.begin(), of_motion.end());
  }
  const Eigen::VectorXd signals =
      Eigen::VectorXd::NullaryExpr(hub.residuals().size(), [&](auto) { return number(random); });
  const Eigen::VectorXd readings = hub.readings(torques);
  const Eigen::VectorXd adjoint = hub.adjoint(signals);
  ASSERT_EQ(adjoint.size(), std::ssize(all));
  EXPECT_NEAR(readings.dot(signals), Eigen::VectorXd::Map(all.data(), adjoint.size()).dot(adjoint),
              kRounding * readings.norm() * signals.norm());
}

TEST(HubRegression, TakesConstantAndSlopeOutOfRunsFromAnUnknownState) {
  constexpr double kRounding = 1e-12;  // sums of a thousand numbers
  const Experiment experiment = with_hidden(kFriction);
  const Problem problem(experiment);
  const Candidate none = problem.as_filed();
  const auto residuals = problem.residuals(none, problem.estimation_runs());
  ASSERT_TRUE(residuals);
  std::vector<HubMotion> motions = hub_motions({problem, *residuals, *residuals, none});
  HubTorques constant;
  for (const HubMotion& motion : motions) constant.emplace_back(motion.time_s.size(), 0.01);
  const Eigen::VectorXd from_rest = HubRegression(motions).readings(constant);
  for (HubMotion& motion : motions) motion.starts_free = true;
  const HubRegression hub(motions);
  const auto count = static_cast<Eigen::Index>(motions.front().time_s.size());
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(count, -1.0, 1.0);
  for (const Eigen::VectorXd& signals : {hub.readings(constant), hub.residuals()}) {
    const auto first = signals.head(count);
    EXPECT_GT(first.norm(), 0.0);
    EXPECT_LE(std::abs(first.mean()), kRounding * first.norm());
    EXPECT_LE(std::abs(time.dot(first)), kRounding * time.norm() * first.norm());
  }
  // What a constant torque makes of a free hub's velocity is such a line, but for vibration.
  EXPECT_GT(from_rest.head(count).norm(), 1.1 * hub.readings(constant).head(count).norm());
}

}  // namespace
}  // namespace flexarm::diagnose
