#include "diagnose/search/fit.hpp"

#include "arm/input_error.hpp"
#include "diagnose/diagnosis.hpp"
#include "diagnose/diagnosis_request.hpp"
#include "diagnose/search/hypothesis.hpp"
#include "effects/registry/vocabulary.hpp"
#include "tests/diagnose/closed_loop_axis.hpp"
#include "tests/diagnose/simulated_experiments.hpp"
#include "tests/diagnose/start_on_grid.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <string_view>
#include <thread>

namespace flexarm::diagnose {
namespace {

TEST(Fit, OfTheTrueEffectLeavesTheNoiseAndFindsItsValue) {
  const Experiment experiment =
      simulated_experiment({effects::named("root_compliance", {{"stiffness", 60.0}})});
  const Problem problem(experiment);
  const auto hypothesis = named(experiment, {"root_compliance"}).front();
  const Candidate start = Candidate{}.with(hypothesis, {hypothesis.parameters[0].value(0.5)});
  const Fit found = fit(problem, start_on_grid(problem, start, 40));
  EXPECT_TRUE(found.converged);
  // Sixteen standard errors would be 1e-3.
  EXPECT_NEAR(found.candidate.values[0], 60.0, 60.0 * 1e-3);
  const Misfit left =
      misfit(problem.observations(), experiment, found.residuals, problem.estimation_runs());
  EXPECT_TRUE(left.is_noise()) << left.sum_of_squares / left.count;
}

TEST(Fit, WithoutEffectsIsTheArmItself) {
  const Experiment experiment = simulated_experiment({});
  const Problem problem(experiment);
  const Fit nothing = fit(problem, {});
  EXPECT_EQ(nothing.jacobian.cols(), 0);
  const Misfit left =
      misfit(problem.observations(), experiment, nothing.residuals, problem.estimation_runs());
  EXPECT_TRUE(left.is_noise()) << left.sum_of_squares / left.count;
}

TEST(Diagnose, OfDataWithNothingHiddenIsAdequate) {
  const Experiment experiment = simulated_experiment({});
  const Diagnosis made = diagnose(experiment, hypotheses(experiment));
  EXPECT_EQ(made.verdict, Verdict::adequate);
  EXPECT_TRUE(made.causes.empty());
  EXPECT_EQ(made.extended_arm, experiment.arm);
}

TEST(Diagnose, NamesACauseAmongItsLikes) {
  const Experiment experiment =
      simulated_experiment({effects::named("time_delay", {{"delay", 0.004}})});
  const Diagnosis made = diagnose(
      experiment, named(experiment, {"time_delay", "actuator_lag", "hub_inertia", "sensor_lag"}));
  EXPECT_EQ(made.verdict, Verdict::explained);
  ASSERT_EQ(made.causes.size(), 1U);
  EXPECT_EQ(made.causes[0].effect, "time_delay");
  EXPECT_NEAR(made.causes[0].parameters[0].value, 0.004, 4e-5);
  EXPECT_TRUE(made.causes[0].confusable_with.empty());
  ASSERT_TRUE(made.validation);
  EXPECT_LE(made.validation->after, 1.1 * made.validation->noise_floor);
}

TEST(Diagnose, SaysThatItCannotExplainWhatItMayNotName) {
  const Experiment experiment =
      simulated_experiment({effects::named("coulomb_friction", {{"torque", 0.012}})});
  const Diagnosis made =
      diagnose(experiment, named(experiment, {"time_delay", "payload_inertia", "torque_bias"}));
  EXPECT_EQ(made.verdict, Verdict::unexplained);
  EXPECT_TRUE(made.causes.empty());
}

TEST(Diagnose, CanBeCancelled) {
  const Experiment experiment =
      simulated_experiment({effects::named("coulomb_friction", {{"torque", 0.012}})});
  const Diagnosis made = diagnose(experiment, named(experiment, {"time_delay", "torque_bias"}), {},
                                  [](std::string_view, double) { return false; });
  EXPECT_TRUE(made.cancelled);
}

TEST(Diagnose, EndsAtTheNextEvaluationWhenCancelled) {
  const Experiment experiment =
      simulated_experiment({effects::named("coulomb_friction", {{"torque", 0.012}})});
  constexpr int kCancelledAt = 20;  // of more than forty
  // Each thread may be told once more.
  const int most_asked = kCancelledAt + static_cast<int>(std::thread::hardware_concurrency());
  int asked = 0;
  const Diagnosis made =
      diagnose(experiment, named(experiment, {"time_delay", "coulomb_friction"}), {},
               [&](std::string_view, double) { return ++asked < kCancelledAt; });
  EXPECT_TRUE(made.cancelled);
  EXPECT_GE(asked, kCancelledAt);
  EXPECT_LE(asked, most_asked);
}

TEST(Diagnose, NamesNothingWhereTheDeadlineIsOverAtOnce) {
  const Experiment experiment =
      simulated_experiment({effects::named("coulomb_friction", {{"torque", 0.012}})});
  const auto hypotheses = named(experiment, {"coulomb_friction", "time_delay", "torque_bias"});
  SelectionOptions options;
  options.deadline = std::chrono::steady_clock::now();
  const Diagnosis none = diagnose(experiment, hypotheses, options);
  EXPECT_FALSE(none.cancelled);
  ASSERT_TRUE(none.search_end);
  EXPECT_EQ(none.verdict, Verdict::unexplained);
  EXPECT_TRUE(none.causes.empty());
  EXPECT_TRUE(none.next_experiments.empty());
}

TEST(Diagnose, SaysNothingWhereNotEvenTheArmAsFiledWasSimulated) {
  const Experiment experiment =
      simulated_experiment({effects::named("coulomb_friction", {{"torque", 0.012}})});
  SelectionOptions options;
  options.deadline = options.last = std::chrono::steady_clock::now();
  EXPECT_THROW(diagnose(experiment, named(experiment, {"time_delay"}), options), Cancelled);
  DiagnosisRequest request;
  request.time_limit_s = 3.0;
  try {
    diagnose(experiment, request, *options.deadline - 2 * kReportTime);
    ADD_FAILURE() << "there is no time for a diagnosis";
  } catch (const arm::InputError& error) {
    EXPECT_STREQ(error.what(),
                 "--time-limit = 3 s: the arm as filed could not be simulated within the limit; "
                 "raise it");
  }
}

TEST(ReportedWork, IsOutOfTimeWhereItsProgressDidNotCancelIt) {
  const Deadline past = std::chrono::steady_clock::now();
  const ReportedWork late({}, past);
  EXPECT_THROW(late.go_on(), Cancelled);
  EXPECT_TRUE(late.is_out_of_time());
  const ReportedWork cancelled([](std::string_view, double) { return false; }, past);
  EXPECT_THROW(cancelled.go_on(), Cancelled);
  EXPECT_FALSE(cancelled.is_out_of_time());
  // An evaluation that has the same deadline may notice it first.
  const ReportedWork unasked({}, past);
  EXPECT_TRUE(unasked.is_out_of_time());
}

TEST(Diagnose, EndsWithTheBestSoFarAtTheDeadline) {
  using Clock = std::chrono::steady_clock;
  const Experiment experiment =
      simulated_experiment({effects::named("coulomb_friction", {{"torque", 0.012}}),
                            effects::named("time_delay", {{"delay", 0.001}})});
  const auto hypotheses = named(experiment, {"coulomb_friction", "time_delay", "torque_bias"});
  constexpr std::string_view kAllData = "effects on all data";
  // How long it takes to all data; then, at these, the rest of a longer time is slept through.
  const auto begun = Clock::now();
  Clock::duration to_all_data{};
  diagnose(experiment, hypotheses, {}, [&](std::string_view what, double) {
    if (what == kAllData) to_all_data = Clock::now() - begun;
    return what != kAllData;
  });
  ASSERT_GT(to_all_data.count(), 0);
  SelectionOptions options;
  options.deadline = Clock::now() + 3 * to_all_data + std::chrono::seconds(1);
  options.predictor = PredictorKind::output_error;  // which else has half of the time
  const Diagnosis made =
      diagnose(experiment, hypotheses, options, [&](std::string_view what, double) {
        if (what == kAllData) std::this_thread::sleep_until(*options.deadline);
        return true;
      });
  EXPECT_FALSE(made.cancelled);
  ASSERT_TRUE(made.search_end);
  EXPECT_EQ(made.search_end->stage, "search");
  EXPECT_FALSE(made.search_end->untried.empty());
  ASSERT_FALSE(made.causes.empty());
  EXPECT_EQ(made.causes.front().effect, "coulomb_friction");
  EXPECT_EQ(made.verdict, Verdict::partly_explained);
}

TEST(Fit, EndsWhereItsWorkIsCancelled) {
  const Experiment experiment =
      simulated_experiment({effects::named("coulomb_friction", {{"torque", 0.012}})});
  const Problem problem(experiment);
  const auto hypothesis = named(experiment, {"coulomb_friction"}).front();
  const Candidate start = problem.as_filed().with(hypothesis, hypothesis.middle());
  const DiagnosisProgress cancel = [](std::string_view, double) { return false; };
  const ReportedWork work(cancel);
  EXPECT_THROW(fit(problem, start, {.work = &work}), Cancelled);
}

}  // namespace
}  // namespace flexarm::diagnose
