#include "arm/input_error.hpp"
#include "effects/registry/vocabulary.hpp"
#include "measured/files/arm_file.hpp"
#include "measured/files/frequency_record.hpp"
#include "measured/files/measurement.hpp"
#include "measured/files/run_data.hpp"
#include "tests/app/flexarm_fixture.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>

namespace flexarm::testing_app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

class Import : public Flexarm {
 protected:
  Ended import(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "import");
    return run(arguments);
  }
  measured::RunData run_in(const std::string& folder) const {
    const fs::path file = folder_ / folder / "measurement.toml";
    return measured::read_run(file, measured::read_measurement(file).runs.at(0));
  }
};

constexpr const char* kLog =
    "Recorder 4.1;;;\nTime (ms);Moment (Nmm);Theta (deg);Room\n0;1,5;90;20,1\n2;-3;0;20,2\n"
    "4;0;-90;20,2\n";

TEST_F(Import, ALogIsReadAndWhatWasAssumedIsSaid) {
  write("log.txt", kLog);
  const Ended ended = import({"log.txt", "--json", "out.json"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(
      ended.output,
      AllOf(StartsWith("log.txt: delimited text, read as time\n"), HasSubstr("names are in line 2"),
            HasSubstr("separated by semicolons"), HasSubstr("decimal comma"),
            HasSubstr("Moment (Nmm)"), HasSubstr("N mm"), HasSubstr("not used: Room"),
            HasSubstr("3 samples, one every 0.002 s"), HasSubstr("next: ")));
  const Json json = Json::parse(text_of("out.json"));
  EXPECT_EQ(json["files"][0]["kind"], "time");
  EXPECT_EQ(json["files"][0]["columns"][0]["name"], "Theta (deg)");
  EXPECT_EQ(json["runs"][0]["samples"], 3);
  EXPECT_THAT(names_in(), ElementsAre("log.txt", "out.json"));
}

TEST_F(Import, TheFolderIsAMeasurementInSi) {
  write("log.txt", kLog);
  run({"new", "rig.toml"});
  const Ended ended = import({"log.txt", "--arm", "rig.toml", "--out", "bench", "--id", "step",
                              "--purpose", "validation", "--initial", "free", "--hold", "first",
                              "--payload-mass", "0.06", "--name", "14 May"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(names_in("bench"), ElementsAre("arm.toml", "measurement.toml", "step.csv"));
  EXPECT_EQ(text_of("bench/arm.toml"), text_of("rig.toml"));
  const auto measurement = measured::read_measurement(folder_ / "bench/measurement.toml");
  EXPECT_EQ(measurement.name, "14 May");
  EXPECT_EQ(measurement.runs.at(0),
            (measured::Run{"step", measured::RunKind::time, "step.csv",
                           measured::Purpose::validation, measured::TorqueHold::first,
                           arm::Payload{0.06, 0.0}, measured::InitialState::free}));
  const auto record = std::get<measured::TimeRecord>(run_in("bench"));
  EXPECT_THAT(record.time_s, ElementsAre(0.0, 0.002, 0.004));
  EXPECT_THAT(record.torque_N_m, ElementsAre(0.0015, -0.003, 0.0));
  EXPECT_EQ(record.channels.at(0).values[0], std::numbers::pi / 2.0);
}

/// No command takes another arm for the one that was measured.
TEST_F(Import, WithoutAnArmAFileToFillInIsWritten) {
  write("log.txt", kLog);
  const Ended ended = import({"log.txt", "--out", "bench"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output, HasSubstr("arm.toml (its numbers are to be filled in)"));
  const Ended diagnosed = run({"diagnose", "bench/measurement.toml"});
  EXPECT_EQ(diagnosed.status, 2);
  EXPECT_THAT(diagnosed.errors,
              AllOf(StartsWith("bench/arm.toml:"), HasSubstr("beam.length: missing; must be")));
  EXPECT_THAT(import({"log.txt", "--out", "bench"}).errors, HasSubstr("--force replaces"));
  EXPECT_EQ(import({"log.txt", "--out", "bench", "--force"}).status, 0);
}

/// Each key that is filled in takes the next fault away, until none is left.
TEST_F(Import, TheArmFileToFillInIsOneOnceItIsFilledIn) {
  write("log.txt", kLog);
  import({"log.txt", "--out", "bench"});
  std::string text = text_of("bench/arm.toml");
  const auto fill = [&](const std::string& key, const std::string& value) {
    const std::string line = "# " + key + " =";
    const auto at = text.find(line);
    ASSERT_NE(at, std::string::npos) << key;
    text.replace(at, line.size(), key + " = " + value);
  };
  const auto read = [&] { return measured::parse_arm(text, "arm.toml", effects::vocabulary()); };
  EXPECT_THROW(read(), arm::InputError);
  fill("length", "0.45");
  fill("flexural_rigidity", "0.2455");
  fill("linear_density", "0.133");
  EXPECT_THROW(read(), arm::InputError);
  fill("inertia", "0.002");
  EXPECT_EQ(read().beam.length_m, 0.45);
  EXPECT_EQ(read().hub.inertia_kg_m2, 0.002);
}

/// A log of the shape of the flexible-link rig's: current in place of torque, angles in degrees.
std::string rig_shaped_log() {
  std::string log = "t_s,i1_cmd_A,i1_meas_A,hub1_ref_deg,hub1_deg,tipdefl1_deg,hub2_deg\n";
  for (int k = 0; k < 50; ++k) {
    log += fmt::format("{},{},{},-25,{},{},9.8\n", k * 2 / 1000.0, 0.1, 0.001 * k, 0.5 * k - 25.0,
                       0.01 * k);
  }
  return log;
}

const std::vector<std::string> kRigMapping = {
    "--column", "torque=i1_meas_A:A:8.925",
    "--column", "hub_angle=hub1_deg",
    "--column", "tip_deflection=tipdefl1_deg:deg:0.202*pi/180"};

TEST_F(Import, ALogOfTheRigsShapeNeedsOneMapping) {
  write("rig.csv", rig_shaped_log());
  const Ended bare = import({"rig.csv"});
  expect_refused(
      bare,
      "rig.csv: torque: column not recognised; columns: t_s, i1_cmd_A, i1_meas_A, hub1_ref_deg, "
      "hub1_deg, tipdefl1_deg, hub2_deg; assign one with --column "
      "torque=NAME:UNIT:SCALE, compute it with --torque EXPRESSION, or state a free decay with "
      "--torque 0 --initial free");
  const Ended several = import({"rig.csv", "rig.csv"});
  EXPECT_THAT(several.errors, testing::EndsWith("; if the files are of one run, add --join\n"));
  std::vector<std::string> arguments = {"rig.csv", "--out", "rig"};
  arguments.insert(arguments.end(), kRigMapping.begin(), kRigMapping.end());
  const Ended ended = import(arguments);
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output, HasSubstr("not used: i1_cmd_A, hub1_ref_deg, hub2_deg"));
  const auto record = std::get<measured::TimeRecord>(run_in("rig"));
  EXPECT_EQ(record.time_s[49], 0.098);
  EXPECT_EQ(record.torque_N_m[10], 0.01 * 8.925);
  ASSERT_EQ(record.channels.size(), 2U);
  EXPECT_EQ(record.channels[0].values[0], -25.0 * std::numbers::pi / 180.0);
  EXPECT_EQ(record.channels[1].values[10], 0.1 * (0.202 * std::numbers::pi / 180.0));
}

TEST_F(Import, TheRigsOwnLogNeedsTheSameMappingAndNoEdit) {
  const fs::path log =
      fs::path(FLEXARM_SOURCE_DIR) / "../shared/data/flexible-link-rig/run-20s.csv";
  if (!fs::exists(log)) GTEST_SKIP() << "no rig log beside the sources";
  std::vector<std::string> arguments = {log.string(), "--out", "rig", "--initial", "free"};
  arguments.insert(arguments.end(), kRigMapping.begin(), kRigMapping.end());
  const Ended ended = import(arguments);
  EXPECT_EQ(ended.status, 0) << ended.errors;
  const auto record = std::get<measured::TimeRecord>(run_in("rig"));
  ASSERT_EQ(record.time_s.size(), 10000U);
  EXPECT_EQ(record.time_s[1], 0.002);
  EXPECT_EQ(record.torque_N_m[0], 0.0897216797 * 8.925);
  EXPECT_EQ(record.channels.at(0).values[0], -25.3652344 * std::numbers::pi / 180.0);
  EXPECT_EQ(record.channels.at(1).values[0], 0.00903190048 * (0.202 * std::numbers::pi / 180.0));
}

TEST_F(Import, EveryFormatGivesTheSameRecordAgain) {
  write("rig.csv", rig_shaped_log());
  std::vector<std::string> arguments = {"rig.csv", "--out", "rig"};
  arguments.insert(arguments.end(), kRigMapping.begin(), kRigMapping.end());
  ASSERT_EQ(import(arguments).status, 0);
  const std::string csv = text_of("rig/rig.csv");
  for (const auto& [name, format] :
       {std::pair{"a.uff", ""}, {"b.uff", "uff58b"}, {"c.mat", ""}, {"d.txt", "csv"}}) {
    std::vector<std::string> save = {"rig/rig.csv", "--save-as", name};
    if (*format != '\0') save.insert(save.end(), {"--to", format});
    const Ended saved = import(save);
    EXPECT_EQ(saved.status, 0) << saved.errors;
    EXPECT_EQ(import({name, "--save-as", "again.csv"}).status, 0) << name;
    EXPECT_EQ(text_of("again.csv"), csv) << name;
  }
}

TEST_F(Import, FrequencyRecordsAndModalTablesAreReadToo) {
  write("f.csv",
        "# bench\nfrequency [Hz];sensor;re;im;coherence\n0,5;hub_angle;-2;0,25;0,99\n"
        "1;hub_angle;-1;0;\n");
  ASSERT_EQ(import({"f.csv", "--out", "f"}).status, 0);
  EXPECT_EQ(std::get<measured::FrequencyRecord>(run_in("f")).channels.at(0).response[0],
            std::complex<double>(-2.0, 0.25));
  ASSERT_EQ(import({"f.csv", "--save-as", "f.uff"}).status, 0);
  ASSERT_EQ(import({"f.uff", "--out", "g"}).status, 0);
  EXPECT_EQ(run_in("g"), run_in("f"));
  expect_refused(
      import({"f.uff", "--time-unit", "ms"}),
      "--compute, --torque, --time-unit, --reference, --own-rate: only for time signals");
  write("m.csv", "sensor,feature,order,frequency [Hz]\n,pole,1,11.8\nhub_angle,zero,1,2.9\n");
  ASSERT_EQ(import({"m.csv", "--out", "m"}).status, 0);
  EXPECT_EQ(std::get<measured::ModalTable>(run_in("m")).size(), 2U);
  write("bad.csv", "frequency [Hz],sensor,re,im\n0.5,hub_angle,-2,0.25\n0.4,hub_angle,-2,0.25\n");
  EXPECT_THAT(import({"bad.csv"}).errors, StartsWith("bad.csv:3: frequency [Hz] = 0.4: below"));
}

TEST_F(Import, TimesMayComeFromAPeriod) {
  write("log.txt", "torque [N m],hub_angle [rad]\n0,1\n1,2\n2,3\n");
  EXPECT_THAT(import({"log.txt"}).errors, HasSubstr("or the sampling period with --period"));
  ASSERT_EQ(import({"log.txt", "--period", "0.003", "--out", "bench"}).status, 0);
  EXPECT_THAT(std::get<measured::TimeRecord>(run_in("bench")).time_s,
              ElementsAre(0.0, 0.003, 0.006));
}

TEST_F(Import, WhatCannotBeUsedIsOneLine) {
  write("log.txt", kLog);
  const auto refused = [&](std::vector<std::string> arguments, const std::string& line) {
    arguments.insert(arguments.begin(), "log.txt");
    expect_refused(import(arguments), line);
  };
  refused({"--column", "torque=Momnt"},
          "--column torque=Momnt: column Momnt: not in the file (did you mean Moment (Nmm)?); it "
          "has Time (ms), Moment "
          "(Nmm), Theta (deg), Room");
  refused({"--column", "torqe=Room"},
          "--column torqe=Room: torqe: unknown (did you mean "
          "torque?)");
  refused({"--column", "torque=Room:V"},
          "--column torque=Room:V: unit = V: not one of N m, N mm, N cm, kN m, MN m, kgf cm, lbf "
          "in, lbf "
          "ft, ozf in, uN m, cN m, daN m, gf cm; give scale in N m per V");
  refused({"--column", "torque=Room:V:x"},
          "--column torque=Room:V:x: scale = x: must be a product of numbers and pi, as "
          "in 0.202*pi/180");
  refused({"--kind", "tme"}, "--kind tme: must be time or frf or modal (did you mean time?)");
  refused({"--kind", "frf"},
          "--kind frf: no columns of a frequency response are recognised; state the parts with "
          "--column frequency=NAME:Hz, --column hub_angle.magnitude=NAME:dB and --column "
          "hub_angle.phase=NAME:deg, or hub_angle.real and hub_angle.imaginary");
  refused({"--save-as", "a.xls"},
          "--save-as a.xls: must be a .csv, .uff or .mat file, or used with --to csv or uff58 or "
          "uff58b or mat");
  refused({"--to", "uff", "--save-as", "a.uff"}, "--to uff: must be csv or uff58 or uff58b or mat");
  refused({"--to", "mat"}, "--to: needs --save-as");
  EXPECT_THAT(import({"none.txt"}).errors, StartsWith("none.txt: "));
  EXPECT_THAT(names_in(), ElementsAre("log.txt"));
}

TEST_F(Import, TheExampleOfTheHelpWorks) {
  const Ended help = import({"--help"});
  run({"simulate", "--duration", "1", "--period", "0.002", "--reference", "bang-bang",
       "--controller", "kp=0.2,kd=0.01", "--out", "simulated"});
  const Ended ended = run(example_in(help.output));
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output, HasSubstr("wrote measured: measurement.toml"));
}

}  // namespace
}  // namespace flexarm::testing_app
