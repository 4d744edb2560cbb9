// Arms that are released or tapped, without a torque: frequencies and damping ratios by the fit.
#include "measured/free_decay.hpp"

#include "arm/input_error.hpp"
#include "measured/run_identification.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace flexarm::measured {
namespace {

using testing::HasSubstr;

struct Decay {
  double frequency_Hz = 1.0;
  double damping_ratio = 0.01;
  double amplitude = 1.0;
  double phase_rad = 0.0;
};

struct DecayCase {
  std::string name;
  std::vector<Decay> decays;
  double released_s = 0.0;  ///< before: at `held`
  double held = 0.0;
  double noise = 0.02;  ///< standard deviation
  double offset = 0.0;
  double duration_s = 8.0;
  double period_s = 0.002;
  arm::SensorKind sensor = arm::SensorKind::tip_acceleration;
};

double value_of(const Decay& decay, double t_s) {
  const double omega = 2.0 * std::numbers::pi * decay.frequency_Hz;
  const double zeta = decay.damping_ratio;
  return decay.amplitude * std::exp(-zeta * omega * t_s) *
         std::cos(omega * std::sqrt(1.0 - zeta * zeta) * t_s + decay.phase_rad);
}

TimeRecord record_of(const DecayCase& decay_case, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> noise(0.0, decay_case.noise);
  TimeRecord record;
  Channel channel;
  channel.sensor.kind = decay_case.sensor;
  const auto samples = std::lround(decay_case.duration_s / decay_case.period_s);
  for (long k = 0; k < samples; ++k) {
    const double t_s = static_cast<double>(k) * decay_case.period_s;
    double value = decay_case.held;
    if (t_s >= decay_case.released_s) {
      value = 0.0;
      for (const Decay& decay : decay_case.decays) {
        value += value_of(decay, t_s - decay_case.released_s);
      }
    }
    record.time_s.push_back(t_s);
    record.torque_N_m.push_back(0.0);
    channel.values.push_back(value + decay_case.offset + noise(generator));
  }
  record.channels.push_back(channel);
  return record;
}

MeasuredRun run_of(const TimeRecord& record, InitialState initial = InitialState::free) {
  return {{.id = "ring", .file = "ring.csv", .initial = initial}, record};
}

std::vector<DecayCase> decay_cases() {
  using enum arm::SensorKind;
  const std::vector<Decay> two = {{2.9, 0.010, 5.0}, {18.0, 0.012, 1.0}};
  return {{.name = "from the first sample", .decays = two},
          {.name = "tapped after a second", .decays = two, .released_s = 1.0},
          {.name = "held bent, then released",
           .decays = {{1.8, 0.02, 0.03}, {11.0, 0.01, 0.004}},
           .released_s = 1.3,
           .held = 0.034,
           .noise = 1e-4,
           .sensor = tip_deflection},
          {.name = "an offset", .decays = {{6.5, 0.004, 1.0}}, .offset = 9.81},
          {.name = "three modes",
           .decays = {{3.0, 0.01, 1.0}, {19.0, 0.01, 1.0, 0.7}, {53.0, 0.008, 1.0, -1.2}},
           .noise = 0.05},
          {.name = "much noise", .decays = two, .noise = 0.5},
          {.name = "heavily damped", .decays = {{4.0, 0.12, 1.0}}, .noise = 0.002},
          {.name = "a short record of strain",
           .decays = {{9.0, 0.02, 1e-4, 1.0}},
           .noise = 1e-6,
           .duration_s = 1.0,
           .sensor = strain}};
}

TEST(FreeDecay, GivesFrequenciesAndDampingRatios) {
  for (const DecayCase& decay_case : decay_cases()) {
    const Identification found = identify({run_of(record_of(decay_case, 1))});
    ASSERT_EQ(found.fits.size(), 1U) << decay_case.name;
    const RunsFit& fitted = found.fits.front();
    EXPECT_TRUE(fitted.refusal.empty()) << decay_case.name << ": " << fitted.refusal;
    EXPECT_TRUE(fitted.fit.free_decay) << decay_case.name;
    EXPECT_EQ(doubt_of(fitted), "") << decay_case.name;
    std::vector<FittedPole> modes;
    std::ranges::copy_if(fitted.fit.poles, std::back_inserter(modes), &FittedPole::is_mode);
    ASSERT_EQ(modes.size(), decay_case.decays.size()) << decay_case.name;
    // Two numbers of at most three modes a case: one of 40 beyond this by a chance of 3 %.
    constexpr double kStandardErrors = 4.0;
    for (std::size_t i = 0; i < modes.size(); ++i) {
      const Decay& decay = decay_case.decays[i];
      EXPECT_NEAR(modes[i].frequency_Hz, decay.frequency_Hz,
                  kStandardErrors * modes[i].frequency_std_Hz)
          << decay_case.name;
      EXPECT_NEAR(modes[i].damping_ratio, decay.damping_ratio,
                  kStandardErrors * modes[i].damping_ratio_std)
          << decay_case.name;
      EXPECT_LT(modes[i].frequency_std_Hz, 0.01 * decay.frequency_Hz) << decay_case.name;
      EXPECT_LT(modes[i].damping_ratio_std, 0.2 * decay.damping_ratio) << decay_case.name;
    }
    for (const auto& reading : found.readings) {
      EXPECT_EQ(std::ranges::count(reading.table, Feature::zero, &ModalEntry::feature), 0);
    }
  }
}

TEST(FreeDecay, BeginsBehindTheRelease) {
  for (const DecayCase& decay_case : decay_cases()) {
    const TimeRecord record = record_of(decay_case, 2);
    const double begin_s = record.time_s[begin_of_decay(record)];
    EXPECT_GE(begin_s, decay_case.released_s) << decay_case.name;
    // Two windows of a fiftieth each.
    EXPECT_LE(begin_s, decay_case.released_s + 0.05 * decay_case.duration_s) << decay_case.name;
  }
}

TEST(FreeDecay, OfNoiseAloneIsRefused) {
  const DecayCase noise{.name = "noise", .decays = {}, .noise = 1.0};
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Identification found = identify({run_of(record_of(noise, seed))});
    ASSERT_EQ(found.fits.size(), 1U);
    EXPECT_THAT(found.fits.front().refusal, HasSubstr("no oscillation")) << seed;
  }
}

TEST(FreeDecay, FromRestIsAFault) {
  const TimeRecord record = record_of(decay_cases().front(), 1);
  EXPECT_THROW(identify({run_of(record, InitialState::rest)}), arm::InputError);
}

TEST(FreeDecay, OfSeveralRunsIsFittedTogether) {
  DecayCase again = decay_cases().front();
  for (Decay& decay : again.decays) decay.amplitude *= 0.3;
  MeasuredRun second = run_of(record_of(again, 2));
  second.run.id = "again";
  const Identification found = identify({run_of(record_of(decay_cases().front(), 1)), second});
  ASSERT_EQ(found.fits.size(), 1U);
  EXPECT_EQ(found.fits.front().runs.size(), 2U);
  EXPECT_EQ(found.readings.front().table.size(), 2U);
}

TEST(FreeDecay, WhileTheHubRestsIsThatOfTheHeldHub) {
  TimeRecord record = record_of(decay_cases().front(), 1);
  record.channels.push_back(
      {{arm::SensorKind::hub_angle, 0.0}, std::vector<double>(record.time_s.size(), 0.001)});
  const Identification found = identify({run_of(record)});
  EXPECT_TRUE(found.runs.front().hub_at_rest);
  ASSERT_EQ(found.readings.size(), 1U);
  EXPECT_TRUE(found.readings.front().hub_held);
  ASSERT_EQ(found.readings.front().table.size(), 2U);
  EXPECT_NEAR(*found.readings.front().table[0].frequency_Hz, 2.9, 0.003);
}

}  // namespace
}  // namespace flexarm::measured
