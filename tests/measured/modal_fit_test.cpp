// Fits of simulated records: noise-free ones to the figures that rounding allows, noisy ones to
// their own standard errors.
#include "measured/modal/modal_fit.hpp"

#include "arm/input_error.hpp"
#include "response/time/random_numbers.hpp"
#include "tests/fit_cases/fit_cases.hpp"
#include "tests/measured/fit_errors.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace flexarm::measured {
namespace {

/// Issue 4 asks for 1e-6, 1e-4 and 1e-5 of noise-free data with all modes in the band. What is
/// left is the rounding of the simulation, 1e-12 of the largest reading, over a mode's share.
constexpr FitErrors kNoiseFree{1e-9, 1e-7, 1e-7};

void expect_below(const FitErrors& errors, const FitErrors& bounds) {
  EXPECT_LT(errors.frequency, bounds.frequency);
  EXPECT_LT(errors.damping_ratio, bounds.damping_ratio);
  EXPECT_LT(errors.zeros, bounds.zeros);
}

ModalFit fit_of(const FitCase& fit_case, const ModalFitOptions& options = {}) {
  const std::array records = {record_of(fit_case)};
  return fit_modes(records, options);
}

FitErrors noise_free_errors(const FitCase& fit_case, const ModalFitOptions& options = {}) {
  const ModalFit fit = fit_of(fit_case, options);
  EXPECT_TRUE(fit.converged);
  return errors_of(fit, exact_roots(model_of(fit_case), fit_case.sensors.size()));
}

TEST(ModalFit, OfNoiseFreeRandomTorqueIsExact) {
  FitCase fit_case;
  fit_case.duration_s = 20.0;
  expect_below(noise_free_errors(fit_case), kNoiseFree);
}

TEST(ModalFit, OfNoiseFreeMultisineChirpAndBangBangIsExact) {
  for (const response::Excitation& excitation :
       {response::Excitation(response::Multisine{}), response::Excitation(response::Chirp{}),
        response::Excitation(response::BangBang{.pairs = 0})}) {
    SCOPED_TRACE(name(excitation));
    FitCase fit_case;
    fit_case.duration_s = 20.0;
    fit_case.excitation = excitation;
    expect_below(noise_free_errors(fit_case), kNoiseFree);
  }
}

TEST(ModalFit, OfATorqueLinearBetweenSamplesIsExact) {
  FitCase fit_case;
  fit_case.duration_s = 20.0;
  fit_case.hold = response::TorqueHold::first;
  expect_below(noise_free_errors(fit_case, {.torque_hold = TorqueHold::first}), kNoiseFree);
}

TEST(ModalFit, OfAnArmWithPayloadIsExact) {
  FitCase fit_case;
  fit_case.duration_s = 20.0;
  fit_case.arm.payload = {.mass_kg = 0.06, .inertia_kg_m2 = 1e-4};
  expect_below(noise_free_errors(fit_case), kNoiseFree);
}

TEST(ModalFit, OfTheHubAngleAloneIsExact) {
  FitCase fit_case;
  fit_case.duration_s = 20.0;
  fit_case.sensors = sensors_named({"hub_angle"});
  // The angle drifts: the third mode is 1e-4 of it.
  expect_below(noise_free_errors(fit_case), {1e-8, 1e-6, 1e-6});
}

TEST(ModalFit, OfARecordThatBeginsInMotionIsExact) {
  FitCase fit_case;
  fit_case.duration_s = 20.0;
  std::array records = {record_of(fit_case)};
  constexpr std::ptrdiff_t kCut = 1000;
  records[0].time_s.erase(records[0].time_s.begin(), records[0].time_s.begin() + kCut);
  records[0].torque_N_m.erase(records[0].torque_N_m.begin(), records[0].torque_N_m.begin() + kCut);
  for (Channel& channel : records[0].channels) {
    channel.values.erase(channel.values.begin(), channel.values.begin() + kCut);
  }
  const ModalFit fit = fit_modes(records, {.initial = {InitialState::free}});
  const auto exact = exact_roots(model_of(fit_case), fit_case.sensors.size());
  expect_below(errors_of(fit, exact), kNoiseFree);
  // Taken to be at rest, it is not described.
  const ModalFit wrong = fit_modes(records, {.modes = 3});
  EXPECT_GT(errors_of(wrong, exact).damping_ratio, kNoiseFree.damping_ratio);
}

TEST(ModalFit, OfHeavilyDampedModesIsExact) {
  FitCase fit_case;
  fit_case.duration_s = 20.0;
  fit_case.arm.damping.kelvin_voigt_s = 2e-3;  // damping ratios 0.075, 0.2, 0.37
  expect_below(noise_free_errors(fit_case), kNoiseFree);
}

/// Two modes 1 % apart beside the rigid body.
arm::ModalModel close_pair() {
  arm::ModalModel model;
  model.modal_mass_kg_m2 = 0.05;
  const auto mode = [](double omega, double slope, double tip) {
    return arm::Mode{.omega_rad_per_s = omega,
                     .hub_slope = slope,
                     .damping_ratio = 0.0,
                     .sensor_values = {slope, tip},
                     .displacement_m = {}};
  };
  model.modes = {mode(0.0, 1.0, 1.0), mode(80.0, 2.0, -1.0), mode(80.8, 1.5, 0.7)};
  model.damping_rad_per_s = {0.04, 0.0, 0.0, 0.0, 0.8, 0.0, 0.0, 0.0, 1.0};
  return model;
}

TEST(ModalFit, TellsTwoCloseModesApart) {
  FitCase fit_case;
  fit_case.sensors = sensors_named({"hub_angle", "tip_acceleration"});
  const auto model = close_pair();
  for (const double noise : {0.0, 0.01}) {
    std::array records = {clean_record(fit_case, model)};
    add_noise(records[0], noise, 3);
    const ModalFit fit = fit_modes(records);
    const FitErrors errors = errors_of(fit, exact_roots(model, 2), false);
    EXPECT_LT(errors.frequency, noise == 0.0 ? 1e-8 : 5e-4);
    EXPECT_LT(errors.damping_ratio, noise == 0.0 ? 1e-6 : 0.05);
  }
}

TEST(ModalFit, OfNoisyDataMeetsTheFiguresAndFindsTheNumberOfModes) {
  FitCase fit_case;
  fit_case.relative_noise = 0.01;
  const ModalFit fit = fit_of(fit_case);
  EXPECT_EQ(fit.poles.size(), 3U) << fit.order_reason;
  const FitErrors errors =
      errors_of(fit, exact_roots(model_of(fit_case), fit_case.sensors.size()), false);
  EXPECT_LT(errors.frequency, 5e-4);
  EXPECT_LT(errors.damping_ratio, 0.05);
  EXPECT_FALSE(fit.robust_covariance);
  for (const FittedSensor& sensor : fit.sensors) {
    EXPECT_NEAR(sensor.residual.relative, 0.01, 1e-3) << arm::to_string(sensor.sensor);
  }
  EXPECT_EQ(std::ranges::count(fit.order_trials, true, &OrderTrial::kept), 4);
  EXPECT_THAT(fit.order_reason, testing::HasSubstr("BIC"));
}

TEST(ModalFit, OfModesBeyondTheBandMeetsTheFigures) {
  // Ten modes at 200 Hz: those from the fifth on show at frequencies that are not their own.
  FitCase fit_case;
  fit_case.modes = 10;
  fit_case.relative_noise = 0.01;
  const ModalFit fit = fit_of(fit_case);
  ExactRoots exact = exact_roots(model_of(fit_case), fit_case.sensors.size());
  exact.poles.resize(3);
  const FitErrors errors = errors_of(fit, exact, false);
  EXPECT_LT(errors.frequency, 5e-4);
  EXPECT_LT(errors.damping_ratio, 0.05);
  // What stands for the others is not taken for a mode.
  EXPECT_EQ(std::ranges::count(fit.poles, true, &FittedPole::is_mode), 3);
}

TEST(ModalFit, OfAnUndampedArmHasNoDamping) {
  FitCase fit_case;
  fit_case.arm = arm::paper_arm();
  fit_case.duration_s = 20.0;
  fit_case.relative_noise = 0.01;
  const ModalFit fit = fit_of(fit_case);
  const auto exact = exact_roots(model_of(fit_case), 0).poles;
  ASSERT_EQ(fit.poles.size(), exact.size());
  for (std::size_t i = 0; i < exact.size(); ++i) {
    EXPECT_LT(std::abs(fit.poles[i].frequency_Hz - natural_Hz(exact[i])),
              4.0 * fit.poles[i].frequency_std_Hz);
    EXPECT_LT(std::abs(fit.poles[i].damping_ratio), 4.0 * fit.poles[i].damping_ratio_std);
  }
}

TEST(ModalFit, OfModesBeyondHalfTheSamplingFrequencyHasNoFalseZeros) {
  // The fourth mode, 102.6 Hz, shows at 97.4 Hz, next to half the sampling frequency.
  FitCase fit_case;
  fit_case.modes = 5;
  fit_case.excitation = response::RandomNoise{.from_Hz = 0.2, .to_Hz = 60.0};
  fit_case.relative_noise = 0.01;
  const auto exact = exact_roots(model_of(fit_case), fit_case.sensors.size());
  const ModalFit fit = fit_of(fit_case);
  int told = 0;
  for (std::size_t j = 0; j < fit.sensors.size(); ++j) {
    for (const FittedZero& zero : fit.sensors[j].zeros) {
      if (!zero.in_band || !zero.is_told) continue;
      ++told;
      const bool near = std::ranges::any_of(exact.zeros[j], [&](std::complex<double> s) {
        return std::abs(zero.frequency_Hz - std::abs(s) / (2.0 * std::numbers::pi)) <
               5.0 * zero.frequency_std_Hz;
      });
      EXPECT_TRUE(near) << arm::to_string(fit.sensors[j].sensor) << ' ' << zero.frequency_Hz
                        << " +- " << zero.frequency_std_Hz;
    }
  }
  EXPECT_GE(told, 4);
}

TEST(ModalFit, OfTwoRunsIsSurerThanOfOne) {
  FitCase fit_case;
  fit_case.duration_s = 30.0;
  fit_case.relative_noise = 0.01;
  std::vector<TimeRecord> records = {record_of(fit_case)};
  const ModalFit one = fit_modes(records, {.modes = 3});
  fit_case.excitation = response::RandomNoise{.seed = 2};
  fit_case.seed = 2;
  records.push_back(record_of(fit_case));
  std::ranges::reverse(records[1].channels);
  const ModalFit both = fit_modes(records, {.modes = 3});
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT(both.poles[i].frequency_std_Hz, one.poles[i].frequency_std_Hz);
  }
}

TEST(ModalFit, ALoudRunBesideAQuietOneDoesNoHarm) {
  FitCase fit_case;
  fit_case.duration_s = 20.0;
  fit_case.relative_noise = 0.002;
  std::vector<TimeRecord> records = {record_of(fit_case)};
  const ModalFit quiet = fit_modes(records, {.modes = 3});
  fit_case.excitation = response::RandomNoise{.seed = 2};
  fit_case.relative_noise = 0.1;
  fit_case.seed = 2;
  records.push_back(record_of(fit_case));
  const ModalFit both = fit_modes(records, {.modes = 3});
  const auto exact = exact_roots(model_of(fit_case), 0).poles;
  for (std::size_t i = 0; i < 3; ++i) {
    // As of twice as many data with the noise of both in the mean they would be 35 times as large.
    EXPECT_LT(both.poles[i].frequency_std_Hz, 1.05 * quiet.poles[i].frequency_std_Hz);
    EXPECT_LT(std::abs(both.poles[i].frequency_Hz - natural_Hz(exact[i])),
              4.0 * both.poles[i].frequency_std_Hz);
  }
}

TEST(ModalFit, SaysThatColouredNoiseIsColouredAndWidensItsErrors) {
  FitCase fit_case;
  fit_case.duration_s = 30.0;
  std::array records = {record_of(fit_case)};
  // Noise of a memory of ten samples.
  response::RandomNumbers random(9);
  for (Channel& channel : records[0].channels) {
    double size = 0.0;
    for (const double value : channel.values) size += value * value;
    const double deviation = 0.01 * std::sqrt(size / static_cast<double>(channel.values.size()));
    double noise = 0.0;
    for (double& value : channel.values) {
      noise = 0.9 * noise + std::sqrt(1.0 - 0.81) * random.normal();
      value += deviation * noise;
    }
  }
  const ModalFit robust = fit_modes(records, {.modes = 3});
  const ModalFit white = fit_modes(records, {.modes = 3, .robust = false});
  EXPECT_TRUE(robust.robust_covariance);
  EXPECT_FALSE(white.robust_covariance);
  EXPECT_LT(robust.sensors[0].residual.whiteness_probability, ResidualQuality::kSignificance);
  // At 11.9 Hz the noise has (1 - 0.81)/|1 - 0.9 exp(-i omega T)|^2 = 1.36 of the white one's
  // power; 40 batches tell a standard error to 11 %.
  const double ratio = robust.poles[0].frequency_std_Hz / white.poles[0].frequency_std_Hz;
  EXPECT_GT(ratio, 0.75);
  EXPECT_LT(ratio, 1.75);
}

TEST(ModalFit, IsAModalTable) {
  FitCase fit_case;
  fit_case.relative_noise = 0.01;
  fit_case.duration_s = 30.0;
  const ModalTable table = modal_table(fit_of(fit_case, {.modes = 3}));
  ASSERT_GE(table.size(), 4U);
  EXPECT_EQ(table[0].feature, Feature::pole);
  EXPECT_EQ(table[2].feature, Feature::pole);
  EXPECT_FALSE(table[2].order);
  EXPECT_NEAR(*table[0].frequency_Hz, 11.86, 0.05);
  EXPECT_GT(*table[0].frequency_std_Hz, 0.0);
  EXPECT_EQ(table[3].sensor, fit_case.sensors[0]);
  EXPECT_NEAR(*table[3].frequency_Hz, 2.873, 0.05);
  EXPECT_EQ(parse_modal_table(format_modal_table(table), "table.csv"), table);
}

TEST(ModalFit, EndsWhereItsProgressSays) {
  FitCase fit_case;
  fit_case.duration_s = 5.0;
  fit_case.relative_noise = 0.01;
  double last = 0.0;
  bool forward = true;
  const ModalFit all = fit_of(fit_case, {.progress = [&](double fraction) {
                                forward = forward && fraction >= last && fraction <= 1.0;
                                last = fraction;
                                return true;
                              }});
  EXPECT_TRUE(forward);
  EXPECT_EQ(last, 1.0);
  EXPECT_FALSE(all.cancelled);
  EXPECT_TRUE(fit_of(fit_case, {.progress = [](double) { return false; }}).cancelled);
}

TEST(ModalFit, RefusesWhatCannotBeFitted) {
  FitCase fit_case;
  fit_case.duration_s = 5.0;
  const TimeRecord record = record_of(fit_case);
  EXPECT_THROW(fit_modes(std::span<const TimeRecord>{}), arm::InputError);
  std::array records = {record};
  records[0].torque_N_m.assign(record.torque_N_m.size(), 0.0);
  EXPECT_THROW(fit_modes(records), arm::InputError);
  records[0] = record;
  records[0].channels.clear();
  EXPECT_THROW(fit_modes(records), arm::InputError);
  records[0] = record;
  EXPECT_THROW(fit_modes(records, {.modes = 0}), arm::InputError);
  EXPECT_THROW(fit_modes(records, {.band = FitBand{20.0, 10.0}}), arm::InputError);
  EXPECT_THROW(fit_modes(records, {.band = FitBand{1.0, 101.0}}), arm::InputError);
  EXPECT_THROW(fit_modes(FrequencyRecord{}), arm::InputError);
}

}  // namespace
}  // namespace flexarm::measured
