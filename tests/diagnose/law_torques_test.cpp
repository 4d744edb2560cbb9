#include "diagnose/search/law_torques.hpp"

#include "effects/registry/vocabulary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace flexarm::diagnose {
namespace {

constexpr double kFriction_N_m = 0.012;
constexpr double kStiffness_N_m_per_rad = 0.4;
constexpr double kPeriod_s = 0.02;

arm::HubLaw presliding_friction() {
  const auto [name, effect] = effects::named(
      "hub_hysteresis", {{"torque", kFriction_N_m}, {"stiffness", kStiffness_N_m_per_rad}});
  return effect.definition->hub_torque(effect);
}

/// Reverses every eight samples, mostly between two of them.
HubMotion swinging(double velocity_noise_rad_per_s) {
  HubMotion motion;
  motion.velocity_noise_rad_per_s = velocity_noise_rad_per_s;
  for (std::size_t k = 0; k < 60; ++k) {
    motion.time_s.push_back(kPeriod_s * static_cast<double>(k));
    motion.velocity_rad_per_s.push_back(0.3 * std::sin(20.0 * motion.time_s.back()));
    motion.torque_N_m.push_back(0.0);
    motion.angle_rad.push_back(0.0);
  }
  return motion;
}

/// Dahl's equation by small steps from midway between the first two samples, the velocity being
/// linear between samples and 0 below `rest`: friction midway to each next sample.
std::vector<double> integrated(const HubMotion& motion, double rest_rad_per_s) {
  constexpr int kSteps = 20000;
  std::vector<double> made = {0.0};
  double friction = 0.0;
  for (std::size_t k = 0; k + 2 < motion.time_s.size(); ++k) {
    for (int i = 0; i < kSteps; ++i) {
      const double part = 0.5 + (i + 0.5) / kSteps;  // of a period, from sample k on
      const std::size_t from = part < 1.0 ? k : k + 1;
      const auto& speed = motion.velocity_rad_per_s;
      double velocity = std::lerp(speed[from], speed[from + 1], part < 1.0 ? part : part - 1.0);
      if (std::abs(velocity) < rest_rad_per_s) velocity = 0.0;
      const double sign = velocity < 0.0 ? -1.0 : 1.0;
      friction += kStiffness_N_m_per_rad * (1.0 - sign * friction / kFriction_N_m) * velocity *
                  kPeriod_s / kSteps;
    }
    made.push_back(-friction);
  }
  return made;
}

void expect_follows(double velocity_noise_rad_per_s) {
  constexpr double kEuler = 1e-4;  // of order 1 in the step
  const HubMotion motion = swinging(velocity_noise_rad_per_s);
  const auto made = torques_of(presliding_friction(), {motion}).front();
  const auto expected = integrated(motion, kNoiseOfRest * velocity_noise_rad_per_s);
  ASSERT_EQ(made.size(), motion.time_s.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_NEAR(made[k], expected[k], kEuler * kFriction_N_m) << k;
  }
  EXPECT_GT(std::abs(made[10]), 0.1 * kFriction_N_m);
}

TEST(LawTorques, OfPreslidingFrictionFollowTheMeasuredMotion) {
  expect_follows(0.0);
}

TEST(LawTorques, OfPreslidingFrictionRestWhereTheVelocityIsNoise) {
  expect_follows(0.04);
}

}  // namespace
}  // namespace flexarm::diagnose
