#include "measured/spectra/window.hpp"

#include "arm/input_error.hpp"
#include "tests/measured/signals.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace flexarm::measured {
namespace {

constexpr Window kAll[] = {Window::rectangular, Window::hann, Window::hamming, Window::blackman,
                           Window::flat_top};
constexpr double kWindowRounding = 1e-13;

TEST(WindowTest, NamesReadBack) {
  for (const Window window : kAll) EXPECT_EQ(parse_window(to_string(window)), window);
  try {
    parse_window("han");
    FAIL();
  } catch (const arm::InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("did you mean hann?"));
  }
}

TEST(WindowTest, OfHannIsTheSquareOfASine) {
  const auto hann = window_values(Window::hann, 10);
  for (std::size_t j = 0; j < 10; ++j) {
    const double sine = std::sin(0.1 * std::numbers::pi * static_cast<double>(j));
    EXPECT_NEAR(hann[j], sine * sine, kWindowRounding);
  }
}

TEST(WindowTest, IsZeroOutsideItsMainLobe) {
  constexpr std::size_t kSamples = 64;
  for (const Window window : kAll) {
    const auto values = window_values(window, kSamples);
    for (std::size_t k = 0; k <= kSamples / 2; ++k) {
      const double size = std::abs(direct_line(values, k));
      if (k < static_cast<std::size_t>(main_lobe_lines(window))) {
        EXPECT_GT(size, 1e-2) << to_string(window) << k;
      } else {
        EXPECT_LT(size, kWindowRounding * kSamples) << to_string(window) << k;
      }
    }
  }
}

TEST(WindowTest, NoiseBandwidthsAreTheKnownOnes) {
  // Sum of squares of the cosine coefficients: a_0^2 + sum a_m^2/2 over a_0^2.
  EXPECT_NEAR(noise_bandwidth_lines(window_values(Window::rectangular, 64)), 1.0, kWindowRounding);
  EXPECT_NEAR(noise_bandwidth_lines(window_values(Window::hann, 64)), 1.5, kWindowRounding);
  EXPECT_NEAR(noise_bandwidth_lines(window_values(Window::hamming, 64)),
              1.0 + 0.5 * 0.46 * 0.46 / (0.54 * 0.54), kWindowRounding);
  EXPECT_NEAR(noise_bandwidth_lines(window_values(Window::blackman, 64)),
              1.0 + 0.5 * (0.25 + 0.0064) / (0.42 * 0.42), kWindowRounding);
  // Of a flat top, from tables to four digits.
  EXPECT_NEAR(noise_bandwidth_lines(window_values(Window::flat_top, 64)), 3.770, 1e-3);
}

TEST(WindowTest, OverlapCorrelationsOfHannAreTheClosedForm) {
  // rho(r) = ((1 - r)(2/3 + cos(2 pi r)/3) + sin(2 pi r)/(2 pi)) for a shift of r segments:
  // the integral of hann times hann shifted over that of hann^2.
  constexpr std::size_t kSamples = 12'000;
  const auto hann = window_values(Window::hann, kSamples);
  for (const double r : {0.25, 1.0 / 3.0, 0.5, 2.0 / 3.0, 0.75}) {
    const double expected = (1.0 - r) * (2.0 + std::cos(kTwoPi * r)) / 3.0 +
                            std::sin(kTwoPi * r) / (2.0 * std::numbers::pi);
    EXPECT_NEAR(overlap_correlation(hann, static_cast<std::size_t>(r * kSamples + 0.5)), expected,
                1e-8)
        << r;
  }
  EXPECT_NEAR(overlap_correlation(hann, kSamples / 2), 1.0 / 6.0, 1e-8);
  EXPECT_EQ(overlap_correlation(hann, kSamples), 0.0);
}

TEST(WindowTest, EffectiveAveragesCountIndependentSegmentsFully) {
  const auto box = window_values(Window::rectangular, 100);
  EXPECT_DOUBLE_EQ(effective_averages(box, 7, 100), 7.0);
  EXPECT_DOUBLE_EQ(effective_averages(box, 1, 50), 1.0);
  // rho = 1/2 between neighbours: K/(1 + 2 (1 - 1/K)/4).
  EXPECT_NEAR(effective_averages(box, 7, 50), 7.0 / (1.0 + 0.5 * 6.0 / 7.0), kWindowRounding);
  const auto hann = window_values(Window::hann, 120);
  EXPECT_NEAR(effective_averages(hann, 100, 60), 100.0 / (1.0 + 2.0 * 0.99 / 36.0), 1e-3);
}

TEST(WindowTest, SufficientOverlapIsTwoThirdsForHannAndMoreForTheRectangle) {
  // Averages of 100 000 samples in segments of 120: 1185 at 2/3, 1212 at 3/4, 1233 at 5/6.
  EXPECT_EQ(sufficient_overlap(Window::rectangular), 0.75);
  EXPECT_NEAR(sufficient_overlap(Window::hann), 2.0 / 3.0, kWindowRounding);
  EXPECT_GE(sufficient_overlap(Window::flat_top), 0.75);
}

}  // namespace
}  // namespace flexarm::measured
