// Fits of frequency responses, on uneven grids, against the formulation that made them.
#include "effects/registry/vocabulary.hpp"
#include "measured/modal/modal_fit.hpp"
#include "response/time/random_numbers.hpp"
#include "tests/fit_cases/fit_cases.hpp"
#include "tests/measured/fit_errors.hpp"
#include "tests/measured/simulated_responses.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace flexarm::measured {
namespace {

using Complex = std::complex<double>;

TEST(ModalFitOfResponses, WithoutNoiseIsExact) {
  const FitCase fit_case;
  const auto model = model_of(fit_case);
  const ModalFit fit = fit_modes(responses(fit_case, model, 400));
  const FitErrors errors = errors_of(fit, exact_roots(model, fit_case.sensors.size()));
  EXPECT_LT(errors.frequency, 1e-9);
  EXPECT_LT(errors.damping_ratio, 1e-7);
  EXPECT_LT(errors.zeros, 1e-7);
}

TEST(ModalFitOfResponses, WithModesBeyondTheBandHasThemInItsRemainder) {
  FitCase fit_case;
  fit_case.modes = 10;
  const auto model = model_of(fit_case);
  const ModalFit fit = fit_modes(responses(fit_case, model, 400));
  const FitErrors errors = errors_of(fit, exact_roots(model, fit_case.sensors.size()), false);
  EXPECT_LT(errors.frequency, 1e-6);
  EXPECT_LT(errors.damping_ratio, 1e-4);
}

TEST(ModalFitOfResponses, FindsTheModeOfAHubSpringBesideItsFirstLine) {
  FitCase fit_case;
  fit_case.modes = 4;
  const double omega_rad_per_s = 2.0 * std::numbers::pi * 0.9;
  fit_case.arm.hub.viscous_friction_N_m_s_per_rad =
      0.26 * omega_rad_per_s * arm::total_inertia_kg_m2(fit_case.arm);
  fit_case.arm.effects = {effects::named(
      "hub_spring",
      {{"stiffness", omega_rad_per_s * omega_rad_per_s * arm::total_inertia_kg_m2(fit_case.arm)}})};
  const auto model = model_of(fit_case);
  FrequencyRecord record = responses(fit_case, model, 500, 1000.0);
  response::RandomNumbers random(5);
  for (FrequencyChannel& channel : record.channels) {
    for (Complex& value : channel.response) {
      value *= 1.0 + 5e-3 * Complex(random.normal(), random.normal());
    }
  }
  const ModalFit fit = fit_modes(record);
  const ExactRoots exact = exact_roots(model, fit_case.sensors.size());
  ASSERT_LT(natural_Hz(exact.poles[0]), 1.0);
  EXPECT_TRUE(fit.converged);
  // Others would take up what its absence leaves.
  ASSERT_EQ(fit.poles.size(), exact.poles.size());
  for (std::size_t i = 0; i < exact.poles.size(); ++i) {
    EXPECT_NEAR(fit.poles[i].frequency_Hz / natural_Hz(exact.poles[i]), 1.0, 1e-3);
    EXPECT_NEAR(fit.poles[i].damping_ratio / damping_of(exact.poles[i]), 1.0, 5e-3);
  }
}

TEST(ModalFitOfResponses, WeighsLinesByTheirCoherence) {
  const FitCase fit_case;
  const auto model = model_of(fit_case);
  FrequencyRecord record = responses(fit_case, model, 400);
  // |H| (1 +- noise/sqrt 2 in each part), as of 50 averages: the last third of the lines is bad.
  constexpr double kAverages = 50.0;
  response::RandomNumbers random(4);
  for (FrequencyChannel& channel : record.channels) {
    for (std::size_t k = 0; k < channel.response.size(); ++k) {
      channel.coherence[k] = 3 * k < 2 * channel.response.size() ? 0.999 : 0.5;
      const double g = channel.coherence[k];
      const double deviation =
          std::sqrt((1.0 - g) / (2.0 * kAverages * g)) * std::abs(channel.response[k]);
      channel.response[k] += deviation * Complex(random.normal(), random.normal());
    }
  }
  const ModalFit fit = fit_modes(record, {.modes = 3, .averages = kAverages});
  const auto exact = exact_roots(model, fit_case.sensors.size());
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT(std::abs(fit.poles[i].frequency_Hz - natural_Hz(exact.poles[i])),
              4.0 * fit.poles[i].frequency_std_Hz);
    EXPECT_LT(std::abs(fit.poles[i].damping_ratio - damping_of(exact.poles[i])),
              4.0 * fit.poles[i].damping_ratio_std);
  }
  // The deviations were right: what is left is one of them.
  for (const FittedSensor& sensor : fit.sensors) {
    EXPECT_NEAR(sensor.residual.standard_deviation, 1.0, 0.15);
  }
}

}  // namespace
}  // namespace flexarm::measured
