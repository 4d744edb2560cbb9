// Standard errors where the errors of all sensors are the same number.
#include "measured/modal/common_noise.hpp"

#include "measured/files/record_constants.hpp"
#include "measured/modal/modal_fit.hpp"
#include "measured/spectra/error_correlation.hpp"
#include "response/frequency/modal_response.hpp"
#include "response/time/random_numbers.hpp"
#include "tests/fit_cases/fit_cases.hpp"
#include "tests/measured/fit_errors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>

namespace flexarm::measured {
namespace {

using Complex = std::complex<double>;

constexpr double kRelativeNoise = 0.01;  // of real and of imaginary part, over |H|
constexpr int kRealisations = 40;

/// 200 lines from 1 to 80 Hz, the same of all sensors.
FrequencyRecord common_lines(const FitCase& fit_case, const arm::ModalModel& model) {
  FrequencyRecord record;
  for (const arm::Sensor& sensor : fit_case.sensors)
    record.channels.push_back({sensor, {}, {}, {}});
  for (int k = 0; k < 200; ++k) {
    const double frequency_Hz = std::pow(80.0, k / 199.0);
    const auto values = response::modal_response(
        model, fit_case.sensors, Complex(0.0, 2.0 * std::numbers::pi * frequency_Hz));
    for (std::size_t j = 0; j < values.size(); ++j) {
      record.channels[j].frequency_Hz.push_back(frequency_Hz);
      record.channels[j].response.push_back(values[j]);
      record.channels[j].coherence.push_back(kUnknown);
    }
  }
  return record;
}

/// Mean of the squared errors of all natural frequencies over their variances.
double mean_square_error(bool is_common_noise_told) {
  const FitCase fit_case;
  const auto model = model_of(fit_case);
  const FrequencyRecord exact = common_lines(fit_case, model);
  const auto channels = static_cast<Eigen::Index>(exact.channels.size());
  const auto roots = exact_roots(model, fit_case.sensors.size());
  double sum = 0.0;
  for (int seed = 1; seed <= kRealisations; ++seed) {
    FrequencyRecord record = exact;
    ModalFitOptions options{.modes = static_cast<int>(roots.poles.size()), .robust = false};
    for (FrequencyChannel& channel : record.channels) {
      response::RandomNumbers random(static_cast<std::uint64_t>(seed));  // the same for all
      auto& deviation = options.response_std.emplace_back();
      for (Complex& value : channel.response) {
        deviation.push_back(kRelativeNoise * std::abs(value));
        value *= 1.0 + kRelativeNoise * Complex(random.normal(), random.normal());
      }
    }
    if (is_common_noise_told) {
      // A relative error that is the same has the phase of each response.
      options.covariance = [&](const ModalFit& fit) {
        return with_common_noise(fit, record, options.response_std, [&](double frequency_Hz) {
          Eigen::VectorXcd phase(channels);
          for (Eigen::Index j = 0; j < channels; ++j) {
            const Complex s(0.0, 2.0 * std::numbers::pi * frequency_Hz);
            const Complex value = fit.transfers[static_cast<std::size_t>(j)].value(s);
            phase(j) = value / std::abs(value);
          }
          return Eigen::MatrixXcd(phase.conjugate() * phase.transpose());
        });
      };
    }
    const ModalFit fit = fit_modes(record, options);
    for (std::size_t i = 0; i < roots.poles.size(); ++i) {
      const double error = (fit.poles.at(i).frequency_Hz - natural_Hz(roots.poles[i])) /
                           fit.poles[i].frequency_std_Hz;
      sum += error * error;
    }
  }
  return sum / (kRealisations * static_cast<double>(roots.poles.size()));
}

TEST(CommonNoise, IsInTheStandardErrorsOfPoles) {
  // Of n = 40 realisations and three poles the mean of squares has a deviation of sqrt(2/120).
  constexpr double kFourDeviations = 4.0 * 0.13;
  EXPECT_NEAR(mean_square_error(true), 1.0, kFourDeviations);
  EXPECT_GT(mean_square_error(false), 1.0 + kFourDeviations) << "independence was assumed";
}

TEST(ErrorCorrelation, OfWhatTheInputExplainsIsThatOfTheRest) {
  // Signals y_1 = g_1 x + n, y_2 = g_2 x + i n/2 + m with unit x, n and m.
  const Complex g1(2.0, 1.0);
  const Complex g2(0.0, -3.0);
  Eigen::MatrixXcd to_signals(3, 3);  // from x, n, m
  to_signals << 1.0, 0.0, 0.0, g1, 1.0, 0.0, g2, Complex(0.0, 0.5), 1.0;
  const Eigen::MatrixXcd joint = to_signals.conjugate() * to_signals.transpose();
  const Eigen::MatrixXcd found = error_correlation(joint, Eigen::Vector2cd(g1, g2));
  constexpr double kRounding = 1e-14;  // of numbers up to 10
  EXPECT_LT(std::abs(found(0, 1) - Complex(0.0, 0.5) / std::sqrt(1.25)), kRounding);
  EXPECT_LT(std::abs(found(1, 0) - std::conj(found(0, 1))), kRounding);
  EXPECT_LT(std::abs(found(1, 1) - 1.0), kRounding);
}

}  // namespace
}  // namespace flexarm::measured
