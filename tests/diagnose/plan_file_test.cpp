#include "arm/input_error.hpp"
#include "diagnose/planning/measurement_plan.hpp"
#include "measured/files/text_file.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace flexarm::diagnose {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* kWhole = R"(name = "bench"
[[run]]
id = "pulses"
kind = "time"
purpose = "estimation"
payload = { mass = 0.06, inertia = 1e-4 }
sensors = ["hub_angle", "strain@0.05"]
noise = { "strain@0.05" = 0.02 }
torque_hold = "first"
excitation = { kind = "chirp", amplitude = 0.2, to = 40, sweep = "linear" }
duration = 2.0
sample_time = 0.002
[[run]]
id = "response"
kind = "frf"
sensors = ["tip_acceleration"]
noise = 0.01
frequencies = { from = 0.5, to = 60.0, count = 3 }
[[run]]
id = "table"
kind = "modal"
poles = 3
zeros = { hub_angle = 2 }
)";

std::string refusal_of_plan(const std::string& text) {
  try {
    parse_measurement_plan(text, "plan.toml");
  } catch (const arm::InputError& error) {
    return error.what();
  }
  return "";
}

/// A `time` run with these lines more.
std::string time_run_with(const std::string& lines) {
  return "[[run]]\nid = \"a\"\nkind = \"time\"\nsensors = [\"hub_angle\"]\nduration = 2.0\n"
         "sample_time = 0.002\n" +
         lines;
}

TEST(MeasurementPlanFile, IsReadWhole) {
  const MeasurementPlan plan = parse_measurement_plan(kWhole, "plan.toml");
  EXPECT_EQ(plan.name, "bench");
  ASSERT_EQ(plan.runs.size(), 3U);
  const PlannedRun& pulses = plan.runs[0];
  EXPECT_EQ(pulses.purpose, measured::Purpose::estimation);
  EXPECT_EQ(pulses.payload, (arm::Payload{0.06, 1e-4}));
  EXPECT_EQ(pulses.torque_hold, measured::TorqueHold::first);
  EXPECT_EQ(pulses.sensors[0].noise, kPlannedNoise);
  EXPECT_EQ(pulses.sensors[1].noise, 0.02);
  EXPECT_EQ(torque_of(pulses).size(), 1000U);
  EXPECT_EQ(plan.runs[1].sensors[0].noise, 0.01);
  // The middle of three in equal ratios is the geometric mean.
  EXPECT_NEAR(frequencies_of(plan.runs[1])[1], std::sqrt(0.5 * 60.0), 1e-12);
  EXPECT_EQ(plan.runs[2].poles, 3);
  EXPECT_EQ(plan.runs[2].sensors[0].zeros, 2);
  EXPECT_EQ(plan.runs[2].noise, kPlannedModalNoise);
}

TEST(MeasurementPlanFile, ComesBackAsItWasWritten) {
  const std::string written = format_measurement_plan(parse_measurement_plan(kWhole, "plan.toml"));
  EXPECT_EQ(format_measurement_plan(parse_measurement_plan(written, "written.toml")), written);
  const MeasurementPlan plan = parse_measurement_plan(written, "written.toml");
  EXPECT_EQ(torque_of(plan.runs[0]),
            torque_of(parse_measurement_plan(kWhole, "plan.toml").runs[0]));
}

TEST(MeasurementPlanFile, TheExampleOfTheFormatsDocumentIsRead) {
  const std::string text = measured::read_text_file(FLEXARM_SOURCE_DIR "/docs/formats.md", 1 << 20);
  const auto heading = text.find("\n## Measurement plan");
  const auto begin = text.find('\n', text.find("```toml", heading)) + 1;
  const MeasurementPlan plan = parse_measurement_plan(
      text.substr(begin, text.find("```", begin) - begin), "docs/formats.md");
  EXPECT_EQ(plan.runs.size(), 3U);
}

TEST(MeasurementPlanFile, ThePlansBesideTheProgramAreRead) {
  for (const char* name : {"hub-response", "all-sensors-response", "modal-table", "three-runs"}) {
    const MeasurementPlan plan =
        read_measurement_plan(fmt::format("{}/data/plans/{}.toml", FLEXARM_SOURCE_DIR, name));
    EXPECT_FALSE(plan.runs.empty()) << name;
  }
}

TEST(MeasurementPlanFile, RefusesWhatItDoesNotKnowByLine) {
  EXPECT_THAT(refusal_of_plan(time_run_with("excitaton = { kind = \"step\" }\n")),
              testing::AllOf(StartsWith("plan.toml:7: run (time).excitaton: unknown key"),
                             HasSubstr("(did you mean excitation?)")));
  EXPECT_THAT(refusal_of_plan(time_run_with("poles = 3\n")),
              StartsWith("plan.toml:7: run (time).poles: unknown key"));
  EXPECT_THAT(refusal_of_plan(time_run_with("excitation = { kind = \"multisin\" }\n")),
              HasSubstr("did you mean multisine"));
  EXPECT_THAT(refusal_of_plan(time_run_with("excitation = { kind = \"step\", amplitud = 1 }\n")),
              testing::AllOf(StartsWith("plan.toml:7: run.excitation: "), HasSubstr("amplitude")));
  EXPECT_THAT(refusal_of_plan("[[run]]\nid = \"a\"\nkind = \"tim\"\n"),
              StartsWith("plan.toml:3: run.kind = \"tim\": must be time or frf or modal"));
  EXPECT_THAT(refusal_of_plan("[[run]]\nid = \"a\"\nkind = \"modal\"\npoles = 2.5\n"),
              StartsWith("plan.toml:4: run.poles = 2.5: a number; must be a whole number"));
  EXPECT_THAT(refusal_of_plan("arm = \"arm.toml\"\n"), StartsWith("plan.toml:1: arm"));
  EXPECT_THAT(refusal_of_plan("\n"), StartsWith("plan.toml:1: empty"));
}

TEST(MeasurementPlanFile, RefusesWhatCannotBe) {
  EXPECT_THAT(refusal_of_plan(time_run_with("")),
              StartsWith("plan.toml:1: run.excitation: missing"));
  EXPECT_THAT(refusal_of_plan(time_run_with("excitation = { kind = \"multisine\", to = 400 }\n")),
              StartsWith("plan.toml:7: run.excitation: "));
  EXPECT_THAT(refusal_of_plan(time_run_with("excitation = { kind = \"step\", amplitude = 0 }\n")),
              HasSubstr("plan.toml:7: run.excitation: "));
  EXPECT_THAT(refusal_of_plan(time_run_with("noise = 0.0\n")),
              StartsWith("plan.toml:7: run.noise = 0: must be a finite number above 0"));
  EXPECT_THAT(refusal_of_plan(time_run_with("noise = { hub_velocity = 0.1 }\n")),
              StartsWith("plan.toml:7: run.noise: hub_velocity is not among run.sensors"));
  EXPECT_THAT(refusal_of_plan("[[run]]\nid = \"a\"\nkind = \"frf\"\nsensors = [\"hub_angle\"]\n"
                              "frequencies = [2.0, 1.0]\n"),
              StartsWith("plan.toml:5: run.frequencies: must be one or more, ascending"));
  std::string many = "\"strain@0\"";
  for (int i = 1; i < 101; ++i) many += fmt::format(", \"strain@{}\"", 1e-4 * i);
  EXPECT_THAT(refusal_of_plan(fmt::format("[[run]]\nid = \"a\"\nkind = \"frf\"\nsensors = [{}]\n"
                                          "frequencies = [1.0]\n",
                                          many)),
              StartsWith("plan.toml:4: run.sensors: 101 names; must be 100 or fewer"));
}

}  // namespace
}  // namespace flexarm::diagnose
