// What each dirt of a recording does, and that none of it is left at size 0.
#include "tests/trials/dirt.hpp"

#include "arm/input_error.hpp"
#include "arm/uncertainties.hpp"
#include "measured/files/text_file.hpp"
#include "tests/trials/excitations.hpp"
#include "tests/trials/trial_case.hpp"
#include "tests/trials/trial_list.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

namespace flexarm::trials {
namespace {

namespace fs = std::filesystem;

/// Slow sines of different frequencies on all channels, as long as a run of a trial.
Recording sines() {
  Recording made;
  made.run.id = "sines";
  const auto wave = [](double cycles, double size) {
    std::vector<double> values;
    for (int k = 0; k < kSamples; ++k) {
      values.push_back(size * std::sin(2.0 * std::numbers::pi * cycles * k / kSamples));
    }
    return values;
  };
  for (int k = 0; k < kSamples; ++k) made.record.time_s.push_back(k * kSampleTime_s);
  made.record.torque_N_m = wave(7.0, 0.06);
  double cycles = 3.0;
  for (const arm::Sensor& sensor : planned_sensors()) {
    made.record.channels.push_back({sensor, wave(cycles, sensor == kGauge ? 2e-4 : 1.5)});
    cycles += 2.0;
  }
  return made;
}

Recording with(const std::string& name, double size = 1.0) {
  Recording made = sines();
  Random random(3, "dirt");
  find_dirt(name).recording(size, random, made);
  return made;
}

std::vector<double> added(const Recording& dirty, std::size_t channel) {
  const Recording clean = sines();
  std::vector<double> difference = dirty.record.channels.at(channel).values;
  for (std::size_t k = 0; k < difference.size(); ++k) {
    difference[k] -= clean.record.channels[channel].values[k];
  }
  return difference;
}

double clean_deviation(std::size_t channel) {
  return deviation(sines().record.channels.at(channel).values);
}

constexpr std::size_t kDirtAngle = 0;
constexpr std::size_t kDirtTip = 2;

std::vector<std::string> names_of_dirts() {
  std::vector<std::string> names;
  for (const Dirt& dirt : dirts()) names.push_back(dirt.name);
  return names;
}

class EveryDirt : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(, EveryDirt, testing::ValuesIn(names_of_dirts()),
                         [](const auto& one) { return one.param; });

TEST_P(EveryDirt, OfSizeZeroLeavesEverythingAsItIs) {
  const Dirt& dirt = find_dirt(GetParam());
  const TrialArm& of = trial_arms().front();
  Random random(1, "test");
  if (dirt.recording) {
    Recording made = sines();
    dirt.recording(0.0, random, made);
    const Recording clean = sines();
    EXPECT_EQ(made.run, clean.run);
    EXPECT_EQ(made.record.time_s, clean.record.time_s);
    EXPECT_EQ(made.record.torque_N_m, clean.record.torque_N_m);
    ASSERT_EQ(made.record.channels.size(), clean.record.channels.size());
    for (std::size_t i = 0; i < clean.record.channels.size(); ++i) {
      EXPECT_EQ(made.record.channels[i].values, clean.record.channels[i].values);
    }
  }
  if (dirt.plan) {
    std::vector<PlannedRun> runs(6);
    dirt.plan(0.0, runs);
    EXPECT_EQ(runs.size(), 6U);
  }
  if (dirt.hide) {
    EXPECT_TRUE(dirt.hide(0.0, of, World{of.arm}, random).hidden.empty());
  }
  if (dirt.simulation) {
    TimeOptions options;
    dirt.simulation(0.0, of, random, options);
    EXPECT_TRUE(options.late_substeps.empty());
    EXPECT_FALSE(options.control);
  }
  if (dirt.arm_file) {
    arm::Arm file = of.arm;
    dirt.arm_file(0.0, random, file);
    EXPECT_EQ(file, of.arm);
  }
}

/// The files of a case by name.
std::map<std::string, std::string> files_of(const TrialKey& key) {
  const fs::path folder = fs::path(testing::TempDir()) / ("dirt-" + key.folder_name());
  fs::remove_all(folder);
  write_case(key, folder);
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    files[entry.path().filename()] = measured::read_text_file(entry.path(), 1 << 26);
  }
  fs::remove_all(folder);
  return files;
}

TEST(Dirt, OfSizeZeroIsTheCleanCaseToTheLastBit) {
  const TrialKey clean{.kind = measured::RunKind::time};
  TrialKey without = clean;
  without.dirt = "drift";
  without.dirt_size = 0.0;
  EXPECT_NE(without.name(), clean.name());
  EXPECT_EQ(files_of(without), files_of(clean));
}

TEST(Dirt, EncoderCountsAreTheOnlyAngles) {
  const Recording made = with("encoder_counts");
  ASSERT_EQ(made.record.channels.size(), 3U);
  for (const double value : made.record.channels[kDirtAngle].values) {
    const double counts = value * 4096.0 / (2.0 * std::numbers::pi);
    EXPECT_NEAR(counts, std::round(counts), 1e-9);
  }
  EXPECT_EQ(made.record.channels[1].values, sines().record.channels[2].values);
}

TEST(Dirt, AConverterHasSteps) {
  const Recording made = with("adc_12_bit");
  const auto& values = made.record.channels[kDirtTip].values;
  const std::set<double> levels(values.begin(), values.end());
  EXPECT_GT(levels.size(), 1000U);
  EXPECT_LE(levels.size(), 4096U);
  const double step = 2.0 * 2.5 * 1.5 / 4096.0;
  for (const double difference : added(made, kDirtTip)) {
    EXPECT_LE(std::abs(difference), 0.5 * step * (1.0 + 1e-4));
  }
  EXPECT_EQ(made.record.channels[kDirtAngle].values, sines().record.channels[kDirtAngle].values);
}

TEST(Dirt, ColouredNoiseIsCorrelated) {
  const std::vector<double> noise = added(with("coloured_noise"), kDirtTip);
  double squares = 0.0;
  double products = 0.0;
  for (std::size_t k = 1; k < noise.size(); ++k) {
    squares += noise[k] * noise[k];
    products += noise[k] * noise[k - 1];
  }
  // 50 numbers are independent of the 4000, so that the deviation is known to a tenth.
  EXPECT_NEAR(std::sqrt(squares / kSamples) / clean_deviation(kDirtTip), 0.03, 0.3 * 0.03);
  EXPECT_NEAR(products / squares, 0.975, 0.01);
}

TEST(Dirt, DriftGoesOneWay) {
  std::vector<double> moved = added(with("drift"), kDirtTip);
  EXPECT_NEAR(std::abs(moved.back()) / clean_deviation(kDirtTip), 0.3, 1e-3);
  if (moved.back() < 0.0) {
    for (double& value : moved) value = -value;
  }
  EXPECT_TRUE(std::ranges::is_sorted(moved));
}

TEST(Dirt, HumIsOfTheMains) {
  const std::vector<double> hum = added(with("mains_hum"), kDirtTip);
  const auto amplitude = [&](double frequency_Hz) {
    std::complex<double> sum = 0.0;
    for (std::size_t k = 0; k < hum.size(); ++k) {
      const double turned = 2.0 * std::numbers::pi * frequency_Hz * kSampleTime_s;
      sum += hum[k] * std::polar(1.0, -turned * static_cast<double>(k));
    }
    return 2.0 * std::abs(sum) / kSamples / clean_deviation(kDirtTip) / std::numbers::sqrt2;
  };
  EXPECT_NEAR(amplitude(50.0), 0.04, 1e-6);
  EXPECT_NEAR(amplitude(150.0), 0.3 * 0.04, 1e-6);
  EXPECT_NEAR(amplitude(51.0), 0.0, 1e-6);
}

TEST(Dirt, OutliersAreFewAndFar) {
  int far = 0;
  for (const double value : added(with("outliers"), kDirtTip)) {
    if (value == 0.0) continue;
    ++far;
    EXPECT_GE(std::abs(value), 4.0 * clean_deviation(kDirtTip) * (1.0 - 1e-9));
  }
  // 8 are expected, Poisson.
  EXPECT_GE(far, 1);
  EXPECT_LE(far, 20);
}

TEST(Dirt, OnlyTheTorqueIsMeasuredWithMoreNoise) {
  const Recording made = with("noisy_torque");
  const Recording clean = sines();
  std::vector<double> noise = made.record.torque_N_m;
  for (std::size_t k = 0; k < noise.size(); ++k) noise[k] -= clean.record.torque_N_m[k];
  EXPECT_NEAR(deviation(noise) / deviation(clean.record.torque_N_m), 0.05, 0.005);
  for (std::size_t i = 0; i < clean.record.channels.size(); ++i) {
    EXPECT_EQ(made.record.channels[i].values, clean.record.channels[i].values);
  }
}

TEST(Dirt, SensorsOfTheBeamAreGone) {
  const Recording made = with("hub_sensors_only");
  ASSERT_EQ(made.record.channels.size(), 2U);
  EXPECT_EQ(made.record.channels[1].sensor.kind, arm::SensorKind::hub_velocity);
}

TEST(Dirt, AFreeStartIsInTheMidstOfARun) {
  const Recording made = with("free_start");
  const Recording clean = sines();
  constexpr std::size_t kBefore = 750;
  EXPECT_EQ(made.run.initial, measured::InitialState::free);
  EXPECT_EQ(made.record.time_s.size(), kSamples - kBefore);
  EXPECT_EQ(made.record.time_s.front(), 0.0);
  EXPECT_EQ(made.record.torque_N_m.front(), clean.record.torque_N_m[kBefore]);
  for (std::size_t i = 0; i < clean.record.channels.size(); ++i) {
    ASSERT_EQ(made.record.channels[i].values.size(), kSamples - kBefore);
    EXPECT_EQ(made.record.channels[i].values.front(), clean.record.channels[i].values[kBefore]);
  }
}

TEST(Dirt, OneRunIsLeft) {
  std::vector<PlannedRun> runs = {{"one"}, {"two"}, {"three"}};
  find_dirt("single_run").plan(1.0, runs);
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_EQ(runs.front().id, "two");
  EXPECT_EQ(runs.front().purpose, measured::Purpose::estimation);
}

TEST(Dirt, RoughNumbersAreDeclaredOrNot) {
  for (const TrialArm& of : trial_arms()) {
    arm::Arm declared = of.arm;
    arm::Arm undeclared = of.arm;
    Random random(5, "rough");
    find_dirt("declared_numbers").arm_file(1.0, random, declared);
    Random same(5, "rough");
    find_dirt("undeclared_numbers").arm_file(1.0, same, undeclared);
    EXPECT_EQ(declared.relative_uncertainties.size(), 3U);
    EXPECT_NO_THROW(arm::require_valid_uncertainties(declared));
    for (const auto& [key, uncertainty] : declared.relative_uncertainties) {
      EXPECT_GE(uncertainty, 0.03) << key;
      EXPECT_LE(uncertainty, 0.1) << key;
    }
    EXPECT_TRUE(undeclared.relative_uncertainties.empty());
    const double factor =
        declared.beam.flexural_rigidity_N_m2() / of.arm.beam.flexural_rigidity_N_m2();
    EXPECT_NE(factor, 1.0);
    EXPECT_NEAR(std::log(factor), 0.0, 0.4);
    declared.relative_uncertainties.clear();
    EXPECT_EQ(declared, undeclared);
  }
}

TEST(Dirt, OfAKnownNameIsHiddenLikeACause) {
  const TrialArm& of = trial_arms().front();
  for (const Dirt& dirt : dirts()) {
    if (!dirt.hide) continue;
    Random random(2, "hidden");
    const World world = dirt.hide(1.0, of, World{of.arm}, random);
    ASSERT_EQ(world.hidden.size(), 1U) << dirt.name;
    EXPECT_THAT(dirt.named_as, testing::ElementsAre(world.hidden.front().name)) << dirt.name;
  }
}

TEST(Dirt, AQuarterOfTheStrengthMakesAQuarterOfTheError) {
  const auto error = [](const std::string& dirt) {
    const TrialKey key{
        .kind = measured::RunKind::modal, .hidden = {"flexural_rigidity"}, .dirt = dirt};
    const fs::path folder = fs::path(testing::TempDir()) / ("quarter-" + key.folder_name());
    const Truth truth = write_case(key, folder);
    fs::remove_all(folder);
    return truth.errors.at(0);
  };
  // Each is reached to 5 %.
  EXPECT_NEAR(error("quarter_strength") / error(""), 0.25, 0.25 * 0.11);
}

constexpr std::size_t kDirtShortRun = 1200;

TEST(Dirt, TheTorqueOfAClosedLoopIsTheOneThatIsRecorded) {
  const TrialArm& of = trial_arms().front();
  Random random(4, "loop");
  TimeOptions options;
  find_dirt("closed_loop").simulation(1.0, of, random, options);
  const auto& sensors = planned_sensors();
  const World world{of.arm};
  const SimulatedRun loop =
      simulate_run(world, sensors, std::vector<double>(kDirtShortRun, 0.0), options);
  const double limit_N_m = 6.0 * of.low_torque_N_m;
  const auto [least, most] = std::ranges::minmax(loop.torque_N_m);
  EXPECT_GE(least, -limit_N_m);
  EXPECT_LE(most, limit_N_m);
  EXPECT_GT(deviation(loop.torque_N_m), 0.3 * of.low_torque_N_m);
  // It does not run away: the stairs are within 4 low torques over kp = I (2 pi 0.5)^2.
  const double stair_rad =
      4.0 * of.low_torque_N_m / (NaturalSizes(of).inertia_kg_m2 * std::pow(std::numbers::pi, 2));
  for (const double angle : loop.channels[kDirtAngle]) EXPECT_LE(std::abs(angle), 3.0 * stair_rad);
  // Open loop under that torque is the same motion.
  EXPECT_EQ(simulate_in_time(world, sensors, loop.torque_N_m), loop.channels);
}

TEST(Dirt, LateReadingsAreThoseOfAFinerRecord) {
  const TrialArm& of = trial_arms().front();
  Random random(6, "late");
  std::vector<double> torque = random_torque(2.0 * of.low_torque_N_m, random);
  torque.resize(kDirtShortRun);
  const auto& sensors = planned_sensors();
  TimeOptions late;
  late.late_substeps.assign(kDirtShortRun, late.substeps / 2);
  const auto readings = simulate_in_time(World{of.arm}, sensors, torque, late);
  std::vector<double> twice;
  for (const double value : torque) twice.insert(twice.end(), 2, value);
  TimeOptions fine;
  fine.sample_time_s = 0.5 * kSampleTime_s;
  fine.substeps = late.substeps / 2;
  const auto finer = simulate_in_time(World{of.arm}, sensors, twice, fine);
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const double unit = deviation(readings[i]);
    for (std::size_t k = 0; k < kDirtShortRun; ++k) {
      // Rounding of 2e5 steps.
      ASSERT_NEAR(readings[i][k], finer[i][2 * k + 1], 1e-9 * unit) << i << " " << k;
    }
  }
}

TEST(Dirt, IsListedBesideWhatItLeavesToBeSeen) {
  const auto listed = [](const std::string& dirt, const std::string& effects) {
    return list_trials({.kinds = {"time", "frf"},
                        .effects = {effects},
                        .strengths = {"middle"},
                        .noises = {0.005},
                        .dirts = {dirt}});
  };
  EXPECT_EQ(listed("drift", "none").size(), 1U);  // of time runs only
  EXPECT_EQ(listed("none", "none").size(), 2U);
  EXPECT_EQ(listed("all", "none").size(), dirts().size());
  EXPECT_TRUE(listed("late_sensor", "sensor_delay").empty());
  EXPECT_TRUE(listed("hub_sensors_only", "gauge_position").empty());
  const auto triple = listed("drift", "triples");
  ASSERT_EQ(triple.size(), 1U);
  EXPECT_EQ(std::set<std::string>(triple[0].hidden.begin(), triple[0].hidden.end()).size(), 3U);
  EXPECT_THROW(listed("drifft", "none"), arm::InputError);
}

}  // namespace
}  // namespace flexarm::trials
