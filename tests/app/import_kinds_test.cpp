// Kinds of files that laboratories have, imported by the program as a user would.
#include "measured/files/measurement.hpp"
#include "measured/files/modal_table.hpp"
#include "measured/files/universal_file.hpp"
#include "tests/app/import_files.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

namespace flexarm::testing_app {
namespace {

using measured::InitialState;
using measured::TimeRecord;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class ImportKinds : public ImportFiles {};

constexpr int kRows = 400;
constexpr double kPeriod_s = 0.005;

/// The angle in row 250 is empty_cell twice; where it is "-", the two rows are absent.
std::string log_with_gap(const std::string& empty_cell) {
  std::string text = "Time (s),Torque (N m),Theta (deg)\n";
  for (int k = 0; k < kRows; ++k) {
    const bool is_missing = k == 250 || k == 251;
    if (is_missing && empty_cell == "absent") continue;
    text += fmt::format("{:.3f},{:.5f},{}\n", kPeriod_s * k, std::sin(0.1 * k),
                        is_missing ? empty_cell : fmt::format("{:.5f}", std::cos(0.1 * k)));
  }
  return text;
}

TEST_F(ImportKinds, EmptyCellsAreMissingSamples) {
  write("absent.csv", log_with_gap("absent"));
  const auto absent = imported({"absent.csv"});
  const auto& expected = std::get<TimeRecord>(absent.data);
  ASSERT_EQ(expected.time_s.size(), static_cast<std::size_t>(kRows));
  EXPECT_EQ(expected.time_s[0], 0.0);
  EXPECT_EQ(expected.time_s[1], kPeriod_s);
  EXPECT_EQ(absent.run.initial, InitialState::rest);
  EXPECT_THAT(output_, Not(HasSubstr("initial state free")));
  for (const auto* cell : {"", "NaN", "nan", "N/A", "-"}) {
    write("cells.csv", log_with_gap(cell));
    EXPECT_EQ(record({"cells.csv"}), expected) << cell;
    EXPECT_THAT(output_, HasSubstr("2 of 400 rows left out, as missing samples"));
  }
  EXPECT_EQ(record({"cells.csv", "--rows", "253:"}).time_s.size(), 148U);
  EXPECT_EQ(record({"cells.csv", "--times", "1.26:"}).time_s.front(), 1.26);
  EXPECT_EQ(record({"cells.csv", "--rows", ":250"}).time_s.size(), 250U);
  EXPECT_EQ(record({"cells.csv", "--run", "a=rows:1:250"}).time_s.size(), 250U);
  const Ended split = import({"cells.csv", "--fill-gaps", "1"});
  EXPECT_THAT(split.output, AllOf(HasSubstr("run cells-1"), HasSubstr("run cells-2")));
}

TEST_F(ImportKinds, MissingSamplesOfAJoinedFileAreMissingSamplesOfTheRun) {
  std::string torque = "t [s],torque [N m]\n";
  for (int k = 0; k < 400; ++k) torque += fmt::format("{:.3f},{}\n", 0.005 * k, k % 7);
  write("torque.csv", torque);
  // The angle at other times; `cell` stands in rows 300 to `last`, and 9.9E37 at 1 s.
  const auto write_angle = [&](const std::string& cell, int last) {
    std::string angle = "t [s],hub_angle [rad]\n";
    for (int k = 0; k < 1000; ++k) {
      const std::string number = fmt::format("{:.9f}", std::sin(0.006 * k));
      const bool is_unread = !cell.empty() && k == 500;
      const bool is_missing = !cell.empty() && k >= 300 && k < last;
      angle += fmt::format("{:.3f},{}\n", 0.002 * k,
                           is_unread    ? "9.9E37"
                           : is_missing ? (cell == "-" ? "" : cell)
                                        : number);
    }
    write("angle.csv", angle);
  };
  const std::vector<std::string> join = {"torque.csv", "angle.csv", "--join", "--join-grid",
                                         "first"};
  write_angle("", 0);
  const auto whole = record(join);
  for (const auto* cell : {"-", "NaN", "N/A"}) {
    write_angle(cell, 302);
    const auto joined = record(join);
    ASSERT_EQ(joined.time_s.size(), whole.time_s.size()) << cell;
    EXPECT_EQ(joined.torque_N_m.size(), whole.torque_N_m.size());
    for (std::size_t k = 0; k < joined.time_s.size(); ++k) {
      // A line over 10 ms of the sine is off by 1.1e-4.
      EXPECT_NEAR(joined.channels[0].values[k], whole.channels[0].values[k], 2e-4) << k;
    }
    EXPECT_THAT(output_, AllOf(HasSubstr("as missing samples"),
                               HasSubstr("1 cell of column hub_angle [rad] with 9.9e+37")));
  }
  write_angle("-", 400);
  EXPECT_THAT(import(join).output, AllOf(HasSubstr("run torque-1"), HasSubstr("run torque-2")));
}

TEST_F(ImportKinds, SignalsByNameAreRead) {
  std::string torque;
  std::string angle;
  std::string rows = "time,signal,value,unit\n";
  for (int k = 0; k < 20; ++k) {
    torque += fmt::format("{}{}", k == 0 ? "" : ",", k);
    angle += fmt::format("{}{}", k == 0 ? "" : ",", 10 * k);
    rows += fmt::format("{0:.3f},tau,{1},N mm\n{0:.3f},theta,{2},deg\n", 0.005 * k, k, 10 * k);
  }
  write("signals.json", fmt::format(R"([{{"name":"tau","unit":"N mm","data":[{}],"dt":0.005}},)"
                                    R"({{"name":"theta","unit":"deg","data":[{}],"dt":0.005}}])",
                                    torque, angle));
  write("rows.csv", rows);
  for (const auto* file : {"signals.json", "rows.csv"}) {
    const auto made = record({file});
    ASSERT_EQ(made.time_s.size(), 20U) << file;
    EXPECT_DOUBLE_EQ(made.time_s[19], 0.095);
    EXPECT_DOUBLE_EQ(made.torque_N_m[19], 0.019);
    EXPECT_DOUBLE_EQ(made.channels.at(0).values[18], std::numbers::pi);
  }
  write("rows.csv", rows + "0.000,tau,3,N mm\n");
  expect_refused(import({"rows.csv"}),
                 "rows.csv: tau: a second value at time = 0 in line 42; must have one at a time");
}

TEST_F(ImportKinds, ATorqueOfItsOwnRateIsHeldWhereThatIsStated) {
  std::string text = "t [s],torque [N m],hub_angle [rad]\n";
  for (int k = 0; k < 100; ++k) {
    text +=
        fmt::format("{:.3f},{},{}\n", 0.001 * k, k % 5 == 0 ? fmt::format("{}", k) : "", 0.1 * k);
  }
  write("rates.csv", text);
  expect_refused(
      import({"rates.csv"}),
      "rates.csv: torque: column torque [N m] has a number in one of 5 rows alone, written "
      "at its own rate; state what stands between with --own-rate torque=hold (the "
      "number above), torque=linear, or torque=rows (only the rows that have all numbers)");
  const auto held = record({"rates.csv", "--own-rate", "torque=hold"});
  ASSERT_EQ(held.time_s.size(), 100U);
  EXPECT_EQ(held.torque_N_m[9], 5.0);
  EXPECT_EQ(record({"rates.csv", "--own-rate", "torque=rows"}).time_s.size(), 20U);
  expect_refused(
      import({"rates.csv", "--own-rate", "torque=maybe"}),
      "--own-rate torque=maybe: must be QUANTITY=hold, QUANTITY=linear or QUANTITY=rows");
}

TEST_F(ImportKinds, AScaleIsInItsUnit) {
  std::string text = "t,tau,th\n";
  for (int k = 0; k < 20; ++k) text += fmt::format("{},{},90\n", 2 * k, k);
  write("scale.csv", text);
  const auto angle = [&](const std::string& column) {
    return record(
               {"scale.csv", "--column", column, "--column", "time=t:ms", "--column", "torque=tau"})
        .channels.front()
        .values.front();
  };
  constexpr double kPi = std::numbers::pi;
  EXPECT_DOUBLE_EQ(angle("hub_angle=th:deg"), kPi / 2.0);
  EXPECT_DOUBLE_EQ(angle("hub_angle=th:deg:pi/180"), kPi / 2.0);
  EXPECT_THAT(output_,
              HasSubstr("hub_angle: SCALE 0.0174533 is the conversion of deg itself; applied "
                        "once"));
  EXPECT_DOUBLE_EQ(angle("hub_angle=th:deg:-0.01745"), -kPi / 2.0);
  EXPECT_DOUBLE_EQ(angle("hub_angle=th:deg:2"), kPi);
  EXPECT_DOUBLE_EQ(angle("hub_angle=th:mrad:0.001"), 0.09);
  EXPECT_DOUBLE_EQ(angle("hub_angle=th:mrad:2"), 0.18);
  EXPECT_DOUBLE_EQ(angle("hub_angle=th:rad:0.99"), 0.99 * 90.0);
  EXPECT_DOUBLE_EQ(angle("hub_velocity=th:rpm:2*pi/60"), 3.0 * kPi);
  EXPECT_DOUBLE_EQ(angle("hub_velocity=th:rpm:1/50"), 3.0 * kPi / 50.0);
  EXPECT_DOUBLE_EQ(angle("hub_velocity=th:deg/s:pi/180"), kPi / 2.0);
  EXPECT_DOUBLE_EQ(angle("tip_displacement=th:mm:0.001"), 0.09);
  EXPECT_DOUBLE_EQ(angle("tip_acceleration=th:g:9.81"), 90.0 * 9.80665);
  EXPECT_DOUBLE_EQ(angle("hub_angle=th:counts:0.25"), 22.5);
  EXPECT_DOUBLE_EQ(angle("hub_angle=th:rad:0.0171"), 0.0171 * 90.0);
}

TEST_F(ImportKinds, AScaleNearTheConversionOfItsUnitIsRefused) {
  write("scale.csv", "t [s],tau [N m],th\n0,0,90\n1,1,90\n2,2,90\n");
  expect_refused(
      import({"scale.csv", "--column", "hub_angle=th:deg:0.0171"}),
      "--column hub_angle=th:deg:0.0171: scale = 0.0171: 2 % off the conversion of deg, 0.0174533; "
      "write unit rad, with scale 0.0171 if it is the whole conversion, 0.000298451302 if it is in "
      "deg");
  for (const auto* column :
       {"hub_angle=th:deg:-0.017", "hub_angle=th:deg:0.018", "hub_angle=th:rev:6.1",
        "hub_velocity=th:rpm:0.1", "hub_velocity=th:deg/s:0.0178", "tip_acceleration=th:g:10",
        "tip_displacement=th:inch:0.025", "tip_displacement=th:mm:0.00098"}) {
    EXPECT_THAT(import({"scale.csv", "--column", column}).errors,
                HasSubstr("% off the conversion of"))
        << column;
  }
}

TEST_F(ImportKinds, AFactorInANameIsNeverIgnored) {
  const std::string rows = "0,1,90\n1,2,90\n2,3,90\n";
  for (const std::string header :
       {"Angle*100 (deg)", "100*Angle (deg)", "Angle x 100 [deg]", "Angle \xc3\x97 100 [deg]",
        "Angle/100 (deg)", "theta^2 (rad)", "Angle (deg)*10", "Angle [deg] x 10",
        "hub_angle*1e3 [rad]", "Winkel*0.01 [Grad]", "Angle (deg x 10)", "Angle (deg*10)",
        "\"Angle (deg, x10)\"", "Angle (theta*10 in deg)", "1e3 x angle"}) {
    write("factor.csv", "t [s],tau [N m]," + header + "\n" + rows);
    const Ended refused = import({"factor.csv"});
    EXPECT_EQ(refused.status, 2) << header;
    EXPECT_THAT(refused.errors, HasSubstr("may be hub_angle, but")) << header;
    EXPECT_EQ(std::ranges::count(refused.errors, '\n'), 1) << refused.errors;
  }
  write("factor.csv", "t [s],tau [N m],Angle*100 (deg)\n" + rows);
  EXPECT_THAT(import({"factor.csv"}).errors,
              HasSubstr("Angle*100 (deg) may be hub_angle, but its name has *100; state its "
                        "numbers with --column 'hub_angle=Angle*100:UNIT:SCALE', SCALE 1/100 where "
                        "they are 100 times hub_angle"));
  const auto stated = record({"factor.csv", "--column", "hub_angle=Angle*100:deg:1/100"});
  EXPECT_DOUBLE_EQ(stated.channels.at(0).values.at(0), 0.9 * std::numbers::pi / 180.0);
  write("factor.csv", "t [s],tau/10 (N m),theta [rad]\n" + rows);
  EXPECT_THAT(import({"factor.csv"}).errors,
              HasSubstr("tau/10 (N m) may be torque, but its name has /10"));
  write("factor.csv", "time*1000 (s),tau [N m],theta [rad]\n" + rows);
  EXPECT_THAT(import({"factor.csv"}).errors, HasSubstr("time: column not recognised"));
  write("factor.csv", "f*1000 (Hz),mag [dB],phase [deg]\n" + rows);
  expect_refused(import({"factor.csv"}),
                 "factor.csv: frequency f*1000 (Hz): its name has *1000; write the numbers without "
                 "it");
  write("factor.csv", "f (Hz),mag [dB],phase/10 [deg]\n" + rows);
  EXPECT_THAT(import({"factor.csv"}).errors,
              HasSubstr("phase phase/10 [deg]: its name has /10; write the numbers without it"));
  // No factors: a power in a unit, a ratio, an index.
  write("plain.csv",
        "t [s],tau [N m],hub angle 1/2 [rad],acc 2 [m/s^2; filtered]\n0,1,2,3\n1,1,2,3\n2,1,2,3\n");
  EXPECT_EQ(record({"plain.csv"}).channels.size(), 2U);
}

TEST_F(ImportKinds, ModesOfAUniversalFileAreAModalTable) {
  const auto mode = [](int analysis, int number, const std::vector<double>& reals) {
    std::string text = "    -1\n    55\n";
    for (int k = 0; k < 5; ++k) text += "NONE\n";
    text += fmt::format("{:10}{:10}{:10}{:10}{:10}{:10}\n", 1, analysis, 2, 8, 5, 3);
    text += fmt::format("{:10}{:10}{:10}{:10}\n", 2, reals.size(), 0, number);
    for (const double real : reals) text += fmt::format("{:13.5E}", real);
    return text + "\n         1\n  1.00000E+00  0.00000E+00  0.00000E+00\n    -1\n";
  };
  const double w_rad_per_s = 2.0 * std::numbers::pi * 30.0;
  write("modes.uff",
        mode(2, 1, {0.0, 1.0, 0.0, 0.0}) + mode(2, 2, {11.86, 1.0, 0.006, 0.0}) +
            mode(3, 3, {-0.02 * w_rad_per_s, w_rad_per_s * std::sqrt(1.0 - 4e-4), 0, 0, 0, 0}));
  const auto run = imported({"modes.uff"});
  const auto& table = std::get<measured::ModalTable>(run.data);
  ASSERT_EQ(table.size(), 2U);
  EXPECT_DOUBLE_EQ(*table[0].frequency_Hz, 11.86);
  EXPECT_DOUBLE_EQ(*table[0].damping_ratio, 0.006);
  EXPECT_NEAR(*table[1].frequency_Hz, 30.0, 1e-4);  // six digits in the file
  EXPECT_NEAR(*table[1].damping_ratio, 0.02, 1e-6);
  EXPECT_THAT(output_,
              AllOf(HasSubstr("mode 1 at 0 Hz, of the rigid body"), HasSubstr("shape of mode 2")));
  write("modes.uff", mode(2, 2, {11.86, 1.0, 1.5, 0.0}));
  EXPECT_THAT(import({"modes.uff"}).errors,
              HasSubstr("mode 2 at 11.86 Hz: damping ratio 1.5: must be from -1 to 1, a fraction, "
                        "not in per cent"));
}

TEST_F(ImportKinds, ClockTimesPastMidnightAreEven) {
  std::string text = "Timestamp;torque [N m];hub_angle [rad]\n";
  for (int k = 0; k < 100; ++k) {
    const int ms = 86400000 - 100 + 2 * k;
    text += fmt::format("{:02}:{:02}:{:02},{:03};{};{}\n", ms / 3600000 % 24, ms / 60000 % 60,
                        ms / 1000 % 60, ms % 1000, k, -k);
  }
  write("clock.csv", text);
  const auto clock = record({"clock.csv"});
  ASSERT_EQ(clock.time_s.size(), 100U);
  EXPECT_EQ(clock.time_s[99], 0.198);
}

TEST_F(ImportKinds, MillisecondsOfTheirOwnColumnCompleteWholeSeconds) {
  const auto log = [](const std::string& name, int first_s) {
    std::string text = name + ",torque [N m],hub_angle [rad]\n";
    for (int k = 0; k < 300; ++k) {
      const int ms = 900 + 2 * k;
      const std::string seconds = first_s > 0 ? fmt::format("{}", first_s + ms / 1000)
                                              : fmt::format("23:59:{:02}", 50 + ms / 1000);
      text += fmt::format("{},{},{},{}\n", seconds, ms % 1000, k, -k);
    }
    return text;
  };
  for (const auto& [name, first_s] : std::vector<std::pair<std::string, int>>{
           {"Time,Millisecond", 0}, {"Zeit,Millisekunden", 0}, {"Time (s),ms", 1711846799}}) {
    write("split.csv", log(name, first_s));
    const auto made = record({"split.csv"});
    ASSERT_EQ(made.time_s.size(), 300U) << name;
    EXPECT_NEAR((made.time_s[299] - made.time_s[0]) / 299.0, 0.002, 1e-9) << name;
    EXPECT_THAT(output_, HasSubstr("is of whole seconds, completed by column")) << name;
  }
  // Without them the period is open.
  write("split.csv", log("Time,counts", 0));
  EXPECT_THAT(import({"split.csv"}).errors, HasSubstr("--period"));
  EXPECT_EQ(record({"split.csv", "--period", "0.002"}).time_s.size(), 300U);
  // Counts on while the seconds change.
  std::string text = "Time,ms,torque [N m],hub_angle [rad]\n";
  for (int k = 0; k < 300; ++k) {
    text += fmt::format("12:00:{:02},{},{},{}\n", (900 + 2 * k) / 1000, 2 * k, k, -k);
  }
  write("split.csv", text);
  EXPECT_THAT(import({"split.csv"}).errors, HasSubstr("--period"));
}

TEST_F(ImportKinds, AnAngleWithinOneTurnIsUnwrapped) {
  using Turn = std::tuple<const char*, double, double>;  // unit, a turn, the least number
  constexpr double kTurn_rad = 2.0 * std::numbers::pi;
  for (const auto& [unit, turn, least] :
       {Turn{"deg", 360.0, 0.0}, Turn{"deg", 360.0, -180.0}, Turn{"rad", kTurn_rad, 0.0},
        Turn{"rad", kTurn_rad, -std::numbers::pi}, Turn{"rev", 1.0, 0.0}}) {
    const auto angle_turns = [](int k) { return 1.3 * std::sin(0.02 * k); };
    std::string log = fmt::format("t [s],tau [N m],theta [{}]\n", unit);
    for (int k = 0; k < 400; ++k) {
      const double turns = angle_turns(k) - least / turn;
      log += fmt::format("{:.3f},1,{}\n", 0.005 * k, least + turn * (turns - std::floor(turns)));
    }
    write("log.csv", log);
    const auto made = record({"log.csv"});
    EXPECT_THAT(output_, AllOf(HasSubstr("jumps by a whole turn"), HasSubstr("unwrapped")));
    for (int k = 0; k < 400; ++k) {
      EXPECT_NEAR(made.channels.at(0).values.at(static_cast<std::size_t>(k)),
                  kTurn_rad * angle_turns(k), 1e-9)
          << unit << least << " " << k;
    }
  }
  // One number of an angle at rest is no turn.
  write("log.csv", "t [s],tau [N m],theta [deg]\n0,1,5\n1,1,5\n2,1,355\n3,1,5\n4,1,5\n");
  EXPECT_NEAR(record({"log.csv"}).channels.at(0).values.at(2), 355.0 / 360.0 * kTurn_rad, 1e-9);
  EXPECT_THAT(output_, AllOf(HasSubstr("theta [deg] jumps by a whole turn, 360, 2 times"),
                             Not(HasSubstr("unwrapped"))));
}

TEST_F(ImportKinds, TimesThatDoNotRunAreNamed) {
  std::string falling = "time [s],torque [N m],hub_angle [rad]\n";
  std::string equal = falling;
  std::string second = "time [s],torque [N m],time2 [s],hub_angle [rad]\n";
  for (int k = 0; k < 20; ++k) {
    falling += fmt::format("{:.3f},{},{}\n", 0.002 * (20 - k), k, -k);
    equal += fmt::format("1.709e+09,{},{}\n", k, -k);
    second += fmt::format("{:.3f},{},{:.3f},{}\n", 0.002 * k, k, 0.002 * k + 0.01, -k);
  }
  write("log.csv", falling);
  expect_refused(import({"log.csv"}),
                 "log.csv: time falls from 0.04 s to 0.038 s in line 3, and in 19 of 20 rows; "
                 "write the rows in the order of their times");
  write("log.csv", equal);
  expect_refused(import({"log.csv"}),
                 "log.csv: time = 1709000000 s in all 20 rows; write it with more digits, take "
                 "another column with --column time=NAME, or state the sampling period with "
                 "--period");
  write("log.csv", second);
  EXPECT_THAT(import({"log.csv"}).output,
              HasSubstr("time2 [s] is a second time, up to 0.01 s off"));
}

TEST_F(ImportKinds, NamesOfFilesMakeShortIds) {
  const std::string log = log_with_gap("absent");
  for (const auto& [file, id] : std::vector<std::pair<std::string, std::string>>{
           {"a=1, b+2 @ 30 deg.csv", "a-1-b-2-30-deg"},
           {"M\xc3\xbcller (3).csv", "M-ller-3"},
           {"\xe6\xb5\x8b.csv", "run"},
           {std::string(120, 'x') + ".csv", std::string(48, 'x')}}) {
    write(file, log);
    const auto made = imported({file});
    EXPECT_EQ(made.run.id, id);
    EXPECT_EQ(made.run.file, id + ".csv");
  }
}

}  // namespace
}  // namespace flexarm::testing_app
