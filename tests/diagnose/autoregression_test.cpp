#include "diagnose/autoregression.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

namespace flexarm::diagnose {
namespace {

using Eigen::Index;

/// x_n = 1.5 x_{n-1} - 0.8 x_{n-2} + e_n, of variance 1: by its autocorrelations r_1 = 1.5/1.8 and
/// r_2 = 1.5 r_1 - 0.8 the variance of e is 1 - 1.5 r_1 + 0.8 r_2.
Eigen::VectorXd resonant_noise(Index count, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  const double r_1 = 1.5 / 1.8;
  const double r_2 = 1.5 * r_1 - 0.8;
  const double innovation = std::sqrt(1.0 - 1.5 * r_1 + 0.8 * r_2);
  Eigen::VectorXd made(count);
  made(0) = normal(engine);
  made(1) = r_1 * made(0) + std::sqrt(1.0 - r_1 * r_1) * normal(engine);
  for (Index k = 2; k < count; ++k) {
    made(k) = 1.5 * made(k - 1) - 0.8 * made(k - 2) + innovation * normal(engine);
  }
  return made;
}

double correlation(const Eigen::VectorXd& values, Index lag) {
  const Index rest = values.size() - lag;
  return values.head(rest).dot(values.tail(rest)) / values.squaredNorm();
}

constexpr Index kNoiseLength = 4000;
/// A correlation of independent numbers varies by 1/sqrt(n); five standard deviations.
const double kCorrelationOfNone = 5.0 / std::sqrt(static_cast<double>(kNoiseLength));

TEST(Autoregression, LeavesIndependentNumbersOfUnitVariance) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Eigen::VectorXd values = resonant_noise(kNoiseLength, seed);
    const Autoregression noise(values, 20);
    EXPECT_GE(noise.order(), 2) << seed;
    EXPECT_GT(correlation(values, 1), 0.8) << seed;
    noise.whiten(values);
    // The root mean square of n normal numbers varies by 1/sqrt(2 n); five standard deviations.
    EXPECT_NEAR(values.norm() / std::sqrt(kNoiseLength), 1.0, 5.0 / std::sqrt(2.0 * kNoiseLength))
        << seed;
    for (Index lag = 1; lag <= 10; ++lag) {
      EXPECT_NEAR(correlation(values, lag), 0.0, kCorrelationOfNone) << seed << ", lag " << lag;
    }
  }
}

TEST(Autoregression, PredictsFromTheTwoNumbersBefore) {
  // The answer to a single number: 1, -a_1, -a_2 over the deviation of the innovations.
  const Autoregression noise(resonant_noise(kNoiseLength, 3), 2);
  ASSERT_EQ(noise.order(), 2);
  Eigen::VectorXd pulse = Eigen::VectorXd::Zero(6);
  pulse(2) = 1.0;
  noise.whiten(pulse);
  // Coefficients of so many numbers vary by sqrt((1 - a_2^2)/n) = 0.01 (Box & Jenkins).
  constexpr double kCoefficient = 0.05;
  EXPECT_NEAR(pulse(3) / pulse(2), -1.5, kCoefficient);
  EXPECT_NEAR(pulse(4) / pulse(2), 0.8, kCoefficient);
  EXPECT_EQ(pulse(5), 0.0);
}

TEST(Autoregression, OfWhiteNoiseChangesLittle) {
  std::mt19937_64 engine(8);
  std::normal_distribution<double> normal;
  Eigen::VectorXd values =
      Eigen::VectorXd::NullaryExpr(kNoiseLength, [&] { return normal(engine); });
  const Eigen::VectorXd before = values;
  const Autoregression noise(values, 20);
  noise.whiten(values);
  // Each order that the criterion takes in error moves the values by about 1/sqrt(n) of themselves.
  EXPECT_LT((values - before).norm() / before.norm(), 0.1);
}

TEST(Autoregression, ColouringUndoesWhitening) {
  const Eigen::VectorXd values = resonant_noise(300, 4);
  const Autoregression noise(values, 20);
  Eigen::VectorXd there_and_back = values;
  noise.whiten(there_and_back);
  noise.colour(there_and_back);
  // A recursion of 300 steps whose poles are inside the unit circle.
  EXPECT_LT((there_and_back - values).norm() / values.norm(), 1e-12);
}

TEST(Autoregression, HasThePowerOfItsAnswerToAPulse) {
  const Autoregression noise(resonant_noise(kNoiseLength, 5), 4);
  ASSERT_GE(noise.order(), 2);
  // By the time of the last sample 0.9^300 of it is left.
  constexpr Index kPulse = 300;
  Eigen::VectorXd pulse = Eigen::VectorXd::Zero(noise.order() + kPulse);
  pulse(noise.order()) = 1.0;
  noise.colour(pulse);
  constexpr Index kFrequencies = 4096;
  double mean = 0.0;
  for (Index k = 0; k < kFrequencies; ++k) {
    const double frequency = static_cast<double>(k) / kFrequencies;
    const double power = noise.power(frequency);
    mean += power / kFrequencies;
    if (k % 512 != 0) continue;
    std::complex<double> sum = 0.0;
    for (Index m = 0; m < kPulse; ++m) {
      const double angle = -2.0 * std::numbers::pi * frequency * static_cast<double>(m);
      sum += pulse(noise.order() + m) * std::polar(1.0, angle);
    }
    EXPECT_NEAR(std::norm(sum) / power, 1.0, 1e-9) << frequency;
  }
  EXPECT_NEAR(mean, 1.0, 1e-9);
}

TEST(Autoregression, OfASlowDriftStaysStable) {
  Eigen::VectorXd drift = Eigen::VectorXd::LinSpaced(500, 0.0, 1.0);
  drift *= std::sqrt(500.0) / drift.norm();
  const Autoregression noise(drift, 20);
  Eigen::VectorXd pulse = Eigen::VectorXd::Zero(500);
  pulse(0) = 1.0;
  noise.colour(pulse);
  EXPECT_TRUE(pulse.allFinite());
  EXPECT_LT(pulse.cwiseAbs().maxCoeff(), 10.0);
}

TEST(Autoregression, OfNothingIsWhite) {
  EXPECT_EQ(Autoregression(Eigen::VectorXd::Zero(100), 20).order(), 0);
  EXPECT_EQ(Autoregression(Eigen::VectorXd::Ones(3), 20).order(), 0);
}

/// The likelihood of Gaussian noise of covariance R = (W^T W)^-1, W its whitening, by the numbers
/// that are known, e_o: e_o^T R_oo^-1 e_o, and the most likely others R_mo R_oo^-1 e_o.
TEST(Autoregression, TakesNumbersThatAreNotKnownForTheMostLikely) {
  constexpr Index kCount = 60;
  constexpr double kRounding = 1e-9;  // of matrices of condition 1e4 and less
  const Autoregression noise(resonant_noise(kNoiseLength, 3), 5);
  ASSERT_GE(noise.order(), 2);
  const std::vector<std::size_t> left_out = {0, 1, 17, 19, 20, 21, 40, 58, 59};
  std::vector<Index> missing;
  std::vector<Index> known;
  for (Index k = 0; k < kCount; ++k) {
    const bool is_missing = std::ranges::count(left_out, static_cast<std::size_t>(k)) > 0;
    (is_missing ? missing : known).push_back(k);
  }
  Eigen::MatrixXd whitening = Eigen::MatrixXd::Identity(kCount, kCount);
  for (Index k = 0; k < kCount; ++k) noise.whiten(whitening.col(k));
  const Eigen::MatrixXd covariance = (whitening.transpose() * whitening).inverse();
  const Eigen::MatrixXd own = covariance(known, known);
  const Eigen::VectorXd values = resonant_noise(kCount, 4);
  const Eigen::VectorXd solved = own.llt().solve(Eigen::VectorXd(values(known)));

  Eigen::VectorXd whitened = values;
  whitened(missing).setConstant(100.0);
  Eigen::VectorXd filled = whitened;
  noise.whiten(whitened, left_out);
  EXPECT_NEAR(whitened.squaredNorm(), values(known).dot(solved), kRounding);
  noise.fill(filled, left_out);
  EXPECT_LE((filled(missing) - covariance(missing, known) * solved).norm(), kRounding);
  EXPECT_EQ(Eigen::VectorXd(filled(known)), Eigen::VectorXd(values(known)));
  noise.colour(whitened);
  EXPECT_LE((whitened - filled).norm(), kRounding);
}

TEST(Autoregression, FillsFromNumbersAlone) {
  const Eigen::VectorXd values = resonant_noise(kNoiseLength, 6);
  Eigen::VectorXd filled = values;
  std::vector<std::size_t> left_out;
  for (std::size_t k = 7; k < static_cast<std::size_t>(kNoiseLength); k += 50) {
    left_out.push_back(k);
    filled(static_cast<Index>(k)) = 100.0;
  }
  fill_by_autoregression(filled, left_out, 20);
  // Both sides known the variance is that of the innovations over 1 + 1.5^2 + 0.8^2.
  const double r_1 = 1.5 / 1.8;
  const double innovation = 1.0 - 1.5 * r_1 + 0.8 * (1.5 * r_1 - 0.8);
  const double variance = innovation / (1.0 + 1.5 * 1.5 + 0.8 * 0.8);
  const auto count = static_cast<double>(left_out.size());
  // Of a mean square of `count` numbers; four standard deviations.
  EXPECT_LT((filled - values).squaredNorm() / count,
            variance * (1.0 + 4.0 * std::sqrt(2.0 / count)));
}

}  // namespace
}  // namespace flexarm::diagnose
