// Runs that state their controllers: loop and arm are simulated together.
#include "arm/input_error.hpp"
#include "diagnose/diagnosis.hpp"
#include "diagnose/search/predictor_choice.hpp"
#include "tests/diagnose/closed_loop_axis.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <variant>

namespace flexarm::diagnose {
namespace {

/// NRMSE of the controller's torque in a run.
Gain torque_error(const Diagnosis& diagnosis, const std::string& run) {
  const auto found = std::ranges::find_if(diagnosis.channels, [&](const ChannelGain& channel) {
    return channel.run == run && channel.sensor == kTorqueChannel;
  });
  return found == diagnosis.channels.end() ? Gain{} : found->error;
}

/// The axis with nothing that its file lacks but the encoder's counts.
Axis plain_axis() {
  return {.viscous_N_m_s_per_rad = 0.0, .coulomb_N_m = 0.0, .bias_N_m = 0.0, .unrecorded_N_m = 0.0};
}

/// Without its first samples, so that it begins in the midst of a move.
void cut(measured::TimeRecord& record, std::ptrdiff_t samples) {
  const auto drop = [samples](std::vector<double>& values) {
    values.erase(values.begin(), values.begin() + samples);
  };
  drop(record.time_s);
  drop(record.torque_N_m);
  drop(record.reference.values);
  for (auto& channel : record.channels) drop(channel.values);
}

TEST(ClosedLoop, ObservesTheTorqueBesideTheSensors) {
  const Observations open = observe(axis_experiment());
  const Observations loop = observe(axis_experiment_with_controller());
  ASSERT_EQ(open.channels.size(), 2U);
  ASSERT_EQ(loop.channels.size(), 4U);
  EXPECT_EQ(loop.channels[1].sensor, kTorqueChannel);
  EXPECT_EQ(loop.values.size(), 2 * open.values.size());
}

TEST(ClosedLoop, NamesFrictionAndBias) {
  const Experiment experiment = axis_experiment_with_controller();
  const auto made = select_by_evidence(experiment, hypotheses_of_an_axis(experiment), {}, {});
  EXPECT_EQ(made.predictor, PredictorKind::closed_loop);
  expect_friction_and_bias(made.selection);
}

TEST(ClosedLoop, ForceErrorOnHeldOutRunsIsThatOfTheUnrecordedTorque) {
  const Experiment experiment = axis_experiment_with_controller({.unrecorded_N_m = 0.02});
  const Diagnosis diagnosis = diagnose(experiment, hypotheses_of_an_axis(experiment));
  const Gain held_out = torque_error(diagnosis, "second");
  EXPECT_GT(held_out.before, 0.5);
  // What is left is the answer of the loop to the unrecorded torque and to the encoder's counts,
  // which the simulation reads without: 3 and 4 % of the torque.
  EXPECT_LT(held_out.after, 0.06);
}

TEST(ClosedLoop, ARunBeginsInTheMostLikelyState) {
  Experiment experiment = axis_experiment_with_controller(plain_axis());
  constexpr std::ptrdiff_t kInAMove = 300;
  for (auto& [run, data] : experiment.runs) cut(std::get<measured::TimeRecord>(data), kInAMove);
  const auto error_of = [&](measured::InitialState initial) {
    for (auto& run : experiment.runs) run.run.initial = initial;
    const Observations observed = observe(experiment);
    const Predictor predictor(experiment, observed, 1);
    const Eigen::VectorXd left = observed.values - predictor(experiment.arm, {true, true});
    return left.head(observed.channels.front().count).cwiseAbs().maxCoeff();
  };
  // The derivative of a controller starts at 0: a jolt of its first sample, which the loop forgets.
  EXPECT_GT(error_of(measured::InitialState::rest), 0.1);
  EXPECT_LT(error_of(measured::InitialState::free), 0.02);
}

TEST(ClosedLoop, ALoopThatRunsAwayIsLeftForTheRecordedTorque) {
  Experiment experiment = axis_experiment_with_controller();
  for (auto& [run, data] : experiment.runs) {
    std::get<arm::PidController>(run.controller->law).kp *= -1.0;
  }
  const auto made = select_by_evidence(experiment, hypotheses_of_an_axis(experiment), {}, {});
  EXPECT_EQ(made.predictor, PredictorKind::torque_balance);
  EXPECT_NE(made.reason.find("loop"), std::string::npos) << made.reason;
  // A simulation by the torque alone would add up what the friction is off.
  expect_friction_and_bias(made.selection);
}

TEST(ClosedLoop, NeedsAController) {
  const Experiment experiment = axis_experiment();
  EXPECT_THROW(select_by_evidence(experiment, hypotheses_of_an_axis(experiment),
                                  {.predictor = PredictorKind::closed_loop}, {}),
               arm::InputError);
}

}  // namespace
}  // namespace flexarm::diagnose
