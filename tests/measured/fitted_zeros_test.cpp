// Zeros of a rational function against those it was made of.
#include "measured/modal/fitted_zeros.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace flexarm::measured {
namespace {

constexpr double kPi = std::numbers::pi;
/// QZ on pencils of a dozen rows, then Newton's method: rounding.
constexpr double kZeroRounding = 1e-12;

FittedTransfer transfer_of(const char* sensor, const BlockSet& set, const Eigen::VectorXd& beta,
                           bool remainder) {
  // A frequency response has the remainder, a run in time for displacements only.
  FrequencyChannel channel{arm::parse_sensor(sensor), {1.0}, {1.0}, {1.0}};
  const Stretch stretch = frequency_stretch(channel, 0, {1.0});
  const SensorModel model = sensor_model(channel.sensor, 0, set, std::span(&stretch, 1),
                                         {.static_remainder = remainder, .offset = false});
  EXPECT_EQ(model.shared, beta.size());
  return {set, model, beta};
}

TEST(FittedZeros, OfTwoBlocksAreThoseOfTheirSum) {
  // 1/s^2 + 2/(s^2 + 900): zeros at 3 s^2 + 900 = 0.
  const BlockSet set{{{0.0, 0.0}, {0.0, 900.0}}, true};
  Eigen::VectorXd beta(4);
  beta << 1.0, 0.0, 2.0, 0.0;
  const auto zeros = fitted_zeros(transfer_of("hub_angle", set, beta, false),
                                  Eigen::MatrixXd::Zero(7, 7), 0.0, 2.0);
  ASSERT_EQ(zeros.size(), 1U);
  EXPECT_NEAR(zeros[0].frequency_Hz, std::sqrt(300.0) / (2.0 * kPi), kZeroRounding);
  EXPECT_NEAR(zeros[0].damping_ratio, 0.0, kZeroRounding);
  EXPECT_FALSE(zeros[0].in_band);
}

TEST(FittedZeros, OnTheRealAxisAreToldApartBySign) {
  // 1/s^2 - 2/(s^2 + 900): 900 - s^2 = 0.
  const BlockSet set{{{0.0, 0.0}, {0.0, 900.0}}, true};
  Eigen::VectorXd beta(4);
  beta << 1.0, 0.0, -2.0, 0.0;
  const auto zeros = fitted_zeros(transfer_of("tip_displacement", set, beta, false),
                                  Eigen::MatrixXd::Zero(7, 7), 0.0, 100.0);
  ASSERT_EQ(zeros.size(), 2U);
  EXPECT_NEAR(zeros[0].frequency_Hz, 30.0 / (2.0 * kPi), kZeroRounding);
  EXPECT_NEAR(zeros[0].damping_ratio + zeros[1].damping_ratio, 0.0, kZeroRounding);
  EXPECT_NEAR(std::abs(zeros[0].damping_ratio), 1.0, kZeroRounding);
}

TEST(FittedZeros, OfAVelocityWithARemainderAreRootsOfTheTransferFunction) {
  const BlockSet set{{{0.4, 0.0}, block_of(70.0, 0.02), block_of(200.0, 0.05)}, true};
  Eigen::VectorXd beta(6);
  beta << 20.0, 0.3, 60.0, -0.2, 90.0, 1e-3;
  const FittedTransfer transfer = transfer_of("hub_velocity", set, beta, true);
  const auto zeros = fitted_zeros(transfer, Eigen::MatrixXd::Zero(11, 11), 0.0, 100.0);
  // Five poles and a remainder in s: as many zeros as degree 6, in conjugate pairs or real.
  std::size_t degree = 0;
  for (const FittedZero& zero : zeros) {
    degree += zero.s_rad_per_s.imag() > 0.0 ? 2U : 1U;
    const double scale = std::abs(transfer.s_derivative(zero.s_rad_per_s) * zero.s_rad_per_s);
    EXPECT_LT(std::abs(transfer.value(zero.s_rad_per_s)), kZeroRounding * scale);
  }
  EXPECT_EQ(degree, 6U);
}

TEST(FittedZeros, HaveTheStandardErrorsThatDifferencesHave) {
  const BlockSet set{{{0.4, 0.0}, block_of(70.0, 0.02), block_of(200.0, 0.05)}, true};
  Eigen::VectorXd beta(5);
  beta << 20.0, 0.3, 60.0, -0.2, 90.0;
  const FittedTransfer transfer = transfer_of("tip_acceleration", set, beta, false);
  const Eigen::Index n = transfer.parameters();
  for (Eigen::Index i = 0; i < n; ++i) {
    constexpr double kStep = 1e-6;  // of the parameter's size: errors step^2 and rounding/step
    constexpr double kDifference = 1e-6;
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(n, n);
    covariance(i, i) = 1.0;
    const auto zeros = fitted_zeros(transfer, covariance, 0.0, 100.0);
    ASSERT_FALSE(zeros.empty());
    const double step = kStep * std::max(1.0, std::abs(transfer.values()(i)));
    Eigen::VectorXd moved = transfer.values();
    moved(i) += step;
    const auto above = fitted_zeros(transfer.with(moved), covariance, 0.0, 100.0);
    moved(i) -= 2.0 * step;
    const auto below = fitted_zeros(transfer.with(moved), covariance, 0.0, 100.0);
    ASSERT_EQ(above.size(), zeros.size());
    for (std::size_t k = 0; k < zeros.size(); ++k) {
      const double frequency =
          std::abs(above[k].frequency_Hz - below[k].frequency_Hz) / (2.0 * step);
      const double damping =
          std::abs(above[k].damping_ratio - below[k].damping_ratio) / (2.0 * step);
      EXPECT_NEAR(zeros[k].frequency_std_Hz, frequency,
                  kDifference * std::max(1.0, zeros[k].frequency_std_Hz));
      EXPECT_NEAR(zeros[k].damping_ratio_std, damping, kDifference);
    }
  }
}

TEST(FittedZeros, AreToldWhereTheirErrorIsSmallBesideThePoles) {
  // 1/s^2 + b/(s^2 + 900): a zero at 900/(1 + b), 0.15 rad/s off the pole for b = 0.01.
  const BlockSet set{{{0.0, 0.0}, {0.0, 900.0}}, true};
  Eigen::VectorXd beta(4);
  beta << 1.0, 0.0, 0.01, 0.0;
  const auto transfer = transfer_of("hub_angle", set, beta, false);
  // d omega/d b = -15 rad/s there: an error of b of 0.001 is a tenth of the distance.
  for (const auto& [deviation, told] : {std::pair{0.001, true}, std::pair{0.01, false}}) {
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(7, 7);
    covariance(5, 5) = deviation * deviation;
    const auto zeros = fitted_zeros(transfer, covariance, 0.0, 10.0);
    ASSERT_EQ(zeros.size(), 1U);
    EXPECT_NEAR(2.0 * kPi * zeros[0].frequency_std_Hz, 15.0 * deviation, 0.5 * deviation);
    EXPECT_EQ(zeros[0].is_told, told);
  }
}

}  // namespace
}  // namespace flexarm::measured
