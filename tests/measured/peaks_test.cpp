#include "measured/modal/peaks.hpp"

#include "measured/spectra/spectra.hpp"
#include "measured/spectra/spectral_features.hpp"
#include "tests/measured/simulated_record.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace flexarm::measured {
namespace {

using Complex = std::complex<double>;

std::vector<double> even_lines(double spacing_Hz, std::size_t count) {
  std::vector<double> lines(count);
  for (std::size_t k = 0; k < count; ++k) lines[k] = spacing_Hz * static_cast<double>(k + 1);
  return lines;
}

/// One pole at 12 Hz and one zero at 18 Hz, damping ratio zeta.
double power_at(double f_Hz, double zeta) {
  const Complex s(0.0, f_Hz);
  const auto quadratic = [&](double f0) { return s * s + 2.0 * zeta * f0 * s + f0 * f0; };
  return std::norm(quadratic(18.0) / quadratic(12.0) / (s + 1.0));
}

/// zeta^2 times the logarithmic slope of the rest of the response, 4.6 at the zero, times 1.5: what
/// weighted least squares over the half-power width makes of it.
constexpr double kTilt = 1.5 * 4.6 * 0.02 * 0.02;

std::vector<SpectralFeature> features(double spacing_Hz, double zeta,
                                      const PeakSettings& settings) {
  const auto lines = even_lines(spacing_Hz, static_cast<std::size_t>(40.0 / spacing_Hz));
  std::vector<double> power;
  for (const double f_Hz : lines) power.push_back(power_at(f_Hz, zeta));
  return peaks_and_valleys(lines, power, std::vector<double>(lines.size(), 0.0), settings);
}

TEST(PeaksAndValleys, OnTheLineAreWithinHalfTheResolution) {
  const auto found = features(0.488, 0.01, {.place = PeakPlace::on_line});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].feature, Feature::pole);
  EXPECT_EQ(found[1].feature, Feature::zero);
  EXPECT_DOUBLE_EQ(found[0].frequency_Hz, 25 * 0.488);
  EXPECT_DOUBLE_EQ(found[1].frequency_Hz, 37 * 0.488);
  for (const auto& feature : found) {
    EXPECT_NEAR(feature.frequency_uncertainty_Hz, 0.244, 1e-12);
    EXPECT_LT(std::abs(feature.frequency_Hz - (feature.feature == Feature::pole ? 12.0 : 18.0)),
              feature.frequency_uncertainty_Hz);
  }
}

TEST(PeaksAndValleys, ALineOfAFlankIsNoFeatureOfAnotherPlace) {
  // Noise makes a minimum at 258 Hz on the flank of a zero at 515 Hz.
  const auto lines = even_lines(1.0, 300);
  std::vector<double> power;
  for (const double f_Hz : lines) power.push_back(std::pow((f_Hz * f_Hz - 515.0 * 515.0) / 1e5, 2));
  power[257] *= 0.6;
  const auto found = peaks_and_valleys(lines, power, std::vector<double>(lines.size(), 0.0), {});
  ASSERT_EQ(found.size(), 2U) << "the minimum and the line above it";
  EXPECT_EQ(found[0].line_Hz, 258.0);
  EXPECT_EQ(found[1].line_Hz, 259.0);
  for (const auto& feature : found) EXPECT_NEAR(feature.frequency_Hz, feature.line_Hz, 1.0);
}

TEST(PeaksAndValleys, BetweenLinesAreThoseOfTheParabola) {
  // Lines a quarter of the half-power width apart.
  const auto found = features(0.12, 0.02, {});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].frequency_Hz / 12.0, 1.0, kTilt);
  EXPECT_NEAR(found[1].frequency_Hz / 18.0, 1.0, kTilt);
  EXPECT_NEAR(found[0].damping_ratio.value(), 0.02, 1e-3);
  EXPECT_NEAR(found[1].damping_ratio.value(), 0.02, 1e-3);
  const auto logarithmic = features(0.12, 0.02, {.place = PeakPlace::log_parabola});
  EXPECT_NEAR(logarithmic[0].frequency_Hz / 12.0, 1.0, kTilt);
}

TEST(PeaksAndValleys, OfASineUnderHannAreItsFrequency) {
  constexpr std::size_t kSegment = 400;  // lines 0.5 Hz apart
  for (const double f_Hz : {12.0, 12.1, 12.24, 12.4}) {
    std::vector<double> x(4000);
    for (std::size_t j = 0; j < x.size(); ++j) {
      x[j] = std::cos(kTwoPi * f_Hz * kPeriod_s * static_cast<double>(j) + 0.3);
    }
    const auto spectra =
        cross_spectra({x}, {}, kPeriod_s, {kSegment, 200, Window::hann, Detrend::none});
    const auto found = peaks_and_valleys(spectra.frequency_Hz, spectra.input,
                                         std::vector<double>(spectra.input.size(), 0.0),
                                         {.from_Hz = 5.0,
                                          .to_Hz = 20.0,
                                          .place = PeakPlace::hann_line,
                                          .least_prominence_dB = 30.0});
    ASSERT_EQ(found.size(), 1U) << f_Hz;
    // The mirror image of the sine, 50 lines away, leaks 50^-3 of it.
    EXPECT_NEAR(found[0].frequency_Hz, f_Hz, 1e-4);
  }
}

TEST(PeaksAndValleys, OfNoiseAreNone) {
  int found = 0;
  constexpr int kRuns = 200;
  for (int run = 0; run < kRuns; ++run) {
    const auto x = white_noise(8000, 300 + static_cast<std::uint64_t>(run));
    const auto spectra = cross_spectra({x}, {}, kPeriod_s, {512, 171, Window::hann, Detrend::mean});
    const std::vector<double> spread(spectra.input.size(),
                                     relative_autopower_std(spectra.effective_averages));
    found += !peaks_and_valleys(spectra.frequency_Hz, spectra.input, spread,
                                {.from_Hz = 1.0, .to_Hz = 98.0})
                  .empty();
  }
  // 1 % of 200 is two; six or more come once in a hundred such tests.
  EXPECT_LT(found, 6);
}

TEST(PeaksAndValleys, StateTheSpreadThatNoiseMakes) {
  constexpr int kRuns = 300;
  double mean = 0.0;
  double square = 0.0;
  double stated = 0.0;
  int count = 0;
  const auto lines = even_lines(0.5, 80);
  constexpr double kSpread = 0.02;
  for (int run = 0; run < kRuns; ++run) {
    const auto noise = white_noise(lines.size(), 40 + static_cast<std::uint64_t>(run));
    std::vector<double> power;
    for (std::size_t k = 0; k < lines.size(); ++k) {
      power.push_back(power_at(lines[k], 0.05) * (1.0 + kSpread * noise[k]));
    }
    for (const auto& found :
         peaks_and_valleys(lines, power, std::vector<double>(80, kSpread), {.to_Hz = 15.0})) {
      if (found.feature != Feature::pole) continue;
      mean += found.frequency_Hz;
      square += found.frequency_Hz * found.frequency_Hz;
      stated += found.frequency_uncertainty_Hz;
      ++count;
    }
  }
  EXPECT_EQ(count, kRuns);
  mean /= count;
  const double spread = std::sqrt(square / count - mean * mean);
  EXPECT_NEAR(spread / (stated / count), 1.0, 0.2);
}

TEST(NaturalFrequency, CorrectsThePeakOfEachKindOfSensor) {
  // Peaks of |s^k/(s^2 + 2 zeta s + 1)| on the imaginary axis, found by search.
  constexpr double kZeta = 0.2;
  for (const int derivatives : {0, 1, 2}) {
    double best = 0.0;
    double peak = 0.0;
    for (double w = 0.5; w < 1.5; w += 1e-5) {
      const Complex s(0.0, w);
      const double size = std::abs(std::pow(s, derivatives) / (s * s + 2.0 * kZeta * s + 1.0));
      if (size > best) {
        best = size;
        peak = w;
      }
    }
    EXPECT_NEAR(natural_frequency_Hz(peak, kZeta, derivatives), 1.0, 2e-5) << derivatives;
  }
  EXPECT_THROW(natural_frequency_Hz(1.0, 0.8, 0), std::invalid_argument);
}

TEST(ModalTableOfFeatures, StatesNoOrdersAndCorrectsPoles) {
  const arm::Sensor sensor = arm::parse_sensor("hub_angle");
  const auto found = features(0.12, 0.02, {});
  const auto table = modal_table(sensor, found, PeakPlace::resonance);
  ASSERT_EQ(table.size(), 2U);
  EXPECT_EQ(table[0].feature, Feature::pole);
  EXPECT_EQ(table[1].feature, Feature::zero);
  EXPECT_FALSE(table[0].order || table[1].order);
  EXPECT_EQ(table[0].frequency_Hz.value(),
            natural_frequency_Hz(found[0].frequency_Hz, *found[0].damping_ratio, 0));
  EXPECT_EQ(table[1].frequency_Hz.value(), found[1].frequency_Hz);
  EXPECT_FALSE(table[1].damping_ratio);
  const auto on_line = features(0.488, 0.01, {.place = PeakPlace::on_line});
  EXPECT_NEAR(modal_table(sensor, on_line, PeakPlace::on_line)[0].frequency_std_Hz.value(),
              0.488 / std::sqrt(12.0), 1e-12);
}

TEST(SpectralFeatures, OfASimulatedArmAreItsPolesAndHubZerosAtThePapersResolution) {
  arm::Arm arm = arm::paper_arm();
  arm.damping.kelvin_voigt_s = 1e-4;
  arm.hub.viscous_friction_N_m_s_per_rad = 2e-3;
  const SimulatedArm simulated(arm, sensors_named({"hub_angle", "hub_velocity"}), 4);
  const auto torque = torque_of(
      response::RandomNoise{.rms_N_m = 0.05, .from_Hz = 0.05, .to_Hz = 95.0}, 24'000, kPeriod_s);
  // Lines 0.488 Hz apart.
  const auto made = estimate_frequency_response(
      simulated.record(torque, kPeriod_s, response::TorqueHold::zero, 1e-5),
      {.segment_samples = 410});
  const auto found =
      spectral_features(made, {.from_Hz = 1.0, .to_Hz = 50.0, .place = PeakPlace::on_line});
  ASSERT_EQ(found.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    // Images and modes left out move zeros: those of what the samples show, on a fine grid.
    const auto zero_near = [&](double f_Hz) {
      double best_Hz = 0.0;
      double least = 1e300;
      for (double at_Hz = f_Hz - 0.6; at_Hz < f_Hz + 0.9; at_Hz += 0.02) {
        const double size = std::abs(simulated.sampled_response(i, at_Hz, kPeriod_s, 1));
        if (size > least) continue;
        least = size;
        best_Hz = at_Hz;
      }
      return best_Hz;
    };
    const double zero_1_Hz = zero_near(2.87337);
    const double zero_2_Hz = zero_near(18.0071);
    for (const auto* features : {&found[i].autopower, &found[i].response}) {
      std::vector<double> poles;
      std::vector<double> zeros;
      for (const auto& feature : *features) {
        (feature.feature == Feature::pole ? poles : zeros).push_back(feature.frequency_Hz);
      }
      // Half a line, and half a line more by what noise and the window's blur make of two that are
      // nearly equal.
      ASSERT_EQ(poles.size(), 2U) << arm::to_string(found[i].sensor);
      EXPECT_NEAR(poles[0], 11.8618, made.spacing_Hz);
      EXPECT_NEAR(poles[1], 32.2606, made.spacing_Hz);
      ASSERT_EQ(zeros.size(), 2U) << arm::to_string(found[i].sensor);
      EXPECT_NEAR(zeros[0], zero_1_Hz, made.spacing_Hz);
      EXPECT_NEAR(zeros[1], zero_2_Hz, made.spacing_Hz);
    }
  }
}

TEST(PeaksAndValleys, BetweenUnevenLinesAreThoseOfTheParabola) {
  // As of a multisine some of whose lines are left out.
  std::vector<double> lines;
  std::vector<double> power;
  for (int k = 0; k < 200; ++k) {
    if (k % 4 == 2) continue;
    lines.push_back(5.0 + 0.1 * k);
    power.push_back(power_at(lines.back(), 0.02));
  }
  const auto found =
      peaks_and_valleys(lines, power, std::vector<double>(lines.size(), 0.0), {.to_Hz = 22.0});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].frequency_Hz / 12.0, 1.0, kTilt);
  EXPECT_NEAR(found[1].frequency_Hz / 18.0, 1.0, kTilt);
}

/// |G|^2 of one mode, a displacement.
double mode_power(double f_Hz, double natural_Hz, double zeta) {
  const Complex s(0.0, f_Hz);
  return 1.0 / std::norm(s * s + 2.0 * zeta * natural_Hz * s + natural_Hz * natural_Hz);
}

TEST(ResonanceParabola, OfOneModeIsExact) {
  const auto lines = even_lines(0.1, 300);
  std::vector<double> power;
  for (const double f_Hz : lines) power.push_back(mode_power(f_Hz, 12.34, 0.05));
  const auto found = peaks_and_valleys(lines, power, std::vector<double>(lines.size(), 0.0));
  ASSERT_EQ(found.size(), 1U);
  // Of solving a least squares problem of some ten lines.
  constexpr double kRounding = 1e-12;
  EXPECT_NEAR(natural_frequency_Hz(found[0].frequency_Hz, 0.05, 0) / 12.34, 1.0, kRounding);
  // (2 place half_width)^2 = (2 zeta f_n^2)^2 (1 - zeta^2).
  EXPECT_NEAR(found[0].damping_ratio.value(), 0.05 * std::sqrt(1.0 - 0.0025) / (1.0 - 0.005),
              kRounding);
}

TEST(ResonanceParabola, OfARaggedPeakStatesItsSpread) {
  // A peak of 24 lines across, each known to 30 %: the highest line is anywhere on it.
  constexpr int kRuns = 200;
  constexpr double kSpread = 0.3;
  const auto lines = even_lines(0.1, 300);
  double square = 0.0;
  std::vector<double> stated;
  for (int run = 0; run < kRuns; ++run) {
    const auto noise = white_noise(lines.size(), 900 + static_cast<std::uint64_t>(run));
    std::vector<double> power;
    for (std::size_t k = 0; k < lines.size(); ++k) {
      power.push_back(mode_power(lines[k], 12.0, 0.1) * std::exp(kSpread * noise[k]));
    }
    const auto found = peaks_and_valleys(lines, power, std::vector<double>(300, kSpread),
                                         {.least_prominence_dB = 15.0, .most_damping_ratio = 0.5});
    ASSERT_EQ(found.size(), 1U);
    const double expected_Hz = 12.0 * std::sqrt(1.0 - 0.02);
    square += std::pow(found[0].frequency_Hz - expected_Hz, 2) / kRuns;
    stated.push_back(found[0].frequency_uncertainty_Hz);
  }
  std::ranges::nth_element(stated, stated.begin() + kRuns / 2);
  // The lines used follow the noise, and weights do, which least squares do not count.
  EXPECT_NEAR(std::sqrt(square) / stated[kRuns / 2], 1.0, 0.35);
  EXPECT_LT(std::sqrt(square), 0.3);
}

TEST(SharedLineVariance, IsThatOfTheWindowsPowers) {
  EXPECT_DOUBLE_EQ(shared_line_variance(Window::rectangular), 1.0);
  // 1 + 2 ((2/3)^2 + (1/6)^2).
  EXPECT_NEAR(shared_line_variance(Window::hann), 35.0 / 18.0, 1e-14);
}

}  // namespace
}  // namespace flexarm::measured
