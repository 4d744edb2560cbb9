// The arm simulator as a Kalman filter.
#include "arm/input_error.hpp"
#include "response/excitation/excitation.hpp"
#include "response/formulation_maker.hpp"
#include "response/time/arm_simulator.hpp"
#include "response/time/random_numbers.hpp"
#include "response/time/time_model.hpp"
#include "tests/response/simulation_models.hpp"

#include <Eigen/Cholesky>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <vector>

namespace flexarm::response {
namespace {

using Eigen::Index;

constexpr int kFilteredModes = 3;
constexpr double kFilteredStep_s = 2e-3;
constexpr std::size_t kFilteredSamples = 4000;
constexpr double kCorrelation_s = 0.1;
constexpr double kDisturbance_N_m = 0.02;

class FilteredRunTest : public testing::Test {
 protected:
  FilteredRunTest() {
    arm_.damping.kelvin_voigt_s = 1.2e-4;
    arm_.hub.viscous_friction_N_m_s_per_rad = 2e-3;
    torque_ = sample(RandomNoise{.rms_N_m = 0.08, .from_Hz = 0.2, .to_Hz = 40.0, .seed = 4},
                     SampleGrid{kFilteredSamples, kFilteredStep_s})
                  .torque_N_m;
  }

  /// Sensors that are not as they should be; the hub angle is late by so many samples.
  void impair_sensors(double late_samples) {
    arm_.effects.insert(effects::named("sensor_gain", {{"factor", 1.3}}, "hub_angle"));
    arm_.effects.insert(effects::named("sensor_offset", {{"value", 0.2}}, "hub_velocity"));
    arm_.effects.insert(
        effects::named("sensor_delay", {{"delay", late_samples * kFilteredStep_s}}, "hub_angle"));
  }

  /// The simulator of the arm as it is now.
  void make() {
    parts_ = take_apart(arm_);
    parts_.disturbance = HubDisturbance{correlation_s_};
    simulator_ = std::make_unique<ArmSimulator>(
        time_model(make_formulation("exact_tf", parts_.linear, kFilteredModes), parts_,
                   kFilteredModes, sensors_),
        parts_, sensors_, options_of_fit(kFilteredStep_s, TorqueHold::zero));
  }

  FilterGains steady() const {
    return {{}, filter_gain(simulator_->sampled({kDisturbance_N_m}, deviations_))};
  }

  void expect_white_innovations();
  /// ... and of the stated covariance, once the filter is steady.
  void expect_white(const FilterGains& gains, const FilteredRun& run) const;
  void expect_stated_covariance_from_an_unknown_state();

  std::vector<arm::Sensor> sensors_ = {kHubAngle, kHubVelocity};
  Eigen::VectorXd deviations_ = Eigen::Vector2d(1e-3, 1e-2);
  double correlation_s_ = kCorrelation_s;
  arm::Arm arm_ = arm::paper_arm();
  ArmParts parts_;
  std::vector<double> torque_;
  std::unique_ptr<ArmSimulator> simulator_;
};

TEST_F(FilteredRunTest, WhatTheArmItselfShowsLeavesNoInnovation) {
  for (const bool has_friction : {false, true}) {
    if (has_friction) arm_.effects = {effects::named("coulomb_friction", {{"torque", 0.02}})};
    make();
    const FilterGains gains = steady();
    const Eigen::MatrixXd shown = simulator_->readings(torque_);
    const FilteredRun run = simulator_->filtered(torque_, shown, gains);
    // Rounding of each sample's readings, which the filter feeds back.
    constexpr double kRounding = 1e-11;
    EXPECT_LE(run.innovations.cwiseAbs().maxCoeff(), kRounding * shown.cwiseAbs().maxCoeff())
        << has_friction;
  }
}

TEST_F(FilteredRunTest, WhatSensorsAsTheyAreShowLeavesNoInnovation) {
  for (const double late_samples : {0.3, 1.0, 2.4, 3.0, 59.5}) {
    arm_.effects = {effects::named("coulomb_friction", {{"torque", 0.02}})};
    impair_sensors(late_samples);
    make();
    const FilterGains gains = steady();
    const Eigen::MatrixXd shown = simulator_->readings(torque_);
    const FilteredRun run = simulator_->filtered(torque_, shown, gains);
    constexpr double kRounding = 1e-11;
    EXPECT_LE(run.innovations.cwiseAbs().maxCoeff(), kRounding * shown.cwiseAbs().maxCoeff())
        << late_samples;
  }
}

TEST_F(FilteredRunTest, RefusesSensorsThatAreTooLate) {
  impair_sensors(60.5);
  make();
  try {
    steady();
    ADD_FAILURE() << "a filter with 61 pending readings";
  } catch (const arm::InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("delayed by 61 samples in all; at most 60"));
  }
}

/// A disturbance of known statistics that is recorded nowhere, and noise of known deviation.
void FilteredRunTest::expect_white_innovations() {
  make();
  RandomNumbers random(7);
  const double kept = std::exp(-kFilteredStep_s / kCorrelation_s);
  std::vector<double> disturbance = {kDisturbance_N_m * random.normal()};
  std::vector<double> acting = torque_;
  for (std::size_t k = 0; k < kFilteredSamples; ++k) {
    // Its mean over the sample, in which the model lets it decay.
    acting[k] += disturbance[k] * (1.0 - kept) * kCorrelation_s / kFilteredStep_s;
    disturbance.push_back(kept * disturbance[k] +
                          kDisturbance_N_m * std::sqrt(1.0 - kept * kept) * random.normal());
  }
  Eigen::MatrixXd measured = simulator_->readings(acting);
  for (Index j = 0; j < measured.cols(); ++j) {
    for (double& value : measured.col(j)) value += deviations_(j) * random.normal();
  }
  const FilterGains gains = steady();
  const FilteredRun run = simulator_->filtered(torque_, measured, gains);
  expect_white(gains, run);
  // The estimate follows the disturbance.
  double error = 0.0;
  for (std::size_t k = 500; k < kFilteredSamples; ++k) {
    error += std::pow(run.disturbance_N_m[k] - disturbance[k], 2);
  }
  EXPECT_LE(std::sqrt(error / (kFilteredSamples - 500.0)), 0.7 * kDisturbance_N_m);
}

void FilteredRunTest::expect_white(const FilterGains& gains, const FilteredRun& run) const {
  const Eigen::LLT<Eigen::MatrixXd> covariance(gains.steady.innovation_covariance);
  // Behind the first second, in which the filter finds the disturbance.
  const Eigen::MatrixXd settled = run.innovations.bottomRows(3500).transpose();
  const Eigen::MatrixXd standard = covariance.matrixL().solve(settled);
  const auto n = static_cast<double>(standard.size());
  // 3.5 standard deviations of chi^2/n and of an autocorrelation.
  EXPECT_NEAR(standard.squaredNorm() / n, 1.0, 3.5 * std::sqrt(2.0 / n));
  for (Index j = 0; j < standard.rows(); ++j) {
    const Eigen::VectorXd u = standard.row(j);
    const Index last = u.size() - 1;
    EXPECT_LE(std::abs(u.head(last).dot(u.tail(last)) / u.squaredNorm()),
              3.5 / std::sqrt(static_cast<double>(u.size())))
        << j;
  }
}

TEST_F(FilteredRunTest, InnovationsOfTheRightModelAreWhiteAndOfTheStatedCovariance) {
  expect_white_innovations();
}

TEST_F(FilteredRunTest, SoAreThoseOfSensorsAsTheyAre) {
  for (const double late_samples : {3.0, 6.4}) {
    arm_.effects.clear();
    impair_sensors(late_samples);
    expect_white_innovations();
  }
}

/// The error of a recorded torque acts for a sample, at once on a tip that moves with the hub.
TEST_F(FilteredRunTest, InnovationsAreOfTheStatedCovarianceWhereTheTorqueIsRecordedWithNoise) {
  sensors_ = {kHubAngle, kHubVelocity, {arm::SensorKind::tip_acceleration}};
  deviations_ = Eigen::Vector3d(1e-3, 1e-2, 0.3);
  correlation_s_ = 0.0;
  make();
  RandomNumbers random(13);
  Eigen::MatrixXd measured = simulator_->readings(torque_);
  for (Index j = 0; j < measured.cols(); ++j) {
    for (double& value : measured.col(j)) value += deviations_(j) * random.normal();
  }
  std::vector<double> recorded = torque_;
  for (double& torque_N_m : recorded) torque_N_m += kDisturbance_N_m * random.normal();
  const FilterGains gains = steady();
  const FilteredRun run = simulator_->filtered(recorded, measured, gains);
  expect_white(gains, run);
}

/// Two samples ahead of one the error of its torque has acted, for one of them.
TEST_F(FilteredRunTest, AWhiteDisturbanceIsForgottenInPredictionsAhead) {
  correlation_s_ = 0.0;
  make();
  const FilterGains gains = steady();
  const Eigen::MatrixXd shown = simulator_->readings(torque_);
  const ErrorsAhead ahead = simulator_->errors_ahead(torque_, shown, gains, {50, {1, 20}});
  constexpr double kRounding = 1e-10;
  for (const auto& of_horizon : ahead) {
    for (const Eigen::VectorXd& error : of_horizon) {
      EXPECT_LE(error.cwiseAbs().maxCoeff(), kRounding * shown.cwiseAbs().maxCoeff());
    }
  }
}

/// A state that nobody knows, with a prior as wide: all samples are as likely as stated.
void FilteredRunTest::expect_stated_covariance_from_an_unknown_state() {
  make();
  RandomNumbers random(11);
  const std::size_t samples = 400;
  const std::vector<double> torque(torque_.begin(), torque_.begin() + samples);
  const double spread = 0.3;
  const SampledSystem sampled = simulator_->sampled({1e-6}, deviations_);
  Eigen::MatrixXd prior =
      Eigen::MatrixXd::Zero(sampled.transition.rows(), sampled.transition.cols());
  prior.diagonal().head(simulator_->states()).setConstant(spread * spread);
  for (auto step = simulator_->lead(samples); step > 0; --step) {
    prior = covariance_after_step(sampled, prior);
  }
  const FilterGains gains = filter_gains_from(sampled, prior, samples);
  double squares = 0.0;
  double count = 0.0;
  for (int repeat = 0; repeat < 40; ++repeat) {
    Eigen::VectorXd state(simulator_->states());
    for (double& value : state) value = spread * random.normal();
    Eigen::MatrixXd measured = simulator_->readings(torque, state);
    for (Index j = 0; j < measured.cols(); ++j) {
      for (double& value : measured.col(j)) value += deviations_(j) * random.normal();
    }
    const FilteredRun run = simulator_->filtered(torque, measured, gains);
    for (Index k = 0; k < 20; ++k) {
      const auto& covariance = gains.at(static_cast<std::size_t>(k)).innovation_covariance;
      const Eigen::VectorXd e = run.innovations.row(k);
      squares += e.dot(covariance.llt().solve(e));
      count += static_cast<double>(e.size());
    }
  }
  EXPECT_NEAR(squares / count, 1.0, 3.5 * std::sqrt(2.0 / count));
}

TEST_F(FilteredRunTest, FromAnUnknownStateTheFirstInnovationsAreOfTheirStatedCovariance) {
  expect_stated_covariance_from_an_unknown_state();
}

TEST_F(FilteredRunTest, SoAreTheFirstOfSensorsAsTheyAre) {
  impair_sensors(4.6);
  expect_stated_covariance_from_an_unknown_state();
}

/// A run without missing readings is filtered in blocks of samples; where the last reading is
/// missing from sample to sample.
TEST_F(FilteredRunTest, IsTheSameInBlocksAsFromSampleToSample) {
  constexpr double kRounding = 1e-9;  // of noise and signals of the order of 1e-3 to 1
  arm_.effects.insert(effects::named("sensor_gain", {{"factor", 1.3}}, "hub_angle"));
  arm_.effects.insert(effects::named("sensor_offset", {{"value", 0.2}}, "hub_velocity"));
  arm_.effects.insert(effects::named("sensor_lag", {{"time_constant", 3e-3}}, "hub_velocity"));
  arm_.effects.insert(effects::named("actuator_lag", {{"time_constant", 4e-3}}));
  arm_.effects.insert(effects::named("time_delay", {{"delay", 1.3 * kFilteredStep_s}}));
  arm_.effects.insert(effects::named("torque_bias", {{"torque", 5e-3}}));
  torque_.resize(kFilteredSamples - 3);
  RandomNumbers random(6);
  for (const double correlation_s : {kCorrelation_s, 0.0}) {
    correlation_s_ = correlation_s;
    make();
    Eigen::MatrixXd measured = simulator_->readings(torque_);
    for (Index j = 0; j < measured.cols(); ++j) {
      for (double& value : measured.col(j)) value += deviations_(j) * random.normal();
    }
    const auto system = simulator_->sampled({kDisturbance_N_m}, deviations_);
    const Eigen::MatrixXd unknown =
        Eigen::MatrixXd::Identity(simulator_->states(), simulator_->states());
    const FilterGains from_unknown = filter_gains_from(system, unknown, torque_.size());
    ASSERT_FALSE(from_unknown.first.empty());
    for (const FilterGains& gains : {steady(), from_unknown}) {
      const FilteredRun in_blocks = simulator_->filtered(torque_, measured, gains);
      Eigen::MatrixXd without_last = measured;
      without_last.bottomRows(1).setConstant(std::numeric_limits<double>::quiet_NaN());
      const FilteredRun stepped = simulator_->filtered(torque_, without_last, gains);
      const Index others = measured.rows() - 1;
      EXPECT_LE((in_blocks.innovations - stepped.innovations).topRows(others).cwiseAbs().maxCoeff(),
                kRounding);
      for (std::size_t k = 0; k < static_cast<std::size_t>(others); ++k) {
        ASSERT_NEAR(in_blocks.disturbance_N_m[k], stepped.disturbance_N_m[k], kRounding) << k;
        ASSERT_NEAR(in_blocks.hub_velocity_rad_per_s[k], stepped.hub_velocity_rad_per_s[k],
                    kRounding)
            << k;
      }
    }
  }
}

TEST_F(FilteredRunTest, AMissingReadingHasNoInnovationAndMovesNothing) {
  make();
  const FilterGains gains = steady();
  Eigen::MatrixXd measured = simulator_->readings(torque_);
  measured.col(0).segment(100, 200).setConstant(std::numeric_limits<double>::quiet_NaN());
  const FilteredRun run = simulator_->filtered(torque_, measured, gains);
  EXPECT_TRUE(run.innovations.col(0).segment(100, 200).isZero());
  EXPECT_LE(run.innovations.cwiseAbs().maxCoeff(), 1e-11);
}

/// Like one whose innovation is what those of the other sensors let expect, which does not move the
/// state beyond these.
TEST_F(FilteredRunTest, BesideAMissingReadingTheOthersMoveTheState) {
  make();
  const FilterGains gains = steady();
  constexpr Index kSample = 100;
  RandomNumbers random(5);
  Eigen::MatrixXd measured = simulator_->readings(torque_);
  for (double& value : measured.reshaped()) value += 1e-3 * random.normal();
  const Eigen::VectorXd innovation =
      simulator_->filtered(torque_, measured, gains).innovations.row(kSample).transpose();
  const Index others = innovation.size() - 1;
  ASSERT_GT(others, 0);
  const Eigen::MatrixXd covariance = gains.at(kSample).innovation_covariance;
  const Eigen::MatrixXd own = covariance.bottomRightCorner(others, others);
  const double expected =
      covariance.row(0).tail(others).dot(own.llt().solve(innovation.tail(others)));
  Eigen::MatrixXd as_expected = measured;
  as_expected(kSample, 0) += expected - innovation(0);
  measured(kSample, 0) = std::numeric_limits<double>::quiet_NaN();
  FilteredRun run = simulator_->filtered(torque_, measured, gains);
  EXPECT_EQ(run.innovations(kSample, 0), 0.0);
  run.innovations(kSample, 0) = expected;
  const FilteredRun same = simulator_->filtered(torque_, as_expected, gains);
  EXPECT_LE((run.innovations - same.innovations).cwiseAbs().maxCoeff(), 1e-12);
}

/// A filter that no reading corrects after a sample goes on freely from there: its innovations are
/// the errors of predictions from that sample.
TEST_F(FilteredRunTest, ErrorsAheadAreThoseOfAFilterWhoseGainEnds) {
  const StartsAhead starts{.stride = 370, .horizons = {1, 10, 100}};
  const std::size_t samples = 1100;
  const std::vector<double> torque(torque_.begin(), torque_.begin() + samples);
  for (const double late_samples : {0.0, 0.3, 6.4}) {
    arm_.effects = {effects::named("coulomb_friction", {{"torque", 0.02}})};
    if (late_samples > 0.0) impair_sensors(late_samples);
    make();
    const FilterGain filter = steady().steady;
    const FilterGain ended{Eigen::MatrixXd::Zero(filter.gain.rows(), filter.gain.cols()),
                           filter.innovation_covariance};
    RandomNumbers random(5);
    Eigen::MatrixXd measured = simulator_->readings(torque);
    for (double& value : measured.reshaped()) value += 1e-2 * random.normal();
    const ErrorsAhead errors = simulator_->errors_ahead(torque, measured, {{}, filter}, starts);
    ASSERT_EQ(errors.size(), starts.horizons.size());
    for (std::size_t h = 0; h < errors.size(); ++h) {
      ASSERT_EQ(errors[h].size(), 3U);  // at 0, 370 and 740, but not at 1110
      for (std::size_t i = 0; i < errors[h].size(); ++i) {
        const auto start = static_cast<Index>(i) * starts.stride;
        const FilterGains gains{
            std::vector<FilterGain>(static_cast<std::size_t>(start) + 1, filter), ended};
        const FilteredRun run = simulator_->filtered(torque, measured, gains);
        const Eigen::VectorXd expected =
            run.innovations.row(start + starts.horizons[h]).transpose();
        EXPECT_LE((errors[h][i] - expected).norm(), 1e-12 * measured.cwiseAbs().maxCoeff())
            << late_samples << " " << h << " " << i;
      }
    }
  }
}

/// Friction that is above all torques holds the hub, whatever the noise of the readings.
TEST_F(FilteredRunTest, AHubThatFrictionHoldsStaysHeld) {
  arm_.effects = {effects::named("coulomb_friction", {{"torque", 10.0}})};
  make();
  RandomNumbers random(3);
  Eigen::MatrixXd measured(static_cast<Index>(kFilteredSamples), 2);
  for (double& value : measured.reshaped()) value = 1e-3 * random.normal();
  const FilterGains gains = steady();
  const FilteredRun run = simulator_->filtered(torque_, measured, gains);
  for (const double velocity : run.hub_velocity_rad_per_s) EXPECT_EQ(velocity, 0.0);
}

}  // namespace
}  // namespace flexarm::response
