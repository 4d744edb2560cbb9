// Frequency responses of files that laboratories have, imported by the program as a user would.
#include "measured/files/frequency_record.hpp"
#include "measured/files/universal_file.hpp"
#include "tests/app/import_files.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

namespace flexarm::testing_app {
namespace {

using Complex = std::complex<double>;
using measured::FrequencyRecord;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class ImportResponses : public ImportFiles {};

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

TEST_F(ImportResponses, FrequencyResponsesInColumnsAreRead) {
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

TEST_F(ImportResponses, CellsOfComplexNumbersAreTakenByTheNameOfTheirColumn) {
  const auto cells = [](double f, Complex h) {
    return fmt::format("{},{:.12g}{:+.12g}j,2", f, h.real(), h.imag());
  };
  write("h.csv", response_text("f [Hz],H,spare", cells));
  expect_compliance(response({"h.csv"}));
  EXPECT_THAT(output_, HasSubstr("warning: H is taken as hub_angle in rad per N m"));
  expect_compliance(response({"h.csv", "--column", "hub_angle=H:deg"}), std::numbers::pi / 180.0);
  write("bare.csv", response_text("a,b,c", cells));
  EXPECT_THAT(
      import({"bare.csv"}).errors,
      HasSubstr("no frequency response: complex numbers, but no column is called frequency"));
  expect_compliance(response({"bare.csv", "--column", "frequency=a:Hz", "--column",
                              "hub_angle.real=real part of b", "--column",
                              "hub_angle.imaginary=imaginary part of b"}));
  EXPECT_THAT(import({"bare.csv", "--column", "frequency=a:Hz", "--column", "hub_angle.real=b",
                      "--column", "hub_angle.imaginary=b"})
                  .errors,
              HasSubstr("column real part of b: given for two parts of a response"));
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

TEST_F(ImportResponses, UnitsOfResponsesAreTakenApart) {
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

TEST_F(ImportResponses, SignsOfNoMeasurementAreLookedForInResponses) {
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

}  // namespace
}  // namespace flexarm::testing_app
