#include "measured/checks/run_check_unpredicted.hpp"
#include "response/time/random_numbers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace flexarm::measured {
namespace {

using response::RandomNumbers;
using Values = std::vector<Eigen::VectorXd>;

constexpr Eigen::Index kSamples = 2000;
const std::vector<bool> kAllUsable{true, true, true};

/// A resonance at a fifth of the sampling frequency, of standard deviation 1.
Eigen::VectorXd resonance(const Eigen::VectorXd& force) {
  constexpr double kPoleRadius = 0.95;
  constexpr double kPoleAngle_rad = 0.4 * std::numbers::pi;
  Eigen::VectorXd motion = Eigen::VectorXd::Zero(force.size());
  for (Eigen::Index k = 2; k < force.size(); ++k) {
    motion[k] = 2.0 * kPoleRadius * std::cos(kPoleAngle_rad) * motion[k - 1] -
                kPoleRadius * kPoleRadius * motion[k - 2] + force[k];
  }
  return motion / std::sqrt(motion.squaredNorm() / static_cast<double>(motion.size()));
}

Eigen::VectorXd white(RandomNumbers& random) {
  Eigen::VectorXd values(kSamples);
  for (double& value : values) value = random.normal();
  return values;
}

/// Torque, and two sensors of the motion that it makes, the second of its change.
Values torque_and_motion(RandomNumbers& random) {
  Values values{white(random)};
  values.push_back(resonance(values[0]));
  Eigen::VectorXd change = Eigen::VectorXd::Zero(kSamples);
  change.tail(kSamples - 1) = values[1].tail(kSamples - 1) - values[1].head(kSamples - 1);
  values.push_back(change);
  return values;
}

TEST(UnpredictedNoise, WhiteNoiseBesideStrongerMotionIsCertain) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    RandomNumbers random(seed);
    Values values = torque_and_motion(random);
    constexpr double kNoise = 0.05;
    values[1] += kNoise * white(random);
    const auto found = unpredicted_noise(values, 1, kAllUsable);
    // Four standard errors of 1/sqrt(2 n), and the noise that is predicted from itself.
    EXPECT_NEAR(found.most, kNoise, 0.1 * kNoise) << seed;
    EXPECT_NEAR(found.certain, kNoise, 0.2 * kNoise) << seed;
  }
}

TEST(UnpredictedNoise, MotionUnderAForceThatIsNotRecordedIsNotCertain) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    RandomNumbers random(seed);
    Values values = torque_and_motion(random);
    values[1] += resonance(white(random));
    const auto found = unpredicted_noise(values, 1, kAllUsable);
    EXPECT_GT(found.most, 0.1) << seed;
    EXPECT_EQ(found.certain, 0.0) << seed;
  }
}

TEST(UnpredictedNoise, BurstsAreNotCertain) {
  constexpr double kNoise = 0.05;
  RandomNumbers random(1);
  Values values = torque_and_motion(random);
  values[1] += kNoise * white(random);
  for (Eigen::Index k = 25; k < kSamples; k += 50) values[1][k] += 10.0 * kNoise * random.normal();
  EXPECT_EQ(unpredicted_noise(values, 1, kAllUsable).certain, 0.0);
}

TEST(UnpredictedNoise, AShortRecordSaysNothing) {
  RandomNumbers random(1);
  Values values = torque_and_motion(random);
  for (auto& signal : values) signal.conservativeResize(100);
  const auto found = unpredicted_noise(values, 1, kAllUsable);
  EXPECT_TRUE(std::isinf(found.most));
  EXPECT_EQ(found.certain, 0.0);
}

}  // namespace
}  // namespace flexarm::measured
