#include "measured/files/run_data.hpp"

#include "arm/input_error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

namespace flexarm::measured {
namespace {

using arm::Sensor;
using arm::SensorKind;
using testing::ElementsAre;
using testing::StartsWith;

/// A measurement's folder of its own, removed afterwards.
class RunDataTest : public testing::Test {
 protected:
  RunDataTest() {
    std::string name = (std::filesystem::temp_directory_path() / "flexarm-test-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~RunDataTest() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  RunData read(const measured::Run& run) const { return read_run(folder_ / "m.toml", run); }
  std::string refusal(const measured::Run& run) const {
    try {
      read(run);
    } catch (const arm::InputError& error) {
      const std::string what = error.what();
      EXPECT_THAT(what, StartsWith(folder_.string()));
      return what.substr(folder_.string().size() + 1);
    }
    return "accepted";
  }

  std::filesystem::path folder_;
};

TEST_F(RunDataTest, EachKindIsReadAsWhatItIs) {
  write("t.csv", "time [s],torque [N m]\n0,1\n1,2\n");
  write("f.csv", "frequency [Hz],sensor,re,im,coherence\n1,hub_angle,1,0,1\n");
  write("p.csv", "sensor,feature,order,frequency [Hz]\nhub_angle,pole,1,11.8\n");
  EXPECT_EQ(std::get<TimeRecord>(read({"a", RunKind::time, "t.csv"})).torque_N_m[1], 2.0);
  EXPECT_EQ(std::get<FrequencyRecord>(read({"a", RunKind::frf, "f.csv"})).channels.size(), 1U);
  EXPECT_EQ(std::get<ModalTable>(read({"a", RunKind::modal, "p.csv"})).size(), 1U);
}

/// value [SI] = number * scale * factor of the unit.
TEST_F(RunDataTest, AForeignLogIsReadThroughItsColumns) {
  write("log.txt",
        "bench 3\nTime (ms);Vm;enc;tip;hub_velocity [deg/s];spare\n"
        "0;1,5;90;2;180;7\n2;-2;-90;4;0;8\n");
  measured::Run run{"a", RunKind::time, "log.txt"};
  run.columns = {{"time", {"Time (ms)", "ms", 1.0}},
                 {"torque", {"Vm", "V", 0.0215}},
                 {"hub_angle", {"enc", "deg", -2.0}},
                 {"tip_deflection", {"tip", "deg", 0.25}}};
  const auto record = std::get<TimeRecord>(read(run));
  EXPECT_THAT(record.time_s, ElementsAre(0.0, 0.002));
  EXPECT_THAT(record.torque_N_m, ElementsAre(1.5 * 0.0215, -2.0 * 0.0215));
  ASSERT_EQ(record.channels.size(), 3U);  // in the order of the log
  EXPECT_EQ(record.channels[0].sensor, (Sensor{SensorKind::hub_angle, 0.0}));
  EXPECT_THAT(record.channels[0].values, ElementsAre(-std::numbers::pi, std::numbers::pi));
  EXPECT_THAT(record.channels[1].values, ElementsAre(0.5, 1.0));
  EXPECT_THAT(record.channels[2].values, ElementsAre(std::numbers::pi, 0.0));
}

TEST_F(RunDataTest, WhatAForeignLogLacksIsSaid) {
  write("log.txt", "t,Vm,enc\n0,1,2\n1,1,\n2,1,3\n");
  measured::Run run{"a", RunKind::time, "log.txt"};
  run.columns = {{"time", {"t", "s", 1.0}}};
  EXPECT_EQ(refusal(run), "log.txt: torque: no column assigned; columns: t, Vm, enc");
  run.columns["torque"] = {"end", "N m", 1.0};
  EXPECT_EQ(refusal(run),
            "log.txt: column end: not in the file (did you mean enc?); it has t, Vm, enc");
  run.columns["torque"] = {"t", "N m", 1.0};
  EXPECT_EQ(refusal(run), "log.txt: column t: assigned to time and torque");
  run.columns["torque"] = {"Vm", "N m", 1.0};
  run.columns["hub_angle"] = {"enc", "rad", 1.0};
  EXPECT_EQ(refusal(run),
            "log.txt:3: hub_angle: column enc = nan (or an empty cell): must be a finite number; "
            "flexarm import takes such rows as missing samples");
  write("log.txt", "t,Vm,enc\n0,1,2\n1,1,2\n1,1,3\n");
  EXPECT_EQ(refusal(run),
            "log.txt:4: time = 1 s: same as the previous sample; must be strictly increasing");
}

TEST_F(RunDataTest, AFileThatIsMissingIsSaid) {
  EXPECT_THAT(refusal({"a", RunKind::frf, "none.csv"}), StartsWith("none.csv: "));
}

}  // namespace
}  // namespace flexarm::measured
