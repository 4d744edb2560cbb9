#include "measured/spectra/spectra.hpp"

#include "arm/input_error.hpp"
#include "tests/measured/signals.hpp"

#include <gtest/gtest.h>

#include <array>

namespace flexarm::measured {
namespace {

/// Sums of some thousand rounded terms.
constexpr double kSumRounding = 1e-12;

double sum_over_lines(const std::vector<double>& density, double spacing_Hz) {
  double sum = 0.0;
  for (const double value : density) sum += value * spacing_Hz;
  return sum;
}

TEST(CrossSpectraTest, IsTheDirectFormulaSegmentBySegment) {
  constexpr std::size_t kSegment = 30;
  constexpr std::size_t kShift = 11;
  const auto x = white_noise(100, 1);
  const auto y = white_noise(100, 2);
  const std::array<Signal, 1> outputs = {Signal{y}};
  const auto window = window_values(Window::hann, kSegment);
  double squares = 0.0;
  for (const double w : window) squares += w * w;
  for (const Detrend detrend : {Detrend::none, Detrend::mean, Detrend::line}) {
    const auto found =
        cross_spectra({x}, outputs, kPeriod_s, {kSegment, kShift, Window::hann, detrend});
    ASSERT_EQ(found.segments, 7U);
    for (const std::size_t k : {0U, 1U, 4U, 15U}) {
      double s_xx = 0.0;
      std::complex<double> s_xy = 0.0;
      for (std::size_t segment = 0; segment < found.segments; ++segment) {
        const auto windowed = [&](const std::vector<double>& values) {
          std::vector<double> made(
              values.begin() + static_cast<std::ptrdiff_t>(segment * kShift),
              values.begin() + static_cast<std::ptrdiff_t>(segment * kShift + kSegment));
          double mean = 0.0;
          double slope = 0.0;
          for (const double v : made) mean += v / kSegment;
          for (std::size_t j = 0; j < kSegment; ++j) {
            slope += (static_cast<double>(j) - 14.5) * made[j] / (30.0 * 899.0 / 12.0);
          }
          for (std::size_t j = 0; j < kSegment; ++j) {
            if (detrend != Detrend::none) made[j] -= mean;
            if (detrend == Detrend::line) made[j] -= slope * (static_cast<double>(j) - 14.5);
            made[j] *= window[j];
          }
          return made;
        };
        const auto a = direct_line(windowed(x), k);
        const auto b = direct_line(windowed(y), k);
        s_xx += std::norm(a);
        s_xy += std::conj(a) * b;
      }
      const double scale = (k == 0 || k == 15 ? 1.0 : 2.0) * kPeriod_s / squares / 7.0;
      EXPECT_NEAR(found.input[k], scale * s_xx, kSumRounding) << k;
      EXPECT_LT(std::abs(found.cross[0][k] - scale * s_xy), kSumRounding) << k;
      EXPECT_NEAR(found.frequency_Hz[k], static_cast<double>(k) / (kSegment * kPeriod_s),
                  kSumRounding);
    }
  }
}

TEST(CrossSpectraTest, HoldsParsevalExactlyForEvenAndOddSegments) {
  for (const std::size_t n : {240U, 243U}) {
    const auto x = white_noise(n, n);
    const auto box = cross_spectra({x}, {}, kPeriod_s, {n, n, Window::rectangular, Detrend::none});
    EXPECT_NEAR(sum_over_lines(box.input, box.spacing_Hz), mean_square(x), kSumRounding) << n;
    // Under a window: the mean square weighted by w^2/mean w^2.
    const auto hann = cross_spectra({x}, {}, kPeriod_s, {n, n, Window::hann, Detrend::none});
    const auto w = window_values(Window::hann, n);
    double weighted = 0.0;
    for (std::size_t j = 0; j < n; ++j) weighted += w[j] * w[j] * x[j] * x[j];
    EXPECT_NEAR(sum_over_lines(hann.input, hann.spacing_Hz),
                weighted / (mean_square(w) * static_cast<double>(n)), kSumRounding)
        << n;
  }
}

TEST(CrossSpectraTest, ShowsTheAmplitudeOfASineOnALineUnderEveryWindow) {
  constexpr std::size_t kSegment = 200;
  std::vector<double> x(1000);
  for (std::size_t j = 0; j < x.size(); ++j) {
    x[j] = 3.0 * std::cos(kTwoPi * 20.0 * static_cast<double>(j) / kSegment + 0.7);
  }
  for (const Window window : {Window::rectangular, Window::hann, Window::flat_top}) {
    const auto found = cross_spectra({x}, {}, kPeriod_s, {kSegment, 77, window, Detrend::none});
    EXPECT_NEAR(sine_amplitude(found.input[20], found.noise_bandwidth_Hz), 3.0, kSumRounding);
  }
}

TEST(CrossSpectraTest, OfAFlatTopShowsASineBetweenLinesToo) {
  constexpr std::size_t kSegment = 200;
  std::vector<double> x(400);
  for (std::size_t j = 0; j < x.size(); ++j) {
    x[j] = std::cos(kTwoPi * 20.5 * static_cast<double>(j) / kSegment + 0.7);
  }
  const auto found =
      cross_spectra({x}, {}, kPeriod_s, {kSegment, kSegment, Window::flat_top, Detrend::none});
  // 0.01 dB at the midpoint is what the window is made for.
  EXPECT_NEAR(sine_amplitude(found.input[20], found.noise_bandwidth_Hz), 1.0, 2e-3);
}

TEST(CrossSpectraTest, OfWhiteNoiseIsFlatWithTheStatedSpread) {
  constexpr std::size_t kSegment = 256;
  constexpr int kRuns = 200;
  double worst_mean = 0.0;
  double spread = 0.0;
  double stated = 0.0;
  int count = 0;
  for (int run = 0; run < kRuns; ++run) {
    const auto x = white_noise(3000, 100 + static_cast<std::uint64_t>(run));
    const auto found =
        cross_spectra({x}, {}, kPeriod_s, {kSegment, 85, Window::hann, Detrend::none});
    stated = relative_autopower_std(found.effective_averages);
    const double expected = 2.0 * kPeriod_s;
    for (std::size_t k = 4; k < 124; k += 8) {
      const double relative = found.input[k] / expected - 1.0;
      worst_mean += relative;
      spread += relative * relative;
      ++count;
    }
  }
  // 3000 values: their mean is known to stated/sqrt(3000), their spread to 1/sqrt(6000), each to
  // four standard deviations; powers of 22 averages have a kurtosis of 0.3.
  EXPECT_LT(std::abs(worst_mean / count), 4.0 * stated / std::sqrt(count));
  EXPECT_NEAR(std::sqrt(spread / count) / stated, 1.0, 4.0 / std::sqrt(2.0 * count));
}

TEST(CrossSpectraTest, TakesBackDifferencesOfADriftThatHidesTheRest) {
  // Drift without a difference leaks over a line 1e-9 its size; differenced twice it is gone.
  constexpr std::size_t kSamples = 4096;
  std::vector<double> y(kSamples);
  for (std::size_t j = 0; j < kSamples; ++j) {
    const auto t = static_cast<double>(j);
    y[j] = 1e4 * t + 1e-3 * std::cos(kTwoPi * 300.0 * t / 1024.0);
  }
  const std::array<Signal, 2> outputs = {Signal{y, 2}, Signal{y, 0}};
  const auto found =
      cross_spectra({y}, outputs, kPeriod_s, {1024, 512, Window::hann, Detrend::mean});
  // Rounding of the drift, 4e7 times epsilon, is 1e-5 of the sine.
  EXPECT_NEAR(sine_amplitude(found.outputs[0][300], found.noise_bandwidth_Hz), 1e-3, 1e-7);
  EXPECT_GT(sine_amplitude(found.outputs[1][300], found.noise_bandwidth_Hz), 2e-3);
  EXPECT_TRUE(std::isnan(found.outputs[0][0]));
  EXPECT_FALSE(std::isnan(found.outputs[1][0]));
}

TEST(DifferenceResponse, IsOneMinusTheDelay) {
  for (const double f : {0.0, 1e-6, 3.0, 99.0}) {
    const std::complex<double> once = 1.0 - std::polar(1.0, -kTwoPi * f * kPeriod_s);
    EXPECT_LT(std::abs(difference_response(f, kPeriod_s, 1) - once), kSumRounding);
    EXPECT_LT(std::abs(difference_response(f, kPeriod_s, 2) - once * once), kSumRounding);
    EXPECT_EQ(difference_response(f, kPeriod_s, 0), 1.0);
  }
}

TEST(CrossSpectraTest, RefusesAPlanThatTheRecordHasNoRoomFor) {
  const auto x = white_noise(100, 3);
  const std::array<Signal, 1> twice = {Signal{x, 2}};
  EXPECT_NO_THROW(cross_spectra({x}, {}, kPeriod_s, {100, 50}));
  EXPECT_THROW(cross_spectra({x}, {}, kPeriod_s, {101, 50}), arm::InputError);
  EXPECT_THROW(cross_spectra({x}, twice, kPeriod_s, {99, 50}), arm::InputError);
  EXPECT_THROW(cross_spectra({x}, {}, kPeriod_s, {3, 2}), arm::InputError);
  EXPECT_THROW(cross_spectra({x}, {}, kPeriod_s, {50, 0}), arm::InputError);
  EXPECT_THROW(cross_spectra({x}, {}, kPeriod_s, {50, 51}), arm::InputError);
}

}  // namespace
}  // namespace flexarm::measured
