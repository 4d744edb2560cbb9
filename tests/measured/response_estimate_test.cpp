#include "measured/spectra/response_estimate.hpp"

#include "arm/input_error.hpp"
#include "exact_tf/exact_arm.hpp"
#include "tests/measured/simulated_record.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace flexarm::measured {
namespace {

using Complex = std::complex<double>;

/// The report of a setting.
const SettingReport& report_of(const FrequencyResponseEstimate& estimate, const std::string& name) {
  const auto& reports = estimate.settings.reports;
  const auto found = std::ranges::find(reports, name, &SettingReport::name);
  EXPECT_NE(found, reports.end()) << name;
  return *found;
}

std::vector<double> random_torque(double duration_s, std::uint64_t seed,
                                  double period_s = kPeriod_s) {
  return torque_of(
      response::RandomNoise{.rms_N_m = 0.05, .from_Hz = 0.05, .to_Hz = 90.0, .seed = seed},
      static_cast<std::size_t>(duration_s / period_s), period_s);
}

TEST(EstimateOfAPeriodicRecord, IsTheExactTransferFunctionButForImages) {
  // 1 kHz, lines to 40 Hz: images of the angle are (40/1000)^3, of strain less.
  constexpr double kFine_s = 0.001;
  const auto arm = settling_arm();
  const SimulatedArm simulated(arm, sensors_named({"hub_angle", "hub_velocity"}), 12);
  const auto torque = torque_of(
      response::Multisine{.from_Hz = 0.1, .to_Hz = 40.0, .period_s = 10.0}, 50'000, kFine_s);
  const auto record = simulated.record(torque, kFine_s);
  const auto made = estimate_frequency_response(record);
  ASSERT_TRUE(made.settings.periodic);
  EXPECT_EQ(made.frequency_Hz.size(), 200U);
  EXPECT_THAT(report_of(made, "periodic").value, testing::HasSubstr("5 periods of 10000 samples"));
  const exact_tf::ExactArm exact(arm);
  // The velocity falls as 1/f and both its images add: 2 (40/1000)^2 if the whole arm turned at
  // 1 kHz; the hub alone does, with an 85th of its inertia: 0.27 at most. Without the hold's
  // correction the phase alone is off by pi f T, 0.13 rad at 40 Hz.
  const double most[] = {1e-3, 0.27};
  const auto raw = estimate_frequency_response(record, {.correct_hold = false});
  for (std::size_t i = 0; i < 2; ++i) {
    double worst = 0.0;
    double worst_raw = 0.0;
    for (std::size_t k = 0; k < made.frequency_Hz.size(); ++k) {
      const auto g = exact.transfer_function(record.channels[i].sensor,
                                             Complex(0.0, kTwoPi * made.frequency_Hz[k]));
      worst = std::max(worst, std::abs(made.channels[i].response[k] / g - 1.0));
      worst_raw = std::max(worst_raw, std::abs(raw.channels[i].response[k] / g - 1.0));
    }
    EXPECT_LT(worst, most[i]) << i;
    EXPECT_GT(worst_raw, 0.1) << i;
  }
}

TEST(EstimateOfAPeriodicRecord, WithALinearTorqueHasImagesOfTheSquare) {
  constexpr double kFine_s = 0.001;
  const auto arm = settling_arm();
  const SimulatedArm simulated(arm, sensors_named({"hub_angle", "tip_acceleration"}), 12);
  const auto torque = torque_of(
      response::Multisine{.from_Hz = 0.1, .to_Hz = 40.0, .period_s = 10.0}, 50'000, kFine_s);
  const auto made = estimate_frequency_response(
      simulated.record(torque, kFine_s, response::TorqueHold::first), {.hold = TorqueHold::first});
  const exact_tf::ExactArm exact(arm);
  for (std::size_t i = 0; i < 2; ++i) {
    double worst = 0.0;
    for (std::size_t k = 0; k < made.frequency_Hz.size(); ++k) {
      const auto g = exact.transfer_function(simulated.sensors()[i],
                                             Complex(0.0, kTwoPi * made.frequency_Hz[k]));
      worst = std::max(worst, std::abs(made.channels[i].response[k] / g - 1.0));
    }
    // (40/1000)^2 times what is beside the tip's response at 1 kHz, a few of that at 40 Hz.
    EXPECT_LT(worst, i == 0 ? 1e-4 : 1e-2) << i;
  }
}

TEST(EstimateOfAPeriodicRecord, StatesItsStandardDeviation) {
  const SimulatedArm simulated(settling_arm(), sensors_named({"hub_angle", "strain@0.05"}), 3);
  const auto torque = torque_of(response::Multisine{.from_Hz = 0.2, .to_Hz = 60.0, .period_s = 5.0},
                                6000, kPeriod_s);
  const auto clean = estimate_frequency_response(simulated.record(torque, kPeriod_s));
  double error[2] = {};
  double stated[2] = {};
  constexpr int kRuns = 60;
  for (int run = 0; run < kRuns; ++run) {
    const auto noisy =
        estimate_frequency_response(simulated.record(torque, kPeriod_s, response::TorqueHold::zero,
                                                     1e-3, static_cast<std::uint64_t>(run + 1)),
                                    {.leave_out_periods = clean.settings.left_out_periods});
    for (std::size_t i = 0; i < 2; ++i) {
      const auto& channel = noisy.channels[i];
      for (std::size_t k = 5; k < noisy.frequency_Hz.size(); ++k) {
        error[i] += std::norm((channel.response[k] - clean.channels[i].response[k]) /
                              clean.channels[i].response[k]);
        stated[i] += std::pow(channel.response_std[k] / std::abs(clean.channels[i].response[k]), 2);
      }
    }
  }
  // 60 x 145 lines, the largest of which count most.
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(error[i] / stated[i], 1.0, 0.1) << i;
}

TEST(EstimateOfARandomRecord, IsTheResponseWithinItsStandardDeviations) {
  const SimulatedArm simulated(settling_arm(),
                               sensors_named({"hub_angle", "hub_velocity", "strain@0.05"}), 3);
  const auto record =
      simulated.record(random_torque(120.0, 1), kPeriod_s, response::TorqueHold::zero, 1e-3);
  const auto made = estimate_frequency_response(record);
  EXPECT_FALSE(made.settings.periodic);
  EXPECT_GE(made.averages, 10.0);
  EXPECT_EQ(made.settings.differences, (std::vector<int>{2, 1, 0}));
  EXPECT_EQ(report_of(made, "window").value, "hann");
  for (std::size_t i = 0; i < 3; ++i) {
    double chi2 = 0.0;
    double count = 0.0;
    for (std::size_t k = 0; k < made.frequency_Hz.size(); ++k) {
      const double f_Hz = made.frequency_Hz[k];
      if (f_Hz < 0.5 || f_Hz > 80.0) continue;
      const auto g = simulated.sampled_response(i, f_Hz, kPeriod_s, 1);
      // What the window blurs at a peak or valley: a few per cent of |G|.
      constexpr double kBlur = 0.03;
      const double allowed = std::hypot(made.channels[i].response_std[k], kBlur * std::abs(g));
      chi2 += std::norm(made.channels[i].response[k] - g) / (allowed * allowed);
      ++count;
    }
    EXPECT_LT(chi2 / count, 1.2) << i;
  }
}

TEST(EstimateOfARandomRecord, NeedsTheDifferencesOfAnAngleThatDrifts) {
  arm::Arm arm = settling_arm();
  arm.hub.viscous_friction_N_m_s_per_rad = 0.0;
  const SimulatedArm simulated(arm, sensors_named({"hub_angle"}), 3);
  // A torque with an offset, as the paper has it against friction: the arm turns ever faster.
  auto torque = random_torque(200.0, 2);
  for (double& value : torque) value += 0.005;
  const auto record = simulated.record(torque, kPeriod_s);
  const auto median_error = [&](bool difference) {
    const auto made =
        estimate_frequency_response(record, {.segment_samples = 2000, .difference = difference});
    std::vector<double> errors;
    for (std::size_t k = 5; k < 45; k += 2) {
      const auto g = simulated.sampled_response(0, made.frequency_Hz[k], kPeriod_s, 1);
      errors.push_back(std::abs(made.channels[0].response[k] / g - 1.0));
    }
    std::ranges::nth_element(errors, errors.begin() + 10);
    return errors[10];
  };
  const double with = median_error(true);
  const double without = median_error(false);
  EXPECT_LT(with, 0.02);
  EXPECT_GT(without, 0.2);
}

TEST(ChosenSegment, ResolvesTheSharpestResonanceWhereTheRecordIsLongEnough) {
  arm::Arm arm = settling_arm();
  arm.damping.kelvin_voigt_s = 2e-4;
  arm.hub.viscous_friction_N_m_s_per_rad = 0.005;
  const SimulatedArm simulated(arm, sensors_named({"strain@0.05"}), 3);
  const auto made =
      estimate_frequency_response(simulated.record(random_torque(300.0, 3), kPeriod_s));
  // Half-power widths 2 zeta f.
  double width_Hz = 1e3;
  for (const auto& pole : exact_tf::ExactArm(arm).damped_poles(3).flexible) {
    width_Hz = std::min(width_Hz, -2.0 * pole.first_rad_per_s.real() / kTwoPi);
  }
  EXPECT_LT(made.spacing_Hz, width_Hz / 4.0);
  EXPECT_GT(made.spacing_Hz, width_Hz / 12.0);
  EXPECT_THAT(report_of(made, "segment").reason, testing::HasSubstr("narrowest resonance"));
}

TEST(ChosenSegment, IsShortEnoughToAverageWhereTheRecordIsShort) {
  arm::Arm arm = settling_arm();
  arm.damping.kelvin_voigt_s = 2e-5;
  arm.hub.viscous_friction_N_m_s_per_rad = 0.002;
  const SimulatedArm simulated(arm, sensors_named({"strain@0.05"}), 3);
  const auto made =
      estimate_frequency_response(simulated.record(random_torque(20.0, 3), kPeriod_s));
  EXPECT_GE(made.averages, 9.5);
  EXPECT_LE(made.averages, 12.0);
  EXPECT_THAT(report_of(made, "segment").reason, testing::HasSubstr("10 effective averages"));
}

TEST(ChosenSettingsTest, AreThoseGiven) {
  const SimulatedArm simulated(settling_arm(), sensors_named({"hub_angle"}), 2);
  const auto record = simulated.record(random_torque(20.0, 3), kPeriod_s);
  const auto made = estimate_frequency_response(record, {.window = Window::flat_top,
                                                         .segment_samples = 410,
                                                         .overlap = 0.5,
                                                         .detrend = Detrend::line,
                                                         .difference = false,
                                                         .periodic = false});
  EXPECT_EQ(made.settings.plan.segment_samples, 410U);
  EXPECT_EQ(made.settings.plan.shift_samples, 205U);
  EXPECT_EQ(made.frequency_Hz.size(), 206U);
  EXPECT_EQ(made.settings.differences[0], 0);
  for (const char* name : {"window", "segment", "overlap", "detrend", "differences", "periodic"}) {
    EXPECT_EQ(report_of(made, name).reason, "given") << name;
  }
}

TEST(ChosenSettingsTest, RefuseWhatCannotBeUsed) {
  const SimulatedArm simulated(settling_arm(), sensors_named({"hub_angle"}), 2);
  auto record = simulated.record(random_torque(5.0, 3), kPeriod_s);
  const auto refused = [&](const SpectrumSettings& settings) {
    EXPECT_THROW(estimate_frequency_response(record, settings), arm::InputError);
  };
  refused({.segment_samples = 1001});
  refused({.overlap = 1.0});
  refused({.periodic = true});
  refused({.period_samples = 2000});
  refused({.period_samples = 500, .leave_out_periods = 2});
  record.torque_N_m.assign(record.torque_N_m.size(), 0.1);
  refused({});
  record.channels.clear();
  refused({});
}

TEST(FrequencyRecordOfAnEstimate, HasTheResponsesWithoutLineZero) {
  const SimulatedArm simulated(settling_arm(), sensors_named({"hub_angle", "strain@0.05"}), 2);
  const auto made =
      estimate_frequency_response(simulated.record(random_torque(20.0, 3), kPeriod_s));
  const auto record = to_frequency_record(made);
  ASSERT_EQ(record.channels.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& channel = record.channels[i];
    EXPECT_EQ(channel.sensor, simulated.sensors()[i]);
    ASSERT_EQ(channel.response.size(), made.frequency_Hz.size() - 1);
    EXPECT_EQ(channel.frequency_Hz[0], made.frequency_Hz[1]);
    EXPECT_EQ(channel.response[9], made.channels[i].estimators.h1[10]);
    EXPECT_EQ(channel.coherence[9], made.channels[i].estimators.coherence[10]);
  }
  EXPECT_NO_THROW(format_frequency_record(record));
}

}  // namespace
}  // namespace flexarm::measured
