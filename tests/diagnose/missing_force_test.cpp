// At which port a force acts that the model lacks. Data are by finite elements and a time stepper,
// what is fitted to them by exact_tf.
#include "diagnose/unknown/missing_force.hpp"

#include "diagnose/diagnosis.hpp"
#include "diagnose/unknown/residual_spectra.hpp"
#include "effects/registry/vocabulary.hpp"
#include "response/formulation_maker.hpp"
#include "response/frequency/frequency_response.hpp"
#include "tests/diagnose/symptoms_fixture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <ostream>
#include <random>
#include <string>
#include <variant>
#include <vector>

namespace flexarm::diagnose {
namespace {

using effects::named;

std::optional<MissingForce> missing_in(const Experiment& experiment) {
  const Symptomatic data(experiment);
  const SymptomsInput input = data.input();
  return missing_force(input.problem, experiment.arm,
                       to_errors(input.problem.observations(), input.before));
}

std::optional<MissingForce> missing_with(const arm::Effects& hidden) {
  return missing_in(simulated_experiment(hidden));
}

/// `frf` runs of `trial_arm` with hidden effects, with and without a payload, by finite elements;
/// with noise of 1 %.
Experiment measured_responses(const arm::Effects& hidden) {
  constexpr double kNoise = 0.01;
  constexpr int kModes = 16;
  std::vector<double> frequency_Hz;
  for (int k = 1; k <= 300; ++k) frequency_Hz.push_back(0.2 * k);
  const std::vector<arm::Sensor> sensors = {arm::parse_sensor("hub_angle"),
                                            arm::parse_sensor("tip_acceleration"),
                                            arm::parse_sensor("strain@0.05")};
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal(0.0, kNoise / std::sqrt(2.0));
  Experiment experiment;
  experiment.arm = trial_arm();
  for (const double payload_kg : {0.0, 0.06}) {
    measured::MeasuredRun run;
    run.run.id = payload_kg > 0.0 ? "payload" : "bare";
    run.run.kind = measured::RunKind::frf;
    run.run.purpose = measured::Purpose::estimation;
    run.run.payload = arm::Payload{payload_kg, 0.0};
    arm::Arm arm = arm_in(experiment, run.run);
    arm.effects = hidden;
    const response::ArmParts parts = response::take_apart(arm);
    const auto made =
        response::frequency_response(response::make_formulation("fem", parts.linear, kModes),
                                     response::linear_chain(parts), sensors, frequency_Hz);
    measured::FrequencyRecord record;
    for (std::size_t j = 0; j < sensors.size(); ++j) {
      measured::FrequencyChannel channel{sensors[j], frequency_Hz, {}, {}};
      for (const std::complex<double> value : made.values[j]) {
        channel.response.push_back(value * (1.0 + std::complex(normal(engine), normal(engine))));
        channel.coherence.push_back(std::nan(""));
      }
      record.channels.push_back(std::move(channel));
    }
    run.data = std::move(record);
    experiment.runs.push_back(std::move(run));
  }
  return experiment;
}

arm::Effects on_gauge(const std::string& effect, const std::string& parameter, double value) {
  return {named(effect, {{parameter, value}}, "strain@0.05")};
}

/// Runs with these sensors alone.
Experiment with_sensors(Experiment experiment, const std::vector<std::string>& names) {
  for (auto& run : experiment.runs) {
    auto& channels = std::get<measured::TimeRecord>(run.data).channels;
    std::erase_if(channels, [&](const auto& channel) {
      return std::ranges::find(names, to_string(channel.sensor)) == names.end();
    });
  }
  return experiment;
}

struct HiddenAt {
  std::string name;  ///< of the test
  arm::Effects effects;
  ForcePort port;
  double share;  ///< that the port explains at least
};

void PrintTo(const HiddenAt& hidden, std::ostream* out) {
  *out << hidden.name;
}

class PortOfHidden : public testing::TestWithParam<HiddenAt> {};

TEST_P(PortOfHidden, IsStatedAlone) {
  const HiddenAt& hidden = GetParam();
  const auto found = missing_with(hidden.effects);
  ASSERT_TRUE(found);
  ASSERT_EQ(found->stated, 1U);
  const PortShare& best = found->ports.front();
  EXPECT_EQ(to_string(best.port), to_string(hidden.port));
  EXPECT_GT(best.share, hidden.share);
  EXPECT_LT(best.share, 1.05);
  EXPECT_GT(best.std_error, 0.0);
  EXPECT_LT(best.std_error, 0.05);
}

std::string name_of(const testing::TestParamInfo<HiddenAt>& info) {
  return info.param.name;
}

// Both in runs of torque and in responses.
const HiddenAt kHubInertia = {
    "hub_inertia", {named("hub_inertia", {{"factor", 1.4}})}, ForcePort::hub, 0.95};
const HiddenAt kRootCompliance = {
    "root_compliance", {named("root_compliance", {{"stiffness", 40.0}})}, ForcePort::root, 0.95};
const HiddenAt kAttachedMass = {"attached_mass",
                                {named("attached_mass", {{"mass", 0.02}, {"position", 0.5}})},
                                ForcePort::beam,
                                0.9};
const HiddenAt kPayloadMass = {
    "payload_mass", {named("payload_mass", {{"mass", 0.02}})}, ForcePort::tip, 0.95};
const HiddenAt kSensorDelay = {"sensor_delay", on_gauge("sensor_delay", "delay", 0.004),
                               ForcePort::sensor, 0.95};

INSTANTIATE_TEST_SUITE_P(
    Effects, PortOfHidden,
    testing::Values(
        HiddenAt{"coulomb_friction",
                 {named("coulomb_friction", {{"torque", 0.01}})},
                 ForcePort::hub,
                 0.95},
        kHubInertia, kRootCompliance, kAttachedMass,
        HiddenAt{"local_stiffness_loss",
                 {named("local_stiffness_loss", {{"stiffness", 40.0}, {"position", 0.5}})},
                 ForcePort::beam,
                 0.9},
        HiddenAt{
            "linear_density", {named("linear_density", {{"factor", 1.1}})}, ForcePort::beam, 0.95},
        kPayloadMass,
        HiddenAt{"sensor_gain", on_gauge("sensor_gain", "factor", 0.8), ForcePort::sensor, 0.95},
        kSensorDelay),
    name_of);

class PortOfHiddenInResponses : public testing::TestWithParam<HiddenAt> {};

TEST_P(PortOfHiddenInResponses, IsStatedAlone) {
  const HiddenAt& hidden = GetParam();
  const auto found = missing_in(measured_responses(hidden.effects));
  ASSERT_TRUE(found);
  ASSERT_EQ(found->stated, 1U);
  EXPECT_EQ(to_string(found->ports.front().port), to_string(hidden.port));
  EXPECT_GT(found->ports.front().share, hidden.share);
  EXPECT_LT(found->ports.front().share, 1.05);
  EXPECT_FALSE(found->size);  // it is per unit of torque
}

INSTANTIATE_TEST_SUITE_P(Effects, PortOfHiddenInResponses,
                         testing::Values(kHubInertia, kRootCompliance, kAttachedMass, kPayloadMass,
                                         kSensorDelay),
                         name_of);

TEST(MissingForce, OfResponsesIsNamedWhereTheCauseIsExcluded) {
  const Experiment experiment =
      measured_responses({named("attached_mass", {{"mass", 0.05}, {"position", 0.5}})});
  // Other inertias would take up a part of it: what is left then acts at the tip.
  std::vector<Hypothesis> others = hypotheses(experiment);
  std::erase_if(others, [](const Hypothesis& one) {
    return one.effect != "hub_spring" && one.effect != "hub_viscous_friction";
  });
  const Diagnosis made = diagnose(experiment, others, {.most_causes = 1});
  EXPECT_NE(made.verdict, Verdict::adequate);
  EXPECT_NE(made.verdict, Verdict::explained);
  ASSERT_TRUE(made.missing_force);
  EXPECT_EQ(to_string(made.missing_force->ports.front().port), to_string(ForcePort::beam));
}

TEST(MissingForce, OfResponsesOfTheArmThereIsNone) {
  EXPECT_FALSE(missing_in(measured_responses({})));
}

TEST(MissingForce, HasTheSizeOfTheFriction) {
  constexpr double kFriction_N_m = 0.01;
  const auto found = missing_with({named("coulomb_friction", {{"torque", kFriction_N_m}})});
  ASSERT_TRUE(found && found->size);
  // Its sign alone changes: the RMS value is the torque itself, but for the lowest lines and for
  // the time that the hub rests.
  EXPECT_EQ(found->size->unit, "N m");
  EXPECT_NEAR(found->size->rms, kFriction_N_m, 0.1 * kFriction_N_m);
  ASSERT_TRUE(found->size->std_error);
  EXPECT_LT(*found->size->std_error, 0.1 * kFriction_N_m);
  EXPECT_LT(found->size->from_Hz, found->size->to_Hz);
}

TEST(MissingForce, HasASpectrumInThirdOctavesThatAddsUpToItsSize) {
  const auto found = missing_with({named("coulomb_friction", {{"torque", 0.01}})});
  ASSERT_TRUE(found && found->size);
  double mean_square = 0.0;
  double above_Hz = 0.0;
  for (const ForceBand& band : found->size->spectrum) {
    EXPECT_NEAR(band.to_Hz / band.from_Hz, std::pow(10.0, 0.1), 1e-9);
    EXPECT_GE(band.from_Hz, above_Hz * (1.0 - 1e-9));
    above_Hz = band.to_Hz;
    mean_square += band.mean_square;
    ASSERT_TRUE(band.std_error);
    EXPECT_LE(band.rms_at(-kDistance), band.rms());
    EXPECT_GE(band.rms_at(kDistance), band.rms());
  }
  EXPECT_NEAR(std::sqrt(mean_square), found->size->rms, 1e-9 * found->size->rms);
}

TEST(MissingForce, IsAtTheSensorThatErrs) {
  const auto found = missing_with(on_gauge("sensor_gain", "factor", 0.8));
  ASSERT_TRUE(found && found->stated == 1);
  EXPECT_EQ(found->ports.front().sensors, std::vector<std::string>{"strain@0.05"});
}

TEST(MissingForce, IsAtThePlaceOfTheMass) {
  const auto found = missing_with({named("attached_mass", {{"mass", 0.02}, {"position", 0.48}})});
  ASSERT_TRUE(found && found->stated == 1);
  EXPECT_EQ(found->ports.front().place, "force at 0.48 m");
  EXPECT_GT(found->ports.front().share, 0.98);
}

TEST(MissingForce, OfNothingThereIsNone) {
  EXPECT_FALSE(missing_with({}));
}

TEST(MissingForce, IsNotDeterminedByOneSensor) {
  const auto experiment = simulated_experiment({named("coulomb_friction", {{"torque", 0.01}})});
  const auto found = missing_in(with_sensors(experiment, {"hub_angle"}));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->stated, 0U);
  EXPECT_TRUE(found->ports.empty());
  EXPECT_FALSE(found->size);
}

TEST(MissingForce, IsNotDeterminedByTwoSensorsOfOneMotion) {
  const auto experiment = simulated_experiment({named("coulomb_friction", {{"torque", 0.01}})});
  const auto found = missing_in(with_sensors(experiment, {"hub_angle", "hub_velocity"}));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->stated, 0U);
  EXPECT_GT(found->ports.size(), kMostPorts);
}

TEST(MissingForce, OfARigidHubThereIsNone) {
  Experiment experiment = simulated_experiment({named("coulomb_friction", {{"torque", 0.01}})});
  const Symptomatic data(experiment);
  const SymptomsInput input = data.input();
  arm::Arm without_beam = experiment.arm;
  without_beam.beam = {};
  EXPECT_FALSE(missing_force(input.problem, without_beam,
                             to_errors(input.problem.observations(), input.before)));
}

TEST(PortResponses, OfAForceIsWhatAMassThereTakes) {
  // A mass M pushes by -M a, a the acceleration of the arm that carries it: H_M - H = -M a u.
  arm::Arm arm = trial_arm();
  const std::vector<arm::Sensor> sensors = {{arm::SensorKind::hub_angle, 0.0},
                                            {arm::SensorKind::tip_acceleration, 0.0},
                                            {arm::SensorKind::strain, 0.05}};
  const std::vector<double> frequency_Hz = {2.0, 9.0, 21.0, 44.0};
  const auto places = force_places(arm, sensors);
  const auto at_tip = std::ranges::find(places, "force at the tip", &ForcePlace::what);
  ASSERT_NE(at_tip, places.end());
  const PortResponses bare(arm, sensors, frequency_Hz);
  const Eigen::MatrixXcd of_force = bare(std::vector{*at_tip}).front();
  constexpr double kMass_kg = 0.1;
  arm.effects = {named("payload_mass", {{"mass", kMass_kg}})};
  const PortResponses heavy(arm, sensors, frequency_Hz);
  const Eigen::MatrixXcd before = bare.of_command();
  const Eigen::MatrixXcd after = heavy.of_command();
  for (Eigen::Index k = 0; k < before.cols(); ++k) {
    const std::complex<double> force_N = -kMass_kg * after(1, k);
    // The sign of a unit force is free.
    const std::complex<double> sign = of_force(0, k) * force_N / (after(0, k) - before(0, k));
    EXPECT_NEAR(std::abs(sign), 1.0, 1e-6);
    for (Eigen::Index j = 0; j < before.rows(); ++j) {
      const std::complex<double> change = after(j, k) - before(j, k);
      EXPECT_LT(std::abs(of_force(j, k) * force_N / sign - change), 1e-6 * std::abs(change));
    }
  }
}

TEST(ResidualSpectra, OfWhiteNoiseHaveThePowerThatIsExpected) {
  // Counted where some sensor is far beyond: the others then show their noise.
  const Symptomatic data(simulated_experiment(on_gauge("sensor_gain", "factor", 0.5)));
  const SymptomsInput input = data.input();
  const auto all =
      residual_spectra(input.problem, to_errors(input.problem.observations(), input.before));
  ASSERT_FALSE(all.empty());
  for (const ResidualSpectra& one : all) {
    for (Eigen::Index j = 0; j + 1 < one.errors.rows(); ++j) {
      const double ratio = one.errors.row(j).cwiseAbs2().cwiseQuotient(one.noise.row(j)).mean();
      EXPECT_NEAR(ratio, 1.0, 0.35) << to_string(one.sensors[static_cast<std::size_t>(j)]);
    }
  }
}

}  // namespace
}  // namespace flexarm::diagnose
