#include "diagnose/search/misfit.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace flexarm::diagnose {
namespace {

Misfit misfit_of(double per_number, double count, double independent) {
  Misfit made;
  made.count = count;
  made.sum_of_squares = per_number * count;
  made.independent = independent;
  return made;
}

TEST(Misfit, WithinWhatIsKnownOfTheNoiseIsNoExcess) {
  EXPECT_TRUE(misfit_of(1.05, 1000.0, 1000.0).is_noise());
  EXPECT_NEAR(misfit_of(3.1, 1000.0, 1000.0).excess(), 2000.0 - 2.5 * std::sqrt(2000.0), 1e-9);
}

TEST(Misfit, OfFewNumbersMayBeLargerByChance) {
  EXPECT_TRUE(misfit_of(1.6, 36.0, 36.0).is_noise());
  EXPECT_FALSE(misfit_of(1.6, 3600.0, 3600.0).is_noise());
}

TEST(InformationGain, AtTheNoiseIsTheDifferenceOfSquaresLessThePenalty) {
  const Misfit simpler = misfit_of(1.02, 10000.0, 10000.0);
  const Misfit fuller = misfit_of(0.99, 10000.0, 10000.0);
  EXPECT_NEAR(information_gain(simpler, fuller, 2), 300.0 - 2.0 * std::log(10000.0), 1e-6);
}

TEST(InformationGain, AboveTheNoiseCountsIndependentNumbersAlone) {
  const Misfit simpler = misfit_of(8.0, 10000.0, 10000.0);
  const Misfit fuller = misfit_of(4.0, 10000.0, 50.0);
  EXPECT_NEAR(information_gain(simpler, fuller, 1), 50.0 * std::log(2.0) - std::log(50.0), 1e-9);
}

}  // namespace
}  // namespace flexarm::diagnose
