#include "measured/spectra/distortion.hpp"

#include "effects/registry/vocabulary.hpp"
#include "measured/spectra/response_estimate.hpp"
#include "tests/measured/simulated_record.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

namespace flexarm::measured {
namespace {

constexpr std::size_t kSamples = 1000;
constexpr std::size_t kPeriods = 8;

const std::vector<std::string> kSensors = {"hub_angle", "hub_velocity", "strain@0.05"};

std::vector<double> multisine(std::uint64_t seed, std::size_t periods = kPeriods) {
  return torque_of(response::Multisine{.rms_N_m = 0.1,
                                       .from_Hz = 0.2,
                                       .to_Hz = 40.0,
                                       .period_s = kSamples * kPeriod_s,
                                       .detection_group = 4,
                                       .seed = seed},
                   periods * kSamples, kPeriod_s);
}

Distortion distortion_of(const SimulatedArm& arm, std::uint64_t seed, double noise) {
  const auto record =
      arm.record(multisine(seed), kPeriod_s, response::TorqueHold::zero, noise, seed);
  const auto estimate = estimate_frequency_response(record);
  return distortion(estimate.periodic.value());
}

bool any_found(const Distortion& found, DistortionTest ChannelDistortion::*parity) {
  for (const auto& channel : found.channels) {
    if ((channel.*parity).found) return true;
  }
  return false;
}

TEST(DistortionTestOfALinearArm, ClaimsNoneInAHundredSeeds) {
  const SimulatedArm arm(settling_arm(), sensors_named(kSensors), 3);
  int claims = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const auto found = distortion_of(arm, seed, seed % 2 == 0 ? 0.01 : 0.001);
    ASSERT_TRUE(found.testable) << found.reason;
    claims +=
        any_found(found, &ChannelDistortion::odd) || any_found(found, &ChannelDistortion::even);
  }
  // 100 records at 1e-3: one claim would come in ten such tests.
  EXPECT_EQ(claims, 0);
}

TEST(DistortionTestOfNoise, ClaimsAtTheStatedRate) {
  // The statistic alone, on white noise beside an odd multisine, at a level that 500 records show.
  constexpr double kRate = 0.1;
  constexpr int kRuns = 500;
  const auto torque = multisine(1, 3);
  int claims = 0;
  for (std::uint64_t run = 0; run < kRuns; ++run) {
    auto y = white_noise(torque.size(), 1000 + run);
    for (std::size_t j = 0; j < y.size(); ++j) y[j] += torque[j];
    const std::vector<Signal> outputs = {{y}};
    const auto found = distortion(periodic_spectra({torque}, outputs, kPeriod_s, kSamples, 3),
                                  {.false_alarm_rate = kRate});
    claims += found.channels[0].odd.found || found.channels[0].even.found;
  }
  // Twice the lesser of two dependent probabilities is a bound, not the rate: it may be a third too
  // careful. Above, four standard deviations of a count.
  const double rate = static_cast<double>(claims) / kRuns;
  EXPECT_LT(rate, kRate + 4.0 * std::sqrt(kRate / kRuns));
  EXPECT_GT(rate, 0.5 * kRate);
}

struct Fault {
  const char* name;
  std::function<void(response::ArmParts&)> plant;
  bool odd;
  bool even;
};

void PrintTo(const Fault& fault, std::ostream* out) {
  *out << fault.name;
}

constexpr auto name_of_fault = [](const auto& info) { return std::string(info.param.name); };

class DistortionOf : public testing::TestWithParam<Fault> {};

TEST_P(DistortionOf, IsFoundByItsParity) {
  SimulatedArm arm(settling_arm(), sensors_named(kSensors), 3);
  GetParam().plant(arm.parts());
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto found = distortion_of(arm, seed, 0.001);
    ASSERT_TRUE(found.testable) << found.reason;
    EXPECT_EQ(any_found(found, &ChannelDistortion::odd), GetParam().odd) << seed;
    EXPECT_EQ(any_found(found, &ChannelDistortion::even), GetParam().even) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Faults, DistortionOf,
    testing::Values(
        Fault{
            "CoulombFriction",
            [](auto& parts) {
              response::add_effect(parts, effects::effect("coulomb_friction", {{"torque", 0.01}}));
            },
            true, false},
        Fault{"DeadZone",
              [](auto& parts) {
                response::add_effect(parts, effects::effect("torque_dead_zone", {{"width", 0.02}}));
              },
              true, false},
        Fault{
            "Saturation",
            [](auto& parts) {
              response::add_effect(parts, effects::effect("torque_saturation", {{"limit", 0.15}}));
            },
            true, false},
        Fault{
            "BiasAndFriction",
            [](auto& parts) {
              response::add_effect(parts, effects::effect("coulomb_friction", {{"torque", 0.02}}));
              response::add_effect(parts, effects::effect("torque_bias", {{"torque", 0.02}}));
            },
            true, true},
        // The hub settles where the ripple's torque is zero and turns about that symmetrically; a
        // bias moves it to where it is not.
        Fault{"Ripple",
              [](auto& parts) {
                response::add_effect(parts, effects::effect("torque_ripple", {{"amplitude", 0.05},
                                                                              {"cycles", 20.0},
                                                                              {"phase", 0.4}}));
              },
              true, false},
        Fault{"RippleAndBias",
              [](auto& parts) {
                response::add_effect(parts, effects::effect("torque_ripple", {{"amplitude", 0.05},
                                                                              {"cycles", 20.0},
                                                                              {"phase", 0.4}}));
                response::add_effect(parts, effects::effect("torque_bias", {{"torque", 0.03}}));
              },
              true, true}),
    name_of_fault);

TEST(DistortionLevel, OfAKnownSquareIsTheLinesOfTheSquare) {
  // y = x + c x^2: the even lines are those of c x^2.
  constexpr double kSquare = 0.3;
  const auto x = multisine(3);
  auto y = x;
  std::vector<double> square(x.size());
  const auto noise = white_noise(x.size(), 4);
  for (std::size_t j = 0; j < x.size(); ++j) {
    square[j] = kSquare * x[j] * x[j];
    y[j] += square[j] + 1e-5 * noise[j];
  }
  const std::vector<Signal> outputs = {{y}, {square}};
  const auto spectra = periodic_spectra({x}, outputs, kPeriod_s, kSamples, kPeriods);
  const auto found = distortion(spectra);
  EXPECT_FALSE(found.channels[0].odd.found);
  EXPECT_TRUE(found.channels[0].even.found);
  double power = 0.0;
  double driven = 0.0;
  int driven_count = 0;
  for (std::size_t k = 0; k < 200; ++k) {
    const auto& line = found.channels[0].lines[k];
    if (line.kind == LineKind::driven) {
      driven += line.amplitude * line.amplitude;
      ++driven_count;
    }
    if (line.kind != LineKind::even) continue;
    EXPECT_NEAR(line.amplitude, std::abs(spectra.outputs[1].amplitude[k]), 6.0 * line.noise_std);
    power += std::norm(spectra.outputs[1].amplitude[k]);
  }
  const double level_dB =
      10.0 * std::log10(power / static_cast<double>(found.channels[0].even.lines) /
                        (driven / driven_count));
  EXPECT_NEAR(found.channels[0].even.level_dB, level_dB, 0.1);
  EXPECT_LT(found.channels[0].even.noise_dB, level_dB - 20.0);
}

TEST(DistortionOfARecord, IsNotTestableWithOnePeriod) {
  const SimulatedArm arm(settling_arm(), sensors_named({"strain@0.05"}), 3);
  const auto record = arm.record(multisine(1, 1), kPeriod_s);
  const auto estimate = estimate_frequency_response(record, {.period_samples = kSamples});
  const auto found = distortion(estimate.periodic.value());
  EXPECT_FALSE(found.testable);
  EXPECT_THAT(found.reason, testing::HasSubstr("cannot be separated"));
  EXPECT_TRUE(found.channels.empty());
}

TEST(DistortionOfARecord, IsNotTestableWithEvenLinesInTheTorque) {
  auto period = white_noise(kSamples, 5);
  std::vector<double> torque;
  for (int i = 0; i < 4; ++i) torque.insert(torque.end(), period.begin(), period.end());
  const std::vector<Signal> outputs = {{torque}};
  const auto found = distortion(periodic_spectra({torque}, outputs, kPeriod_s, kSamples, 4));
  EXPECT_FALSE(found.testable);
  EXPECT_THAT(found.reason, testing::HasSubstr("even lines"));
}

}  // namespace
}  // namespace flexarm::measured
