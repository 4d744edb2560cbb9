#include "diagnose/search/residual_test.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::diagnose {
namespace {

constexpr Eigen::Index kCount = 2000;
constexpr double kNoise = 0.01;  // of the signal

/// A run of one kind with so many channels of kCount numbers each.
struct Channels {
  Experiment experiment;
  Observations observations;
  std::vector<bool> runs = {true};

  Channels(measured::RunKind kind, int channels, double noise = kNoise) {
    measured::MeasuredRun run;
    run.run.kind = kind;
    experiment.runs.push_back(run);
    for (int c = 0; c < channels; ++c) {
      observations.channels.push_back(
          {.sensor = std::to_string(c), .first = c * kCount, .count = kCount, .noise = noise});
    }
    observations.values = Eigen::VectorXd::Zero(channels * kCount);
  }

  ResidualTest test(const Eigen::VectorXd& residuals) const {
    return test_residuals(observations, experiment, residuals, runs);
  }
};

/// First-order autoregressive residuals of variance 1.
Eigen::VectorXd residuals(Eigen::Index count, double correlation, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  Eigen::VectorXd made(count);
  double last = normal(engine);
  for (double& value : made) {
    value = last;
    last = correlation * last + std::sqrt(1.0 - correlation * correlation) * normal(engine);
  }
  return made;
}

TEST(Exceedance, OfValuesFarBelowTheMeanIsOne) {
  for (const double n : {100.0, 4000.0, 9999.0, 1e5}) {
    for (const double lambda : {0.0, 10.0, 0.5 * n}) {
      EXPECT_EQ(exceedance(0.0, n, lambda), 1.0);
      EXPECT_EQ(exceedance(1e-10, n, lambda), 1.0) << n;
      // Where the distribution itself is evaluated: P(chi^2_100 < 70) = 0.01.
      EXPECT_NEAR(exceedance(0.7 * n, n, lambda), 1.0, 0.02) << n;
    }
  }
}

TEST(ResidualTest, AcceptsNoise) {
  // At the level 0.001 a rejection in 200 has probability 0.2; more than two 0.001.
  const Channels channels(measured::RunKind::frf, 4);
  int rejected = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    if (!channels.test(residuals(4 * kCount, 0.0, seed)).is_noise()) ++rejected;
  }
  EXPECT_LE(rejected, 2);
}

TEST(ResidualTest, RejectsColouredResidualsOfTheRightLevel) {
  // More colour in time, where some is granted.
  for (const auto& [kind, correlation] :
       {std::pair(measured::RunKind::frf, 0.5), std::pair(measured::RunKind::time, 0.8)}) {
    const ResidualTest found = Channels(kind, 1).test(residuals(kCount, correlation, 1));
    EXPECT_LT(found.whiteness_p_value, kResidualLevel);
    EXPECT_GE(found.level_p_value, kResidualLevel);
    EXPECT_FALSE(found.is_noise());
  }
}

TEST(ResidualTest, RejectsTwiceTheNoise) {
  // 1.78 % of the signal where noise makes 1 %.
  const ResidualTest found =
      Channels(measured::RunKind::time, 1).test(1.78 * residuals(kCount, 0.0, 1));
  EXPECT_LT(found.level_p_value, kResidualLevel);
  EXPECT_GE(found.whiteness_p_value, kResidualLevel);
}

TEST(ResidualTest, GrantsASimulationInTimeItsErrorAndAResponseNone) {
  // As large an error as is granted, of the form of a decaying oscillation's first part.
  constexpr double kFine = 0.004;  // noise as large as the error
  Eigen::VectorXd error(kCount);
  for (Eigen::Index k = 0; k < kCount; ++k) error(k) = std::sin(0.1 * static_cast<double>(k));
  error *= kSimulationError / kFine * std::sqrt(2.0);
  const Eigen::VectorXd all = residuals(kCount, 0.0, 1) + 0.9 * error;
  EXPECT_TRUE(Channels(measured::RunKind::time, 1, kFine).test(all).is_noise());
  EXPECT_FALSE(Channels(measured::RunKind::frf, 1, kFine).test(all).is_noise());
  EXPECT_FALSE(Channels(measured::RunKind::time, 1, 10.0 * kFine).test(all).is_noise());
}

TEST(ResidualTest, RejectsUncertainNumbersFarFromTheirs) {
  const Channels channels(measured::RunKind::time, 1);
  Eigen::VectorXd all(kCount + 1);
  all << residuals(kCount, 0.0, 1), 2.0;
  EXPECT_TRUE(channels.test(all).is_noise());
  all(kCount) = 6.0;
  EXPECT_LT(channels.test(all).nuisance_p_value, kResidualLevel);
}

TEST(ResidualTest, FindsOneChannelAmongMany) {
  const Channels channels(measured::RunKind::time, 20);
  Eigen::VectorXd all = residuals(20 * kCount, 0.0, 1);
  all.segment(3 * kCount, kCount) *= 1.6;
  EXPECT_LT(channels.test(all).level_p_value, kResidualLevel);
}

}  // namespace
}  // namespace flexarm::diagnose
