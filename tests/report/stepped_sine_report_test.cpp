#include "report/tables/stepped_sine_report.hpp"

#include "report/tables/text_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <limits>
#include <string>
#include <vector>

namespace flexarm::report {
namespace {

using testing::HasSubstr;

/// Two bands, and a hub that does not move.
SteppedSineRun sine_run() {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  SteppedSineRun run;
  run.id = "fine";
  run.keys = {{"amplitude", "N m", "0.05"}};
  run.payload = {0.06, 0.0};
  run.sensors = {{arm::SensorKind::tip_acceleration}, {arm::SensorKind::hub_angle}};
  run.measured.frequency_Hz = {1.0, 1.1, 1.2, 9.0, 9.1};
  run.measured.values = {{{3.0, 4.0}, {1.0, 0.0}, {2.0, 0.0}, {0.0, 0.5}, {2.0, 1.0}},
                         {0.0, 0.0, 0.0, 0.0, 0.0}};
  run.measured.coherence = {{0.9, 0.8, 0.7, 0.6, 0.5}, {kNaN, kNaN, kNaN, kNaN, kNaN}};
  run.measured.noise_deviation = {0.01, 0.0};
  run.measured.summary.stops = 3;
  run.measured.summary.largest_change = 2e-9;
  return run;
}

TEST(SteppedSineReport, TellsWhereResponsesAreLargestAndSmallest) {
  const Table table = stepped_response_table({sine_run()});
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(std::get<std::string>(table.rows[0][2]), "m/s^2/(N m)");
  EXPECT_EQ(std::get<double>(table.rows[0][3]), 5.0);
  EXPECT_EQ(std::get<double>(table.rows[0][4]), 1.0);
  EXPECT_EQ(std::get<double>(table.rows[0][5]), 0.5);
  EXPECT_EQ(std::get<double>(table.rows[0][6]), 9.0);
  EXPECT_THAT(to_text(stepped_sine_table({sine_run()})), HasSubstr("2.0e-09"));
  EXPECT_EQ(std::get<std::int64_t>(stepped_hub_motion_table({sine_run()}).rows[0][2]), 3);
}

TEST(SteppedSineReport, DrawsASensorUnlessItReadsNothing) {
  const auto plots = stepped_sine_plots("rig", sine_run());
  ASSERT_EQ(plots.size(), 1U);
  EXPECT_EQ(plots[0].name, "fine-tip_acceleration");
  EXPECT_EQ(plots[0].figure.title, "rig, fine: torque to tip acceleration, stepped sine");
}

TEST(SteppedSineReport, IsAFrequencyRecordThatReadsBack) {
  const auto record = frequency_record(sine_run());
  EXPECT_EQ(measured::parse_frequency_record(measured::format_frequency_record(record), "x.csv"),
            record);
  EXPECT_EQ(record.channels[0].response[0], (std::complex<double>(3.0, 4.0)));
}

TEST(SteppedSineReport, UnknownCoherenceIsNullInJson) {
  const auto json = nlohmann::json::parse(stepped_runs_json({sine_run()}).dump());
  EXPECT_EQ(json[0]["channels"][0]["coherence"][4], 0.5);
  EXPECT_TRUE(json[0]["channels"][1]["coherence"][0].is_null());
  EXPECT_EQ(json[0]["channels"][0]["im"][0], 4.0);
}

}  // namespace
}  // namespace flexarm::report
