#include "measured/files/period_changes.hpp"

#include "measured/files/even_record.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <utility>

namespace flexarm::measured {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Times of blocks of so many steps of a period.
std::vector<double> times_of(const std::vector<std::pair<int, double>>& blocks) {
  std::vector<double> times_s = {0.0};
  for (const auto& [steps, period_s] : blocks) {
    const double first_s = times_s.back();
    for (int k = 1; k <= steps; ++k) times_s.push_back(first_s + period_s * k);
  }
  return times_s;
}

TEST(PeriodChanges, APeriodHalvesOrDoubles) {
  EXPECT_THAT(period_changes(times_of({{200, 0.002}, {200, 0.001}})), ElementsAre(201));
  EXPECT_THAT(period_changes(times_of({{200, 0.002}, {200, 0.004}})), ElementsAre(201));
}

TEST(PeriodChanges, APauseStandsInFrontOfTheNextBlock) {
  EXPECT_THAT(period_changes(times_of({{50, 0.002}, {1, 0.7}, {50, 0.005}})), ElementsAre(51));
}

TEST(PeriodChanges, ManyBlocksAndASlightChange) {
  EXPECT_THAT(
      period_changes(times_of({{40, 0.001}, {30, 0.002}, {20, 0.0015}, {60, 0.01}, {25, 0.0005}})),
      ElementsAre(41, 71, 91, 151));
  EXPECT_THAT(period_changes(times_of({{100, 0.002}, {100, 0.0025}})), ElementsAre(101));
}

TEST(PeriodChanges, AnUnevenClockMayChangeItsPeriod) {
  std::mt19937_64 random(20261201);
  std::uniform_real_distribution<double> jitter(-0.12, 0.12);
  std::vector<double> times_s = {0.0};
  for (int k = 0; k < 600; ++k) {
    times_s.push_back(times_s.back() + (k < 300 ? 0.002 : 0.001) * (1.0 + jitter(random)));
  }
  EXPECT_THAT(period_changes(times_s), ElementsAre(301));
}

TEST(PeriodChanges, NoChangeOfPeriod) {
  EXPECT_THAT(period_changes(times_of({{400, 0.002}})), IsEmpty());
  EXPECT_THAT(period_changes(times_of({{200, 0.002}, {1, 0.1}, {200, 0.002}})), IsEmpty())
      << "a pause";
  EXPECT_THAT(period_changes(times_of({{100, 0.002}, {1, 0.04}, {19, 1e-4}, {100, 0.002}})),
              IsEmpty())
      << "a burst after a stall";
  std::mt19937_64 random(20261202);
  std::uniform_real_distribution<double> jitter(-0.4, 0.4);
  std::vector<double> uneven = {0.0};
  std::vector<double> drifting = {0.0};
  for (int k = 0; k < 600; ++k) {
    uneven.push_back(uneven.back() + 0.002 * (1.0 + jitter(random)));
    drifting.push_back(drifting.back() + 0.002 * (1.0 + 0.0003 * k));
  }
  EXPECT_THAT(period_changes(uneven), IsEmpty());
  EXPECT_THAT(period_changes(drifting), IsEmpty());
  std::vector<double> bursts = {0.0};
  for (int k = 1; k < 400; ++k) bursts.push_back(bursts.back() + (k % 8 == 0 ? 0.0153 : 1e-4));
  EXPECT_THAT(period_changes(bursts), IsEmpty()) << "buffers of 8 samples";
}

TEST(PeriodChanges, MakeRunsWithoutInventedSamples) {
  TimeRecord record;
  record.time_s = times_of({{60, 0.001}, {60, 0.01}, {60, 0.003}});
  for (std::size_t k = 0; k < record.time_s.size(); ++k) {
    record.torque_N_m.push_back(static_cast<double>(k));
  }
  record.channels = {{{arm::SensorKind::hub_angle, 0.0}, record.torque_N_m}};
  const EvenRecords even = make_even(record);
  ASSERT_EQ(even.stretches.size(), 3U);
  std::vector<double> torques_N_m;
  for (const auto& stretch : even.stretches) {
    torques_N_m.insert(torques_N_m.end(), stretch.torque_N_m.begin(), stretch.torque_N_m.end());
  }
  EXPECT_EQ(torques_N_m, record.torque_N_m);
  EXPECT_NEAR(sampling_period_s(even.stretches[1]), 0.01, 1e-9);
  EXPECT_THAT(even.notes.front(),
              HasSubstr("the sampling period changes at 2 places, first after"));
}

}  // namespace
}  // namespace flexarm::measured
