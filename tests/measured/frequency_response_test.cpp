#include "measured/spectra/frequency_response.hpp"

#include "tests/measured/signals.hpp"

#include <gtest/gtest.h>

#include <array>

namespace flexarm::measured {
namespace {

using Complex = std::complex<double>;

constexpr double kCoarsePeriod_s = 0.01;
constexpr double kRatioRounding = 1e-12;

/// y = x filtered by 1 + 0.5 z^-1, plus noise, from white x.
struct Pair {
  std::vector<double> x;
  std::vector<double> y;
};

Pair noisy_pair(std::size_t samples, double output_noise, std::uint64_t seed,
                double input_noise = 0.0) {
  const auto clean = white_noise(samples, seed, 0);
  const auto on_output = white_noise(samples, seed, 1);
  const auto on_input = white_noise(samples, seed, 2);
  Pair made{clean, std::vector<double>(samples)};
  for (std::size_t j = 0; j < samples; ++j) {
    made.y[j] = clean[j] + 0.5 * (j > 0 ? clean[j - 1] : 0.0) + output_noise * on_output[j];
    made.x[j] += input_noise * on_input[j];
  }
  return made;
}

Complex exact(double frequency_Hz) {
  return 1.0 + 0.5 * std::polar(1.0, -kTwoPi * frequency_Hz * kCoarsePeriod_s);
}

TEST(FrequencyResponseEstimatorsTest, OneSegmentHasCoherenceOneWhateverTheSignals) {
  const auto x = white_noise(64, 1);
  const auto y = white_noise(64, 2);
  const std::array<Signal, 1> outputs = {Signal{y}};
  const auto found = estimate(cross_spectra({x}, outputs, kCoarsePeriod_s, {64, 64}), 0);
  for (std::size_t k = 1; k < 32; ++k) {
    EXPECT_NEAR(found.coherence[k], 1.0, kRatioRounding);
    EXPECT_LT(std::abs(found.h1[k] - found.h2[k]), kRatioRounding * std::abs(found.h1[k]) * 10.0);
  }
}

TEST(FrequencyResponseEstimatorsTest, AreTiedAsTheEquationsSay) {
  const auto pair = noisy_pair(2000, 0.7, 3, 0.4);
  const std::array<Signal, 1> outputs = {Signal{pair.y}};
  const auto found = estimate(cross_spectra({pair.x}, outputs, kCoarsePeriod_s, {100, 50}), 0);
  for (std::size_t k = 1; k < 50; ++k) {
    EXPECT_LT(std::abs(found.h1[k] / found.h2[k] - found.coherence[k]), kRatioRounding);  // (46)
    EXPECT_NEAR(std::abs(found.hv[k]), std::sqrt(std::abs(found.h1[k]) * std::abs(found.h2[k])),
                kRatioRounding);
    EXPECT_NEAR(std::arg(found.hv[k]), std::arg(found.h1[k]), kRatioRounding);
    EXPECT_LE(std::abs(found.h1[k]), std::abs(found.h2[k]));
  }
}

TEST(FrequencyResponseEstimatorsTest, EachIsUnbiasedForTheNoiseItIsMadeFor) {
  constexpr std::size_t kSamples = 400'000;
  // Segments of 128 of white noise blur nothing but the slope of a two-term filter; 9000 averages
  // leave 0.5 %.
  constexpr double kSpread = 0.025;
  const auto line = [](const Pair& pair) {
    const std::array<Signal, 1> outputs = {Signal{pair.y}};
    return estimate(cross_spectra({pair.x}, outputs, kCoarsePeriod_s, {128, 43}), 0);
  };
  const std::size_t k = 20;
  const Complex h = exact(static_cast<double>(k) / (128 * kCoarsePeriod_s));
  const auto out = line(noisy_pair(kSamples, 1.0, 5, 0.0));
  EXPECT_LT(std::abs(out.h1[k] - h), kSpread * std::abs(h));
  EXPECT_GT(std::abs(out.h2[k]), 1.3 * std::abs(h));
  const auto in = line(noisy_pair(kSamples, 0.0, 6, 1.0));
  EXPECT_LT(std::abs(in.h2[k] - h), kSpread * std::abs(h));
  EXPECT_LT(std::abs(in.h1[k]), 0.6 * std::abs(h));
  // Both signals with noise of the same part of their power at this line.
  const auto both = line(noisy_pair(kSamples, std::abs(h), 7, 1.0));
  EXPECT_LT(std::abs(both.hv[k] - h), kSpread * std::abs(h));
}

struct Coverage {
  double circle = 0.0;     ///< of circles stated to hold H with 95 %
  double magnitude = 0.0;  ///< of |H| within 1.96 standard deviations
  double phase = 0.0;
};

/// Over many records, at lines far enough apart to be independent.
Coverage coverage(std::size_t segment, std::size_t shift, std::size_t samples, double noise) {
  constexpr int kRuns = 400;
  constexpr double kNormal95 = 1.959963984540054;
  Coverage found;
  int count = 0;
  for (int run = 0; run < kRuns; ++run) {
    const auto pair = noisy_pair(samples, noise, 1000 + static_cast<std::uint64_t>(run));
    const std::array<Signal, 1> outputs = {Signal{pair.y}};
    const auto spectra = cross_spectra({pair.x}, outputs, kCoarsePeriod_s, {segment, shift});
    const auto h = estimate(spectra, 0);
    for (std::size_t k = 6; k < segment / 2 - 4; k += 5) {
      const Complex truth = exact(spectra.frequency_Hz[k]);
      const double nd = spectra.effective_averages;
      const double size = std::abs(h.h1[k]);
      const double std_of = relative_response_std(h.coherence[k], nd);
      found.circle +=
          std::abs(h.h1[k] - truth) < relative_confidence_radius(h.coherence[k], nd, 0.95) * size;
      found.magnitude += std::abs(size - std::abs(truth)) < kNormal95 * std_of * size;
      found.phase += std::abs(std::arg(h.h1[k] / truth)) < kNormal95 * std_of;
      ++count;
    }
  }
  found.circle /= count;
  found.magnitude /= count;
  found.phase /= count;
  return found;
}

/// 400 records of 22 lines: 9000 trials at 95 % scatter by 0.23 %, here four times that.
constexpr double kScatter = 0.01;

TEST(ConfidenceCircles, HoldTheTruthInTheStatedPartOfRecordsForFewAverages) {
  // Eight segments end to end; a two-term filter leaves 1e-3 of leakage in segments of 240.
  const auto found = coverage(240, 240, 8 * 240, 1.0);
  EXPECT_NEAR(found.circle, 0.95, kScatter);
}

TEST(ConfidenceCircles, HoldTheTruthWithOverlapToo) {
  // Overlapped segments count as fewer: an approximation of some tenths of a per cent.
  const auto found = coverage(240, 80, 12 * 240, 1.0);
  EXPECT_NEAR(found.circle, 0.95, 0.005 + kScatter);
}

TEST(StandardDeviations, CoverMagnitudeAndPhaseWhereAveragesAreMany) {
  // Of 40 averages the normal quantile, not Student's, misses 1 %.
  const auto found = coverage(240, 80, 20 * 240, 0.5);
  EXPECT_NEAR(found.magnitude, 0.95, 0.01 + kScatter);
  EXPECT_NEAR(found.phase, 0.95, 0.01 + kScatter);
}

TEST(Coherence, OfFewAveragesIsBiasedAsStated) {
  constexpr std::size_t kSegment = 64;
  constexpr std::size_t kAverages = 6;
  constexpr int kRuns = 2000;
  constexpr double kNoise = 1.5;
  const std::size_t k = 16;
  double mean = 0.0;
  double square = 0.0;
  double chance = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    const auto pair =
        noisy_pair(kSegment * kAverages, kNoise, 7000 + static_cast<std::uint64_t>(run));
    const std::array<Signal, 1> outputs = {Signal{pair.y}};
    const SegmentPlan plan{kSegment, kSegment};
    const double g2 =
        estimate(cross_spectra({pair.x}, outputs, kCoarsePeriod_s, plan), 0).coherence[k];
    mean += g2 / kRuns;
    square += g2 * g2 / kRuns;
    const auto other = white_noise(kSegment * kAverages, 90'000 + static_cast<std::uint64_t>(run));
    const std::array<Signal, 1> unrelated = {Signal{other}};
    chance += estimate(cross_spectra({pair.x}, unrelated, kCoarsePeriod_s, plan), 0).coherence[k] >
              coherence_of_chance(kAverages, 0.05);
  }
  const double power = std::norm(exact(static_cast<double>(k) / (kSegment * kCoarsePeriod_s)));
  const double g2 = power / (power + kNoise * kNoise);
  // The spread of a mean of 2000, four times; the formula's next order is 1/nd^3 or so.
  const double spread = coherence_std(g2, kAverages);
  EXPECT_NEAR(mean - g2, coherence_bias(g2, kAverages),
              4.0 * spread / std::sqrt(kRuns) + 1.0 / (kAverages * kAverages * kAverages));
  EXPECT_NEAR(std::sqrt(square - mean * mean) / spread, 1.0, 0.2);  // to first order in 1/nd
  EXPECT_NEAR(chance / kRuns, 0.05, 4.0 * std::sqrt(0.05 * 0.95 / kRuns));
}

TEST(Coherence, OfOneAverageSaysNothing) {
  EXPECT_EQ(coherence_of_chance(1.0, 0.05), 1.0);
  EXPECT_TRUE(std::isnan(relative_response_std(0.5, 1.0)));
  EXPECT_TRUE(std::isinf(relative_confidence_radius(0.5, 1.0, 0.95)));
}

TEST(HoldResponse, IsTheIntegralOverAPeriod) {
  constexpr double kF_Hz = 13.0;
  // (1/T) int_0^T exp(-i w t) dt = (1 - exp(-i w T))/(i w T); of linear pieces its square advanced
  // by T.
  const Complex i_w_t(0.0, kTwoPi * kF_Hz * kCoarsePeriod_s);
  const Complex zero = (1.0 - std::exp(-i_w_t)) / i_w_t;
  EXPECT_LT(std::abs(hold_response(TorqueHold::zero, kF_Hz, kCoarsePeriod_s) - zero),
            kRatioRounding);
  EXPECT_LT(std::abs(hold_response(TorqueHold::first, kF_Hz, kCoarsePeriod_s) -
                     zero * zero * std::exp(i_w_t)),
            kRatioRounding);
  EXPECT_EQ(hold_response(TorqueHold::zero, 0.0, kCoarsePeriod_s), 1.0);
}

}  // namespace
}  // namespace flexarm::measured
