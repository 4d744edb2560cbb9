#include "response/excitation/excitation.hpp"

#include "arm/input_error.hpp"
#include "response/excitation/line_spectrum.hpp"

#include <Eigen/Core>
#include <gtest/gtest.h>
#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <ostream>

namespace flexarm::response {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr SampleGrid kGrid{4000, 0.002};

/// Sizes |c_k| of the lines of which `signal` is the sum, k = 0 to half its length.
std::vector<double> line_sizes(const std::vector<double>& signal) {
  Eigen::FFT<double> transform;
  std::vector<std::complex<double>> spectrum;
  transform.fwd(spectrum, signal);
  std::vector<double> sizes(signal.size() / 2 + 1);
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    sizes[k] = 2.0 * std::abs(spectrum[k]) / static_cast<double>(signal.size());
  }
  return sizes;
}

TEST(BangBang, IsAPairOfEqualPulses) {
  const auto torque = sample(BangBang{0.2, 0.3, 0.1}, kGrid).torque_N_m;
  ASSERT_EQ(torque.size(), 4000U);
  for (std::size_t k = 0; k < torque.size(); ++k) {
    const double expected = k < 50 || k >= 350 ? 0.0 : k < 200 ? 0.2 : -0.2;
    ASSERT_EQ(torque[k], expected) << k;
  }
}

TEST(BangBang, PulsesCancelWhateverThePeriod) {
  const auto torque = sample(BangBang{0.2, 0.3, 0.1}, {1000, 0.0071}).torque_N_m;
  EXPECT_EQ(std::ranges::count(torque, 0.2), 42);
  EXPECT_EQ(std::ranges::count(torque, -0.2), 42);
}

TEST(BangBang, PairsFillTheRecordWhenAsked) {
  const auto torque = sample(BangBang{0.2, 0.3, 0.0, 0}, kGrid).torque_N_m;
  EXPECT_EQ(std::ranges::count(torque, 0.2), 13 * 150);
  EXPECT_EQ(std::ranges::count(torque, 0.0), 4000 - 13 * 300);
}

TEST(Staircase, ClimbsAndDescends) {
  const Staircase stairs{.amplitude_N_m = 0.5, .dwell_s = 0.3, .start_s = 0.2, .levels = 2};
  const auto torque = sample(stairs, {20, 0.1}).torque_N_m;
  EXPECT_EQ(torque, (std::vector<double>{0.0, 0.0, 0.5, 0.5, 0.5, 1.0, 1.0, 1.0, 0.5, 0.5,
                                         0.5, 0.0, 0.0, 0.0, 0.5, 0.5, 0.5, 1.0, 1.0, 1.0}));
  const auto rounded = std::get<Staircase>(
      in_whole_samples(Staircase{.dwell_s = 0.3004, .start_s = 0.2003}, {20, 0.1}));
  EXPECT_EQ(rounded.dwell_s, 0.3);
  EXPECT_EQ(rounded.start_s, 0.2);
}

TEST(Excitation, IsSaidInWholeSamplesAsItIsSampled) {
  const SampleGrid grid{40, 0.1};
  const auto pulses = std::get<BangBang>(
      in_whole_samples(BangBang{.amplitude_N_m = 0.2, .pulse_s = 0.3007, .start_s = 0.0003}, grid));
  EXPECT_EQ(pulses.pulse_s, 0.3);
  EXPECT_EQ(pulses.start_s, 0.0);
  EXPECT_EQ(std::get<Step>(in_whole_samples(Step{.start_s = 0.16}, grid)).start_s, 0.2);
  EXPECT_EQ(std::get<Multisine>(in_whole_samples(Multisine{.period_s = 1.26}, grid)).period_s, 1.3);
  // Whole samples to rounding: as it was typed.
  EXPECT_EQ(std::get<Step>(in_whole_samples(Step{.start_s = 3 * 0.1}, grid)).start_s, 3 * 0.1);
}

TEST(Excitation, TheRootMeanSquareOfLargeTorquesIsANumber) {
  EXPECT_DOUBLE_EQ(rms_N_m(std::vector<double>{1e300, -1e300, 0.0, 0.0}), std::sqrt(0.5) * 1e300);
}

TEST(Step, BeginsAtItsSample) {
  const auto torque = sample(Step{-0.05, 0.1}, kGrid).torque_N_m;
  EXPECT_EQ(torque[49], 0.0);
  EXPECT_EQ(torque[50], -0.05);
  EXPECT_EQ(torque.back(), -0.05);
}

TEST(Prbs, HasTheGreatestPeriodOfItsRegister) {
  for (int length = 2; length <= 16; ++length) {
    const std::size_t period = (std::size_t{1} << static_cast<unsigned>(length)) - 1;
    const Prbs signal{.amplitude_N_m = 0.2, .clock_s = 0.001, .register_length = length, .seed = 3};
    const auto torque = sample(signal, {2 * period, 0.001}).torque_N_m;
    // Of a sequence of the greatest period: one value of one sign more, and a cyclic
    // autocorrelation of -1 for each shift, which no shorter period has.
    double sum = 0.0;
    for (std::size_t k = 0; k < period; ++k) {
      ASSERT_EQ(std::abs(torque[k]), 0.2);
      ASSERT_EQ(torque[k], torque[k + period]);
      sum += torque[k] / 0.2;
    }
    EXPECT_NEAR(sum, 1.0, 1e-6) << length;
    for (const std::size_t shift : {std::size_t{1}, period / 3, period / 2}) {
      if (shift % period == 0) continue;
      double product = 0.0;
      for (std::size_t k = 0; k < period; ++k) product += torque[k] * torque[k + shift] / 0.04;
      EXPECT_NEAR(product, -1.0, 1e-6) << length << ", " << shift;
    }
  }
}

TEST(Prbs, HoldsEachValueForItsClockAndBeginsBySeed) {
  const auto torque = sample(Prbs{0.1, 0.01, 9, 1}, kGrid).torque_N_m;
  for (std::size_t k = 0; k < torque.size(); ++k) ASSERT_EQ(torque[k], torque[k - k % 5]) << k;
  EXPECT_EQ(torque, sample(Prbs{0.1, 0.01, 9, 1}, kGrid).torque_N_m);
  EXPECT_NE(torque, sample(Prbs{0.1, 0.01, 9, 2}, kGrid).torque_N_m);
  EXPECT_NEAR(rms_N_m(torque), 0.1, 1e-15);
}

TEST(Sine, HasItsFrequencyAmplitudeOffsetAndPhaseFromItsStartOn) {
  const auto torque = sample(Sine{0.2, 3.0, 0.05, 0.4, 0.1}, kGrid).torque_N_m;
  for (std::size_t k = 0; k < torque.size(); ++k) {
    const double time_s = 0.002 * static_cast<double>(k) - 0.1;
    const double expected =
        k < 50 ? 0.0 : 0.05 + 0.2 * std::sin(2.0 * std::numbers::pi * 3.0 * time_s + 0.4);
    ASSERT_NEAR(torque[k], expected, 1e-13) << k;
  }
}

TEST(RandomNoise, IsBandLimitedAndOfItsRootMeanSquare) {
  const auto torque = sample(RandomNoise{0.05, 5.0, 60.0, 3}, kGrid).torque_N_m;
  const double rms = rms_N_m(torque);
  EXPECT_NEAR(rms, 0.05, 0.05 * kEpsilon * 100);
  const auto sizes = line_sizes(torque);
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    const double frequency_Hz = static_cast<double>(k) / 8.0;
    if (frequency_Hz < 4.99 || frequency_Hz > 60.01) {
      EXPECT_LT(sizes[k], 1e-15) << k;  // 2e-3 a line within, times rounding
    }
  }
}

TEST(RandomNoise, IsNormal) {
  const std::size_t samples = 200'000;
  const auto torque = sample(RandomNoise{1.0, 0.0, 250.0, 5}, {samples, 0.002}).torque_N_m;
  double third = 0.0;
  double fourth = 0.0;
  for (const double value : torque) {
    third += std::pow(value, 3) / static_cast<double>(samples);
    fourth += std::pow(value, 4) / static_cast<double>(samples);
  }
  // Standard errors sqrt(6/n) = 0.0055 and sqrt(24/n) = 0.011 of white normal noise, four of each.
  EXPECT_NEAR(third, 0.0, 0.022);
  EXPECT_NEAR(fourth, 3.0, 0.044);
}

TEST(RandomNoise, ASeedDeterminesEverySample) {
  const auto draw = [](std::uint64_t seed) {
    return sample(RandomNoise{0.05, 1.0, 50.0, seed}, kGrid).torque_N_m;
  };
  EXPECT_EQ(draw(7), draw(7));
  EXPECT_NE(draw(7), draw(8));
  // The upper half of a seed counts too.
  EXPECT_NE(draw(7), draw(7 + (std::uint64_t{1} << 40U)));
}

TEST(RandomNoise, LengthsWithLargePrimesAreNoObstacle) {
  const auto torque = sample(RandomNoise{0.05, 1.0, 50.0, 7}, {1'000'003, 0.002}).torque_N_m;
  EXPECT_EQ(torque.size(), 1'000'003U);
  EXPECT_NEAR(rms_N_m(torque), 0.05, 1e-12);
}

TEST(Multisine, HasEqualOddLinesInItsBandAndNothingElse) {
  const auto result = sample(Multisine{0.04, 2.0, 50.0, 4.0, 0, 9}, kGrid);
  // Odd multiples of 1/4 Hz from 2.25 to 49.75 Hz.
  ASSERT_EQ(result.lines_Hz.size(), 96U);
  EXPECT_DOUBLE_EQ(result.lines_Hz.front(), 2.25);
  EXPECT_DOUBLE_EQ(result.lines_Hz.back(), 49.75);
  EXPECT_TRUE(result.detection_Hz.empty());
  const std::vector<double> period(result.torque_N_m.begin(), result.torque_N_m.begin() + 2000);
  const auto sizes = line_sizes(period);
  const double amplitude = 0.04 * std::sqrt(2.0 / 96.0);
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    const bool excited = k % 2 == 1 && k >= 9 && k <= 199;
    EXPECT_NEAR(sizes[k], excited ? amplitude : 0.0, 100 * kEpsilon * amplitude) << k;
  }
  EXPECT_NEAR(rms_N_m(period), 0.04, 100 * kEpsilon);
  EXPECT_NEAR(crest_factor(period), peak_N_m(period) / 0.04, 1e-12);
  EXPECT_GT(crest_factor(period), 1.5);
  EXPECT_LT(crest_factor(period), 5.0);
}

TEST(Multisine, RepeatsWithItsPeriodAndIsOddInHalfOfIt) {
  const auto torque = sample(Multisine{0.04, 2.0, 50.0, 1.6, 0, 9}, kGrid).torque_N_m;
  for (std::size_t k = 0; k + 800 < torque.size(); ++k) ASSERT_EQ(torque[k + 800], torque[k]) << k;
  for (std::size_t k = 0; k < 400; ++k) {
    ASSERT_NEAR(torque[k + 400], -torque[k], 100 * kEpsilon) << k;
  }
}

TEST(Multisine, LeavesOneLineOfEachGroupOut) {
  const auto result = sample(Multisine{0.04, 1.0, 60.0, 0.0, 4, 2}, kGrid);
  EXPECT_EQ(result.lines_Hz.size() + result.detection_Hz.size(), 236U);
  EXPECT_EQ(result.detection_Hz.size(), 59U);
  const auto sizes = line_sizes(result.torque_N_m);
  for (std::size_t i = 0; i < result.detection_Hz.size(); ++i) {
    // Group i holds the odd lines 9 + 8 i to 15 + 8 i of 1/8 Hz.
    const auto line = static_cast<std::size_t>(std::lround(result.detection_Hz[i] * 8.0));
    EXPECT_EQ((line - 9) / 8, i);
    EXPECT_LT(sizes[line], 1e-15);
  }
  EXPECT_NEAR(rms_N_m(result.torque_N_m), 0.04, 100 * kEpsilon);
}

TEST(Chirp, GoesFromOneFrequencyToTheOther) {
  const auto crossings = [](const std::vector<double>& torque, std::size_t from, std::size_t to) {
    int count = 0;
    for (std::size_t k = from; k + 1 < to; ++k) count += torque[k] * torque[k + 1] < 0.0;
    return count;
  };
  // Cycles in a second: 8 s from 2 to 42 Hz; linear 4.5 in the first, 39.5 in the last.
  const auto linear = sample(Chirp{0.1, 2.0, 42.0, Sweep::linear}, kGrid).torque_N_m;
  EXPECT_NEAR(crossings(linear, 0, 500), 2 * 4.5, 1);
  EXPECT_NEAR(crossings(linear, 3500, 4000), 2 * 39.5, 1);
  // Logarithmic: 16/log 21 (21^(1/8) - 1) = 2.43 and 16/log 21 (21 - 21^(7/8)) = 34.9.
  const auto logarithmic = sample(Chirp{0.1, 2.0, 42.0, Sweep::logarithmic}, kGrid).torque_N_m;
  EXPECT_NEAR(crossings(logarithmic, 0, 500), 2 * 2.43, 1);
  EXPECT_NEAR(crossings(logarithmic, 3500, 4000), 2 * 34.9, 1);
  EXPECT_EQ(logarithmic[0], 0.0);
  EXPECT_LE(peak_N_m(linear), 0.1);
  EXPECT_GT(peak_N_m(linear), 0.0999);
}

TEST(LineSpectrum, IsTheSumOfItsLinesForAnyLength) {
  // Those from 101 on by a convolution.
  for (const std::size_t samples : {2U, 3U, 8U, 30U, 97U, 101U, 206U, 1009U}) {
    std::vector<std::complex<double>> lines(samples / 2 + 1);
    for (std::size_t k = 0; k < lines.size(); ++k) {
      lines[k] = std::polar(1.0 + static_cast<double>(k), 0.7 * static_cast<double>(k));
    }
    const auto sum = sum_of_lines(lines, samples);
    for (std::size_t j = 0; j < samples; ++j) {
      double expected = 0.0;
      double size = 0.0;
      for (std::size_t k = 0; k < lines.size(); ++k) {
        const double turns = static_cast<double>(j * k % samples) / static_cast<double>(samples);
        expected += (lines[k] * std::polar(1.0, 2.0 * std::numbers::pi * turns)).real();
        size += std::abs(lines[k]);
      }
      EXPECT_NEAR(sum[j], expected, 20 * kEpsilon * size) << samples;
    }
  }
}

TEST(LineSpectrum, PrimeFactors) {
  EXPECT_EQ(largest_prime_factor(1), 1U);
  EXPECT_EQ(largest_prime_factor(4000), 5U);
  EXPECT_EQ(largest_prime_factor(2 * 3 * 97), 97U);
  EXPECT_EQ(largest_prime_factor(1'000'003), 1'000'003U);
  EXPECT_EQ(next_smooth_number(97), 100U);
  EXPECT_EQ(next_smooth_number(100), 100U);
}

struct Mistake {
  const char* name;
  Excitation excitation;
  const char* error;
};

void PrintTo(const Mistake& mistake, std::ostream* out) {
  *out << mistake.name;
}

const double kNaN = std::numeric_limits<double>::quiet_NaN();

const std::vector<Mistake> kMistakes = {
    {"AmplitudeNotFinite", BangBang{kNaN},
     "bang-bang.amplitude = nan N m: must be a finite number"},
    {"PulseBelowASample", BangBang{0.1, 0.0005},
     "bang-bang.pulse = 0.0005 s: must be a sampling period, 0.002 s, or more"},
    {"PulsesDoNotFit", BangBang{0.1, 3.0, 3.0},
     "bang-bang: a pair of pulses from 3 s on, 3 s each, must end within the duration, 8 s"},
    {"PairsDoNotFit", BangBang{0.1, 1.0, 0.0, 5},
     "bang-bang: 5 pairs of pulses from 0 s on, 1 s each, must end within the duration, 8 s"},
    {"StepAfterTheEnd", Step{0.1, 8.0}, "step.start = 8 s: must be less than the duration, 8 s"},
    {"StartNegative", Step{0.1, -1.0}, "step.start = -1 s: must be a finite number, 0 or more"},
    {"BandAboveHalfTheSampling", RandomNoise{0.1, 1.0, 251.0},
     "random.to = 251 Hz: must be above 1 Hz and at most the Nyquist frequency, 250 Hz"},
    {"BandEmpty", RandomNoise{0.1, 5.0, 5.0},
     "random.to = 5 Hz: must be above 5 Hz and at most the Nyquist frequency, 250 Hz"},
    {"NoLine", RandomNoise{0.1, 5.01, 5.1},
     "random: no spectral line between 5.01 Hz and 5.1 Hz (line spacing 0.125 Hz); widen the band "
     "or increase the duration"},
    {"NoOddLine", Multisine{0.1, 0.2, 0.3},
     "multisine: no spectral line between 0.2 Hz and 0.3 Hz (line spacing 0.25 Hz); widen the band "
     "or increase the duration"},
    {"RmsNegative", Multisine{-0.1},
     "multisine.rms = -0.1 N m: must be a finite number, 0 or more"},
    {"PeriodBelowTwoSamples", Multisine{0.1, 1.0, 50.0, 1e-6},
     "multisine.period = 1e-06 s: must be two sampling periods, 0.004 s, or more"},
    {"PeriodTooLong", Multisine{0.1, 1.0, 50.0, 9.0},
     "multisine.period = 9 s: must be at most the duration, 8 s"},
    {"GroupOfOne", Multisine{0.1, 1.0, 50.0, 0.0, 1},
     "multisine.detection = 1: must be 0, or at least 2: one of so many odd lines is a detection "
     "line"},
    {"DwellBelowASample", Staircase{0.1, 0.0005},
     "staircase.dwell = 0.0005 s: must be a sampling period, 0.002 s, or more"},
    {"NoLevel", Staircase{.levels = 0}, "staircase.levels = 0: must be 1 or more"},
    {"ClockBelowASample", Prbs{.clock_s = 0.0005},
     "prbs.clock = 0.0005 s: must be a sampling period, 0.002 s, or more"},
    {"RegisterTooLong", Prbs{.register_length = 25}, "prbs.register = 25: must be from 2 to 24"},
    {"SineAboveHalfTheSampling", Sine{.frequency_Hz = 251.0},
     "sine.frequency = 251 Hz: must be above 0 and at most the Nyquist frequency, 250 Hz"},
    {"SineAfterTheEnd", Sine{.start_s = 9.0},
     "sine.start = 9 s: must be less than the duration, 8 s"},
    {"ChirpFromZero", Chirp{0.1, 0.0, 50.0}, "chirp.from = 0 Hz: must be a finite number above 0"},
};

class ExcitationMistake : public testing::TestWithParam<Mistake> {};

TEST_P(ExcitationMistake, GivesOneLineWithNumberUnitAndBound) {
  try {
    sample(GetParam().excitation, kGrid);
    FAIL() << "accepted";
  } catch (const arm::InputError& error) {
    EXPECT_STREQ(error.what(), GetParam().error);
  }
}

INSTANTIATE_TEST_SUITE_P(, ExcitationMistake, testing::ValuesIn(kMistakes),
                         [](const auto& mistake) { return std::string(mistake.param.name); });

TEST(Excitation, APrimePeriodThatCannotBeTransformedIsRefusedWithOneThatCan) {
  try {
    sample(Multisine{0.1, 1.0, 50.0}, {10'000'019, 0.002});
    FAIL() << "accepted";
  } catch (const arm::InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "multisine: a period of 10000019 samples has a prime factor too large for the FFT; "
        "use 10077696 samples, 20155.392 s");
  }
}

TEST(Excitation, AGridOfOneSampleIsRefused) {
  EXPECT_THROW(sample(Step{}, {1, 0.002}), arm::InputError);
  EXPECT_THROW(sample(Step{}, {10, 0.0}), arm::InputError);
}

}  // namespace
}  // namespace flexarm::response
