#include "measured/files/unit_spelling.hpp"

#include "measured/files/column_mapping.hpp"
#include "measured/files/column_name.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

namespace flexarm::measured {
namespace {

struct Spelled {
  const char* unit;
  std::vector<const char*> spellings;
};

TEST(UnitSpelling, EveryUsualOneIsKnown) {
  const std::vector<Spelled> table = {
      {"s", {"s", "sec", "sec.", "Seconds", "SEC"}},
      {"ms", {"ms", "msec", "milliseconds", "MS"}},
      {"us", {"us", "\xc2\xb5s", "\xce\xbcs", "microseconds"}},
      {"rad", {"rad", "rads", "Radians"}},
      {"deg", {"deg", "\xc2\xb0", "degrees", "Deg", "Deg."}},
      {"rad/s",
       {"rads/s", "rad/sec", "rad s-1", "rad.s^-1", "rad*s**-1", "radians per second", "rad_per_s",
        "RAD/S", "rad s\xe2\x81\xbb\xc2\xb9", "rad / s"}},
      {"deg/s", {"\xc2\xb0/s", "dps", "deg_s", "degrees/second", "deg\xc2\xb7s^-1"}},
      {"rpm", {"rpm", "RPM", "rev/min", "1/min", "min-1", "U/min"}},
      {"N m", {"Nm", "N*m", "N.m", "N-m", "N\xc2\xb7m", "N_m", "newton metres", "NM"}},
      {"N mm", {"mNm", "mN m", "N*mm", "mN-m"}},
      {"N cm", {"Ncm", "N cm"}},
      {"ozf in", {"oz-in", "ozin"}},
      {"m/s^2", {"m/s2", "m/s\xc2\xb2", "m/s/s", "m s^-2", "ms-2", "m/s**2", "m/sec^2"}},
      {"mm/s^2", {"mm/s2", "mm/s^2"}},
      {"g", {"g", "gn"}},
      {"uN m", {"\xc2\xb5Nm", "uN m"}},
      {"cN m", {"cNm", "cN m"}},
      {"daN m", {"daNm", "daN*m"}},
      {"gf cm",
       {"gf cm",
        "g\xc2\xb7"
        "cm",
        "gf*cm"}},
      {"lbf ft",
       {"ft\xc2\xb7lbf",
        "lbf\xc2\xb7"
        "ft",
        "ft-lb"}},
      {"mdeg", {"mdeg"}},
      {"urad", {"\xc2\xb5rad", "urad"}},
      {"krpm", {"krpm"}},
      {"rad/min", {"rad/min"}},
      {"in/s^2", {"in/s^2", "in/s\xc2\xb2"}},
      {"ft/s^2", {"ft/s2"}},
      {"inch", {"in", "inches"}},
      {"mil", {"mil"}},
      {"mstrain", {"\xe2\x80\xb0", "m\xce\xb5"}},
      {"h", {"h", "hours"}},
      {"ustrain",
       {"\xc2\xb5\xce\xb5", "\xce\xbcm/m", "microstrain", "um/m", "\xc2\xb5strain", "ppm",
        "\xc2\xb5in/in"}},
      {"V", {"V", "volts", "Volt"}},
      {"mV", {"mV", "millivolts"}},
      {"A", {"A", "amps"}},
  };
  for (const auto& [unit, spellings] : table) {
    for (const char* spelling : spellings) EXPECT_EQ(find_unit(spelling), unit) << spelling;
  }
}

TEST(UnitSpelling, WhatIsNoUnitIsNone) {
  for (const char* text : {"", "S", "M", "G", "H", "furlong", "rad s", "s/s", "m/s^", "theta",
                           "N/m/", "rad//s", "m^12"}) {
    EXPECT_EQ(find_unit(text), "") << text;
  }
}

TEST(UnitSpelling, ACapitalMIsMega) {
  EXPECT_EQ(find_unit("MNm"), "MN m");
  EXPECT_EQ(find_unit("MN m"), "MN m");
  EXPECT_EQ(find_unit("MN"), "MN");
  EXPECT_EQ(scale_of_unit("torque", "MNm"), 1e6);
  for (const char* text : {"MNM", "Mrad", "Mrad/s", "Mm", "Ms"})
    EXPECT_EQ(find_unit(text), "") << text;
  EXPECT_EQ(find_unit("Meters"), "m");
  EXPECT_EQ(find_unit("Min"), "min");
}

TEST(UnitSpelling, UnitsStandInHeadersInManyWays) {
  const auto expect = [](const char* header, const char* base, const char* unit) {
    const ColumnName name = split_column_name(header);
    EXPECT_EQ(name.base, base) << header;
    EXPECT_EQ(name.unit, unit) << header;
  };
  expect("Hubangle(Theta in rad)", "Hubangle", "rad");
  expect("Hub Angular Velocity (rads/s)", "Hub Angular Velocity", "rad/s");
  expect("Theta in rad", "Theta", "rad");
  expect("theta_in_deg", "theta", "deg");
  expect("Angle (deg, filtered)", "Angle", "deg");
  expect("Hub Velocity degrees per second", "Hub Velocity", "deg/s");
  expect("data(:,1)", "data(:,1)", "");
  expect("theta(2)", "theta(2)", "");
  expect("strain@0.05 [1]", "strain@0.05", "1");
  expect("torque_min", "torque_min", "");
  expect("torque_in", "torque_in", "");
  expect("tau_h", "tau_h", "");
  expect("Deflection [in]", "Deflection", "inch");
}

/// Each blank may stand in front of a unit: the time must not grow with the square of their number.
TEST(UnitSpelling, LongHeadersTakeLittleTime) {
  constexpr std::size_t kWords = 200'000;
  std::string words = "t";
  for (std::size_t i = 0; i < kWords; ++i) words += " b";
  EXPECT_EQ(split_column_name(words).base, words);
  EXPECT_EQ(split_column_name(words + " [rad]").unit, "rad");
  EXPECT_EQ(split_column_name(words + " rad").base, words);
  const std::string blanks = "t" + std::string(kWords, ' ') + "deg";
  EXPECT_EQ(split_column_name(blanks).base, "t");
  EXPECT_EQ(split_column_name(blanks).unit, "deg");
  EXPECT_EQ(find_unit("m" + std::string(kLongestUnit, ' ') + "s"), "");
}

/// A unit beyond those of a record stands for its scale, where none is given.
TEST(UnitSpelling, OtherUnitsHaveAScale) {
  EXPECT_EQ(scale_of_unit("hub_velocity", "rpm"), 2.0 * std::numbers::pi / 60.0);
  EXPECT_EQ(scale_of_unit("torque", "N cm"), 1e-2);
  EXPECT_NEAR(scale_of_unit("torque", "oz-in"), 0.00706155, 1e-8);
  EXPECT_EQ(scale_of_unit("hub_angle", "deg"), 1.0);  // a unit of a record has a factor
  EXPECT_TRUE(is_unit_of("tip_deflection", "cm"));
  EXPECT_FALSE(is_unit_of("torque", "V"));
}

}  // namespace
}  // namespace flexarm::measured
