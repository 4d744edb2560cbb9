#include "measured/files/measurement.hpp"
#include "measured/files/run_data.hpp"
#include "tests/app/flexarm_fixture.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <variant>
#include <vector>

namespace flexarm::testing_app {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr double kOneDegree = std::numbers::pi / 180.0;

class ImportLanguage : public Flexarm {
 protected:
  /// The record that a log is imported as, with the options.
  measured::TimeRecord record_of(const std::string& text, std::vector<std::string> options = {}) {
    write("log.csv", text);
    std::vector<std::string> arguments = {"import", "log.csv", "--out", "measured"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Ended ended = run(arguments);
    EXPECT_EQ(ended.status, 0) << ended.errors;
    output_ = ended.output;
    const auto file = folder_ / "measured" / "measurement.toml";
    const auto measurement = measured::read_measurement(file);
    return std::get<measured::TimeRecord>(measured::read_run(file, measurement.runs.front()));
  }
  std::string refusal_of(const std::string& text) {
    write("log.csv", text);
    const Ended ended = run({"import", "log.csv", "--out", "refused"});
    EXPECT_EQ(ended.status, 2) << ended.output;
    EXPECT_EQ(std::ranges::count(ended.errors, '\n'), 1) << ended.errors;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "refused"));
    return ended.errors;
  }
  static std::vector<std::string> sensors_of(const measured::TimeRecord& record) {
    std::vector<std::string> names;
    for (const auto& channel : record.channels) names.push_back(arm::to_string(channel.sensor));
    return names;
  }

  std::string output_;
};

/// As a data logger of a German laboratory writes it: Latin-1, CRLF, semicolons, decimal commas,
/// lines in front, units in a row of their own.
constexpr const char* kLatin1Log =
    "Pr\xfc"
    "fstand 3;14.05.2026\r\n"
    "Zeit;Drehmoment;Winkel;Winkelgeschwindigkeit;Beschleunigung;Dehnung\r\n"
    "s;Nm;\xb0;\xb0/s;m/s\xb2;\xb5m/m\r\n"
    "0,000;0,10;0,0;0,0;0,1;1,0\r\n"
    "0,002;0,10;0,1;0,2;0,3;2,0\r\n"
    "0,004;0,20;0,2;0,4;0,2;3,0\r\n";

TEST_F(ImportLanguage, ALatin1LogOfAGermanLoggerIsMapped) {
  const auto record = record_of(kLatin1Log);
  EXPECT_THAT(sensors_of(record), ElementsAre("hub_angle", "hub_velocity", "tip_acceleration"));
  EXPECT_EQ(record.time_s[1], 0.002);
  EXPECT_EQ(record.torque_N_m[2], 0.2);
  EXPECT_NEAR(record.channels[0].values[1], 0.1 * kOneDegree, 1e-15);
  EXPECT_NEAR(record.channels[1].values[2], 0.4 * kOneDegree, 1e-15);
  EXPECT_EQ(record.channels[2].values[1], 0.3);
  EXPECT_THAT(output_, HasSubstr("warning: not imported: Dehnung may be a strain"));
  EXPECT_THAT(output_, HasSubstr("--column 'strain@X=Dehnung'"));
}

TEST_F(ImportLanguage, AStatedGaugeIsImportedWithoutAWarning) {
  const auto record = record_of(kLatin1Log, {"--column", "strain@0.05=Dehnung"});
  ASSERT_EQ(record.channels.size(), 4U);
  EXPECT_NEAR(record.channels[3].values[1], 2e-6, 1e-20);
  EXPECT_THAT(output_, Not(HasSubstr("warning")));
}

TEST_F(ImportLanguage, AUtf8LogWithAMarkAndUnitsInBracketsIsMapped) {
  const auto record = record_of(
      "\xef\xbb\xbf"
      "Zeit [ms];Motormoment [Nm];Drehwinkel [\xc2\xb0];Drehzahl [U/min];"
      "Durchbiegung [mm]\n"
      "0,0;0,1;0,0;1,5;0,5\n2,0;0,1;0,1;3,0;1,5\n4,0;0,1;0,1;3,0;1,5\n");
  EXPECT_THAT(sensors_of(record), ElementsAre("hub_angle", "hub_velocity", "tip_deflection"));
  EXPECT_EQ(record.time_s[1], 0.002);
  EXPECT_NEAR(record.channels[1].values[1], 3.0 * 2.0 * std::numbers::pi / 60.0, 1e-15);
  EXPECT_NEAR(record.channels[2].values[0], 0.5e-3, 1e-18);
}

TEST_F(ImportLanguage, AFrenchLogIsMapped) {
  const auto record = record_of(
      "temps (s);couple (N.m);angle (degr\xc3\xa9s);vitesse (tr/min);acc\xc3\xa9l\xc3\xa9ration\n"
      "0,0;0,1;0,0;1,5;0,5\n0,1;0,1;0,1;3,0;1,5\n0,2;0,1;0,1;3,0;1,5\n");
  EXPECT_THAT(sensors_of(record), ElementsAre("hub_angle", "hub_velocity", "tip_acceleration"));
  EXPECT_NEAR(record.channels[0].values[1], 0.1 * kOneDegree, 1e-15);
}

TEST_F(ImportLanguage, WhatIsNotSureIsAskedInOneLine) {
  EXPECT_THAT(
      refusal_of("Zeit [s];Strom [A];Winkel [rad]\n0,0;0,1;0,0\n0,1;0,1;0,1\n"),
      HasSubstr(
          "Strom [A] may be a motor current; state it with --torque 'K*[Strom]', K in N m/A"));
  EXPECT_THAT(refusal_of("Zeit;Spannung;Winkel\n0,0;0,1;0,0\n0,1;0,1;0,1\n"),
              HasSubstr("--torque 'K*[Spannung]', K in N m/V"));
  EXPECT_THAT(refusal_of("Zeit;Moment;Auslenkung\n0,0;0,1;0,0\n0,1;0,1;0,1\n"),
              HasSubstr("--column 'tip_deflection=Auslenkung' (relative to the rigid arm) or "
                        "--column 'tip_displacement=Auslenkung' (absolute)"));
  EXPECT_THAT(refusal_of("Zeit [s];Moment [Nm];Geschwindigkeit [m/s]\n0,0;0,1;0,0\n0,1;0,1;0,1\n"),
              HasSubstr("Geschwindigkeit [m/s] may be hub_velocity, but m/s is no unit of it"));
  EXPECT_THAT(refusal_of("Zeit;Moment;Drehmoment;Winkel\n0,0;0,1;0,0;1\n0,1;0,1;0,1;1\n"),
              HasSubstr("torque: Moment or Drehmoment? Choose one with --column torque=NAME"));
}

/// What the question says to type works.
TEST_F(ImportLanguage, TheAnswerToAQuestionIsTaken) {
  const auto record = record_of("Zeit;Strom;Winkel\n0,0;0,5;0,0\n0,1;1,0;0,1\n0,2;1,0;0,1\n",
                                {"--torque", "0.15*[Strom]"});
  EXPECT_NEAR(record.torque_N_m[0], 0.075, 1e-15);
  EXPECT_THAT(sensors_of(record), ElementsAre("hub_angle"));
}

}  // namespace
}  // namespace flexarm::testing_app
