#include "arm/linear_arm.hpp"
#include "effects/registry/vocabulary.hpp"
#include "laws/effect_arms.hpp"
#include "laws/subjects.hpp"
#include "response/any_formulation.hpp"
#include "response/settings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace flexarm::laws {
namespace {

using arm::Sensor;
using arm::SensorKind;
using Complex = std::complex<double>;
using response::AnyFormulation;

constexpr int kComparedRoots = 10;
/// The tip's real zeros lose 1.5 digits each in coordinates that span the link
/// (assumed_modes/assumed_modes_arm.hpp).
constexpr int kTipZeros = 4;
constexpr std::array kSensors = {kHubAngle, kTipAcceleration,
                                 Sensor{SensorKind::tip_deflection, 0.0},
                                 Sensor{SensorKind::strain, 0.05}};

std::vector<AnyFormulation> formulations(const arm::Arm& arm) {
  return {exact_tf::ExactArm(arm), fem::FemArm(arm, response::fem_settings(kComparedRoots)),
          assumed_modes::AssumedModesArm(arm, response::assumed_modes_settings(kComparedRoots))};
}

void expect_close(Complex actual, Complex expected, double tolerance, const std::string& what) {
  EXPECT_LE(std::abs(actual - expected), tolerance * std::abs(expected))
      << what << ": " << actual << " beside " << expected << ", relative "
      << std::abs(actual - expected) / std::abs(expected);
}

class EffectAgreement : public testing::TestWithParam<EffectArm> {
 protected:
  const arm::Arm& arm() const { return GetParam().arm; }
  double tolerance() const { return agreement_tolerance(arm()); }
};

TEST_P(EffectAgreement, PolesAndZeros) {
  const auto models = formulations(arm());
  const auto poles = response::poles(models[0], kComparedRoots);
  const auto hub_zeros = response::zeros(models[0], kHubAngle, kComparedRoots);
  const auto tip_zeros = response::zeros(models[0], kTipAcceleration, kTipZeros);
  ASSERT_EQ(poles.omega_rad_per_s.size(), static_cast<std::size_t>(kComparedRoots));
  EXPECT_EQ(poles.count.found, poles.count.expected);
  const double omega_squared = poles.omega_rad_per_s[0] * poles.omega_rad_per_s[0];
  for (std::size_t m = 1; m < models.size(); ++m) {
    const std::string name(response::name(models[m]));
    const auto others = response::poles(models[m], kComparedRoots);
    EXPECT_NEAR(others.lowest_omega_squared_rad2_per_s2, poles.lowest_omega_squared_rad2_per_s2,
                tolerance() * omega_squared)
        << name;
    ASSERT_EQ(others.omega_rad_per_s.size(), poles.omega_rad_per_s.size()) << name;
    const auto other_hub_zeros = response::zeros(models[m], kHubAngle, kComparedRoots);
    ASSERT_EQ(other_hub_zeros.s_rad_per_s.size(), hub_zeros.s_rad_per_s.size()) << name;
    for (std::size_t i = 0; i < poles.omega_rad_per_s.size(); ++i) {
      expect_close(others.omega_rad_per_s[i], poles.omega_rad_per_s[i], tolerance(),
                   name + " pole " + std::to_string(i + 1));
      expect_close(other_hub_zeros.s_rad_per_s[i], hub_zeros.s_rad_per_s[i], tolerance(),
                   name + " hub zero " + std::to_string(i + 1));
    }
    const auto other_tip_zeros = response::zeros(models[m], kTipAcceleration, kTipZeros);
    ASSERT_EQ(other_tip_zeros.s_rad_per_s.size(), tip_zeros.s_rad_per_s.size()) << name;
    for (std::size_t i = 0; i < tip_zeros.s_rad_per_s.size(); ++i) {
      expect_close(other_tip_zeros.s_rad_per_s[i], tip_zeros.s_rad_per_s[i], tolerance(),
                   name + " tip zero " + std::to_string(i + 1));
    }
  }
}

TEST_P(EffectAgreement, ModesAndHowDampingCouplesThem) {
  constexpr int kModes = 5;
  const double length_m = arm::linear_arm(arm()).length_m;
  const std::vector<double> stations_m = {0.0, 0.2, 0.6, length_m};
  const auto models = formulations(arm());
  const auto first = response::modal_model(models[0], kModes, kSensors, stations_m);
  ASSERT_EQ(first.modes.size(), static_cast<std::size_t>(kModes) + 1);
  ASSERT_EQ(first.damping_rad_per_s.size(), first.modes.size() * first.modes.size());
  // A shape is stationary to first order where its frequency is to second: half the digits.
  const double shape_tolerance = 10.0 * tolerance();
  double largest_damping = 0.0;
  for (const double d : first.damping_rad_per_s) {
    largest_damping = std::max(largest_damping, std::abs(d));
  }
  for (std::size_t m = 1; m < models.size(); ++m) {
    const std::string name(response::name(models[m]));
    const auto other = response::modal_model(models[m], kModes, kSensors, stations_m);
    EXPECT_NEAR(other.modal_mass_kg_m2 / first.modal_mass_kg_m2, 1.0, 1e-13);
    for (std::size_t i = 0; i < first.modes.size(); ++i) {
      const std::string which = name + " mode " + std::to_string(i);
      const arm::Mode& a = first.modes[i];
      const arm::Mode& b = other.modes[i];
      expect_close(b.hub_slope, a.hub_slope, shape_tolerance, which + " hub slope");
      ASSERT_EQ(b.sensor_values.size(), a.sensor_values.size());
      for (std::size_t k = 0; k < a.sensor_values.size(); ++k) {
        // The lowest mode of a free arm does not bend: its strain is rounding.
        const double size =
            std::max(std::abs(a.sensor_values[k]), std::abs(first.modes[1].sensor_values[k]));
        EXPECT_NEAR(b.sensor_values[k], a.sensor_values[k], shape_tolerance * size)
            << which << " " << arm::to_string(kSensors[k]);
      }
      for (std::size_t k = 0; k < stations_m.size(); ++k) {
        EXPECT_NEAR(b.displacement_m[k], a.displacement_m[k], shape_tolerance * length_m)
            << which << " at " << stations_m[k] << " m";
      }
    }
    for (std::size_t k = 0; k < first.damping_rad_per_s.size(); ++k) {
      EXPECT_NEAR(other.damping_rad_per_s[k], first.damping_rad_per_s[k],
                  shape_tolerance * largest_damping)
          << name << " D(" << k / first.modes.size() << ", " << k % first.modes.size() << ")";
    }
  }
}

TEST_P(EffectAgreement, DampedPoles) {
  constexpr int kPairs = 6;
  const auto models = formulations(arm());
  const auto first = response::damped_poles(models[0], kPairs);
  ASSERT_EQ(first.flexible.size(), static_cast<std::size_t>(kPairs));
  const double size = std::abs(first.flexible[0].first_rad_per_s);
  for (std::size_t m = 0; m < models.size(); ++m) {
    const std::string name(response::name(models[m]));
    const auto other = response::damped_poles(models[m], kPairs);
    EXPECT_TRUE(other.summary.converged) << name;
    EXPECT_LE(std::abs(other.lowest.first_rad_per_s - first.lowest.first_rad_per_s),
              tolerance() * size)
        << name;
    EXPECT_LE(std::abs(other.lowest.second_rad_per_s - first.lowest.second_rad_per_s),
              tolerance() * size)
        << name;
    ASSERT_EQ(other.flexible.size(), first.flexible.size()) << name;
    for (std::size_t i = 0; i < first.flexible.size(); ++i) {
      const std::string which = name + " pair " + std::to_string(i + 1);
      expect_close(other.flexible[i].first_rad_per_s, first.flexible[i].first_rad_per_s,
                   tolerance(), which);
      expect_close(other.flexible[i].second_rad_per_s, first.flexible[i].second_rad_per_s,
                   tolerance(), which);
    }
  }
}

TEST_P(EffectAgreement, TransferFunctions) {
  const auto models = formulations(arm());
  // The response moves more than its poles and zeros where it is small: some powers of ten over
  // the distance to the next root.
  const double response_tolerance = 10.0 * tolerance();
  for (const Complex s : {Complex(0.0, 3.0), Complex(-2.0, 95.0), Complex(5.0, 700.0)}) {
    for (const Sensor& sensor : kSensors) {
      const Complex expected = response::transfer_function(models[0], sensor, s);
      for (std::size_t m = 1; m < models.size(); ++m) {
        expect_close(response::transfer_function(models[m], sensor, s), expected,
                     response_tolerance,
                     std::string(response::name(models[m])) + " " + arm::to_string(sensor));
      }
    }
  }
}

std::vector<EffectArm> effect_arms() {
  auto arms = arms_with_one_effect();
  const auto pairs = arms_with_two_effects();
  arms.insert(arms.end(), pairs.begin(), pairs.end());
  arms.push_back(arm_with_every_effect());
  return arms;
}

INSTANTIATE_TEST_SUITE_P(EveryEffectAndPair, EffectAgreement, testing::ValuesIn(effect_arms()),
                         [](const auto& each) { return each.param.name; });

TEST(EffectArms, CoverEveryLinearEffectAndEveryPair) {
  std::set<std::string> names;
  for (const auto& each : arms_with_one_effect()) names.insert(each.name);
  const auto linear =
      std::ranges::count_if(effects::vocabulary(), &arm::EffectDefinition::is_of_linear_arm,
                            [](const auto& definition) { return *definition; });
  EXPECT_EQ(std::ssize(names), linear);
  constexpr int kExclusive = 1;
  EXPECT_EQ(std::ssize(arms_with_two_effects()), linear * (linear - 1) / 2 - kExclusive);
}

}  // namespace
}  // namespace flexarm::laws
