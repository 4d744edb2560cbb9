#include "compare/features.hpp"

#include <gtest/gtest.h>

#include <complex>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace flexarm::compare {
namespace {

using Complex = std::complex<double>;
using Roots = std::vector<Complex>;
using Matches = std::vector<std::optional<Complex>>;

const FeatureFamily kPoles{std::nullopt, 3};
const FeatureFamily kHubZeros{arm::Sensor{arm::SensorKind::hub_angle}, 3};
const FeatureFamily kTipZeros{arm::Sensor{arm::SensorKind::tip_acceleration}, 3};

TEST(Match, PolesAndHubZerosGoByOrderHoweverFarOff) {
  const Roots reference = {{0, 10}, {0, 20}, {0, 30}};
  const Roots found = {{0, 19}, {0, 29}, {0, 90}};
  for (const auto& family : {kPoles, kHubZeros}) {
    EXPECT_EQ(match(family, reference, found), (Matches{found[0], found[1], found[2]}));
  }
}

TEST(Match, WhatAModelWithFewRootsDoesNotHaveIsEmpty) {
  const Roots reference = {{0, 10}, {0, 20}, {0, 30}};
  const Roots found = {{0, 10}};
  EXPECT_EQ(match(kPoles, reference, found), (Matches{found[0], std::nullopt, std::nullopt}));
  EXPECT_EQ(match(kTipZeros, reference, found), (Matches{found[0], std::nullopt, std::nullopt}));
  EXPECT_EQ(match(kTipZeros, reference, {}), Matches(3));
  EXPECT_TRUE(match(kTipZeros, {}, found).empty());
}

TEST(Match, AMissingZeroLeavesItsNeighboursAlone) {
  // Strain zeros lie within kNearest of each other: the second must not take the third's.
  const Roots reference = {{0, 10}, {0, 20}, {0, 24}, {0, 29}};
  const Roots found = {{0, 10}, {0, 24}, {0, 29}};
  EXPECT_EQ(match(kTipZeros, reference, found),
            (Matches{found[0], std::nullopt, found[1], found[2]}));
}

TEST(Match, ASpuriousNeighbourIsLeftOver) {
  const Roots reference = {{10, 0}, {20, 0}, {40, 0}};
  const Roots found = {{10, 0}, {19, 0}, {20.001, 0}, {40, 0}};
  EXPECT_EQ(match(kTipZeros, reference, found), (Matches{found[0], found[2], found[3]}));
}

TEST(Match, AxesAreKeptApart) {
  const Roots reference = {{20, 0}, {0, 20}};
  const Roots found = {{0, 20}, {20, 0}};
  EXPECT_EQ(match(kTipZeros, reference, found), (Matches{found[1], found[0]}));
  EXPECT_EQ(match(kTipZeros, reference, Roots{{0, 20}}), (Matches{std::nullopt, found[0]}));
}

TEST(Match, ComplexZerosGoByTheirDistanceInThePlane) {
  const Roots reference = {{3, 20}, {20, 3}};
  const Roots found = {{20.1, 3}, {3, 19.9}};
  EXPECT_EQ(match(kTipZeros, reference, found), (Matches{found[1], found[0]}));
}

TEST(Match, ARootThatIsNotANumberStandsForNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Roots found = {{nan, 0}, {20, 0}};
  EXPECT_EQ(match(kTipZeros, Roots{{10, 0}, {20, 0}}, found), (Matches{std::nullopt, found[1]}));
}

TEST(Match, NothingFurtherThanNearestIsTaken) {
  const Roots reference = {{100, 0}};
  const double just_inside = 100 * (1 + 0.99 * kNearest);
  const double just_outside = 100 * (1 + 1.01 * kNearest);
  EXPECT_TRUE(match(kTipZeros, reference, Roots{{just_inside, 0}})[0].has_value());
  EXPECT_FALSE(match(kTipZeros, reference, Roots{{just_outside, 0}})[0].has_value());
}

TEST(PairNearest, AsksTheNearestFirstAndOnlyWhatIsNotPaired) {
  const Roots reference = {{0, 20}, {0, 22}};
  const Roots found = {{0, 20.1}, {0, 21}};
  std::vector<std::pair<std::size_t, std::size_t>> asked;
  pair_nearest(reference, found, [&](std::size_t i, std::size_t j) {
    asked.emplace_back(i, j);
    return asked.size() > 1;  // not the first
  });
  EXPECT_EQ(asked, (std::vector<std::pair<std::size_t, std::size_t>>{{0, 0}, {1, 1}}));
  asked.clear();
  pair_nearest(reference, found, [&](std::size_t i, std::size_t j) {
    asked.emplace_back(i, j);
    return false;
  });
  EXPECT_EQ(asked.size(), 4U);
}

TEST(RelativeDistance, IsOverTheReferencesModulus) {
  EXPECT_EQ(relative_distance({3, 4}, {0, 0.5}), std::abs(Complex(3, 3.5)) / 0.5);
  EXPECT_EQ(relative_distance({0, 2}, {0, 2}), 0.0);
}

TEST(Label, NamesTheFamily) {
  EXPECT_EQ(label(kPoles), "pole");
  EXPECT_EQ(label({arm::Sensor{arm::SensorKind::strain, 0.05}, 1}), "strain@0.05 zero");
}

}  // namespace
}  // namespace flexarm::compare
