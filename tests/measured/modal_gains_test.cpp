// Hub slopes and tip gains of fits against the modal models of the three formulations.
#include "measured/modal/modal_gains.hpp"

#include "arm/input_error.hpp"
#include "response/formulation_maker.hpp"
#include "response/frequency/modal_response.hpp"
#include "tests/fit_cases/exact_gains.hpp"
#include "tests/fit_cases/fit_cases.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>

namespace flexarm::measured {
namespace {

/// Issue 4: within 1 %.
constexpr double kAsked = 0.01;

ModalGains gains_of(const FitCase& fit_case, std::optional<double> inertia = {}) {
  const std::array records = {record_of(fit_case)};
  return modal_gains(fit_modes(records, {.modes = fit_case.modes}), inertia);
}

class ModalGainsOf : public testing::TestWithParam<double> {};

TEST_P(ModalGainsOf, SimulatedDataAreThoseOfTheThreeFormulations) {
  FitCase fit_case;
  fit_case.relative_noise = GetParam();
  const ModalGains gains = gains_of(fit_case);
  ASSERT_EQ(gains.modes.size(), 3U);
  for (const char* name : {"exact_tf", "fem", "assumed_modes"}) {
    SCOPED_TRACE(name);
    const auto formulation = response::make_formulation(name, fit_case.arm, 3);
    const auto model = response::modal_model(formulation, 3, fit_case.sensors, {});
    EXPECT_NEAR(gains.total_inertia_kg_m2.value / model.modal_mass_kg_m2, 1.0, kAsked);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& mode = model.modes[i + 1];
      const ModalGain& gain = gains.modes[i];
      ASSERT_TRUE(gain.hub_slope && gain.tip_gain_m && gain.tip_gain_of_ratio_m);
      EXPECT_NEAR(gain.hub_slope->value / mode.hub_slope, 1.0, kAsked);
      EXPECT_NEAR(gain.tip_gain_m->value / mode.sensor_values[2], 1.0, kAsked);
      const std::complex<double> s(0.0, mode.omega_rad_per_s);
      const auto at_resonance = response::modal_response(model, fit_case.sensors, s);
      const double ratio =
          -(at_resonance[2] / at_resonance[0]).real() * mode.hub_slope / std::norm(s);
      EXPECT_NEAR(gain.tip_gain_of_ratio_m->value / ratio, 1.0, kAsked);
      // (52) takes the other modes for nothing: they stand at right angles to the resonance, so
      // that their share, about 2 xi, counts squared.
      EXPECT_NEAR(ratio / mode.sensor_values[2], 1.0, 0.02);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, ModalGainsOf, testing::Values(0.0, 0.01), [](const auto& entry) {
  return entry.param == 0.0 ? "noise_free" : "one_per_cent_noise";
});

TEST(ModalGains, OfNoiseFreeDataAreThoseOfTheDampedModel) {
  const FitCase fit_case;
  const ModalGains gains = gains_of(fit_case);
  const ExactGains exact = exact_gains(model_of(fit_case), 0, 2);
  // Rounding of the simulation, 1e-12 of the drifting angle's size, over the rigid body's part.
  constexpr double kRounding = 1e-7;
  // What hub_velocity takes for the rigid body's b0 is b0 - a1 b1: off by the coupling of rigid and
  // flexible motion by hub friction, a1 over the first frequency squared.
  constexpr double kCoupling = 1e-5;
  EXPECT_NEAR(gains.total_inertia_kg_m2.value / exact.total_inertia_kg_m2, 1.0, kCoupling);
  const double inertia_ratio = gains.total_inertia_kg_m2.value / exact.total_inertia_kg_m2;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(gains.modes[i].hub_slope->value / exact.hub_slopes[i], std::sqrt(inertia_ratio),
                kRounding);
    EXPECT_NEAR(gains.modes[i].tip_gain_m->value / exact.tip_gains_m[i], std::sqrt(inertia_ratio),
                kRounding);
    EXPECT_NEAR(gains.modes[i].tip_gain_of_ratio_m->value / exact.tip_gains_of_ratio_m[i],
                std::sqrt(inertia_ratio), kRounding);
  }
}

TEST(ModalGains, OfTheProductOfPolesAndZerosAgreeWithoutInertia) {
  FitCase fit_case;
  fit_case.duration_s = 20.0;
  const auto model = model_of(fit_case);
  const ModalGains gains = gains_of(fit_case);
  for (std::size_t i = 0; i < gains.modes.size(); ++i) {
    // (47) is of undamped roots; damping moves its factors by the square of a few per cent.
    ASSERT_TRUE(gains.modes[i].hub_slope_of_product);
    EXPECT_NEAR(gains.modes[i].hub_slope_of_product->value / model.modes[i + 1].hub_slope, 1.0,
                1e-3);
  }
}

TEST(ModalGains, FollowAGivenInertia) {
  FitCase fit_case;
  fit_case.duration_s = 20.0;
  const ModalGains found = gains_of(fit_case);
  const ModalGains given = gains_of(fit_case, 4.0 * found.total_inertia_kg_m2.value);
  EXPECT_NEAR(given.modes[0].hub_slope->value / found.modes[0].hub_slope->value, 2.0, 1e-9);
  EXPECT_NEAR(given.modes[0].tip_gain_m->value / found.modes[0].tip_gain_m->value, 2.0, 1e-9);
}

TEST(ModalGains, NeedAHubSensor) {
  FitCase fit_case;
  fit_case.duration_s = 20.0;
  fit_case.sensors = sensors_named({"tip_acceleration"});
  EXPECT_THROW(gains_of(fit_case), arm::InputError);
}

}  // namespace
}  // namespace flexarm::measured
