#include "diagnose/experiment.hpp"

#include "arm/input_error.hpp"
#include "measured/files/arm_file.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace flexarm::diagnose {
namespace {

namespace fs = std::filesystem;
using measured::Purpose;
using testing::HasSubstr;

/// An experiment as files in a folder of its own.
class ExperimentFiles : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / ("flexarm-experiment-" + std::string(info->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path write(const Experiment& experiment) const {
    measured::Measurement measurement;
    measurement.arm = "arm.toml";
    measured::write_arm_file(experiment.arm, folder_ / "arm.toml");
    for (const auto& [run, data] : experiment.runs) {
      measurement.runs.push_back(run);
      measurement.runs.back().file = run.id + ".csv";
      measured::write_time_record(std::get<measured::TimeRecord>(data),
                                  folder_ / (run.id + ".csv"));
    }
    measured::write_measurement(measurement, folder_ / "measurement.toml");
    return folder_ / "measurement.toml";
  }

  static std::string refusal(const fs::path& file) {
    try {
      read_experiment(file);
    } catch (const arm::InputError& error) {
      return error.what();
    }
    return "";
  }

  fs::path folder_;
};

measured::TimeRecord& record_in(Experiment& experiment, std::size_t run) {
  return std::get<measured::TimeRecord>(experiment.runs[run].data);
}

TEST_F(ExperimentFiles, AreReadAsTheyWereWritten) {
  const Experiment made = simulated_experiment({}, {.duration_s = 1.0});
  const Experiment read = read_experiment(write(made));
  ASSERT_EQ(read.runs.size(), made.runs.size());
  EXPECT_EQ(read.arm, made.arm);
  EXPECT_EQ(read.runs[2].run.payload, made.runs[2].run.payload);
  EXPECT_EQ(std::get<measured::TimeRecord>(read.runs[0].data).channels,
            std::get<measured::TimeRecord>(made.runs[0].data).channels);
}

TEST_F(ExperimentFiles, WithADeadChannelLeaveItOutAndSaySo) {
  Experiment made = simulated_experiment({}, {.duration_s = 1.0});
  std::ranges::fill(record_in(made, 1).channels[2].values, 0.25);
  const Experiment read = read_experiment(write(made));
  EXPECT_EQ(std::get<measured::TimeRecord>(read.runs[1].data).channels.size(), 3U);
  EXPECT_THAT(read.notices, testing::Contains(HasSubstr("tip_acceleration excluded")));
}

TEST_F(ExperimentFiles, WithOutliersLeaveThemOutUnlessTheyAreAccepted) {
  const Experiment sound = simulated_experiment({}, {.duration_s = 1.0});
  Experiment made = sound;
  double& reading = record_in(made, 1).channels[2].values[300];
  const double before = reading;
  const double spike = 1e3;  // m/s^2; the largest of the run is a tenth of it
  reading += spike;
  const fs::path file = write(made);
  Experiment read = read_experiment(file);
  EXPECT_THAT(read.notices, testing::Contains(HasSubstr("tip_acceleration has a spike")));
  EXPECT_THAT(read.notices,
              testing::Contains(HasSubstr("1 of 500 readings of tip_acceleration in run "
                                          "random-high are outliers and are left out")));
  EXPECT_THAT(record_in(read, 1).channels[2].left_out, testing::ElementsAre(300));
  EXPECT_NEAR(record_in(read, 1).channels[2].values[300], before, 0.01 * spike);
  EXPECT_THAT(record_in(read, 0).channels[2].left_out, testing::IsEmpty());
  Experiment accepted = read_experiment(file, {measured::Fault::spikes});
  EXPECT_EQ(accepted.accepted.size(), 1U);
  EXPECT_THAT(accepted.notices, testing::Not(testing::Contains(HasSubstr("left out"))));
  EXPECT_EQ(record_in(accepted, 1).channels[2].values[300], before + spike);
  EXPECT_THAT(record_in(accepted, 1).channels[2].left_out, testing::IsEmpty());
}

TEST_F(ExperimentFiles, WithATorqueThatIsZeroAreRefused) {
  Experiment made = simulated_experiment({}, {.duration_s = 1.0});
  std::ranges::fill(record_in(made, 0).torque_N_m, 0.0);
  EXPECT_THAT(refusal(write(made)), HasSubstr("run random-low"));
}

TEST_F(ExperimentFiles, AllForValidationAreRefused) {
  Experiment made = simulated_experiment({}, {.duration_s = 1.0});
  for (auto& run : made.runs) run.run.purpose = Purpose::validation;
  EXPECT_THAT(refusal(write(made)), HasSubstr("needs at least one estimation run"));
}

std::vector<measured::MeasuredRun> runs_with_payloads(const std::vector<double>& masses_kg) {
  std::vector<measured::MeasuredRun> runs;
  for (const double mass : masses_kg) {
    measured::MeasuredRun run;
    run.run.id = "run " + std::to_string(runs.size());
    run.run.payload = arm::Payload{mass, 0.0};
    runs.push_back(run);
  }
  return runs;
}

TEST(SplitPurposes, KeepsTheLastRunOfThePayloadWithMost) {
  auto runs = runs_with_payloads({0.0, 0.0, 0.1});
  EXPECT_THAT(split_purposes(runs), HasSubstr("run 1 is used for validation"));
  EXPECT_EQ(runs[0].run.purpose, Purpose::estimation);
  EXPECT_EQ(runs[1].run.purpose, Purpose::validation);
  EXPECT_EQ(runs[2].run.purpose, Purpose::estimation);
}

TEST(SplitPurposes, LeavesASingleRunForEstimation) {
  auto runs = runs_with_payloads({0.0});
  EXPECT_THAT(split_purposes(runs), HasSubstr("there is no validation"));
  EXPECT_EQ(runs[0].run.purpose, Purpose::estimation);
}

TEST(SplitPurposes, TakesRunsThatSayNothingForEstimationBesideOneForValidation) {
  auto runs = runs_with_payloads({0.0, 0.1});
  runs[0].run.purpose = Purpose::validation;
  EXPECT_EQ(split_purposes(runs), "");
  EXPECT_EQ(runs[1].run.purpose, Purpose::estimation);
}

}  // namespace
}  // namespace flexarm::diagnose
