#include "arm/input_error.hpp"
#include "measured/checks/time_unit_check.hpp"
#include "measured/files/decimation.hpp"
#include "measured/files/raw_doubles.hpp"
#include "measured/files/record_range.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <unistd.h>

namespace flexarm::measured {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kTurn_rad = 2.0 * std::numbers::pi;

double sine(double time_s, double frequency_Hz) {
  return std::sin(kTurn_rad * frequency_Hz * time_s);
}

/// 1 kHz; the torque is a sine of one frequency, the hub angle one of another.
TimeRecord sines(double torque_Hz, double angle_Hz, int samples) {
  TimeRecord record{{}, {}, {{{arm::SensorKind::hub_angle, 0.0}, {}}}};
  for (int k = 0; k < samples; ++k) {
    const double time_s = k * 1e-3;
    record.time_s.push_back(time_s);
    record.torque_N_m.push_back(sine(time_s, torque_Hz));
    record.channels[0].values.push_back(sine(time_s, angle_Hz));
  }
  return record;
}

/// Ripple and stop band are 80 dB, as the window is designed for; the bound leaves 1 dB for
/// Kaiser's formulas, which are empirical.
TEST(Decimation, TheFilterPassesAndStopsAsStated) {
  constexpr double kRipple = 1.2e-4;
  for (const std::size_t factor : {2U, 5U, 16U}) {
    const auto filter = decimation_filter(factor);
    ASSERT_EQ(filter.size() % 2, 1U);
    for (int i = 0; i <= 2000; ++i) {
      const double nyquists = i * 1e-3;  // of the decimated record
      std::complex<double> gain = 0.0;
      for (std::size_t k = 0; k < filter.size(); ++k) {
        gain += filter[k] * std::polar(1.0, -std::numbers::pi * nyquists * static_cast<double>(k) /
                                                static_cast<double>(factor));
      }
      if (nyquists <= 0.8) {
        EXPECT_NEAR(std::abs(gain), 1.0, kRipple) << factor << " " << nyquists;
      }
      if (nyquists >= 1.0 && nyquists <= static_cast<double>(factor)) {
        EXPECT_LT(std::abs(gain), kRipple) << factor << " " << nyquists;
      }
    }
  }
}

TEST(Decimation, KeepsWhatIsSlowInPhaseAndRemovesWhatWouldAlias) {
  const TimeRecord record = decimated(sines(8.0, 190.0, 2000), 5);  // to 200 Hz
  EXPECT_NEAR(sampling_period_s(record), 5e-3, 1e-12);
  constexpr double kLargestError = 1e-3;
  for (std::size_t k = 0; k < record.time_s.size(); ++k) {
    EXPECT_NEAR(record.torque_N_m[k], sine(record.time_s[k], 8.0), kLargestError);
    EXPECT_NEAR(record.channels[0].values[k], 0.0, kLargestError);
  }
}

TEST(Decimation, ARecordThatIsTooShortIsRefused) {
  try {
    decimated(sines(1.0, 1.0, 100), 5);
    FAIL() << "accepted";
  } catch (const arm::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("100 samples are too few to decimate by 5, whose filter"));
  }
}

/// No controller makes a filtered torque of a reference.
TEST(Decimation, LeavesAReferenceOut) {
  TimeRecord record = sines(1.0, 1.0, 2000);
  record.reference = {"rad", record.torque_N_m};
  EXPECT_EQ(decimated(record, 5).reference, Reference());
}

TEST(RecordRange, HasTheReferenceOfItsSamples) {
  TimeRecord record = sines(1.0, 2.0, 100);
  record.reference = {"rad/s", record.time_s};
  std::size_t first = 0;
  const TimeRecord part = part_of(record, parse_range("11:20", true), first);
  EXPECT_EQ(part.reference.unit, "rad/s");
  EXPECT_EQ(part.reference.values, part.time_s);
}

TEST(RecordRange, KnowsItsReadingsThatAreLeftOut) {
  TimeRecord record = sines(1.0, 2.0, 100);
  record.channels[0].left_out = {3, 10, 15, 20};
  EXPECT_THAT(samples_of(record, 10, 20).channels[0].left_out, ElementsAre(0, 5));
}

TEST(RecordRange, IsOfRowsOrTimes) {
  const TimeRecord record = sines(1.0, 2.0, 100);
  std::size_t first = 0;
  const TimeRecord rows = part_of(record, parse_range("11:20", true), first);
  EXPECT_EQ(first, 10U);
  EXPECT_EQ(rows.time_s.size(), 10U);
  EXPECT_EQ(rows.channels[0].values[0], record.channels[0].values[10]);
  const TimeRecord times = part_of(record, parse_range("0.0105:", false), first);
  EXPECT_EQ(first, 11U);
  EXPECT_EQ(times.time_s.back(), record.time_s.back());
  EXPECT_EQ(part_of(record, parse_range(":0.05", false), first).time_s.size(), 51U);
}

TEST(RecordRange, WhatIsNoneIsOneLine) {
  const auto refusal = [](const char* text, bool by_rows) {
    try {
      std::size_t first = 0;
      part_of(sines(1.0, 2.0, 100), parse_range(text, by_rows), first);
    } catch (const arm::InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(refusal("5", true), "5: must be FROM:TO, FROM: or :TO");
  EXPECT_EQ(refusal("0:5", true), "0: must be a row, a whole number from 1");
  EXPECT_EQ(refusal("x:5", false), "x: must be a time in s");
  EXPECT_EQ(refusal("7:5", false), "7:5: must end after its beginning");
  EXPECT_EQ(refusal("7:9", false),
            "0 samples in this range; the file has rows 1 to 100, times 0 s to 0.099 s");
}

class RawDoubles : public testing::Test {
 protected:
  ~RawDoubles() override { std::filesystem::remove(path_); }
  void write(const std::string& bytes) const { std::ofstream(path_, std::ios::binary) << bytes; }
  std::filesystem::path path_ = std::filesystem::temp_directory_path() /
                                ("flexarm-raw-" + std::to_string(::getpid()) + ".bin");
};

TEST_F(RawDoubles, AreRowsOfColumns) {
  // 1, -2; 0.5, 3 by the bytes of IEEE 754, the lowest first.
  const auto high = [](unsigned char top, unsigned char next) {
    return std::string(6, '\0') + static_cast<char>(next) + static_cast<char>(top);
  };
  write(high(0x3f, 0xf0) + high(0xc0, 0x00) + high(0x3f, 0xe0) + high(0x40, 0x08));
  const ForeignTable table = read_raw_doubles(path_, 2);
  ASSERT_EQ(table.columns.size(), 2U);
  EXPECT_THAT(table.columns[0].values, ElementsAre(1.0, 0.5));
  EXPECT_THAT(table.columns[1].values, ElementsAre(-2.0, 3.0));
  EXPECT_EQ(table.columns[1].name, "column 2");
  EXPECT_THROW(read_raw_doubles(path_, 3), arm::InputError);
  EXPECT_THROW(read_raw_doubles(path_, 1), arm::InputError);
}

/// An arm that swings at 1 Hz, sampled at 500 Hz, with times times `per_second`.
TimeRecord swing(double per_second, bool with_velocity) {
  TimeRecord record{{}, {}, {{{arm::SensorKind::hub_angle, 0.0}, {}}}};
  if (with_velocity) record.channels.push_back({{arm::SensorKind::hub_velocity, 0.0}, {}});
  for (int k = 0; k < 1000; ++k) {
    const double time_s = 0.002 * k;
    record.time_s.push_back(per_second * time_s);
    record.torque_N_m.push_back(0.0);
    record.channels[0].values.push_back(sine(time_s, 1.0));
    if (with_velocity) {
      record.channels[1].values.push_back(kTurn_rad * std::cos(kTurn_rad * time_s));
    }
  }
  return record;
}

TEST(TimeUnit, TheVelocityTellsMillisecondsFromSeconds) {
  EXPECT_FALSE(doubt_time_unit(swing(1.0, true)));
  const auto called_s = doubt_time_unit(swing(1e3, true));
  ASSERT_TRUE(called_s);
  EXPECT_NEAR(called_s->factor, 1e-3, 1e-12);
  EXPECT_THAT(called_s->evidence, HasSubstr("0.001 of the integral of the hub velocity"));
  const auto called_ms = doubt_time_unit(swing(1e-3, true));
  ASSERT_TRUE(called_ms);
  EXPECT_NEAR(called_ms->factor, 1e3, 1e-6);
}

TEST(TimeUnit, WithoutAVelocityThePeriodDoes) {
  EXPECT_FALSE(doubt_time_unit(swing(1.0, false)));
  EXPECT_FALSE(doubt_time_unit(swing(100.0, false)));  // 5 Hz may be meant
  const auto slow = doubt_time_unit(swing(1e3, false));
  ASSERT_TRUE(slow);
  EXPECT_EQ(slow->factor, 1e-3);
  EXPECT_THAT(slow->evidence, HasSubstr("one sample every 2 s"));
  EXPECT_TRUE(doubt_time_unit(swing(1e-4, false)));
  for (const double factor : {1e3, 1e6, 1e9}) {
    const auto doubt = doubt_time_unit(swing(factor, false));
    ASSERT_TRUE(doubt) << factor;
    EXPECT_NEAR(doubt->factor * factor, 1.0, 1e-9);
  }
}

}  // namespace
}  // namespace flexarm::measured
