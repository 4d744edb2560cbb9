// Parts of the data for looks: long enough to show what is left of all of them.
#include "diagnose/search/coarse_problems.hpp"

#include "tests/diagnose/simulated_experiments.hpp"

#include <gtest/gtest.h>

namespace flexarm::diagnose {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

class LongerParts : public testing::Test {
 protected:
  /// In standard deviations: `before` up to a sample of each channel, then `behind`.
  VectorXd residuals(Index sample, double before, double behind) const {
    VectorXd made = VectorXd::Constant(problem_.residual_count(), behind);
    for (const ObservedChannel& channel : problem_.observations().channels) {
      made.segment(channel.first, std::min(sample, channel.count)).setConstant(before);
    }
    return made;
  }
  static Index samples(const Problem& part) { return part.observations().channels.front().count; }

  const Experiment experiment_ = simulated_experiment({}, {.duration_s = 4.0});
  const Problem problem_ = Problem(experiment_);
  const SelectionOptions options_ = {.coarse_samples = 400, .short_samples = 100};
  CoarseProblems parts_ = {problem_, options_};
};

TEST_F(LongerParts, StayWhereTheyShowWhatIsLeft) {
  EXPECT_FALSE(parts_.lengthen(problem_, residuals(0, 0.0, 5.0)));
  EXPECT_EQ(samples(parts_.coarse()), 400);
  EXPECT_EQ(samples(parts_.early()), 100);
}

TEST_F(LongerParts, DoubleUntilTheyShowWhatComesLate) {
  // The mean square beyond noise of 400 samples is 24/4, of 200 it is 0.
  EXPECT_TRUE(parts_.lengthen(problem_, residuals(300, 1.0, 5.0)));
  EXPECT_EQ(samples(parts_.coarse()), 400);
  EXPECT_EQ(samples(parts_.early()), 400);
  EXPECT_FALSE(parts_.is_early_shorter());
  EXPECT_TRUE(parts_.lengthen(problem_, residuals(700, 1.0, 5.0)));
  EXPECT_EQ(samples(parts_.coarse()), 800);
}

TEST_F(LongerParts, StayWhereNoiseIsLeft) {
  EXPECT_FALSE(parts_.lengthen(problem_, residuals(0, 0.0, 1.0)));
}

TEST_F(LongerParts, AreNoLongerThanTheMost) {
  const SelectionOptions bounded = {
      .coarse_samples = 400, .most_coarse_samples = 500, .short_samples = 100};
  CoarseProblems parts(problem_, bounded);
  EXPECT_TRUE(parts.lengthen(problem_, residuals(450, 1.0, 5.0)));
  EXPECT_EQ(samples(parts.early()), 400);
  EXPECT_EQ(samples(parts.coarse()), 400);
}

}  // namespace
}  // namespace flexarm::diagnose
