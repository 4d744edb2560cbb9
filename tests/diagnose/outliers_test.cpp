// Readings that are left out: nothing depends on what is in their places.
#include "diagnose/diagnosis.hpp"
#include "diagnose/predictors/noise_estimate.hpp"
#include "diagnose/search/fit.hpp"
#include "diagnose/search/parameter_errors.hpp"
#include "effects/registry/vocabulary.hpp"
#include "measured/checks/data_check.hpp"
#include "measured/spectra/robust.hpp"
#include "response/time/random_numbers.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <variant>
#include <vector>

namespace flexarm::diagnose {
namespace {

using Eigen::Index;

constexpr double kPart = 0.005;  ///< of the readings
constexpr double kTruth_kg = 0.004;

/// Least squares of 0.995 n readings differ from those of n by sqrt(1/0.995 - 1) = 0.07 standard
/// errors: three and a half of these.
constexpr double kShift = 0.25;
/// Beyond rounding a fit ends where its last step moves a place by 1e-7: far below standard errors.
constexpr double kSameFit = 1e-3;

measured::TimeRecord& record_of(measured::MeasuredRun& run) {
  return std::get<measured::TimeRecord>(run.data);
}

/// Leaves out this part of the readings by chance, and adds an error to the value in their place,
/// in deviations of the channel.
Experiment with_left_out(Experiment experiment, double part, double error) {
  response::RandomNumbers random(3);
  for (measured::MeasuredRun& run : experiment.runs) {
    for (measured::Channel& channel : record_of(run).channels) {
      const double unit = measured::standard_deviation(channel.values);
      for (std::size_t k = 0; k < channel.values.size(); ++k) {
        if (random.uniform() >= part) continue;
        channel.left_out.push_back(k);
        channel.values[k] += error * unit;
      }
    }
  }
  return experiment;
}

/// Single samples of 4 to 12 deviations of a channel, apart from each other, found and left out as
/// those of a file.
Experiment with_outliers(Experiment experiment, double part) {
  constexpr std::size_t kApart = 13;
  response::RandomNumbers random(4);
  for (measured::MeasuredRun& run : experiment.runs) {
    measured::TimeRecord& record = record_of(run);
    std::vector<double> units;
    for (const measured::Channel& channel : record.channels) {
      units.push_back(measured::standard_deviation(channel.values));
    }
    for (std::size_t k = 0; k < record.time_s.size(); ++k) {
      if (random.uniform() >= part * static_cast<double>(units.size())) continue;
      const auto at =
          static_cast<std::size_t>(random.uniform() * static_cast<double>(units.size()));
      const double sign = random.uniform() < 0.5 ? -1.0 : 1.0;
      record.channels[at].values[k] += sign * (4.0 + 8.0 * random.uniform()) * units[at];
      k += kApart;
    }
    for (const measured::DataFinding& finding : measured::check_data(record)) {
      measured::leave_out_spikes(record, finding);
    }
  }
  return experiment;
}

/// Of the first order, 3 % of the signal, correlated over 20 samples.
Experiment with_coloured_noise(Experiment experiment) {
  constexpr double kStay = 0.95;
  response::RandomNumbers random(5);
  for (measured::MeasuredRun& run : experiment.runs) {
    for (measured::Channel& channel : record_of(run).channels) {
      const double size = 0.03 * measured::standard_deviation(channel.values);
      double now = size * random.normal();
      for (double& value : channel.values) {
        value += now;
        now = kStay * now + std::sqrt(1.0 - kStay * kStay) * size * random.normal();
      }
    }
  }
  return experiment;
}

/// With errors of 100 deviations of the noise in the numbers that are left out.
Observations with_spikes(Observations observations) {
  for (const ObservedChannel& channel : observations.channels) {
    for (const std::size_t k : channel.left_out) {
      const Index at = channel.first + static_cast<Index>(k);
      observations.values(at) += 100.0 * observations.deviations(at);
    }
  }
  return observations;
}

/// A hidden payload, refitted.
struct Estimate {
  double mass_kg = 0.0;
  double std_error_kg = 0.0;
  Misfit left;
};

enum class Noise { white, coloured };

Estimate estimate(const Experiment& experiment, const Observations& observations, Noise noise) {
  Problem problem(experiment, observations);
  const Hypothesis payload = named(experiment, {"payload_mass"}).front();
  const Candidate truth = problem.as_filed().with(payload, {kTruth_kg});
  if (noise == Noise::coloured) problem = *problem.with_coloured_noise(truth);
  const Explanation found = explain(problem, fit(problem, truth));
  return {found.fit.candidate.values[0], standard_errors(problem, found, 0)[0], found.estimation};
}

class LeftOut : public testing::TestWithParam<Noise> {
 protected:
  static Experiment experiment() {
    const Experiment made = simulated_experiment(
        {effects::named("payload_mass", {{"mass", kTruth_kg}})}, {.duration_s = 2.0});
    return GetParam() == Noise::coloured ? with_coloured_noise(made) : made;
  }
  static Estimate of(const Experiment& experiment, const Observations& observations) {
    return estimate(experiment, observations, GetParam());
  }
};
INSTANTIATE_TEST_SUITE_P(, LeftOut, testing::Values(Noise::white, Noise::coloured),
                         [](const auto& one) {
                           return std::string(one.param == Noise::white ? "white" : "coloured");
                         });

TEST_P(LeftOut, SpikesChangeNothing) {
  const Experiment sound = experiment();
  const Experiment left_out = with_left_out(sound, kPart, 0.0);
  const Observations observed = observe(left_out);
  const Estimate of_all = of(sound, observe(sound));
  const Estimate without = of(left_out, observed);
  const Estimate with_spikes_there = of(left_out, with_spikes(observed));
  EXPECT_NEAR(with_spikes_there.mass_kg, without.mass_kg, kSameFit * without.std_error_kg);
  EXPECT_NEAR(with_spikes_there.std_error_kg, without.std_error_kg,
              kSameFit * without.std_error_kg);
  EXPECT_NEAR(with_spikes_there.left.sum_of_squares, without.left.sum_of_squares,
              kSameFit * without.left.sum_of_squares);
  EXPECT_NEAR(without.mass_kg, of_all.mass_kg, kShift * of_all.std_error_kg);
  // Standard errors are also those of 20 clusters, whose sizes are changed by a few readings.
  EXPECT_NEAR(without.std_error_kg, of_all.std_error_kg, 0.1 * of_all.std_error_kg);
  // As readings they are noise of 100 sqrt(0.005) = 7 times the white part of what there is.
  Observations kept = with_spikes(observed);
  for (ObservedChannel& channel : kept.channels) channel.left_out.clear();
  EXPECT_GT(of(left_out, kept).std_error_kg, 1.5 * of_all.std_error_kg);
}

TEST_P(LeftOut, AreCounted) {
  const Experiment left_out = with_left_out(experiment(), kPart, 0.0);
  const Observations observed = observe(left_out);
  const Problem problem(left_out);
  double count = 0.0;
  for (const ObservedChannel& channel : observed.channels) {
    EXPECT_EQ(channel.used() + std::ssize(channel.left_out), channel.count);
    if (problem.estimation_runs()[channel.run]) count += static_cast<double>(channel.used());
  }
  const Misfit left = of(left_out, observed).left;
  EXPECT_EQ(left.count, count);
  // Of n squares of normal numbers; four standard deviations, and the noise as it is estimated.
  EXPECT_NEAR(left.sum_of_squares / count, 1.0, 4.0 * std::sqrt(2.0 / count) + 0.05);
}

/// What the check puts in the place of a true acceleration may be off by a sixth of the channel.
TEST_P(LeftOut, GoodReadingsCostLessThanHalfAStandardError) {
  constexpr double kError = 0.16;
  const Experiment sound = experiment();
  const Experiment left_out = with_left_out(sound, kPart, kError);
  const Estimate of_all = of(sound, observe(sound));
  const Estimate without = of(left_out, observe(left_out));
  EXPECT_NEAR(without.mass_kg, of_all.mass_kg, 0.5 * of_all.std_error_kg);
  EXPECT_NEAR(without.std_error_kg, of_all.std_error_kg, 0.1 * of_all.std_error_kg);
  EXPECT_NEAR(without.left.relative_error, of_all.left.relative_error,
              0.02 * of_all.left.relative_error);
  EXPECT_NEAR(without.left.noise_floor, of_all.left.noise_floor, 0.1 * of_all.left.noise_floor);
}

TEST(Outliers, WithNothingHiddenAreAdequate) {
  const Experiment experiment = with_outliers(simulated_experiment({}), 0.002);
  const Diagnosis made =
      diagnose(experiment, named(experiment, {"coulomb_friction", "torque_gain", "hub_inertia"}));
  EXPECT_EQ(made.verdict, Verdict::adequate) << to_string(made.verdict);
  // The noise of 0.5 %, where the outliers would be 25 to 55 %.
  EXPECT_LT(made.estimation.before, 0.01);
}

/// 4 % of three standard deviations in one sensor: as readings they would be noise of 60 %.
TEST(Outliers, OfATwentyFifthOfTheReadingsAreLeftOut) {
  constexpr double kShare = 0.04;
  constexpr double kFound = 0.9;
  Experiment experiment = simulated_experiment({});
  measured::TimeRecord& record = record_of(experiment.runs.front());
  measured::Channel& angle = record.channels.front();
  const measured::TimeRecord sound = record;
  const double size = 3.0 * measured::standard_deviation(angle.values);
  response::RandomNumbers random(8);
  std::size_t planted = 0;
  for (double& value : angle.values) {
    if (random.uniform() >= kShare) continue;
    value += random.uniform() < 0.5 ? size : -size;
    ++planted;
  }
  for (const measured::DataFinding& finding : measured::check_data(record)) {
    measured::leave_out_spikes(record, finding);
  }
  EXPECT_GE(static_cast<double>(angle.left_out.size()), kFound * static_cast<double>(planted));
  for (const std::size_t k : angle.left_out) {
    EXPECT_NEAR(angle.values[k], sound.channels.front().values[k], 0.1 * size);
  }
}

TEST(Outliers, OfTheTorqueAreReplaced) {
  Experiment experiment = simulated_experiment({});
  measured::TimeRecord& record = record_of(experiment.runs.front());
  const measured::TimeRecord sound = record;
  const double unit = measured::standard_deviation(record.torque_N_m);
  record.torque_N_m[record.torque_N_m.size() / 2] += 8.0 * unit;
  std::size_t replaced = 0;
  for (const measured::DataFinding& finding : measured::check_data(record)) {
    if (finding.channel == "torque") replaced += measured::leave_out_spikes(record, finding);
  }
  EXPECT_EQ(replaced, 1U);
  const std::size_t k = record.torque_N_m.size() / 2;
  EXPECT_NEAR(record.torque_N_m[k], sound.torque_N_m[k], 0.5 * unit);
  EXPECT_EQ(record.channels, sound.channels);
}

TEST(Outliers, HideNoCause) {
  constexpr double kHidden_N_m = 0.02;
  const Experiment experiment = with_outliers(
      simulated_experiment({effects::named("coulomb_friction", {{"torque", kHidden_N_m}})}), 0.002);
  const Diagnosis made =
      diagnose(experiment, named(experiment, {"coulomb_friction", "torque_gain", "hub_inertia"}));
  EXPECT_EQ(made.verdict, Verdict::explained) << to_string(made.verdict);
  ASSERT_EQ(made.causes.size(), 1U);
  const auto& found = made.causes[0].parameters.front();
  // Three standard errors: one trial in 400 is beyond.
  EXPECT_NEAR(found.value, kHidden_N_m, 3.0 * found.std_error);
}

TEST(Outliers, FoundAmongGoodReadingsLeaveTheVerdictAdequate) {
  const Experiment experiment = with_left_out(simulated_experiment({}), kPart, 0.16);
  const Diagnosis made =
      diagnose(experiment, named(experiment, {"coulomb_friction", "torque_gain", "hub_inertia"}));
  EXPECT_EQ(made.verdict, Verdict::adequate) << to_string(made.verdict);
}

TEST(Outliers, AreMissingForAFilter) {
  constexpr double kDisturbance_N_m = 0.01;
  constexpr double kCorrelation_s = 0.05;
  Experiment experiment = simulated_experiment({}, {.duration_s = 2.0});
  response::RandomNumbers random(6);
  for (measured::MeasuredRun& run : experiment.runs) {
    const double kept = std::exp(-measured::sampling_period_s(record_of(run)) / kCorrelation_s);
    double torque_N_m = kDisturbance_N_m * random.normal();
    for (double& recorded : record_of(run).torque_N_m) {
      recorded -= torque_N_m;
      torque_N_m =
          kept * torque_N_m + kDisturbance_N_m * std::sqrt(1.0 - kept * kept) * random.normal();
    }
  }
  const Experiment left_out = with_left_out(experiment, 2.0 * kPart, 0.0);
  const NoiseModel noise{kDisturbance_N_m, kCorrelation_s};
  const Observations observed = observe(left_out);
  const Problem problem(left_out, observed, {.noise = noise});
  const Problem spiked(left_out, with_spikes(observed), {.noise = noise});
  const std::vector<bool> all(experiment.runs.size(), true);
  const auto runs = problem.predictor().innovations(trial_arm(), all, noise);
  const auto same = spiked.predictor().innovations(trial_arm(), all, noise);
  double squares = 0.0;
  double count = 0.0;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    EXPECT_EQ(runs[r].standardised, same[r].standardised);
    EXPECT_EQ(runs[r].log_determinant, same[r].log_determinant);
    EXPECT_EQ((runs[r].standardised.array() == 0.0).count(),
              runs[r].standardised.size() - runs[r].count);
    squares += runs[r].standardised.squaredNorm();
    count += static_cast<double>(runs[r].count);
  }
  const auto whole = Problem(experiment).predictor().innovations(trial_arm(), all, noise);
  double of_all = 0.0;
  double all_count = 0.0;
  for (const RunInnovations& run : whole) {
    of_all += run.standardised.squaredNorm();
    all_count += static_cast<double>(run.count);
  }
  // The covariance after a missing reading is that of complete samples: some five squares more.
  EXPECT_NEAR(squares / count, of_all / all_count, 0.1);
  const NoiseEstimate found =
      NoiseEstimator(left_out, observed, problem.predictor()).model(trial_arm(), all);
  // Of some 8 s, 160 correlation times: three standard errors are 20 and 45 %.
  EXPECT_NEAR(found.model.disturbance_N_m, kDisturbance_N_m, 0.2 * kDisturbance_N_m);
  EXPECT_NEAR(found.model.correlation_time_s, kCorrelation_s, 0.45 * kCorrelation_s);
  const auto residuals = spiked.residuals(spiked.as_filed(), all);
  ASSERT_TRUE(residuals.has_value());
  EXPECT_EQ(*residuals, *problem.residuals(problem.as_filed(), all));
}

}  // namespace
}  // namespace flexarm::diagnose
