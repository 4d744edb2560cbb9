#include "diagnose/search/fit.hpp"
#include "effects/registry/vocabulary.hpp"
#include "measured/files/frequency_record.hpp"
#include "response/time/random_numbers.hpp"
#include "tests/diagnose/simulated_experiments.hpp"
#include "tests/diagnose/start_on_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstddef>
#include <utility>
#include <variant>

namespace flexarm::diagnose {
namespace {

/// A frequency response of the hub angle, as `trial_arm` with `hidden` effects has it.
Experiment measured_response(const Candidate& hidden) {
  constexpr std::size_t kLines = 800;
  constexpr double kLowest_Hz = 0.5;
  constexpr double kHighest_Hz = 60.0;
  constexpr double kRelativeNoise = 0.005;
  Experiment experiment;
  experiment.arm = trial_arm();
  measured::FrequencyChannel channel{arm::parse_sensor("hub_angle"), {}, {}, {}};
  for (std::size_t k = 0; k < kLines; ++k) {
    channel.frequency_Hz.push_back(kLowest_Hz + (kHighest_Hz - kLowest_Hz) *
                                                    static_cast<double>(k) /
                                                    static_cast<double>(kLines - 1));
    channel.response.emplace_back(1.0, 0.0);
    channel.coherence.push_back(0.999);
  }
  measured::MeasuredRun run;
  run.run.id = "frf";
  run.run.kind = measured::RunKind::frf;
  run.run.purpose = measured::Purpose::estimation;
  run.data = measured::FrequencyRecord{{channel}};
  experiment.runs.push_back(run);
  // The measured response is that which a problem of this shape predicts, with noise.
  const Problem shape(experiment);
  const Eigen::VectorXd predicted =
      shape.predictor()(hidden.extend(experiment.arm), shape.estimation_runs());
  response::RandomNumbers numbers(1, 0);
  auto& response =
      std::get<measured::FrequencyRecord>(experiment.runs[0].data).channels[0].response;
  for (std::size_t k = 0; k < kLines; ++k) {
    const auto at = static_cast<Eigen::Index>(2 * k);
    const std::complex value(predicted(at), predicted(at + 1));
    const std::complex noise(numbers.normal(), numbers.normal());
    response[k] = value * (1.0 + kRelativeNoise * noise);
  }
  return experiment;
}

TEST(Problem, ResidualsOfResponsesAreTheErrorsToFirstOrder) {
  const Experiment experiment = measured_response({});
  const Problem problem(experiment);
  const Eigen::VectorXd residuals = *problem.residuals({}, problem.estimation_runs());
  const double squares = to_errors(problem.observations(), residuals).squaredNorm();
  // The second order of noise of 0.5 %, and as much again for what it adds up to.
  EXPECT_NEAR(residuals.squaredNorm(), squares, 0.01 * squares);
}

TEST(Problem, ErrorsOfResponsesAreKeptByTheirResiduals) {
  const Experiment experiment = measured_response({});
  Observations observations = observe(experiment);
  observations.deviations.head(40) *= 1e3;  // lines that are below their noise, too
  const auto count = observations.values.size();
  Eigen::VectorXd errors(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    errors(k) = std::pow(-1.0, k / 2) * std::pow(10.0, static_cast<double>(k % 7) - 3.0);
  }
  Eigen::VectorXd residuals = errors;
  to_residuals(observations, residuals);
  EXPECT_LT(residuals.norm(), 0.5 * errors.norm());
  const Eigen::VectorXd again = to_errors(observations, residuals);
  EXPECT_LT((again - errors).cwiseAbs().cwiseQuotient(errors.cwiseAbs()).maxCoeff(), 1e-9);
}

TEST(Problem, ResidualsOfResponsesAreLogarithmsFarBelowTheMeasuredOnes) {
  const Observations observations = observe(measured_response({}));
  const Eigen::VectorXd measured = observations.values.cwiseQuotient(observations.deviations);
  // 1e-12 is formed as a difference of 1 and itself: to 1e-4.
  for (const auto& [ratio, accuracy] :
       {std::pair{0.999, 1e-12}, std::pair{0.7, 1e-12}, std::pair{1e-12, 1e-4}}) {
    Eigen::VectorXd residuals = (1.0 - ratio) * measured;
    to_residuals(observations, residuals);
    for (Eigen::Index k = 0; k < measured.size(); k += 2) {
      const double size = measured.segment<2>(k).norm();
      ASSERT_GT(size, kResponseFloor);
      EXPECT_NEAR(residuals(k) / size, -std::log(ratio), accuracy);
      EXPECT_NEAR(residuals(k + 1) / size, 0.0, accuracy);
    }
  }
}

TEST(Problem, ResidualsOfResponsesShowAnEffectBesideAnotherThatIsOff) {
  // A hub spring makes a resonance that meets no line of the response until it is right.
  const Experiment bare = measured_response({});
  const auto spring = named(bare, {"hub_spring"}).front();
  const auto rigidity = named(bare, {"flexural_rigidity"}).front();
  const Experiment experiment =
      measured_response(Candidate{}.with(rigidity, {0.930}).with(spring, {0.93}));
  const Candidate start =
      Candidate{}.with(rigidity, {0.936}).with(spring, {spring.parameters[0].value(0.5)});
  const Problem problem(experiment);
  const Fit found = fit(problem, start_on_grid(problem, start, 40));
  EXPECT_NEAR(found.candidate.values[0], 0.930, 1e-4);
  EXPECT_NEAR(found.candidate.values[1], 0.93, 1e-3);
}

TEST(Problem, OfAnArmThatFrictionHoldsHasTheDataForResiduals) {
  Experiment experiment = simulated_experiment({}, {.duration_s = 1.0});
  effects::put(experiment.arm, "coulomb_friction", {{"torque", 100.0}});
  const Problem problem(experiment);
  const auto residuals = problem.residuals(problem.as_filed(), problem.validation_runs());
  ASSERT_TRUE(residuals);
  const Observations& observations = problem.observations();
  for (const ObservedChannel& channel : observations.channels) {
    if (!problem.validation_runs()[channel.run]) continue;
    for (Eigen::Index k = channel.first; k < channel.first + channel.count; ++k) {
      EXPECT_EQ((*residuals)(k), observations.values(k) / observations.deviations(k));
    }
  }
}

}  // namespace
}  // namespace flexarm::diagnose
