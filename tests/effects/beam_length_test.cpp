// beam_length against the arm whose file has that length, and a fit that looks for it.
#include "compare/sweeps/sweep.hpp"
#include "diagnose/search/fit.hpp"
#include "effects/registry/vocabulary.hpp"
#include "exact_tf/exact_arm.hpp"
#include "fem/fem_arm.hpp"
#include "tests/diagnose/start_on_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

namespace flexarm::effects {
namespace {

arm::Arm loaded_arm() {
  arm::Arm arm = arm::paper_arm();
  arm.hub.viscous_friction_N_m_s_per_rad = 2e-3;
  arm.damping.kelvin_voigt_s = 1.2e-4;
  arm.payload = {0.05, 1e-4};
  return arm;
}

arm::Arm with_length(arm::Arm arm, double factor) {
  put(arm, "beam_length", {{"factor", factor}});
  return arm;
}

TEST(BeamLength, IsTheArmWhoseFileSaysSo) {
  const arm::Arm by_effect = with_length(loaded_arm(), 1.02);
  arm::Arm by_number = loaded_arm();
  by_number.beam.length_m *= 1.02;
  EXPECT_EQ(arm::linear_arm(by_effect), arm::linear_arm(by_number));
  const auto sensor = arm::parse_sensor("strain@0.05");
  const std::complex<double> s(0.0, 40.0);
  EXPECT_EQ(exact_tf::ExactArm(by_effect).transfer_function(sensor, s),
            exact_tf::ExactArm(by_number).transfer_function(sensor, s));
}

TEST(BeamLength, MovesPolesOfABeamAloneByItsInverseSquare) {
  // Without hub and payload inertia nothing but EI, m and l enters.
  arm::Arm arm = arm::paper_arm();
  arm.hub.inertia_kg_m2 = 0.0;
  const auto before = exact_tf::ExactArm(arm).poles(4).omega_rad_per_s;
  const auto after = exact_tf::ExactArm(with_length(arm, 1.1)).poles(4).omega_rad_per_s;
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_NEAR(after[i] / before[i], 1.0 / (1.1 * 1.1), 1e-12);
  }
}

TEST(BeamLength, IsSweptToTheSameAsTheLengthOfTheFile) {
  const auto swept = [](const std::string& parameter, double from, double to) {
    compare::SweepTask task{loaded_arm(), {}, compare::standard_models(3), {.poles = 3}};
    compare::SweepAxis axis;
    axis.parameter = compare::sweep_parameter(parameter);
    axis.values = {from, to};
    task.axes = {axis};
    return compare::evaluate(task, {}).points.front();
  };
  const auto by_effect = swept("effects.beam_length.factor", 0.8, 1.25);
  const auto by_number = swept("beam.length", 0.8 * 0.96, 1.25 * 0.96);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(by_effect[i].tip_value_m, by_number[i].tip_value_m);
    EXPECT_EQ(by_effect[i].damped_poles_rad_per_s, by_number[i].damped_poles_rad_per_s);
    EXPECT_EQ(by_effect[i].zeros_rad_per_s, by_number[i].zeros_rad_per_s);
  }
}

/// The frequency responses of an arm, by finite elements.
diagnose::Experiment measured_on(const arm::Arm& truth, const std::vector<std::string>& sensors) {
  const fem::FemArm model(truth);
  measured::FrequencyRecord record;
  for (const std::string& name : sensors) {
    measured::FrequencyChannel channel{arm::parse_sensor(name), {}, {}, {}};
    for (double f = 0.5; f < 40.0; f *= 1.03) {
      channel.frequency_Hz.push_back(f);
      channel.response.push_back(
          model.transfer_function(channel.sensor, {0.0, 2.0 * std::numbers::pi * f}));
      channel.coherence.push_back(0.999);
    }
    record.channels.push_back(std::move(channel));
  }
  measured::Run run;
  run.id = "frf";
  run.kind = measured::RunKind::frf;
  run.purpose = measured::Purpose::estimation;
  diagnose::Experiment experiment;
  experiment.arm = loaded_arm();
  experiment.runs.push_back({run, std::move(record)});
  return experiment;
}

diagnose::Hypothesis hypothesis_of(const diagnose::Experiment& experiment) {
  const auto all = diagnose::hypotheses(experiment);
  return *std::ranges::find(all, "beam_length", &diagnose::Hypothesis::effect);
}

TEST(BeamLength, IsFoundByAFitThatScansItsWholeRange) {
  for (const double factor : {0.65, 0.98, 1.5}) {
    const auto experiment = measured_on(with_length(loaded_arm(), factor),
                                        {"hub_angle", "tip_acceleration", "strain@0.05"});
    const diagnose::Problem problem(experiment);
    const auto start = diagnose::Candidate{}.with(hypothesis_of(experiment), {1.0});
    const auto found = diagnose::fit(problem, diagnose::start_on_grid(problem, start, 60));
    EXPECT_TRUE(found.converged);
    EXPECT_NEAR(found.candidate.values[0] / factor, 1.0, 1e-6);
  }
}

TEST(BeamLength, IsLookedForWhereTheBeamReachesEveryGauge) {
  const auto lowest = [](const std::vector<std::string>& sensors) {
    return hypothesis_of(measured_on(loaded_arm(), sensors)).parameters[0].lowest;
  };
  EXPECT_EQ(lowest({"hub_angle", "strain@0.05"}), 0.6);
  EXPECT_EQ(lowest({"strain@0.05", "strain@0.72"}), 0.75);
  EXPECT_EQ(lowest({"strain@0.96"}), 0.6);  // at the tip, which moves with the length
}

}  // namespace
}  // namespace flexarm::effects
