#include "response/time/kalman_filter.hpp"

#include "arm/input_error.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <cmath>

namespace flexarm::response {
namespace {

/// The same by plain steps from sample to sample, in the form of Joseph, which stays symmetric.
FilterGain by_steps(const SampledSystem& system, int samples) {
  const auto n = system.transition.rows();
  const Eigen::MatrixXd r = system.reading_variances.asDiagonal();
  Eigen::MatrixXd p = system.process_covariance;
  FilterGain made;
  for (int k = 0; k < samples; ++k) {
    made.innovation_covariance = system.readings * p * system.readings.transpose() + r;
    made.gain = p * system.readings.transpose() * made.innovation_covariance.inverse();
    const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(n, n) - made.gain * system.readings;
    p = rest * p * rest.transpose() + made.gain * r * made.gain.transpose();
    p = system.transition * p * system.transition.transpose() + system.process_covariance;
  }
  return made;
}

/// A random walk that is read with noise: P^2 - Q P - Q R = 0 of the predicted variance P.
TEST(KalmanFilter, OfARandomWalkIsTheClosedForm) {
  constexpr double kQ = 0.3;
  constexpr double kR = 2.0;
  const SampledSystem system{Eigen::MatrixXd::Ones(1, 1), Eigen::MatrixXd::Ones(1, 1),
                             Eigen::MatrixXd::Constant(1, 1, kQ), Eigen::VectorXd::Constant(1, kR)};
  const double p = 0.5 * (kQ + std::sqrt(kQ * kQ + 4.0 * kQ * kR));
  const FilterGain filter = filter_gain(system);
  EXPECT_NEAR(filter.gain(0, 0), p / (p + kR), 1e-14);
  EXPECT_NEAR(filter.innovation_covariance(0, 0), p + kR, 1e-13);
}

SampledSystem sampled_oscillator(double kept) {
  const double c = std::cos(0.7);
  const double s = std::sin(0.7);
  SampledSystem system;
  system.transition = Eigen::MatrixXd::Zero(4, 4);
  system.transition.topLeftCorner(2, 2) << 1.0, 0.1, 0.0, 1.0;
  system.transition.block(2, 2, 2, 2) << 0.99 * c, 0.99 * s, -0.99 * s, 0.99 * c;
  system.transition *= kept;
  system.readings = Eigen::MatrixXd::Zero(2, 4);
  system.readings << 1.0, 0.0, 0.3, 0.1, 0.0, 0.0, 1.0, -0.4;
  Eigen::Vector4d driven(0.0, 1.0, 0.2, 0.5);
  system.process_covariance = 1e-3 * driven * driven.transpose();
  system.reading_variances = Eigen::Vector2d(1e-4, 1e-2);
  return system;
}

TEST(KalmanFilter, OfARigidBodyWithAModeIsWhatPlainStepsComeTo) {
  // Plain steps round some 1e-15 of the covariance per step; the gain forgets them.
  constexpr double kRounding = 1e-10;
  const SampledSystem system = sampled_oscillator(1.0);
  const FilterGain filter = filter_gain(system);
  const FilterGain steps = by_steps(system, 5000);
  EXPECT_LE((filter.gain - steps.gain).norm(), kRounding * steps.gain.norm());
  EXPECT_LE((filter.innovation_covariance - steps.innovation_covariance).norm(),
            kRounding * steps.innovation_covariance.norm());
}

TEST(KalmanFilter, OfWhatNoReadingShowsDoesNotEnterTheGain) {
  SampledSystem system = sampled_oscillator(1.0);
  const FilterGain whole = filter_gain(system);
  // A random walk beside it.
  const Eigen::Index n = 5;
  SampledSystem larger = system;
  larger.transition = Eigen::MatrixXd::Identity(n, n);
  larger.transition.topLeftCorner(4, 4) = system.transition;
  larger.readings = Eigen::MatrixXd::Zero(2, n);
  larger.readings.leftCols(4) = system.readings;
  larger.process_covariance = Eigen::MatrixXd::Identity(n, n);
  larger.process_covariance.topLeftCorner(4, 4) = system.process_covariance;
  const FilterGain filter = filter_gain(larger);
  EXPECT_LE((filter.gain.topRows(4) - whole.gain).norm(), 1e-10 * whole.gain.norm());
  EXPECT_LE(filter.gain.row(4).norm(), 1e-10);
}

TEST(KalmanFilter, RefusesReadingsWithoutNoise) {
  SampledSystem system = sampled_oscillator(1.0);
  system.reading_variances(1) = 0.0;
  EXPECT_THROW(filter_gain(system), arm::InputError);
}

}  // namespace
}  // namespace flexarm::response
