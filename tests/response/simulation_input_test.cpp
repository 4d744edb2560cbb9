// Torque, options and models that are refused, and what a run says of itself.
#include "arm/input_error.hpp"
#include "tests/response/simulation_models.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace flexarm::response {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::string refusal(const std::vector<double>& torque, const SimulationOptions& options,
                    const ArmParts& parts = coulomb(0.1)) {
  try {
    simulate(oscillator(1.0, 1.0), parts, hub_sensors(), torque, options);
  } catch (const arm::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(SimulationInput, BadTorqueAndSampleTimesAreRefusedInOneLine) {
  using testing::HasSubstr;
  EXPECT_EQ(refusal({}, {}), "torque: there are no samples");
  EXPECT_EQ(refusal({0.0, kNaN}, {}), "torque = nan N m at sample 1 (from 0): must be finite");
  EXPECT_THAT(refusal({0.0}, {.sample_time_s = -1e-3}), HasSubstr("sample time = -0.001 s"));
  EXPECT_THAT(refusal({0.0}, {.sample_time_s = 0.0}), HasSubstr("sample time = 0 s"));
  EXPECT_THAT(refusal({0.0}, {.sample_time_s = kNaN}), HasSubstr("sample time = nan s"));
  EXPECT_THAT(refusal({0.0}, {.substeps = -1}), HasSubstr("substeps = -1"));
  EXPECT_EQ(refusal({0.0}, {}), "");
}

TEST(SimulationInput, AnEffectThatNeedsTooManyInnerStepsIsNamed) {
  const SimulationOptions slow{.sample_time_s = 1e7};
  EXPECT_EQ(refusal({0.0, 0.0}, slow),
            "effects.coulomb_friction: needs 1e+07 inner steps per sample of 10000000 s (fastest "
            "rate 1 rad/s), at most 100000: reduce the damping or the sampling period");
  ArmParts rippled = coulomb(0.0);
  put(rippled, "torque_ripple", {{"amplitude", 0.1}, {"cycles", 1.0}, {"phase", 0.0}});
  EXPECT_THAT(refusal({0.0, 0.0}, slow, rippled), testing::StartsWith("effects.torque_ripple: "));
  EXPECT_EQ(refusal({0.0, 0.0}, slow, coulomb(0.0)), "");
}

TEST(SimulationInput, AMotionTooLargeForANumberIsRefusedAtItsSample) {
  EXPECT_EQ(refusal({1e300, 1e300, 1e300}, {.sample_time_s = 10.0}, coulomb(0.0)),
            "energy at 10 s: numeric overflow; reduce the torque or the duration");
  ArmParts amplified = coulomb(0.0);
  put(amplified, "torque_gain", {{"factor", 10.0}});
  EXPECT_EQ(refusal({0.0, 1e308}, {}, amplified),
            "torque = 1e+308 N m at 0.001 s: numeric overflow in the actuator model");
}

TEST(SimulationInput, FrictionOfTheWrongSignIsRefused) {
  try {
    coulomb(-0.1);
    ADD_FAILURE() << "not refused";
  } catch (const arm::InputError& error) {
    EXPECT_STREQ(error.what(),
                 "effects.coulomb_friction.torque = -0.1 N m: must be a finite number, 0 or more");
  }
}

TEST(SimulationInput, AModelThatDoesNotFitItsSensorsIsRefused) {
  arm::ModalModel model = oscillator(1.0, 1.0);
  const std::vector<arm::Sensor> one = {kHubAngle};
  EXPECT_THROW(simulate(model, coulomb(0.0), one, step_torque(1.0, 3)), arm::InputError);
  model.damping_rad_per_s.clear();
  EXPECT_THROW(simulate(model, coulomb(0.0), hub_sensors(), step_torque(1.0, 3)), arm::InputError);
}

TEST(SimulationSummary, SaysWhatTheSamplesShowOfTheHighestMode) {
  const auto sampling_at = [](double samples_per_period) {
    const double h = 2.0 * M_PI / samples_per_period;
    return simulate(oscillator(1.0, 1.0), coulomb(0.0), hub_sensors(), step_torque(1.0, 3),
                    {.sample_time_s = h})
        .summary;
  };
  EXPECT_EQ(sampling_at(1.9).sampling, Sampling::aliased);
  EXPECT_EQ(sampling_at(4.0).sampling, Sampling::coarse);
  EXPECT_EQ(sampling_at(11.0).sampling, Sampling::fine);
  EXPECT_NEAR(sampling_at(4.0).samples_per_period, 4.0, 1e-12);
}

TEST(SimulationSummary, ACoarseStepMissesNoEvent) {
  // Two samples a period: the turning points lie between samples, some intervals hold two.
  const auto fine = simulate(oscillator(0.05, 2.0), coulomb(0.01), hub_sensors(),
                             step_torque(0.7, 5001), {.sample_time_s = 1e-3});
  const auto coarse = simulate(oscillator(0.05, 2.0), coulomb(0.01), hub_sensors(),
                               step_torque(0.7, 6), {.sample_time_s = 1.0});
  ASSERT_EQ(coarse.summary.event_times_s.size(), fine.summary.event_times_s.size());
  for (std::size_t n = 0; n < fine.summary.event_times_s.size(); ++n) {
    EXPECT_NEAR(coarse.summary.event_times_s[n], fine.summary.event_times_s[n], 1e-11);
  }
}

TEST(SimulationProgressTest, MayCancel) {
  int calls = 0;
  const auto made = simulate(oscillator(1.0, 1.0), coulomb(0.1), hub_sensors(),
                             step_torque(1.0, 100'000), {.energy = false}, [&](double fraction) {
                               EXPECT_LE(fraction, 1.0);
                               return ++calls < 2;
                             });
  EXPECT_FALSE(made.summary.completed);
  EXPECT_LT(made.time_s.size(), 100'000U);
  EXPECT_EQ(made.channels[0].size(), made.time_s.size());
}

TEST(Simulation, OneSampleIsTheArmAtRest) {
  const auto made =
      simulate(oscillator(1.0, 1.0), coulomb(0.1), hub_sensors(), step_torque(1.0, 1));
  ASSERT_EQ(made.time_s.size(), 1U);
  EXPECT_EQ(made.channels[0][0], 0.0);
  EXPECT_EQ(made.hub_torque_N_m[0], 1.0);
}

}  // namespace
}  // namespace flexarm::response
