// sensor_gain, sensor_offset and sensor_delay: what they make of readings, and that the sensor is
// found on which they act.
#include "diagnose/search/fit.hpp"
#include "effects/registry/vocabulary.hpp"
#include "laws/effect_arms.hpp"
#include "measured/files/arm_file.hpp"
#include "response/formulation_maker.hpp"
#include "response/frequency/frequency_response.hpp"
#include "response/time/arm_simulator.hpp"
#include "response/time/time_model.hpp"
#include "tests/diagnose/start_on_grid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <map>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

namespace flexarm::effects {
namespace {

constexpr int kSensorModes = 3;
constexpr double kStep_s = 2e-3;

const std::vector<std::string>& sensor_names() {
  static const std::vector<std::string> names = {"hub_angle", "tip_acceleration", "strain@0.05"};
  return names;
}

std::vector<arm::Sensor> read_sensors() {
  std::vector<arm::Sensor> all;
  for (const std::string& name : sensor_names()) all.push_back(arm::parse_sensor(name));
  return all;
}

arm::Arm arm_with(const std::string& effect, const std::map<std::string, double>& parameters,
                  const std::string& sensor) {
  arm::Arm arm = laws::damped_arm();
  put(arm, effect, parameters, sensor);
  return arm;
}

/// A row a sample, a column a sensor.
Eigen::MatrixXd readings_of(const arm::Arm& arm, double step_s, const std::vector<double>& torque) {
  const auto parts = response::take_apart(arm);
  const auto model =
      response::time_model(response::make_formulation("exact_tf", parts.linear, kSensorModes),
                           parts, kSensorModes, read_sensors());
  return response::ArmSimulator(model, parts, read_sensors(),
                                response::options_of_fit(step_s, response::TorqueHold::zero))
      .readings(torque);
}

std::vector<double> half_waves(std::size_t samples, std::size_t half_period) {
  std::vector<double> torque;
  for (std::size_t k = 0; k < samples; ++k) {
    torque.push_back((k / half_period) % 2 == 0 ? 0.15 : -0.12);
  }
  return torque;
}

/// Of a thousand steps of readings between 1e-4 (strain) and 10 (acceleration).
constexpr double kReadingRounding = 1e-11;

TEST(SensorGain, MultipliesTheReadingsOfItsSensor) {
  const auto torque = half_waves(400, 60);
  const Eigen::MatrixXd plain = readings_of(laws::damped_arm(), kStep_s, torque);
  Eigen::MatrixXd expected = plain;
  expected.col(2) *= -1.3;
  const Eigen::MatrixXd made =
      readings_of(arm_with("sensor_gain", {{"factor", -1.3}}, "strain@0.05"), kStep_s, torque);
  EXPECT_LE((made - expected).norm(), kReadingRounding * plain.norm());
  EXPECT_LE((made.col(2) - expected.col(2)).norm(), kReadingRounding * plain.col(2).norm());
}

TEST(SensorOffset, AddsToTheReadingsOfItsSensor) {
  const auto torque = half_waves(400, 60);
  Eigen::MatrixXd expected = readings_of(laws::damped_arm(), kStep_s, torque);
  expected.col(0).array() += 0.25;
  const Eigen::MatrixXd made =
      readings_of(arm_with("sensor_offset", {{"value", 0.25}}, "hub_angle"), kStep_s, torque);
  EXPECT_LE((made - expected).norm(), kReadingRounding * expected.norm());
}

/// The readings of an arm sampled five times as densely are known at the delayed instants.
TEST(SensorDelay, ReadsTheArmAtTheDelayedInstants) {
  constexpr Eigen::Index kDenser = 5;
  constexpr Eigen::Index kLate = 17;  // dense samples
  const auto dense =
      readings_of(laws::damped_arm(), kStep_s / kDenser, half_waves(400 * kDenser, 300));
  const Eigen::MatrixXd made = readings_of(
      arm_with("sensor_delay", {{"delay", kLate * kStep_s / kDenser}}, "tip_acceleration"), kStep_s,
      half_waves(400, 60));
  const double size = dense.col(1).norm();
  for (Eigen::Index k = 0; k < made.rows(); ++k) {
    const Eigen::Index at = k * kDenser - kLate;
    ASSERT_NEAR(made(k, 1), at < 0 ? 0.0 : dense(at, 1), kReadingRounding * size) << k;
    ASSERT_NEAR(made(k, 0), dense(k * kDenser, 0), kReadingRounding * dense.col(0).norm()) << k;
  }
}

TEST(SensorEffects, ActOnFrequencyResponsesByTheirFactor) {
  const std::vector<double> frequencies = {0.7, 9.0, 33.0};
  const auto responses = [&](const arm::Arm& arm) {
    const auto parts = response::take_apart(arm);
    return response::frequency_response(response::make_formulation("exact_tf", parts.linear, 1),
                                        response::linear_chain(parts), read_sensors(), frequencies)
        .values;
  };
  const auto plain = responses(laws::damped_arm());
  const auto gain = responses(arm_with("sensor_gain", {{"factor", 0.7}}, "hub_angle"));
  const auto late = responses(arm_with("sensor_delay", {{"delay", 0.011}}, "hub_angle"));
  EXPECT_EQ(responses(arm_with("sensor_offset", {{"value", 0.1}}, "hub_angle")), plain);
  for (std::size_t i = 0; i < frequencies.size(); ++i) {
    const double turned = -2.0 * std::numbers::pi * frequencies[i] * 0.011;
    EXPECT_LT(std::abs(gain[0][i] / plain[0][i] - 0.7), 1e-14);
    EXPECT_LT(std::abs(late[0][i] / plain[0][i] - std::polar(1.0, turned)), 1e-14);
    EXPECT_EQ(gain[1][i], plain[1][i]);
    EXPECT_EQ(late[2][i], plain[2][i]);
  }
}

diagnose::Experiment read_on(const arm::Arm& truth) {
  measured::TimeRecord record;
  record.torque_N_m = half_waves(300, 45);
  const Eigen::MatrixXd readings = readings_of(truth, kStep_s, record.torque_N_m);
  for (Eigen::Index k = 0; k < readings.rows(); ++k) {
    record.time_s.push_back(kStep_s * static_cast<double>(k));
  }
  for (std::size_t j = 0; j < read_sensors().size(); ++j) {
    const auto column = readings.col(static_cast<Eigen::Index>(j));
    record.channels.push_back({read_sensors()[j], {column.begin(), column.end()}});
  }
  measured::Run run;
  run.id = "square";
  run.purpose = measured::Purpose::estimation;
  diagnose::Experiment experiment;
  experiment.arm = laws::damped_arm();
  experiment.runs.push_back({run, std::move(record)});
  return experiment;
}

struct HiddenCase {
  std::string effect;
  std::string parameter;
  double value;
  std::string sensor;
};

void PrintTo(const HiddenCase& hidden, std::ostream* out) {
  *out << hidden.effect << " on " << hidden.sensor;
}

class SensorEffect : public testing::TestWithParam<HiddenCase> {};

/// Of all effects of a sensor on all sensors the one that is there fits best, with its size.
TEST_P(SensorEffect, IsFoundOnTheSensorThatItActsOn) {
  const HiddenCase& hidden = GetParam();
  const auto experiment =
      read_on(arm_with(hidden.effect, {{hidden.parameter, hidden.value}}, hidden.sensor));
  const diagnose::Problem problem(experiment, {.flexible_modes = kSensorModes});
  std::string best;
  double least = std::numeric_limits<double>::infinity();
  double found = 0.0;
  for (const auto& hypothesis : diagnose::hypotheses(experiment)) {
    if (hypothesis.sensor.empty()) continue;
    const auto start = diagnose::Candidate{}.with(hypothesis, hypothesis.middle());
    const auto fit = diagnose::fit(problem, diagnose::start_on_grid(problem, start, 40));
    if (fit.sum_of_squares >= least) continue;
    least = fit.sum_of_squares;
    best = hypothesis.label();
    found = fit.candidate.values[0];
  }
  EXPECT_EQ(best, hidden.effect + " on " + hidden.sensor);
  EXPECT_NEAR(found / hidden.value, 1.0, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(
    Hidden, SensorEffect,
    testing::Values(HiddenCase{"sensor_gain", "factor", 1.17, "strain@0.05"},
                    HiddenCase{"sensor_gain", "factor", 0.9, "hub_angle"},
                    HiddenCase{"sensor_offset", "value", 0.31, "tip_acceleration"},
                    HiddenCase{"sensor_offset", "value", -2e-5, "strain@0.05"},
                    HiddenCase{"sensor_delay", "delay", 0.0371, "tip_acceleration"},
                    HiddenCase{"sensor_delay", "delay", 0.0013, "hub_angle"},
                    HiddenCase{"gauge_position", "shift", 0.021, "strain@0.05"}),
    [](const auto& each) { return each.param.effect + "_" + std::to_string(each.index); });

TEST(SensorEffects, AreWrittenWithTheirSensorAndReadBack) {
  const auto experiment = read_on(laws::damped_arm());
  for (const auto& hypothesis : diagnose::hypotheses(experiment)) {
    if (hypothesis.sensor.empty()) continue;
    const arm::Arm extended =
        diagnose::Candidate{}.with(hypothesis, hypothesis.middle()).extend(experiment.arm);
    const std::string text = measured::format_arm(extended);
    EXPECT_THAT(text, testing::HasSubstr("sensor = \"" + hypothesis.sensor + "\""));
    const arm::Arm read = measured::parse_arm(text, "extended.toml", vocabulary());
    EXPECT_EQ(read.effects.at(hypothesis.effect).acting_sensor(),
              arm::parse_sensor(hypothesis.sensor))
        << hypothesis.label();
  }
}

}  // namespace
}  // namespace flexarm::effects
