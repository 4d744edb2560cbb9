#include "arm/linear_arm.hpp"
#include "laws/effect_arms.hpp"
#include "response/any_formulation.hpp"
#include "response/settings.hpp"
#include "tests/reference/effect_cases.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

namespace flexarm::laws {
namespace {

using arm::Sensor;
using arm::SensorKind;
using Complex = std::complex<double>;
using response::AnyFormulation;

constexpr int kReferenceRoots = 10;
/// exact_tf has no discretisation: rounding of a long double over some thousand operations, shown
/// as a double, times the condition of the root.
constexpr double kExactTolerance = 1e-12;

struct Formulation {
  const char* name;
  AnyFormulation (*make)(const arm::Arm&);
};

const std::vector<Formulation>& formulations() {
  static const std::vector<Formulation> all = {
      {"exact_tf", [](const arm::Arm& arm) -> AnyFormulation { return exact_tf::ExactArm(arm); }},
      {"fem",
       [](const arm::Arm& arm) -> AnyFormulation {
         return fem::FemArm(arm, response::fem_settings(kReferenceRoots));
       }},
      {"assumed_modes",
       [](const arm::Arm& arm) -> AnyFormulation {
         return assumed_modes::AssumedModesArm(arm,
                                               response::assumed_modes_settings(kReferenceRoots));
       }},
  };
  return all;
}

using FormulationAndCase = std::tuple<std::size_t, std::size_t>;  // formulation, case

class EffectReference : public testing::TestWithParam<FormulationAndCase> {
 protected:
  const Formulation& formulation() const { return formulations()[std::get<0>(GetParam())]; }
  const reference::EffectCase& expected() const {
    return reference::effect_cases()[std::get<1>(GetParam())];
  }
  AnyFormulation model() const { return formulation().make(expected().arm); }
  double tolerance() const {
    return std::get<0>(GetParam()) == 0 ? kExactTolerance : agreement_tolerance(expected().arm);
  }
  void expect_close(Complex actual, Complex wanted, double allowed, const std::string& what) const {
    EXPECT_LE(std::abs(actual - wanted), allowed * std::abs(wanted))
        << what << ": " << actual << " instead of " << wanted << ", relative "
        << std::abs(actual - wanted) / std::abs(wanted);
  }
};

TEST_P(EffectReference, PolesAndHubZeros) {
  const auto subject = model();
  const auto poles = response::poles(subject, kReferenceRoots);
  const auto zeros = response::zeros(subject, {SensorKind::hub_angle, 0.0}, kReferenceRoots);
  const double first = expected().pole_rad_per_s.front();
  EXPECT_NEAR(poles.lowest_omega_squared_rad2_per_s2, expected().lowest_omega_squared_rad2_per_s2,
              tolerance() * first * first);
  for (std::size_t i = 0; i < expected().pole_rad_per_s.size(); ++i) {
    expect_close(poles.omega_rad_per_s[i], expected().pole_rad_per_s[i], tolerance(),
                 "pole " + std::to_string(i + 1));
  }
  for (std::size_t i = 0; i < expected().hub_zero_rad_per_s.size(); ++i) {
    expect_close(zeros.s_rad_per_s[i], {0.0, expected().hub_zero_rad_per_s[i]}, tolerance(),
                 "hub zero " + std::to_string(i + 1));
  }
  EXPECT_NEAR(
      arm::total_inertia_kg_m2(arm::linear_arm(expected().arm)) / expected().total_inertia_kg_m2,
      1.0, 1e-14);
}

TEST_P(EffectReference, TipZeros) {
  std::vector<Complex> wanted;
  for (const double s : expected().real_tip_zero_rad_per_s) wanted.emplace_back(s, 0.0);
  for (const double s : expected().imaginary_tip_zero_rad_per_s) wanted.emplace_back(0.0, s);
  std::ranges::sort(wanted, {}, [](Complex s) { return std::abs(s); });
  wanted.resize(4);
  const auto zeros = response::zeros(model(), {SensorKind::tip_acceleration, 0.0}, 4);
  ASSERT_EQ(zeros.s_rad_per_s.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    expect_close(zeros.s_rad_per_s[i], wanted[i], tolerance(), "tip zero " + std::to_string(i + 1));
  }
}

TEST_P(EffectReference, ModeValues) {
  std::vector<Sensor> sensors;
  for (const auto& [name, value] : expected().mode_values.front()) {
    sensors.push_back(arm::parse_sensor(name));
  }
  const auto modes =
      response::modes(model(), static_cast<int>(expected().mode_values.size()), sensors, {});
  // A shape is stationary to first order where its frequency is to second.
  const double shape_tolerance = 10.0 * tolerance();
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const auto& wanted = expected().mode_values[i];
    expect_close(modes[i].hub_slope, wanted.at("hub_angle"), shape_tolerance, "hub slope");
    for (std::size_t k = 0; k < sensors.size(); ++k) {
      const std::string name = arm::to_string(sensors[k]);
      expect_close(modes[i].sensor_values[k], wanted.at(name), shape_tolerance,
                   "mode " + std::to_string(i + 1) + " " + name);
    }
  }
}

TEST_P(EffectReference, ResponsesWithDamping) {
  const auto subject = model();
  const double response_tolerance = 10.0 * tolerance();
  for (const auto& point : expected().responses) {
    for (const auto& [name, wanted] : point.values) {
      expect_close(response::transfer_function(subject, arm::parse_sensor(name), point.s_rad_per_s),
                   wanted, response_tolerance, name);
    }
  }
}

TEST_P(EffectReference, DampedPoles) {
  const auto& wanted = expected().damped_pole_rad_per_s;
  if (wanted.empty()) return;
  const auto pairs = response::damped_poles(model(), static_cast<int>(wanted.size()));
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    expect_close(pairs.flexible[i].first_rad_per_s, wanted[i], tolerance(),
                 "pair " + std::to_string(i + 1));
    expect_close(pairs.flexible[i].second_rad_per_s, std::conj(wanted[i]), tolerance(),
                 "pair " + std::to_string(i + 1));
  }
}

INSTANTIATE_TEST_SUITE_P(
    EveryFormulation, EffectReference,
    testing::Combine(testing::Range<std::size_t>(0, formulations().size()),
                     testing::Range<std::size_t>(0, reference::effect_cases().size())),
    [](const auto& each) {
      return std::string(formulations()[std::get<0>(each.param)].name) + "_" +
             reference::effect_cases()[std::get<1>(each.param)].name;
    });

}  // namespace
}  // namespace flexarm::laws
