// Stated intervals cover the truth as often as they say: the fixed part of
// benchmarks/modal_coverage.cpp, of data from the model that is fitted and of data from another
// one.
#include "tests/measured/coverage_study.hpp"
#include "tests/measured/unlike_coverage.hpp"

#include <boost/math/distributions/binomial.hpp>
#include <gtest/gtest.h>

namespace flexarm::measured {
namespace {

constexpr int kRuns = 20;
/// A quantity whose intervals cover in 95 of 100 fails this with a probability of 1e-5.
constexpr double kChance = 1e-5;

TEST(ModalCoverage, OfEveryPoleAndZeroIsWhatIntervalsSay) {
  FitCase fit_case;
  fit_case.relative_noise = 0.01;
  fit_case.duration_s = 20.0;
  CoverageStudy study(fit_case);
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) study.run(seed);
  const double least = boost::math::quantile(boost::math::binomial(kRuns, 0.95), kChance);
  double spread = 0.0;
  for (const Coverage& entry : study.coverage()) {
    EXPECT_EQ(entry.runs, kRuns) << entry.quantity;
    EXPECT_GE(entry.covered, least) << entry.quantity;
    spread += entry.sum_of_squares;
  }
  ASSERT_FALSE(study.coverage().empty());
  // Errors over standard errors have mean square 1; the quantities of a run hang together, so the
  // runs alone count: 1 +- 4 sqrt(2/runs).
  spread /= kRuns * static_cast<double>(study.coverage().size());
  EXPECT_NEAR(spread, 1.0, 4.0 * std::sqrt(2.0 / kRuns));
}

/// With modes beyond the band and beyond half the sampling frequency, that data do not show and
/// zeros hang on.
TEST(ModalCoverage, OfEachKindIsWhatIntervalsSayWithModesBeyondTheBand) {
  constexpr std::uint64_t kSeeds = 3;
  constexpr double kNoise = 0.005;
  UnlikeStudy study;
  for (std::size_t arm = 0; arm < 3; ++arm) {
    for (const Drive drive : {Drive::random, Drive::multisine}) {
      const UnlikeCase unlike(arm, drive, kNoise);
      for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) study.run(unlike, seed);
    }
  }
  for (const auto& [kind, coverage] : study.kinds()) {
    EXPECT_TRUE(coverage.is_as_stated(kChance))
        << kind << ": " << coverage.covered << " of " << coverage.stated;
  }
  EXPECT_GE(study.kinds().at("tip_acceleration real zero frequency").stated, 10);
  EXPECT_GE(study.kinds().at("hub_angle zero frequency").stated, 10);
}

}  // namespace
}  // namespace flexarm::measured
