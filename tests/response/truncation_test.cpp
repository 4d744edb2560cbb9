#include "response/truncation.hpp"

#include "response/excitation/excitation.hpp"
#include "response/formulation_maker.hpp"
#include "response/frequency/frequency_response.hpp"
#include "response/frequency/modal_response.hpp"
#include "response/residual_mode.hpp"
#include "response/time/simulation.hpp"
#include "response/time/time_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace flexarm::response {
namespace {

constexpr SampleGrid kRecord{2000, 0.0005};

const std::vector<arm::Sensor>& every_kind() {
  static const std::vector<arm::Sensor> sensors = {{arm::SensorKind::hub_angle},
                                                   {arm::SensorKind::hub_velocity},
                                                   {arm::SensorKind::tip_acceleration},
                                                   {arm::SensorKind::strain, 0.05},
                                                   {arm::SensorKind::tip_displacement}};
  return sensors;
}

struct Case {
  std::string name;
  arm::Arm arm;
  Excitation excitation;
};

std::vector<Case> cases() {
  arm::Arm plain;
  plain.beam.length_m = 0.96;
  plain.beam.width_m = 0.019008;
  plain.beam.thickness_m = 0.0032004;
  plain.beam.density_kg_per_m3 = 2710.0;
  plain.beam.youngs_modulus_Pa = 7.11e10;
  plain.hub.inertia_kg_m2 = 5.86e-4;
  arm::Arm damped = plain;
  damped.damping.kelvin_voigt_s = 1.2e-4;
  arm::Arm loaded = plain;
  loaded.payload = {0.06, 1e-5};
  arm::Arm viscous = damped;
  viscous.hub.viscous_friction_N_m_s_per_rad = 0.01;
  return {
      {"undamped, pulses", plain, BangBang{}},      {"undamped, noise", plain, RandomNoise{}},
      {"Kelvin-Voigt, pulses", damped, BangBang{}}, {"payload, pulses", loaded, BangBang{}},
      {"payload, multisine", loaded, Multisine{}},  {"viscous hub, pulses", viscous, BangBang{}}};
}

std::vector<double> torque_of(const Case& tried) {
  return sample(tried.excitation, kRecord).torque_N_m;
}

/// Channels of `simulate` with so many modes of a formulation.
std::vector<std::vector<double>> channels(const Case& tried, const std::string& formulation,
                                          int modes) {
  const ArmParts parts = take_apart(tried.arm);
  const auto model =
      time_model(make_formulation(formulation, tried.arm, modes), parts, modes, every_kind());
  SimulationOptions options;
  options.sample_time_s = kRecord.period_s;
  options.energy = false;
  return simulate(model, parts, every_kind(), torque_of(tried), options).channels;
}

/// Root mean square of the difference over that of `whole`.
double difference(const std::vector<double>& some, const std::vector<double>& whole) {
  double error = 0.0;
  double size = 0.0;
  for (std::size_t k = 0; k < whole.size(); ++k) {
    error += std::pow(some[k] - whole[k], 2);
    size += whole[k] * whole[k];
  }
  return std::sqrt(error / size);
}

// Modes beyond four times those kept make the estimate low by 13 % where the error falls as
// modes^(-1/2), which is the slowest here; damping that couples modes is left out of it.
constexpr double kLow = 1.3;
constexpr double kHigh = 1.3;
// Where an error is at the rounding of e^(A dt), the estimate is lower.
constexpr double kRounding = 2e-6;

TEST(Truncation, InTimeTheEstimateIsTheErrorOfASimulation) {
  for (const Case& tried : cases()) {
    constexpr int kMany = 200;
    const auto whole = channels(tried, "exact_tf", kMany);
    for (const int modes : {5, 12, 40}) {
      const auto estimate =
          truncation_in_time(tried.arm, every_kind(), torque_of(tried), kRecord.period_s,
                             TorqueHold::zero, {.given = modes});
      EXPECT_FALSE(estimate.chosen);
      const auto some = channels(tried, "exact_tf", modes);
      for (std::size_t k = 0; k < some.size(); ++k) {
        const double error = difference(some[k], whole[k]);
        EXPECT_LE(error, kLow * estimate.errors[k] + kRounding)
            << tried.name << ", sensor " << k << ", " << modes << " modes";
        EXPECT_LE(estimate.errors[k], kHigh * error + kRounding)
            << tried.name << ", sensor " << k << ", " << modes << " modes";
      }
    }
  }
}

TEST(Truncation, TheChosenNumberIsTheFewestWithinToleranceAgainstAnotherFormulation) {
  for (const Case& tried : cases()) {
    const auto chosen = truncation_in_time(tried.arm, every_kind(), torque_of(tried),
                                           kRecord.period_s, TorqueHold::zero, {});
    EXPECT_TRUE(chosen.chosen);
    if (!chosen.is_within_tolerance()) {
      EXPECT_EQ(chosen.modes, kMostChosenModes) << tried.name;
      continue;
    }
    const auto fewer =
        truncation_in_time(tried.arm, every_kind(), torque_of(tried), kRecord.period_s,
                           TorqueHold::zero, {.given = chosen.modes - 1});
    EXPECT_FALSE(chosen.modes > kFewestChosenModes && fewer.largest_error() < 0.9e-4) << tried.name;
    if (chosen.modes > 40) continue;  // fem has settings for 90
    const auto whole = channels(tried, "fem", 85);
    const auto some = channels(tried, "exact_tf", chosen.modes);
    for (std::size_t k = 0; k < some.size(); ++k) {
      EXPECT_LE(difference(some[k], whole[k]), kLow * kTruncationTolerance)
          << tried.name << ", sensor " << k << ", " << chosen.modes << " modes";
    }
  }
}

TEST(Truncation, AnUndampedAccelerationAfterAJumpNeedsMoreThanTheMost) {
  const Case tried = cases().front();
  const auto of_modes = [&](int modes) {
    return truncation_in_time(tried.arm, every_kind(), torque_of(tried), kRecord.period_s,
                              TorqueHold::zero, {.given = modes})
        .errors[2];
  };
  EXPECT_GT(of_modes(kMostChosenModes), kTruncationTolerance);
  EXPECT_NEAR(std::log2(of_modes(80) / of_modes(160)), 1.5, 0.15);
}

TEST(Truncation, AFirstOrderHoldRingsHighModesLess) {
  // From torque 0 on: a first sample that is not is a jump by either hold.
  const Case tried{"", cases().front().arm, Sine{.amplitude_N_m = 0.1, .frequency_Hz = 3.0}};
  const auto of_hold = [&](TorqueHold hold) {
    return truncation_in_time(tried.arm, every_kind(), torque_of(tried), kRecord.period_s, hold,
                              {.given = 40})
        .errors[2];
  };
  EXPECT_LT(of_hold(TorqueHold::first), 0.5 * of_hold(TorqueHold::zero));
}

TEST(Truncation, VisibleModesAreThoseWithoutWhichAnErrorIsAboveOnePercent) {
  const Case tried = cases().front();
  const auto torque = torque_of(tried);
  const auto with = [&](int modes) {
    return truncation_in_time(tried.arm, every_kind(), torque, kRecord.period_s, TorqueHold::zero,
                              {.given = modes});
  };
  const auto natural = modal_model(make_formulation("exact_tf", tried.arm, 60), 60, {}, {}).modes;
  int visible = 1;
  while (with(visible).largest_error() > kVisiblePart) ++visible;
  const double highest_Hz =
      natural.at(static_cast<std::size_t>(visible)).omega_rad_per_s / (2.0 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(with(60).visible_Hz, highest_Hz);
  // A model of fewer modes shows all of them.
  EXPECT_DOUBLE_EQ(with(3).visible_Hz, natural[3].omega_rad_per_s / (2.0 * std::numbers::pi));
}

TEST(Truncation, RestBeforeTheTorqueDoesNotCount) {
  const Case tried = cases().front();
  std::vector<double> late(3 * kMostJudgedSamples, 0.0);
  const auto torque = torque_of(tried);
  std::ranges::copy(torque, late.begin() + 2 * kMostJudgedSamples);
  std::vector<double> early(late.begin() + 2 * kMostJudgedSamples, late.end());
  const auto errors_of = [&](const std::vector<double>& of) {
    return truncation_in_time(tried.arm, every_kind(), of, kRecord.period_s, TorqueHold::zero,
                              {.given = 10})
        .errors;
  };
  EXPECT_EQ(errors_of(late), errors_of(early));
}

TEST(Truncation, WithoutSignalOrBeamThereIsNoError) {
  const Case tried = cases().front();
  const std::vector<double> nothing(100, 0.0);
  EXPECT_EQ(truncation_in_time(tried.arm, every_kind(), nothing, 0.001, TorqueHold::zero, {})
                .largest_error(),
            0.0);
  arm::Arm hub;
  hub.hub.inertia_kg_m2 = 0.01;
  const std::vector<arm::Sensor> angle = {{arm::SensorKind::hub_angle}};
  const std::vector<double> torque(100, 1.0);
  EXPECT_EQ(truncation_in_time(hub, angle, torque, 0.001, TorqueHold::zero, {}).largest_error(),
            0.0);
}

TEST(Truncation, InFrequencyTheErrorIsThatOfTheModesAgainstAnotherFormulation) {
  for (const Case& tried : cases()) {
    for (const bool correction : {false, true}) {
      const auto frequencies = judged_frequencies_Hz(0.1, 100.0);
      const auto exact = make_formulation("exact_tf", tried.arm, 1);
      const auto chosen = truncation_in_frequency(exact, every_kind(), frequencies, correction, {});
      EXPECT_TRUE(chosen.is_within_tolerance()) << tried.name;
      auto model = modal_model(exact, chosen.modes, every_kind(), {});
      if (correction) model = with_residual_mode(exact, model, every_kind());
      const auto other = make_formulation("fem", tried.arm, 60);
      for (std::size_t k = 0; k < every_kind().size(); ++k) {
        double sum = 0.0;
        for (const double frequency : frequencies) {
          const auto s = on_imaginary_axis(frequency);
          const auto whole = transfer_function(other, every_kind()[k], s);
          sum += std::norm((modal_response(model, every_kind(), s)[k] - whole) / whole);
        }
        const double error = std::sqrt(sum / static_cast<double>(frequencies.size()));
        EXPECT_NEAR(error, chosen.errors[k], 1e-6) << tried.name << ", sensor " << k;
      }
    }
  }
}

}  // namespace
}  // namespace flexarm::response
