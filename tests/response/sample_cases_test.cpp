#include "arm/arm_file.hpp"
#include "arm/text_file.hpp"
#include "measured/measurement.hpp"
#include "measured/time_record.hpp"
#include "response/formulation_maker.hpp"
#include "response/simulation.hpp"
#include "response/time_model.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

/// Measurements of an independent simulator (Hermite elements, friction by another scheme), with
/// noise and known causes: signs, units and the meaning of each effect from end to end. They are no
/// part of the repository; without them these tests are skipped.
namespace flexarm::response {
namespace {

namespace fs = std::filesystem;

constexpr int kModes = 14;  // of the simulator that made the cases

fs::path cases_folder() {
  if (const char* folder = std::getenv("FLEXARM_SAMPLE_CASES"); folder != nullptr) return folder;
  return fs::path(FLEXARM_SOURCE_DIR) / "../shared/data/sample-cases";
}

/// Effects of one case as answers.json gives them.
arm::Effects effects_of(const std::string& name) {
  const auto answers = nlohmann::json::parse(
      arm::read_text_file(cases_folder() / "answers.json", std::size_t{1} << 20U));
  arm::Effects effects;
  for (const auto& [effect, parameters] : answers.at(name).at("effects").items()) {
    effects[effect].parameters = parameters.get<std::map<std::string, double>>();
  }
  return effects;
}

struct ChannelResidual {
  std::string run;
  std::string sensor;
  double residual = 0.0;  ///< rms of measured less model, over the measured standard deviation
};

double relative_residual(const std::vector<double>& measured, const std::vector<double>& model) {
  const auto count = static_cast<double>(measured.size());
  double mean = 0.0;
  for (const double value : measured) mean += value / count;
  double signal = 0.0;
  double error = 0.0;
  for (std::size_t k = 0; k < measured.size(); ++k) {
    signal += (measured[k] - mean) * (measured[k] - mean);
    error += (measured[k] - model[k]) * (measured[k] - model[k]);
  }
  return std::sqrt(error / signal);
}

/// Every channel of every run of a case, against an arm with the case's dimensions and `effects`.
std::vector<ChannelResidual> residuals(const std::string& name, const arm::Effects& effects) {
  const fs::path file = cases_folder() / name / "measurement.toml";
  const auto measurement = measured::read_measurement(file);
  std::vector<ChannelResidual> all;
  for (const auto& run : measurement.runs) {
    arm::Arm arm = arm::read_arm_file(measured::beside(file, measurement.arm));
    arm.effects = effects;
    arm.payload = run.payload.value_or(arm.payload);
    const auto record = measured::read_time_record(measured::beside(file, run.file));
    std::vector<arm::Sensor> sensors;
    for (const auto& channel : record.channels) sensors.push_back(channel.sensor);
    const ArmParts parts = take_apart(arm);
    const auto model =
        time_model(make_formulation("exact_tf", arm, kModes), parts, kModes, sensors);
    SimulationOptions options;
    options.sample_time_s = measured::sampling_period_s(record);
    options.energy = false;
    const auto simulated = simulate(model, parts, sensors, record.torque_N_m, options);
    for (std::size_t i = 0; i < sensors.size(); ++i) {
      all.push_back({run.id, arm::to_string(sensors[i]),
                     relative_residual(record.channels[i].values, simulated.channels[i])});
    }
  }
  return all;
}

class SampleCase : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (!fs::exists(cases_folder())) GTEST_SKIP() << "no sample cases at " << cases_folder();
  }
};

TEST_P(SampleCase, WithItsEffectsWhatIsLeftIsNoise) {
  constexpr double kMostNoise = 0.0065;
  constexpr double kLeastNoise = 0.0035;
  for (const auto& channel : residuals(GetParam(), effects_of(GetParam()))) {
    std::puts(
        fmt::format("{} {} {}: {:.5f}", GetParam(), channel.run, channel.sensor, channel.residual)
            .c_str());
    EXPECT_LT(channel.residual, kMostNoise) << channel.run << ' ' << channel.sensor;
    EXPECT_GT(channel.residual, kLeastNoise) << channel.run << ' ' << channel.sensor;
  }
}

INSTANTIATE_TEST_SUITE_P(, SampleCase, testing::Values("sample-1", "sample-2", "sample-5"),
                         [](const auto& name) {
                           std::string text = name.param;
                           std::ranges::replace(text, '-', '_');
                           return text;
                         });

class SampleCaseWithEffects : public SampleCase {};

TEST_P(SampleCaseWithEffects, WithoutItsEffectsMoreThanNoiseIsLeft) {
  double largest = 0.0;
  for (const auto& channel : residuals(GetParam(), {})) {
    std::puts(fmt::format("without {} {} {}: {:.5f}", GetParam(), channel.run, channel.sensor,
                          channel.residual)
                  .c_str());
    largest = std::max(largest, channel.residual);
  }
  EXPECT_GT(largest, 0.05);
}

INSTANTIATE_TEST_SUITE_P(, SampleCaseWithEffects, testing::Values("sample-2", "sample-5"),
                         [](const auto& name) {
                           std::string text = name.param;
                           std::ranges::replace(text, '-', '_');
                           return text;
                         });

}  // namespace
}  // namespace flexarm::response
