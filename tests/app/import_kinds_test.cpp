// Kinds of files that laboratories have, imported by the program as a user would.
#include "measured/files/frequency_record.hpp"
#include "measured/files/measurement.hpp"
#include "measured/files/modal_table.hpp"
#include "measured/files/run_data.hpp"
#include "measured/files/universal_file.hpp"
#include "tests/app/flexarm_fixture.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

namespace flexarm::testing_app {
namespace {

using Complex = std::complex<double>;
using measured::FrequencyRecord;
using measured::InitialState;
using measured::TimeRecord;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class ImportKinds : public Flexarm {
 protected:
  Ended import(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "import");
    return run(arguments);
  }

  /// The first run of the measurement that the arguments make.
  measured::MeasuredRun imported(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--out", "out", "--force"});
    const Ended ended = import(arguments);
    EXPECT_EQ(ended.status, 0) << ended.errors;
    output_ = ended.output;
    if (ended.status != 0) return {};
    const auto file = folder_ / "out/measurement.toml";
    const measured::Run run = measured::read_measurement(file).runs.front();
    return {run, measured::read_run(file, run)};
  }

  TimeRecord record(const std::vector<std::string>& arguments) const {
    return std::get<TimeRecord>(imported(arguments).data);
  }

  FrequencyRecord response(const std::vector<std::string>& arguments) const {
    return std::get<FrequencyRecord>(imported(arguments).data);
  }

  mutable std::string output_;
};

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

Complex compliance(double frequency_Hz) {
  const Complex s(0.0, 2.0 * std::numbers::pi * frequency_Hz);
  return 1.0 / (0.01 * s * s + 0.01 * s);
}

template <class Cells>
std::string response_text(const std::string& header, const Cells& cells) {
  std::string text = header + "\n";
  for (int k = 1; k <= 100; ++k) text += cells(0.5 * k, compliance(0.5 * k)) + "\n";
  return text;
}

void expect_compliance(const FrequencyRecord& record, double factor = 1.0) {
  ASSERT_EQ(record.channels.size(), 1U);
  const auto& channel = record.channels.front();
  EXPECT_EQ(channel.sensor.kind, arm::SensorKind::hub_angle);
  ASSERT_EQ(channel.response.size(), 100U);
  for (std::size_t k = 0; k < 100; ++k) {
    const Complex right = factor * compliance(channel.frequency_Hz[k]);
    EXPECT_LT(std::abs(channel.response[k] - right),
              1e-9 * std::abs(right));  // 10 digits in the file
  }
}

TEST_F(ImportKinds, FrequencyResponsesInColumnsAreRead) {
  const auto polar = [](double f, Complex h) {
    return fmt::format("{},{:.12g},{:.12g}", f, 20.0 * std::log10(std::abs(h)),
                       std::arg(h) * 180.0 / std::numbers::pi);
  };
  const auto cartesian = [](double f, Complex h) {
    return fmt::format("{},{:.12g},{:.12g},0.99", f, h.real(), h.imag());
  };
  write("bode.csv", response_text("Frequency (Hz),Magnitude (dB),Phase (deg)", polar));
  expect_compliance(response({"bode.csv"}));
  EXPECT_THAT(output_, HasSubstr("warning: Magnitude (dB) is taken as hub_angle in rad per N m"));
  expect_compliance(response({"bode.csv", "--column", "hub_angle=Magnitude:deg"}),
                    std::numbers::pi / 180.0);
  EXPECT_THAT(output_, Not(HasSubstr("warning")));
  write("reim.csv", response_text("Frequency (Hz),Real,Imag,Coherence", cartesian));
  const auto record = response({"reim.csv", "--kind", "frf", "--column", "hub_angle=Real"});
  expect_compliance(record);
  EXPECT_EQ(record.channels[0].coherence[7], 0.99);
  write("named.csv",
        response_text("f,hub_angle_re [rad/(N m)],hub_angle_im,hub_angle_coh", cartesian));
  expect_compliance(response({"named.csv"}));
  EXPECT_THAT(output_, Not(HasSubstr("warning")));
  write("plain.csv", response_text("a,b,c", polar));
  expect_compliance(response({"plain.csv", "--column", "frequency=#1:Hz", "--column",
                              "hub_angle.magnitude=b:dB", "--column", "hub_angle.phase=c:deg"}));
  EXPECT_THAT(import({"plain.csv", "--kind", "frf"}).errors,
              HasSubstr("--kind frf: no columns of a frequency response are recognised"));
  write("unclear.csv", "f,mag,phase\n1,1,-8\n2,1,-9\n");
  EXPECT_THAT(import({"unclear.csv"}).errors, HasSubstr("unit not given, deg or rad; state it"));
  const auto stated =
      response({"unclear.csv", "--column", "frequency=f:Hz", "--column",
                "hub_angle.magnitude=mag:rad", "--column", "hub_angle.phase=phase:deg"});
  EXPECT_LT(std::abs(stated.channels.at(0).response.at(0) -
                     std::polar(1.0, -8.0 * std::numbers::pi / 180.0)),
            1e-15);
  write("half.csv", "Frequency (Hz),Magnitude (dB)\n1,2\n2,3\n");
  EXPECT_THAT(import({"half.csv"}).errors,
              HasSubstr("no frequency response: response without a name: magnitude without phase"));
}

/// A response whose unit is that of a response.
std::string universal_text(const std::string& name, const std::string& unit) {
  measured::UniversalFunction function;
  function.id[0] = name;
  function.type = measured::kUniversalFrequencyResponse;
  function.abscissa_axis = {18, 0, 0, 0, "Frequency", "Hz"};
  function.ordinate_axis.units = unit;
  for (int k = 1; k <= 100; ++k) {
    function.abscissa.push_back(0.5 * k);
    function.real.push_back(compliance(0.5 * k).real());
    function.imaginary.push_back(compliance(0.5 * k).imag());
  }
  return measured::format_universal_file({function}, {.binary = true});
}

TEST_F(ImportKinds, UnitsOfResponsesAreTakenApart) {
  for (const auto& [unit, factor] :
       std::vector<std::pair<std::string, double>>{{"rad", 1.0},
                                                   {"rad/N m", 1.0},
                                                   {"rad/(N m)", 1.0},
                                                   {"deg/(N m)", std::numbers::pi / 180.0},
                                                   {"mrad/(N cm)", 0.1}}) {
    write("r.uff", universal_text("hub_angle", unit));
    expect_compliance(response({"r.uff"}), factor);
  }
  write("r.uff", universal_text("tip_acceleration", "(m/s^2)/N"));
  expect_refused(
      import({"r.uff"}),
      "r.uff: tip_acceleration: a response to N, not to a torque; state its scale in N per "
      "N m, as in --column 'tip_acceleration=tip_acceleration:m/s^2:SCALE'");
  const auto scaled = response({"r.uff", "--column", "tip_acceleration=tip_acceleration:m/s^2:2"});
  EXPECT_NEAR(scaled.channels[0].response[0].real(), 2.0 * compliance(0.5).real(), 1e-12);
  write("r.uff", universal_text("sensor 7", "furlong"));
  expect_refused(import({"r.uff"}),
                 "r.uff: no response is mapped to a sensor; responses: sensor 7; assign one with "
                 "--column hub_angle=NAME:UNIT:SCALE");
}

TEST_F(ImportKinds, SignsOfNoMeasurementAreLookedForInResponses) {
  const auto expect_warned = [&](const std::string& warning) {
    const auto record = response({"signs"});
    ASSERT_EQ(record.channels.size(), 1U);
    EXPECT_EQ(record.channels[0].response.size(), 99U);
    EXPECT_THAT(output_, AllOf(HasSubstr("1 of 100 lines left out"), HasSubstr(warning)));
  };
  const auto polar = [](double f, Complex h) {
    return fmt::format("{},{},{}", f,
                       f == 5.0 ? "9.9E+37" : fmt::format("{}", 20.0 * std::log10(std::abs(h))),
                       f == 7.0 ? -9999.0 : std::arg(h) * 180.0 / std::numbers::pi);
  };
  write("signs", response_text("Frequency (Hz),Magnitude (dB),Phase (deg)", polar));
  expect_warned("hub_angle: 1 cell of column Phase (deg) is -9999");
  const auto cartesian = [](double f, Complex h) {
    return fmt::format("{},{},{}", f, f == 5.0 ? -9.91e37 : h.real(),
                       f == 7.0 ? -32768.0 : h.imag());
  };
  write("signs", response_text("Frequency (Hz),Re [rad/(N m)],Im [rad/(N m)]", cartesian));
  expect_warned("hub_angle: 1 cell of column Im [rad/(N m)] is -32768");
  measured::UniversalFunction function;
  function.id[0] = "hub_angle";
  function.type = measured::kUniversalFrequencyResponse;
  function.abscissa_axis = {18, 0, 0, 0, "Frequency", "Hz"};
  for (int k = 1; k <= 100; ++k) {
    function.abscissa.push_back(0.5 * k);
    function.real.push_back(k == 10 ? 9.9e37 : compliance(0.5 * k).real());
    function.imaginary.push_back(k == 14 ? -9999.0 : compliance(0.5 * k).imag());
  }
  for (const bool binary : {true, false}) {
    write("signs", measured::format_universal_file({function}, {.binary = binary}));
    expect_warned("hub_angle: 1 cell of column im is -9999");
  }
  write("signs", "frequency [Hz],sensor,re,im\n0.5,hub_angle,1,2\n1,hub_angle,9.9E37,1\n");
  EXPECT_THAT(import({"signs"}).errors,
              HasSubstr("signs:3: re = 9.9e+37: an instrument's sign of no measurement; must be a "
                        "measured number, or the row left out"));
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
