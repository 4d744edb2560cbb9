#include "measured/files/response_columns.hpp"

#include "arm/input_error.hpp"
#include "measured/files/delimited_line.hpp"
#include "measured/files/foreign_table.hpp"
#include "measured/files/response_unit.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::measured {
namespace {

using Complex = std::complex<double>;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

const std::vector<Complex> kResponse = {{-9.2, -2.9}, {0.5, 0.25}, {1e-3, -2e-3}};
const std::vector<double> kFrequency_Hz = {0.5, 4.0, 40.0};
constexpr double kWholeTurn_rad = 2.0 * std::numbers::pi;

/// Rows of what `cells` makes of a frequency and its response.
template <class Cells>
std::string table_text(const std::string& header, const Cells& cells) {
  std::string text = header + "\n";
  for (std::size_t k = 0; k < kResponse.size(); ++k) {
    text += cells(kFrequency_Hz[k], kResponse[k]) + "\n";
  }
  return text;
}

std::string polar(double f, Complex h, const char* separator, bool decibel, bool degrees) {
  return fmt::format("{1:.17g}{0}{2:.17g}{0}{3:.17g}", separator, f,
                     decibel ? 20.0 * std::log10(std::abs(h)) : std::abs(h),
                     degrees ? std::arg(h) * 180.0 / std::numbers::pi : std::arg(h));
}

void expect_response(const ForeignResponse& response) {
  ASSERT_EQ(response.response.size(), kResponse.size());
  for (std::size_t k = 0; k < kResponse.size(); ++k) {
    EXPECT_NEAR(response.frequency_Hz[k], kFrequency_Hz[k], 1e-12 * kFrequency_Hz[k]);
    // Two logarithms and an angle in degrees.
    EXPECT_LT(std::abs(response.response[k] - kResponse[k]), 1e-13 * std::abs(kResponse[k]));
  }
}

TEST(ResponseColumns, UsualHeadersArePartsOfAResponse) {
  struct Header {
    const char* text;
    bool decibel;
    bool degrees;
    const char* name;
    const char* unit;
  };
  for (const Header& header :
       {Header{"Frequency (Hz),Magnitude (dB),Phase (deg)", true, true, "Magnitude (dB)", ""},
        Header{"f_Hz,mag_dB,phase_deg", true, true, "mag_dB", ""},
        Header{"Freq [Hz],Gain [dB],Phase [\xc2\xb0]", true, true, "Gain [dB]", ""},
        Header{"freq,H1 mag [rad/(N m)],H1 phase [rad]", false, false, "H1", "rad"},
        Header{"Frequenz [Hz],Betrag [deg/Nm],Phase [rad]", false, false, "Betrag [deg/Nm]", "deg"},
        Header{"f,|H| [1],arg(H) [deg]", false, true, "|H| [1]", ""},
        Header{"Hz,magH1,phaseH1 (rad)", false, false, "H1", ""},
        Header{"Frequency,Amplitude ratio (dB),Phase angle (deg)", true, true, "ratio", ""},
        Header{"Frequency,Magnitude,Phase\nHz,dB,deg", true, true, "Magnitude", ""},
        Header{"frequency,hub_angle magnitude (dB re 1 rad/(N m)),hub_angle phase (deg)", true,
               true, "hub_angle", "rad"},
        Header{"frequency,strain@0.05_mag (dB),strain@0.05_phase (deg)", true, true, "strain@0.05",
               ""}}) {
    const auto table = parse_foreign_table(
        table_text(
            header.text,
            [&](double f, Complex h) { return polar(f, h, ",", header.decibel, header.degrees); }),
        "bode.csv");
    const auto made = responses_in(table);
    ASSERT_EQ(made.responses.size(), 1U) << header.text << made.incomplete;
    EXPECT_EQ(made.responses[0].unit, header.unit) << header.text;
    if (header.text != std::string("f,|H| [1],arg(H) [deg]")) {
      EXPECT_EQ(made.responses[0].name, header.name);
    }
    expect_response(made.responses[0]);
  }
}

TEST(ResponseColumns, DecibelInTheNameBesideAUnitOfTheResponseIsDecibel) {
  struct Header {
    const char* text;
    const char* unit;
  };
  for (const Header& header :
       {Header{"Frequency (Hz),Magnitude dB(rad/Nm),Phase (deg)", "rad"},
        Header{"Frequency [Hz],Magnitude dB [rad/Nm],Phase [deg]", "rad"},
        Header{"Frequency (Hz),MagdB (deg/Nm),Phase (deg)", "deg"},
        Header{"Frequency (Hz),dB(rad/Nm),Phase (deg)", "rad"},
        Header{"Frequency (Hz),|H| dB [rad/Nm],arg(H) [deg]", "rad"},
        Header{"Frequency (Hz),Magnitude [dB/(rad/Nm)],Phase (deg)", "rad"},
        Header{"Frequency (Hz),Gain (dB ref 1 mrad/Nm),Phase (deg)", "mrad"},
        Header{"Frequency (Hz),Trace 1: Gain: Magnitude (dB),Trace 2: Gain: Phase (deg)", ""}}) {
    const auto made = responses_in(parse_foreign_table(
        table_text(header.text, [](double f, Complex h) { return polar(f, h, ",", true, true); }),
        "bode.csv"));
    ASSERT_EQ(made.responses.size(), 1U) << header.text << made.incomplete;
    EXPECT_EQ(made.responses[0].unit, header.unit) << header.text;
    expect_response(made.responses[0]);
  }
}

TEST(ResponseColumns, WhatIsNotAMagnitudeOrAPhaseIsRefused) {
  struct Header {
    const char* text;
    const char* fault;
  };
  for (const Header& header :
       {Header{"f_Hz,Magnitude (rad/Nm),Phase (cycles)", "phase Phase (cycles) in cycles: must be"},
        Header{"f_Hz,Magnitude (rad/Nm),Phase(pi rad)", "in pi rad: must be in deg or rad"},
        Header{"f_Hz,Magnitude (Np),Phase (deg)", "magnitude Magnitude (Np) in Np: must be"},
        Header{"f_Hz,Magnitude (dBm),Phase (deg)", "in dBm: must be"},
        Header{"f_Hz,Magnitude (Nm/rad),Phase (deg)", "a stiffness, not a response to a torque"},
        Header{"f_Hz,Real (Nm/rad),Imag (Nm/rad)", "a stiffness, not a response to a torque"},
        Header{"f_Hz,Real (rad/Nm),Imag (deg/Nm)", "must be in one unit"},
        Header{"f_Hz,Real (rad/Nm),Imag (deg/Nm)", "must be in one unit"},
        Header{"f_Hz,Magnitude squared,Phase (deg)", "magnitude Magnitude squared: a square"},
        Header{"f_Hz,Mag^2,Phase (deg)", "magnitude Mag^2: a square"},
        Header{"f_Hz,Gain (dB),Phase lag (deg)", "phase Phase lag (deg): a lag"}}) {
    const auto table = parse_foreign_table(std::string(header.text) + "\n1,2,3\n2,3,4\n", "a.csv");
    try {
      responses_in(table);
      ADD_FAILURE() << header.text;
    } catch (const arm::InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(header.fault));
    }
  }
}

TEST(ResponseColumns, AnAbsoluteMagnitudeAndASquaredCoherenceAreRead) {
  const auto made = responses_in(parse_foreign_table(
      "f_Hz,Magnitude (abs),Phase (deg),Coherence squared\n1,2,0,0.5\n2,3,0,0.5\n", "a.csv"));
  ASSERT_EQ(made.responses.size(), 1U);
  EXPECT_EQ(made.responses[0].response[0], Complex(2.0, 0.0));
  EXPECT_EQ(made.responses[0].unit, "");
  EXPECT_THAT(made.responses[0].coherence, ElementsAre(0.5, 0.5));
}

TEST(ResponseColumns, ACoherenceInPerCentIsAFraction) {
  const auto made = responses_in(
      parse_foreign_table("f_Hz,Real,Imag (deg/Nm),Coherence (%)\n1,2,0,50\n2,3,0,100\n", "a.csv"));
  ASSERT_EQ(made.responses.size(), 1U);
  EXPECT_EQ(made.responses[0].unit, "deg");
  EXPECT_THAT(made.responses[0].coherence, ElementsAre(0.5, 1.0));
}

TEST(ResponseColumns, AnAssumedUnitOfFrequenciesIsSaid) {
  const auto notes_of = [](const std::string& name) {
    return responses_in(parse_foreign_table(name + ",re,im\n1,2,3\n2,3,4\n", "a.csv")).notes;
  };
  EXPECT_THAT(notes_of("frequency"), Contains("unit of frequency not given; Hz assumed"));
  EXPECT_THAT(notes_of("omega"), Contains("unit of omega not given; rad/s assumed"));
  for (const auto* name : {"Hz", "f_Hz", "frequency (kHz)", "w [rad/s]"}) {
    EXPECT_THAT(notes_of(name), testing::Each(testing::Not(HasSubstr("assumed")))) << name;
  }
}

TEST(ResponseColumns, RealAndImaginaryPartsWithCoherenceAndAngularFrequency) {
  for (const auto* header : {"w [rad/s];Re(H);Im(H);Coherence", "omega;Real;Imag;Coh",
                             "Kreisfrequenz;Realteil;Imagin\xc3\xa4rteil;Koh\xc3\xa4renz"}) {
    const auto table =
        parse_foreign_table(table_text(header,
                                       [](double f, Complex h) {
                                         return fmt::format("{:.17g};{};{};0.99",
                                                            kWholeTurn_rad * f, h.real(), h.imag());
                                       }),
                            "reim.csv");
    const auto made = responses_in(table);
    ASSERT_EQ(made.responses.size(), 1U) << header;
    expect_response(made.responses[0]);
    EXPECT_THAT(made.responses[0].coherence, ElementsAre(0.99, 0.99, 0.99));
  }
}

TEST(ResponseColumns, SeveralResponsesStandBesideEachOther) {
  const auto table = parse_foreign_table(
      table_text("Frequency (Hz),Channel 1 Magnitude (dB),H1 mag (dB),H1 phase (deg),H2 re,H2 im,"
                 "Coherence 1,Coherence 2",
                 [](double f, Complex h) {
                   const auto columns = polar(f, h, ",", true, true);
                   const auto first = columns.find(',');
                   return columns.substr(0, first) + ",7" + columns.substr(first) +
                          fmt::format(",{},{},0.5,", h.real(), h.imag());
                 }),
      "two.csv");
  const auto made = responses_in(table);
  ASSERT_EQ(made.responses.size(), 2U);
  EXPECT_EQ(made.responses[0].name, "H1");
  EXPECT_EQ(made.responses[1].name, "H2");
  expect_response(made.responses[0]);
  expect_response(made.responses[1]);
  EXPECT_THAT(made.notes, Contains("response Channel 1: magnitude without phase; left out"));
}

TEST(ResponseColumns, WhatIsNotToldIsAssumedAndSaid) {
  const auto table = parse_foreign_table("f,mag,phase\n2,-3,170\n1,-6,-170\n,1,1\n3,,1\n", "a.csv");
  const auto made = responses_in(table);
  ASSERT_EQ(made.responses.size(), 1U);
  EXPECT_THAT(made.responses[0].frequency_Hz, ElementsAre(1.0, 2.0));  // ascending
  EXPECT_NEAR(std::abs(made.responses[0].response[0]), std::pow(10.0, -0.3), 1e-15);
  EXPECT_THAT(made.notes, Contains("unit of mag not given; dB assumed"));
  EXPECT_THAT(made.notes, Contains("unit of phase not given; deg assumed"));
  EXPECT_THAT(made.notes, Contains("2 of 4 lines left out: a cell is empty, not finite or an "
                                   "instrument's sign of no measurement"));
  const auto unclear = parse_foreign_table("f,mag,phase\n1,1,-8\n2,1,-9\n", "a.csv");
  EXPECT_THROW(responses_in(unclear), arm::InputError);
}

TEST(ResponseColumns, SignalsInTimeAreNone) {
  for (const auto* text :
       {"t,f,mag,phase\n0,1,1,1\n1,1,1,1\n", "time,torque,hub_angle\n0,1,2\n1,1,2\n",
        "torque,hub_angle,phase\n0,1,2\n1,1,2\n"}) {
    EXPECT_TRUE(responses_in(parse_foreign_table(text, "a")).responses.empty()) << text;
  }
  EXPECT_EQ(responses_in(parse_foreign_table("f,mag\n1,2\n2,3\n", "a")).incomplete,
            "response without a name: magnitude without phase");
}

TEST(ResponseColumns, ComplexCellsAreNumbers) {
  const auto expect = [](const char* cell, Complex right) {
    EXPECT_EQ(parse_complex_cell(cell, '.'), right) << cell;
  };
  expect("1+2j", {1.0, 2.0});
  expect("(1-2i)", {1.0, -2.0});
  expect("1.5e-3 - 2e-4*i", {1.5e-3, -2e-4});
  expect("(1.0e+00+-2.0e+00j)", {1.0, -2.0});
  expect("-1+j2", {-1.0, 2.0});
  expect("3-j", {3.0, -1.0});
  expect("-2.5e-3i", {0.0, -2.5e-3});
  EXPECT_EQ(parse_complex_cell("1,5-0,5i", ','), Complex(1.5, -0.5));
  for (const auto* none : {"", "1", "-1.5", "1+2", "i", "J1", "j1", "Ti", "inf", "nan", "-1.#IND",
                           "12:00:00", "3 jan 2024", "bias 3i", "1+2j+3", "i1+2"}) {
    EXPECT_EQ(parse_complex_cell(none, '.'), std::nullopt) << none;
  }
}

TEST(ResponseColumns, CellsOfComplexNumbersAreAResponse) {
  struct ComplexCells {
    const char* header;
    const char* row;
    char decimal = '.';
  };
  for (const ComplexCells& layout :
       {ComplexCells{"f [Hz],hub_angle [rad]", "{:.17g},{:.17g}{:+.17g}j"},
        ComplexCells{"f [Hz],hub_angle [rad]", "{:.17g},({:.17g}{:+.17g}j)"},
        ComplexCells{"frequency\thub_angle (rad/(N m))", "{:.17g}\t{:.17g} {:+.17g}i"},
        ComplexCells{"# f,hub_angle [rad]", "({:.17e}+0.0e+00j),({:.17e}{:+.17e}j)"},
        ComplexCells{"f hub_angle_rad", " ({:.17e}+0.0e+00j)  ({:.17e}{:+.17e}j) "},
        ComplexCells{"Frequenz [Hz];hub_angle [rad]", "{:.17g};{:.17g}{:+.17g}*i", ','}}) {
    std::string text = table_text(layout.header, [&](double f, Complex h) {
      std::string row = fmt::format(fmt::runtime(layout.row), f, h.real(), h.imag());
      std::ranges::replace(row, '.', layout.decimal);
      return row;
    });
    const auto table = parse_foreign_table(text, "h.csv");
    const auto made = responses_in(table);
    ASSERT_EQ(made.responses.size(), 1U) << layout.header << made.incomplete;
    EXPECT_EQ(made.responses[0].name, "hub_angle") << layout.header;
    EXPECT_EQ(made.responses[0].unit, "rad") << layout.header;
    expect_response(made.responses[0]);
    EXPECT_EQ(table.columns[find_column(table, "#2")].path,
              std::string(layout.header).substr(std::string(layout.header).find("hub_angle")));
    EXPECT_THAT(table.assumptions, Contains(HasSubstr("holds complex numbers: real part of")));
  }
  const auto two = responses_in(parse_foreign_table("f,H1,H2\n1,1+2j,3\n2,,1e-3-2j\n", "h.csv"));
  ASSERT_EQ(two.responses.size(), 2U);
  EXPECT_EQ(two.responses[0].name, "H1");
  EXPECT_THAT(two.responses[0].response, ElementsAre(Complex(1.0, 2.0)));
  EXPECT_EQ(two.responses[1].name, "H2");
  EXPECT_THAT(two.responses[1].response, ElementsAre(Complex(3.0, 0.0), Complex(1e-3, -2.0)));
  EXPECT_THAT(responses_in(parse_foreign_table("1,1+2j\n2,3+4j\n", "h.csv")).incomplete,
              HasSubstr("complex numbers, but no column is called frequency; state the parts"));
}

TEST(ResponseColumns, LogarithmsOfFrequenciesAreTakenBack) {
  struct Header {
    const char* text;
    double (*logarithm)(double frequency_Hz);
  };
  const auto lg = [](double f) { return std::log10(f); };
  const auto lg_of_w = [](double f) { return std::log10(kWholeTurn_rad * f); };
  for (const Header& header :
       {Header{"log10(f)", lg}, Header{"log10(f [Hz])", lg}, Header{"log10(f) [Hz]", lg},
        Header{"lg f [Hz]", lg}, Header{"log10_f_Hz", lg}, Header{"Log10 Frequency (Hz)", lg},
        Header{"log10(f/Hz)", lg}, Header{"ln(f)", [](double f) { return std::log(f); }},
        Header{"log10(w)", lg_of_w}, Header{"log10(omega) [rad/s]", lg_of_w}}) {
    const auto made = responses_in(parse_foreign_table(
        table_text(
            std::string(header.text) + ",mag [dB],phase [deg]",
            [&](double f, Complex h) { return polar(header.logarithm(f), h, ",", true, true); }),
        "log.csv"));
    ASSERT_EQ(made.responses.size(), 1U) << header.text;
    expect_response(made.responses[0]);
    EXPECT_THAT(made.notes, Contains(HasSubstr("holds logarithms to base"))) << header.text;
  }
  const auto refusal = [](const std::string& header) {
    try {
      responses_in(parse_foreign_table(header + "\n0,1,2\n1,2,3\n", "log.csv"));
    } catch (const arm::InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(refusal("log f,mag [dB],phase [deg]"),
            "frequency log f: a logarithm to base 10 or e; call it log10(f) or ln(f), or write the "
            "frequencies themselves");
  EXPECT_THAT(refusal("f,log10 mag,phase [deg]"), HasSubstr("magnitude log10 mag: a logarithm"));
}

TEST(ResponseColumns, PartsMayBeStated) {
  const auto table = parse_foreign_table(
      table_text("a,b,c", [](double f, Complex h) { return polar(f, h, ",", true, true); }),
      "a.csv");
  const auto made = responses_of(table, {{ResponsePart::frequency, "", 0, "Hz"},
                                         {ResponsePart::magnitude, "hub_angle [rad]", 1, "dB"},
                                         {ResponsePart::phase, "hub_angle [rad]", 2, "deg"}});
  ASSERT_EQ(made.responses.size(), 1U);
  expect_response(made.responses[0]);
  EXPECT_THROW(responses_of(table, {{ResponsePart::magnitude, "x", 1, "dB"}}), arm::InputError);
  EXPECT_THROW(responses_of(table, {{ResponsePart::frequency, "", 0, "Hz"},
                                    {ResponsePart::real, "x", 1, "1"},
                                    {ResponsePart::imaginary, "x", 1, "1"}}),
               arm::InputError);
  EXPECT_THROW(responses_of(table, {{ResponsePart::frequency, "", 0, "Hz"},
                                    {ResponsePart::magnitude, "x", 1, "dB"}}),
               arm::InputError);
  EXPECT_THROW(responses_of(table, {{ResponsePart::frequency, "", 0, "orders"},
                                    {ResponsePart::magnitude, "x", 1, "dB"},
                                    {ResponsePart::phase, "x", 2, "deg"}}),
               arm::InputError);
}

TEST(ResponseUnit, UnitsAreTakenApart) {
  const auto expect = [](const char* text, const char* unit, const char* per) {
    const ResponseUnit split = split_response_unit(text);
    EXPECT_EQ(split.unit, unit) << text;
    EXPECT_EQ(split.per, per) << text;
  };
  expect("rad/N m", "rad", "N m");
  expect("rad/(N m)", "rad", "N m");
  expect("(rad)/(N*m)", "rad", "N m");
  expect("deg/(N m)", "deg", "N m");
  expect("deg per Nm", "deg", "N m");
  expect("rad/s/(N m)", "rad/s", "N m");
  expect("(m/s^2)/N", "m/s^2", "N");
  expect("m/s\xc2\xb2/N", "m/s^2", "N");
  expect("g/N", "g", "N");
  expect("ustrain/Nmm", "ustrain", "N mm");
  expect("1/(N m)", "1", "N m");
  expect("rad\xc2\xb7N\xe2\x81\xbb\xc2\xb9\xc2\xb7m\xe2\x81\xbb\xc2\xb9", "rad", "N m");
  expect("rad/(s N m)", "rad/s", "N m");
  expect("m/(N m s^2)", "m/s^2", "N m");
  expect("rad/s", "rad/s", "");
  expect("m/s^2", "m/s^2", "");
  expect("rad", "rad", "");
  expect("", "", "");
  expect("furlong/N", "furlong/N", "");
  for (const auto* stiffness : {"Nm/rad", "N m/deg", "N/m"}) {
    EXPECT_TRUE(is_stiffness_unit(stiffness)) << stiffness;
  }
  for (const auto* other : {"rad/Nm", "V/V", "m/s", "rad/s", "furlong/N", ""}) {
    EXPECT_FALSE(is_stiffness_unit(other)) << other;
  }
}

}  // namespace
}  // namespace flexarm::measured
