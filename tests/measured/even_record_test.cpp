#include "measured/files/even_record.hpp"

#include "arm/input_error.hpp"
#include "measured/files/sample_clock.hpp"
#include "measured/files/time_grid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace flexarm::measured {
namespace {

using testing::HasSubstr;

constexpr double kPeriod_s = 0.01;

double angle_at(double time_s) {
  return std::sin(2.0 * std::numbers::pi * 3.0 * time_s);
}

/// A record at the times, of a sine of 3 Hz, and of a torque that is the number of the sample.
TimeRecord record_at(const std::vector<double>& times_s) {
  TimeRecord record{times_s, {}, {{{arm::SensorKind::hub_angle, 0.0}, {}}}};
  for (const double time_s : times_s) {
    record.torque_N_m.push_back(static_cast<double>(record.torque_N_m.size()));
    record.channels[0].values.push_back(angle_at(time_s));
  }
  return record;
}

std::vector<double> times_of(int samples, const std::function<double(int)>& time_s) {
  std::vector<double> times_s;
  for (int k = 0; k < samples; ++k) times_s.push_back(time_s(k));
  return times_s;
}

/// Largest error of the angle of a stretch.
double angle_error(const TimeRecord& record) {
  double error = 0.0;
  for (std::size_t k = 0; k < record.time_s.size(); ++k) {
    error = std::max(error, std::abs(record.channels[0].values[k] - angle_at(record.time_s[k])));
  }
  return error;
}

/// A reference is held, and where it steps no sample of it overshoots: it is the mean over the
/// step.
TEST(EvenRecord, AReferenceIsHeldLikeTheTorque) {
  TimeRecord record =
      record_at(times_of(200, [](int k) { return (k + (k % 3 == 1 ? 0.2 : 0.0)) * kPeriod_s; }));
  for (std::size_t k = 0; k < record.time_s.size(); ++k) {
    record.reference.values.push_back(3.0 * record.torque_N_m[k]);
  }
  record.reference.unit = "rad";
  const EvenRecords even = make_even(record);
  ASSERT_EQ(even.stretches.size(), 1U);
  EXPECT_THAT(even.notes[0], HasSubstr(", the reference by its mean over each step"));
  const TimeRecord& made = even.stretches[0];
  EXPECT_EQ(made.reference.unit, "rad");
  ASSERT_EQ(made.reference.values.size(), made.torque_N_m.size());
  for (std::size_t k = 0; k < made.torque_N_m.size(); ++k) {
    EXPECT_NEAR(made.reference.values[k], 3.0 * made.torque_N_m[k], 1e-9);
  }
}

TEST(EvenRecord, ARepeatedSampleIsLeftOutOfTheReferenceToo) {
  TimeRecord record =
      record_at(times_of(100, [](int k) { return (k < 50 ? k : k - 1) * kPeriod_s; }));
  record.reference = {"rad", record.torque_N_m};
  const EvenRecords even = make_even(record);
  ASSERT_EQ(even.stretches.size(), 1U);
  EXPECT_EQ(even.stretches[0].reference.values, even.stretches[0].torque_N_m);
  EXPECT_EQ(even.stretches[0].reference.values.size(), 99U);
}

TEST(EvenRecord, AnEvenOneIsReturnedBitForBit) {
  const TimeRecord record = record_at(times_of(50, [](int k) { return k * kPeriod_s; }));
  const EvenRecords even = make_even(record);
  ASSERT_EQ(even.stretches.size(), 1U);
  EXPECT_EQ(even.stretches[0], record);
  EXPECT_TRUE(even.notes.empty());
}

/// A cubic through four points h apart errs by up to 3/128 (h w)^4: 2e-4 for steps of up to 1.4
/// periods and 33 samples a cycle. Linear interpolation errs by (h w)^2/8 = 9e-3.
TEST(EvenRecord, JitterIsResampledAtTheTimesOfTheSamples) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> jitter(-0.2, 0.2);
  const TimeRecord record =
      record_at(times_of(2000, [&](int k) { return (k + jitter(random)) * kPeriod_s; }));
  const EvenRecords even = make_even(record);
  ASSERT_EQ(even.stretches.size(), 1U);
  ASSERT_EQ(even.notes.size(), 1U);
  EXPECT_THAT(even.notes[0], HasSubstr("sampling jitter up to 0.2 of the period 0.01 s"));
  EXPECT_THAT(even.notes[0], HasSubstr("sensors by cubic interpolation"));
  EXPECT_FALSE(grid_fault(even.stretches[0].time_s));
  EXPECT_NEAR(sampling_period_s(even.stretches[0]), kPeriod_s, 1e-3 * kPeriod_s);
  constexpr double kLargestError = 2e-4;
  EXPECT_LT(angle_error(even.stretches[0]), kLargestError);
  EXPECT_GT(angle_error(make_even(record, {.clock = Clock::even}).stretches[0]),
            100.0 * kLargestError);
}

/// The impulse of a held torque is that of its means over the new steps.
TEST(EvenRecord, AHeldTorqueKeepsItsImpulse) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> jitter(-0.3, 0.3);
  const TimeRecord record =
      record_at(times_of(400, [&](int k) { return (k + jitter(random)) * kPeriod_s; }));
  const TimeRecord even = make_even(record).stretches.at(0);
  const double period_s = sampling_period_s(even);
  double impulse = 0.0;
  for (const double torque : even.torque_N_m) impulse += torque * period_s;
  double expected = 0.0;
  const double end_s = even.time_s.back() + period_s;
  for (std::size_t k = 0; k < record.time_s.size() && record.time_s[k] < end_s; ++k) {
    const double next_s =
        k + 1 < record.time_s.size() ? std::min(record.time_s[k + 1], end_s) : end_s;
    expected += record.torque_N_m[k] * (next_s - record.time_s[k]);
  }
  EXPECT_NEAR(impulse, expected, 1e-12 * expected);
  const TimeRecord linear = make_even(record, {.torque_hold = TorqueHold::first}).stretches.at(0);
  EXPECT_NE(linear.torque_N_m[100], even.torque_N_m[100]);
}

TEST(EvenRecord, ALateSampleIsNotAMissingOne) {
  const auto times_s =
      times_of(200, [](int k) { return (k + (k == 60 || k == 130 ? 0.9 : 0.0)) * kPeriod_s; });
  EXPECT_TRUE(clock_steps(times_s).gaps.empty());
  const auto fault = grid_fault(times_s);
  ASSERT_TRUE(fault);
  EXPECT_THAT(fault->error.what(), HasSubstr("jitter 0.9"));
  const EvenRecords even = make_even(record_at(times_s));
  ASSERT_EQ(even.stretches.size(), 1U);
  EXPECT_EQ(even.stretches[0].time_s.size(), 200U);
}

TEST(EvenRecord, AStallWithABurstBehindIsNotAGap) {
  const auto times_s = times_of(
      200, [](int k) { return (k >= 80 && k < 84 ? 84.0 + 0.01 * (k - 84) : k) * kPeriod_s; });
  EXPECT_TRUE(clock_steps(times_s).gaps.empty());
}

/// Noise of samples that are taken almost at once is not blown up by the curve through them.
TEST(EvenRecord, SamplesThatLieCloseAreAveraged) {
  TimeRecord record =
      record_at(times_of(200, [](int k) { return (k + (k % 4 == 1 ? 0.99 : 0.0)) * kPeriod_s; }));
  std::mt19937_64 random(9);
  std::normal_distribution<double> noise(0.0, 0.01);
  for (double& value : record.channels[0].values) value += noise(random);
  EXPECT_LT(angle_error(make_even(record).stretches.at(0)), 0.06);
}

TEST(EvenRecord, RoundedTimesAreReplacedByTheirGrid) {
  const double period_s = 0.0016;
  const auto times_s =
      times_of(300, [&](int k) { return std::round(1000.0 * period_s * k) / 1000.0; });
  const TimeRecord record = record_at(times_s);
  const EvenRecords even = make_even(record);
  ASSERT_EQ(even.stretches.size(), 1U);
  ASSERT_EQ(even.notes.size(), 1U);
  EXPECT_THAT(even.notes[0], HasSubstr("times are rounded to 0.001 s"));
  EXPECT_EQ(even.stretches[0].torque_N_m, record.torque_N_m);
  EXPECT_NEAR(sampling_period_s(even.stretches[0]), period_s, 1e-3 * period_s);
  // Coarser than the period: stamps repeat, and no sample is left out.
  const auto coarse = record_at(times_of(300, [](int k) { return std::floor(0.6 * k) / 1000.0; }));
  const EvenRecords finer = make_even(coarse);
  ASSERT_EQ(finer.stretches.size(), 1U);
  EXPECT_EQ(finer.stretches[0].time_s.size(), 300U);
  EXPECT_NEAR(sampling_period_s(finer.stretches[0]), 0.0006, 1e-5);
}

std::string refusal(const TimeRecord& record) {
  try {
    make_even(record);
  } catch (const arm::InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(EvenRecord, TimesTooCoarseForAPeriodAreRefused) {
  const auto in_seconds = [](int samples, double period_s) {
    return record_at(
        times_of(samples, [&](int k) { return std::floor(0.9 + period_s * k + 1e-9); }));
  };
  for (const double period_s : {0.01, 0.002, 0.0201}) {
    EXPECT_THAT(refusal(in_seconds(300, period_s)), HasSubstr("--period")) << period_s;
  }
  EXPECT_THAT(refusal(in_seconds(300, 0.0201)),
              HasSubstr("time: times in steps of 1 s leave any sampling period from"));
  const EvenRecords even = make_even(in_seconds(20000, 0.0201));
  ASSERT_EQ(even.stretches.size(), 1U);
  EXPECT_NEAR(sampling_period_s(even.stretches[0]), 0.0201, 1e-3 * 0.0201);
  EXPECT_THAT(even.notes[0], HasSubstr("which they tell within 1e-08 s"));
}

TEST(EvenRecord, RowsOfSeveralSignalsAreRefusedAndCopiesLeftOut) {
  const auto pairs_every = [](int ms) {
    return times_of(600, [&](int k) { return 0.001 * ms * (k / 2); });
  };
  EXPECT_EQ(refusal(record_at(pairs_every(2))),
            "time: each time stands in 2 rows, with other values in each; if the rows are of "
            "several signals or devices, write each to columns or a file of its own; if the times "
            "are rounded, state the sampling period with --period");
  EXPECT_THAT(refusal(record_at(pairs_every(1))),
              HasSubstr("each time stands in 2 rows, with other values in each"));
  auto with_one_absent = pairs_every(2);
  with_one_absent.erase(with_one_absent.begin() + 101);
  EXPECT_THAT(refusal(record_at(with_one_absent)), HasSubstr("one time stands in up to 2 rows"));
  for (const int ms : {1, 2}) {
    TimeRecord copied = record_at(pairs_every(ms));
    for (std::size_t k = 0; k < copied.torque_N_m.size(); ++k) {
      copied.torque_N_m[k] = static_cast<double>(k / 2);
    }
    const EvenRecords even = make_even(copied);
    ASSERT_EQ(even.stretches.size(), 1U);
    EXPECT_EQ(even.stretches[0].time_s.size(), 300U);
    EXPECT_NEAR(sampling_period_s(even.stretches[0]), 0.001 * ms, 1e-9);
    EXPECT_THAT(even.notes[0],
                HasSubstr("300 samples with the time of the sample before left out"));
  }
}

TEST(EvenRecord, AShortGapIsFilledAndALongOneSplits) {
  const auto gap_of = [](int missing) {
    return record_at(times_of(200, [&](int k) { return (k < 100 ? k : k + missing) * kPeriod_s; }));
  };
  const EvenRecords filled = make_even(gap_of(2));
  ASSERT_EQ(filled.stretches.size(), 1U);
  EXPECT_EQ(filled.stretches[0].time_s.size(), 202U);
  EXPECT_LT(angle_error(filled.stretches[0]), 0.02);
  EXPECT_NEAR(filled.stretches[0].torque_N_m[100], 99.0, 1e-9);  // held through the gap
  EXPECT_THAT(filled.notes[0], HasSubstr("2 missing samples in 1 gap filled by interpolation"));
  const EvenRecords split = make_even(gap_of(4));
  ASSERT_EQ(split.stretches.size(), 2U);
  EXPECT_EQ(split.stretches[0].time_s.size(), 100U);
  EXPECT_EQ(split.stretches[1].torque_N_m[0], 100.0);
  EXPECT_THAT(split.notes[0], HasSubstr("4 samples missing between 0.99 s and 1.04 s"));
  EXPECT_EQ(make_even(gap_of(2), {.longest_filled_gap = 1}).stretches.size(), 2U);
}

TEST(EvenRecord, TimesThatGoBackSplitAndRepeatsAreLeftOut) {
  const EvenRecords back =
      make_even(record_at(times_of(100, [](int k) { return (k % 50) * kPeriod_s; })));
  ASSERT_EQ(back.stretches.size(), 2U);
  EXPECT_EQ(back.stretches[1].torque_N_m[0], 50.0);
  EXPECT_THAT(back.notes[0], HasSubstr("times go back at 1 place, first after 0.49 s"));
  const EvenRecords repeated =
      make_even(record_at(times_of(101, [](int k) { return (k <= 40 ? k : k - 1) * kPeriod_s; })));
  ASSERT_EQ(repeated.stretches.size(), 1U);
  EXPECT_EQ(repeated.stretches[0].time_s.size(), 100U);
  EXPECT_EQ(repeated.stretches[0].torque_N_m[41], 42.0);
  EXPECT_THAT(repeated.notes[0], HasSubstr("1 sample with the time of the sample before left out"));
}

TEST(EvenRecord, ARecordWithoutAStretchIsRefused) {
  EXPECT_THROW(make_even(record_at({0.0, 0.01, 0.025, 0.5, 0.52})), arm::InputError);
}

/// Two of three samples: their times alone might be rounded ones of 1.5 periods.
TEST(EvenRecord, AKnownGridIsFilled) {
  TimeRecord record =
      record_at(times_of(200, [](int k) { return (k / 2 * 3 + k % 2) * kPeriod_s; }));
  record.torque_N_m.assign(record.time_s.size(), 1.0);
  EvenOptions options;
  options.period_s = kPeriod_s;
  const EvenRecords even = make_even(record, options);
  ASSERT_EQ(even.stretches.size(), 1U);
  const TimeRecord& filled = even.stretches[0];
  ASSERT_EQ(filled.time_s.size(), 299U);
  for (std::size_t k = 0; k < filled.time_s.size(); ++k) {
    EXPECT_NEAR(filled.time_s[k], kPeriod_s * static_cast<double>(k), 1e-9);
    EXPECT_NEAR(filled.torque_N_m[k], 1.0, 1e-9);
  }
  EXPECT_LT(angle_error(filled), 5e-3);
  EXPECT_THAT(even.notes, testing::ElementsAre(HasSubstr("99 missing samples in 99 gaps filled")));
  options.longest_filled_gap = 0;
  EXPECT_THROW(make_even(record, options), arm::InputError);
}

}  // namespace
}  // namespace flexarm::measured
