// Fits of data that are short, poor, of another arm than the model's, or no data at all.
#include "arm/input_error.hpp"
#include "effects/registry/vocabulary.hpp"
#include "measured/modal/modal_fit.hpp"
#include "measured/modal/modal_gains.hpp"
#include "tests/fit_cases/fit_cases.hpp"
#include "tests/measured/fit_errors.hpp"
#include "tests/measured/simulated_responses.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>

namespace flexarm::measured {
namespace {

/// 1 % noise: issue 4's figures.
constexpr double kFrequencyAsked = 5e-4;
constexpr double kDampingAsked = 0.05;

FitCase noisy_case() {
  FitCase fit_case;
  fit_case.relative_noise = 0.01;
  return fit_case;
}

ModalFit fit_of(const TimeRecord& record, const ModalFitOptions& options = {}) {
  return fit_modes(std::span(&record, 1), options);
}

TimeRecord record_with(const FitCase& fit_case, const std::string& effect,
                       const std::map<std::string, double>& parameters) {
  arm::Arm arm = fit_case.arm;
  effects::put(arm, effect, parameters);
  TimeRecord record = clean_record(fit_case, model_of(fit_case), response::take_apart(arm));
  add_noise(record, fit_case.relative_noise, fit_case.seed);
  return record;
}

std::vector<FittedPole> modes_of(const ModalFit& fit) {
  std::vector<FittedPole> modes;
  std::ranges::copy_if(fit.poles, std::back_inserter(modes), &FittedPole::is_mode);
  return modes;
}

void expect_finite(const ModalFit& fit) {
  EXPECT_TRUE(fit.parameters.allFinite());
  EXPECT_TRUE(fit.covariance.allFinite());
  for (const FittedSensor& sensor : fit.sensors) {
    EXPECT_TRUE(std::isfinite(sensor.residual.relative));
    for (const FittedZero& zero : sensor.zeros) {
      EXPECT_TRUE(std::isfinite(zero.frequency_Hz));
      EXPECT_FALSE(std::isnan(zero.frequency_std_Hz));
    }
    for (const FittedNumerator& numerator : sensor.numerators) {
      EXPECT_TRUE(std::isfinite(numerator.b0));
      EXPECT_FALSE(std::isnan(numerator.b0_std));
    }
  }
}

TEST(ModalFitRobustness, EachSensorAloneShowsTheModesItSees) {
  for (const char* name : {"hub_angle", "hub_velocity", "tip_acceleration", "tip_displacement",
                           "tip_deflection", "strain@0.05"}) {
    SCOPED_TRACE(name);
    FitCase fit_case = noisy_case();
    fit_case.sensors = sensors_named({name});
    const ModalFit fit = fit_of(record_of(fit_case));
    expect_finite(fit);
    const auto exact = exact_roots(model_of(fit_case), 0).poles;
    // Displacements of the tip drift: of the third mode, 1e-5 of them, noise leaves nothing.
    const auto modes = modes_of(fit);
    ASSERT_GE(modes.size(), 2U);
    ASSERT_LE(modes.size(), 3U);
    for (std::size_t i = 0; i < modes.size(); ++i) {
      EXPECT_NEAR(modes[i].frequency_Hz, natural_Hz(exact[i]), 4.0 * modes[i].frequency_std_Hz);
      EXPECT_NEAR(modes[i].damping_ratio, damping_of(exact[i]), 4.0 * modes[i].damping_ratio_std);
    }
  }
}

TEST(ModalFitRobustness, ShortestRecordsAreFitted) {
  FitCase fit_case = noisy_case();
  fit_case.duration_s = 0.005 * kLeastSamples;
  for (const InitialState initial : {InitialState::rest, InitialState::free}) {
    const ModalFit fit = fit_of(record_of(fit_case), {.initial = {initial}});
    expect_finite(fit);
    const auto modes = modes_of(fit);
    ASSERT_EQ(modes.size(), 3U);
    // 64 samples of each sensor leave the variance itself known to a tenth.
    const auto exact = exact_roots(model_of(fit_case), 0).poles;
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(modes[i].frequency_Hz, natural_Hz(exact[i]), 5.0 * modes[i].frequency_std_Hz);
    }
  }
}

TEST(ModalFitRobustness, RecordsOfOtherLengthsRatesAndSensorsAreFittedTogether) {
  FitCase fit_case = noisy_case();
  std::vector<TimeRecord> records = {record_of(fit_case)};
  fit_case.duration_s = 7.0;
  fit_case.seed = 5;
  fit_case.sample_time_s = 0.002;
  fit_case.excitation = response::RandomNoise{.seed = 6};
  fit_case.sensors = sensors_named({"strain@0.05", "tip_deflection", "hub_velocity"});
  records.push_back(record_of(fit_case));
  const ModalFit fit = fit_modes(records);
  EXPECT_EQ(fit.sensors.size(), 5U);
  const auto modes = modes_of(fit);
  ASSERT_EQ(modes.size(), 3U);
  const auto exact = exact_roots(model_of(fit_case), 0).poles;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(modes[i].frequency_Hz, natural_Hz(exact[i]), 4.0 * modes[i].frequency_std_Hz);
    EXPECT_NEAR(modes[i].damping_ratio, damping_of(exact[i]), 4.0 * modes[i].damping_ratio_std);
  }
  EXPECT_THROW(fit_modes(records, {.initial = std::vector(3, InitialState::rest)}),
               arm::InputError);
}

TEST(ModalFitRobustness, DryFrictionLeavesTheModesAndWidensTheirIntervals) {
  FitCase fit_case = noisy_case();
  fit_case.duration_s = 30.0;
  const auto exact = exact_roots(model_of(fit_case), 0).poles;
  const auto without = modes_of(fit_of(record_of(fit_case)));
  for (const double torque_N_m : {0.006, 0.012}) {
    SCOPED_TRACE(torque_N_m);
    const ModalFit fit =
        fit_of(record_with(fit_case, "coulomb_friction", {{"torque", torque_N_m}}));
    expect_finite(fit);
    EXPECT_TRUE(fit.robust_covariance);
    EXPECT_EQ(fit.delay_s, 0.0);
    const auto modes = modes_of(fit);
    ASSERT_EQ(modes.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      // It damps in the mean over its amplitudes, and moves frequencies by the damping squared.
      const double damping_ratio = damping_of(exact[i]);
      EXPECT_GT(modes[i].damping_ratio, damping_ratio);
      EXPECT_NEAR(modes[i].frequency_Hz / natural_Hz(exact[i]), 1.0, 5e-3);
      EXPECT_GT(modes[i].frequency_std_Hz, 3.0 * without[i].frequency_std_Hz);
      EXPECT_GT(modes[i].damping_ratio_std, 3.0 * without[i].damping_ratio_std);
    }
  }
}

TEST(ModalFitRobustness, ADelayIsFoundAndLeavesPolesRight) {
  FitCase fit_case = noisy_case();
  const auto exact = exact_roots(model_of(fit_case), 0).poles;
  EXPECT_EQ(fit_of(record_of(fit_case)).delay_s, 0.0);
  for (const double delay_s : {0.002, 0.005, 0.0125, 0.05}) {
    SCOPED_TRACE(delay_s);
    const ModalFit fit = fit_of(record_with(fit_case, "time_delay", {{"delay", delay_s}}));
    expect_finite(fit);
    // Damping turns residues too, by a per cent or so: at 11.9 Hz a tenth of a millisecond.
    EXPECT_NEAR(fit.delay_s, delay_s, 1e-4);
    const auto modes = modes_of(fit);
    ASSERT_EQ(modes.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(modes[i].frequency_Hz / natural_Hz(exact[i]), 1.0, kFrequencyAsked);
      EXPECT_NEAR(modes[i].damping_ratio / damping_of(exact[i]), 1.0, kDampingAsked);
    }
  }
}

TEST(ModalFitRobustness, OverdampedModesLeaveTheFirstOneExact) {
  FitCase fit_case;
  fit_case.arm.damping.kelvin_voigt_s = 1e-2;  // damping ratios 0.38, 1.03, 1.8
  const auto exact = exact_roots(model_of(fit_case), 0).poles;
  ASSERT_EQ(exact.size(), 1U);
  const ModalFit clean = fit_of(record_of(fit_case));
  expect_finite(clean);
  const auto modes = modes_of(clean);
  ASSERT_EQ(modes.size(), 1U);
  EXPECT_NEAR(modes[0].frequency_Hz / natural_Hz(exact[0]), 1.0, 1e-9);
  EXPECT_NEAR(modes[0].damping_ratio / damping_of(exact[0]), 1.0, 1e-7);
  fit_case.relative_noise = 0.01;
  const auto noisy = modes_of(fit_of(record_of(fit_case)));
  ASSERT_EQ(noisy.size(), 1U);
  EXPECT_NEAR(noisy[0].frequency_Hz / natural_Hz(exact[0]), 1.0, kFrequencyAsked);
  EXPECT_NEAR(noisy[0].damping_ratio / damping_of(exact[0]), 1.0, kDampingAsked);
}

TEST(ModalFitRobustness, BendingAloneNeedsNoRigidBody) {
  FitCase fit_case;
  fit_case.duration_s = 20.0;
  fit_case.sensors = sensors_named({"tip_deflection"});
  // Without hub friction the rigid body does not couple into bending.
  fit_case.arm.hub.viscous_friction_N_m_s_per_rad = 0.0;
  const ModalFit fit = fit_of(record_of(fit_case), {.rigid_body = false});
  EXPECT_FALSE(fit.blocks.rigid);
  const FitErrors errors = errors_of(fit, exact_roots(model_of(fit_case), 1));
  EXPECT_LT(errors.frequency, 1e-9);
  EXPECT_LT(errors.damping_ratio, 1e-7);
  EXPECT_THROW(modal_gains(fit), arm::InputError);
}

TEST(ModalFitRobustness, OfFewLinesOfAResponse) {
  const FitCase fit_case;
  const auto exact = exact_roots(model_of(fit_case), 0).poles;
  const ModalFit fit = fit_modes(responses(fit_case, model_of(fit_case), 20));
  const auto modes = modes_of(fit);
  ASSERT_EQ(modes.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(modes[i].frequency_Hz / natural_Hz(exact[i]), 1.0, 1e-9);
  }
  expect_finite(fit_modes(responses(fit_case, model_of(fit_case), static_cast<int>(kLeastLines))));
}

TEST(ModalFitRobustness, RefusesChannelsThatAreNone) {
  FitCase fit_case = noisy_case();
  fit_case.duration_s = 5.0;
  const TimeRecord good = record_of(fit_case);
  const auto changed = [&good](const auto& change) {
    TimeRecord record = good;
    change(record);
    return record;
  };
  for (const double value : {0.0, 7.5}) {
    const TimeRecord dead =
        changed([&](TimeRecord& r) { r.channels[1].values.assign(r.time_s.size(), value); });
    EXPECT_THROW(fit_of(dead), arm::InputError);
  }
  EXPECT_THROW(fit_of(changed([](TimeRecord& r) { r.channels[0].values[7] = kUnknown; })),
               arm::InputError);
  EXPECT_THROW(fit_of(changed([](TimeRecord& r) { r.torque_N_m[7] = kUnknown; })), arm::InputError);
  EXPECT_THROW(fit_of(changed([](TimeRecord& r) { r.channels[0].values.pop_back(); })),
               std::invalid_argument);
  EXPECT_THROW(fit_of(changed([](TimeRecord& r) { r.channels.push_back(r.channels[0]); })),
               std::invalid_argument);
}

TEST(ModalFitRobustness, RefusesResponsesThatAreNone) {
  const FrequencyRecord good = responses(FitCase{}, model_of(FitCase{}), 40);
  const auto changed = [&good](const auto& change) {
    FrequencyRecord record = good;
    change(record.channels);
    return record;
  };
  EXPECT_THROW(fit_modes(changed([](auto& c) {
                 c[1] = {c[1].sensor, {}, {}, {}};
               })),
               arm::InputError);
  EXPECT_THROW(fit_modes(changed([](auto& c) { std::ranges::fill(c[1].response, 0.0); })),
               arm::InputError);
  EXPECT_THROW(fit_modes(changed([](auto& c) { std::ranges::fill(c[1].coherence, 0.0); })),
               arm::InputError);
  EXPECT_THROW(fit_modes(changed([](auto& c) { c[1].response[3] = kUnknown; })), arm::InputError);
  EXPECT_THROW(fit_modes(changed([](auto& c) { c[1].coherence.clear(); })), std::invalid_argument);
  EXPECT_THROW(fit_modes(changed([](auto& c) { c.push_back(c[0]); })), std::invalid_argument);
  EXPECT_THROW(fit_modes(good, {.band = FitBand{100.0, 200.0}}), arm::InputError);
}

}  // namespace
}  // namespace flexarm::measured
