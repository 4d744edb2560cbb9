// Samples of uncertain numbers: their moments, limits and order, and the state spaces of them.
#include "arm/arm_keys.hpp"
#include "arm/input_error.hpp"
#include "effects/registry/vocabulary.hpp"
#include "export/samples/sample_files.hpp"
#include "response/formulation_maker.hpp"

#include <Eigen/Eigenvalues>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>

namespace flexarm::samples {
namespace {

using arm::SensorKind;
using Json = nlohmann::json;

constexpr std::size_t kDraws = 4000;
/// Of a mean of kDraws, in its standard deviations; and as much of a standard deviation.
constexpr double kChance = 4.0;

arm::Arm uncertain_arm() {
  arm::Arm arm = arm::paper_arm();
  arm.relative_uncertainties = {{"beam.flexural_rigidity", 0.05}, {"hub.inertia", 0.2}};
  return arm;
}

/// What a diagnosis says of such an arm.
Json diagnosis() {
  return {{"posterior",
           {{{"effects", {{{"effect", "coulomb_friction"}}, {{"effect", "actuator_lag"}}}},
             {"probability", 0.75},
             {"parameters",
              {{{"key", "effects.coulomb_friction.torque"},
                {"value", 0.02},
                {"std_error", 0.01},
                {"unit", "N m"},
                {"logarithmic", false}},
               {{"key", "effects.actuator_lag.time_constant"},
                {"value", 0.004},
                {"std_error", 0.0004},
                {"unit", "s"},
                {"logarithmic", true}},
               {{"key", "hub.inertia"},
                {"value", 6e-4},
                {"std_error", 6e-6},
                {"unit", "kg m^2"},
                {"logarithmic", true}}}},
             {"correlation", {{1.0, 0.0, 0.0}, {0.0, 1.0, -0.8}, {0.0, -0.8, 1.0}}}},
            {{"effects", {{{"effect", "payload_mass"}}}},
             {"probability", 0.25},
             {"parameters",
              {{{"key", "effects.payload_mass.mass"},
                {"value", 0.02},
                {"std_error", 0.001},
                {"unit", "kg"},
                {"logarithmic", true}}}},
             {"correlation", {{1.0}}}}}}};
}

arm::Arm extended_arm() {
  arm::Arm arm = uncertain_arm();
  arm.hub.inertia_kg_m2 = 6e-4;
  arm.effects = {effects::named("coulomb_friction", {{"torque", 0.02}}),
                 effects::named("actuator_lag", {{"time_constant", 0.004}})};
  return arm;
}

std::vector<double> column(const ArmSamples& samples, const std::string& key) {
  const auto at = std::ranges::find(samples.numbers, key, &SampledNumber::key);
  if (at == samples.numbers.end()) throw std::runtime_error(key);
  const auto i = static_cast<std::size_t>(at - samples.numbers.begin());
  std::vector<double> made;
  for (std::size_t k = 1; k < samples.samples.size(); ++k) {
    made.push_back(samples.samples[k].values[i]);
  }
  return made;
}

struct Moments {
  double mean = 0.0;
  double deviation = 0.0;
};

Moments moments_of(const std::vector<double>& values) {
  const Eigen::Map<const Eigen::ArrayXd> all(values.data(), std::ssize(values));
  const double mean = all.mean();
  return {mean, std::sqrt((all - mean).square().sum() / static_cast<double>(all.size() - 1))};
}

std::vector<double> logarithms(std::vector<double> values) {
  for (double& value : values) value = std::log(value);
  return values;
}

void expect_moments(const std::vector<double>& values, double mean, double deviation) {
  const double count = static_cast<double>(values.size());
  const Moments found = moments_of(values);
  EXPECT_NEAR(found.mean, mean, kChance * deviation / std::sqrt(count));
  EXPECT_NEAR(found.deviation, deviation, kChance * deviation / std::sqrt(2.0 * count));
}

TEST(ArmSamples, OfStatedUncertaintiesAreLogNormalAndIndependent) {
  const arm::Arm arm = uncertain_arm();
  const auto drawn = draw(posterior_of(arm), kDraws, 3);
  ASSERT_EQ(drawn.samples.size(), kDraws + 1);
  EXPECT_EQ(drawn.samples.front().arm, arm);
  const auto rigidity = logarithms(column(drawn, "beam.flexural_rigidity"));
  const auto inertia = logarithms(column(drawn, "hub.inertia"));
  expect_moments(rigidity, std::log(*arm.beam.given_flexural_rigidity_N_m2), 0.05);
  expect_moments(inertia, std::log(arm.hub.inertia_kg_m2), 0.2);
  double product = 0.0;
  for (std::size_t k = 0; k < kDraws; ++k) {
    product += (rigidity[k] - std::log(*arm.beam.given_flexural_rigidity_N_m2)) / 0.05 *
               (inertia[k] - std::log(arm.hub.inertia_kg_m2)) / 0.2;
  }
  EXPECT_NEAR(product / kDraws, 0.0, kChance / std::sqrt(static_cast<double>(kDraws)));
  // The arms have them.
  EXPECT_DOUBLE_EQ(drawn.samples[7].arm.hub.inertia_kg_m2, std::exp(inertia[6]));
}

TEST(ArmSamples, OfADiagnosisHaveItsSetsCorrelationAndLimits) {
  const auto posterior = posterior_of(diagnosis(), extended_arm());
  ASSERT_EQ(posterior.sets.size(), 2U);
  EXPECT_EQ(posterior.sets[0].effects, "coulomb_friction + actuator_lag");
  EXPECT_FALSE(posterior.sets[1].arm.effects.contains("coulomb_friction"));
  EXPECT_EQ(posterior.sets[1].arm.effects.at("payload_mass").value("mass"), 0.02);
  const auto drawn = draw(posterior, kDraws, 11);
  std::vector<double> lags;
  std::vector<double> inertias;
  double of_first = 0.0;
  double lowest = 1.0;
  for (std::size_t k = 1; k < drawn.samples.size(); ++k) {
    const ArmSample& sample = drawn.samples[k];
    EXPECT_EQ(sample.arm.effects.contains("payload_mass"), sample.set == 1);
    if (sample.set != 0) continue;
    of_first += 1.0;
    lags.push_back(std::log(sample.arm.effects.at("actuator_lag").value("time_constant")));
    inertias.push_back(std::log(sample.arm.hub.inertia_kg_m2));
    lowest = std::min(lowest, sample.arm.effects.at("coulomb_friction").value("torque"));
  }
  EXPECT_NEAR(of_first / kDraws, 0.75, kChance * std::sqrt(0.75 * 0.25 / kDraws));
  expect_moments(lags, std::log(0.004), 0.1);
  expect_moments(inertias, std::log(6e-4), 0.01);
  double product = 0.0;
  for (std::size_t k = 0; k < lags.size(); ++k) {
    product += (lags[k] - std::log(0.004)) / 0.1 * (inertias[k] - std::log(6e-4)) / 0.01;
  }
  EXPECT_NEAR(product / of_first, -0.8, kChance * std::sqrt((1.0 + 0.64) / of_first));
  // 2.3 % of the normal friction lies below 0: those are drawn anew.
  EXPECT_GE(lowest, 0.0);
  EXPECT_NEAR(static_cast<double>(drawn.rejected), 0.0228 * of_first,
              kChance * std::sqrt(0.0228 * of_first));
}

TEST(ArmSamples, AreThoseOfTheirSeedAndTheFirstOnesOfAnyCount) {
  const auto posterior = posterior_of(diagnosis(), extended_arm());
  const auto few = draw(posterior, 5, 1);
  const auto more = draw(posterior, 9, 1);
  const auto others = draw(posterior, 5, 2);
  for (std::size_t k = 0; k < few.samples.size(); ++k) {
    EXPECT_EQ(few.samples[k].arm, more.samples[k].arm);
    if (k == 0) continue;
    EXPECT_NE(few.samples[k].arm, others.samples[k].arm);
  }
}

TEST(ArmSamples, OfWhichNoneIsAllowedAreRefused) {
  auto posterior = posterior_of(diagnosis(), extended_arm());
  posterior.sets.resize(1);
  posterior.sets[0].marginals[0].value = -1.0;
  EXPECT_THROW(draw(posterior, 1, 1), arm::InputError);
}

TEST(ArmSamples, OfADiagnosisOfAnotherFormAreRefused) {
  EXPECT_THROW(posterior_of(Json::object(), extended_arm()), arm::InputError);
  Json unknown = diagnosis();
  unknown["posterior"][0]["parameters"][2]["key"] = "hub.colour";
  EXPECT_THROW(posterior_of(unknown, extended_arm()), arm::InputError);
  // A set that the arm cannot have is left out, and said.
  Json other = diagnosis();
  other["posterior"][1]["effects"][0]["effect"] = "no_effect";
  const auto posterior = posterior_of(other, extended_arm());
  EXPECT_EQ(posterior.sets.size(), 1U);
  EXPECT_DOUBLE_EQ(posterior.sets[0].probability, 1.0);
  EXPECT_THAT(posterior.left_out, testing::ElementsAre(testing::HasSubstr("no_effect")));
}

SampleExport sample_export(std::size_t count) {
  SampleExport made{.posterior = posterior_of(diagnosis(), extended_arm()),
                    .samples = {},
                    .state_space = {},
                    .seed = 5,
                    .left_out_effects = {"coulomb_friction"}};
  made.samples = draw(made.posterior, count, made.seed);
  made.state_space = state_spaces(
      made.samples,
      {.modes = 3, .sensors = {{SensorKind::hub_angle}, {SensorKind::tip_acceleration}}});
  return made;
}

TEST(SampledStateSpace, HasThePolesOfEachArmInTheSameOrder) {
  const auto made = sample_export(12);
  const auto& states = made.state_space.states;
  EXPECT_EQ(states.front(), "q_0");
  EXPECT_EQ(states.back(), "hub torque");
  for (std::size_t k = 0; k < made.samples.samples.size(); ++k) {
    const arm::Arm& arm = made.samples.samples[k].arm;
    const auto poles = response::poles(response::make_formulation("exact_tf", arm, 3), 3);
    const auto& system = made.state_space.systems[k];
    EXPECT_EQ(system.states, states);
    // Undamped: |s| of each pair, ascending as the states are.
    for (Eigen::Index mode = 1; mode <= 3; ++mode) {
      const double omega = std::sqrt(-system.a(2 * mode + 1, 2 * mode));
      EXPECT_NEAR(omega / poles.omega_rad_per_s[static_cast<std::size_t>(mode - 1)], 1.0, 1e-9);
    }
    // The torque drives every mode with the same sign.
    const bool has_lag = arm.effects.contains("actuator_lag");
    for (Eigen::Index mode = 0; mode <= 3; ++mode) {
      const double drive =
          has_lag ? system.a(2 * mode + 1, system.a.cols() - 1) : system.b(2 * mode + 1, 0);
      EXPECT_GT(drive, 0.0);
    }
    if (has_lag) continue;
    // The state of a lag that this arm does not have is alone.
    EXPECT_EQ(system.a(system.a.rows() - 1, system.a.cols() - 1), -1.0);
    EXPECT_EQ(system.a.rightCols(1).topRows(system.a.rows() - 1).norm(), 0.0);
    EXPECT_EQ(system.c.rightCols(1).norm(), 0.0);
  }
}

class SampleFile : public testing::Test {
 protected:
  SampleFile() {
    std::string name = (std::filesystem::temp_directory_path() / "flexarm-samples-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~SampleFile() override { std::filesystem::remove_all(folder_); }

  /// Writes JSON and MATLAB file, and runs a reader that compares the two.
  void expect_same(const std::string& reader, const std::string& script, const std::string& name) {
    const auto made = sample_export(6);
    write_samples_mat(made, folder_ / "samples.mat");
    std::ofstream(folder_ / "samples.json") << samples_json(made);
    std::ofstream(folder_ / name) << script;
    const std::string command = "cd " + folder_.string() + " && " + reader + " " + name;
    EXPECT_EQ(std::system(command.c_str()), 0);
  }
  std::filesystem::path folder_;
};

TEST_F(SampleFile, IsReadBySciPyToTheLastBit) {
  expect_same("/usr/bin/python3",
              R"(
import json
import numpy as np
import scipy.io
with open('samples.json') as file:
    expected = json.load(file)
read = scipy.io.loadmat('samples.mat')
count = len(expected['samples'])
assert count == 7
for name in 'ABCD':
    stacked = np.stack([np.array(one[name]) for one in expected['samples']], axis=-1)
    assert read[name].shape == stacked.shape, (name, read[name].shape)
    assert np.array_equal(read[name], stacked), name
values = np.array([[np.nan if v is None else v for v in one['values']]
                   for one in expected['samples']]).T
assert np.array_equal(read['values'], values, equal_nan=True)
def texts(name):
    return [str(cell[0][0]) if cell[0].size else '' for cell in read[name]]
assert texts('states') == expected['states']
assert texts('sensors') == [one['sensor'] for one in expected['outputs']]
assert texts('units') == [one['unit'] for one in expected['outputs']]
assert texts('numbers') == [one['key'] for one in expected['numbers']]
assert texts('sets') == [one['effects'] for one in expected['sets']]
assert texts('left_out_effects') == expected['left_out_effects']
assert list(read['set'][0]) == [one['set'] + 1 for one in expected['samples']]
assert list(read['probability'][:, 0]) == [one['probability'] for one in expected['sets']]
assert read['delay_s'].shape == (1, count) and read['output_delay_s'].shape == (2, count)
assert read['seed'][0, 0] == 5
)",
              "read.py");
}

TEST_F(SampleFile, IsTheSameForTheSameSamples) {
  const auto made = sample_export(3);
  const auto bytes = [&](const char* name) {
    write_samples_mat(made, folder_ / name);
    std::ifstream file(folder_ / name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_EQ(bytes("one.mat"), bytes("other.mat"));
}

}  // namespace
}  // namespace flexarm::samples
