#include "compare/reading_clusters.hpp"

#include "compare/identification.hpp"
#include "tests/compare/models.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::compare {
namespace {

using measured::Feature;
using measured::Method;
using measured::ModalReading;

/// Modes of a ruler; seen at 500 Hz, so that its pole 4 folds to 183.91 Hz.
constexpr double kSamplingPeriod_s = 0.002;
constexpr std::array kTrue_Hz = {18.144, 59.9815, 161.9332, 316.085};

arm::Arm ruler(double flexural_rigidity_N_m2) {
  arm::Arm arm;
  arm.beam = arm::Beam::from_rigidity(0.43, flexural_rigidity_N_m2, 0.25);
  arm.hub.inertia_kg_m2 = 2e-3;
  return arm;
}

ModelRoots model_of(const arm::Arm& arm) {
  return model_roots(analytical_modes(arm, std::array{kHubAngle, kTipAcceleration}, 800.0));
}

ModalReading poles(Method method, const std::optional<arm::Sensor>& sensor,
                   const std::vector<double>& frequencies_Hz, double std_Hz) {
  ModalReading reading{method, {"a"}, sensor, {}, {}};
  for (const double frequency_Hz : frequencies_Hz) {
    reading.table.push_back({.sensor = sensor,
                             .feature = Feature::pole,
                             .order = {},
                             .frequency_Hz = frequency_Hz,
                             .frequency_std_Hz = std_Hz,
                             .damping_ratio = {},
                             .damping_ratio_std = {}});
  }
  return reading;
}

std::vector<std::vector<RootPlace>> places_of(const std::vector<ModalReading>& readings,
                                              const std::optional<ModelRoots>& model,
                                              double period_s = kSamplingPeriod_s) {
  std::vector<SampledReading> sampled;
  for (const ModalReading& reading : readings) sampled.push_back({&reading, period_s});
  return place_readings(sampled, model);
}

/// What every method reads off the ruler at 500 Hz.
std::vector<ModalReading> readings_of_ruler() {
  return {poles(Method::response, kHubAngle, {18.119, 59.9843}, 0.02),
          poles(Method::response, kTipAcceleration, {18.13, 162.005, 183.8}, 0.03),
          poles(Method::nyquist_circle, kTipAcceleration, {18.1303, 161.957}, 0.01),
          poles(Method::rational_fit, {}, {18.1341, 59.9799, 161.933, 183.841}, 0.001)};
}

TEST(ReadingClusters, HaveOneOrderAPeakWhateverTheRigidityOfTheFile) {
  for (const double rigidity_N_m2 : {1.36, 1.8, 2.3, 2.9, 3.6}) {
    const auto places = places_of(readings_of_ruler(), model_of(ruler(rigidity_N_m2)));
    const std::vector<std::vector<int>> expected = {{1, 2}, {1, 3, 0}, {1, 3}, {1, 2, 3, 0}};
    for (std::size_t r = 0; r < places.size(); ++r) {
      for (std::size_t i = 0; i < places[r].size(); ++i) {
        EXPECT_EQ(places[r][i].order.value_or(0), expected[r][i])
            << rigidity_N_m2 << " N m^2, reading " << r << ", entry " << i;
      }
    }
  }
}

TEST(ReadingClusters, NameTheModeThatAnAliasIsOf) {
  for (const double rigidity_N_m2 : {1.36, 1.8, 2.3, 2.9, 3.6}) {
    const auto places = places_of(readings_of_ruler(), model_of(ruler(rigidity_N_m2)));
    const RootPlace& alias = places[3][3];
    ASSERT_TRUE(alias.alias_of_Hz) << rigidity_N_m2;
    EXPECT_NEAR(*alias.alias_of_Hz, 316.159, 1e-9) << rigidity_N_m2;
    EXPECT_EQ(alias.alias_of_order, 4) << rigidity_N_m2;
    EXPECT_EQ(places[1][2].alias_of_Hz, alias.alias_of_Hz) << rigidity_N_m2;
  }
}

TEST(ReadingClusters, FindAnAliasBySpacingWithoutAnArm) {
  const auto places = places_of(readings_of_ruler(), std::nullopt);
  EXPECT_EQ(places[3][2].order, 3);
  EXPECT_FALSE(places[3][3].order);
  ASSERT_TRUE(places[3][3].alias_of_Hz);
  EXPECT_NEAR(*places[3][3].alias_of_Hz, 316.159, 1e-9);
}

TEST(ReadingClusters, TakeNoPoleOfTheArmForAnAlias) {
  for (const double factor : {0.8, 1.0, 1.3}) {
    std::vector<double> frequencies_Hz;
    for (const double frequency_Hz : kTrue_Hz) frequencies_Hz.push_back(factor * frequency_Hz);
    const std::vector readings = {poles(Method::rational_fit, {}, frequencies_Hz, 0.001)};
    for (const auto& model : {std::optional(model_of(ruler(2.3))), std::optional<ModelRoots>()}) {
      const auto places = places_of(readings, model, 0.001);
      for (std::size_t i = 0; i < places[0].size(); ++i) {
        EXPECT_EQ(places[0][i].order, static_cast<int>(i) + 1) << factor;
        EXPECT_FALSE(places[0][i].alias_of_Hz) << factor;
      }
    }
  }
}

TEST(ReadingClusters, HaveNoAliasOfResponsesThatWereGiven) {
  const auto places = places_of(readings_of_ruler(), model_of(ruler(2.3)), 0.0);
  for (const auto& reading : places) {
    for (const RootPlace& place : reading) EXPECT_FALSE(place.alias_of_Hz);
  }
}

TEST(ReadingClusters, HaveAReadingOnceAndTheNearestOfIt) {
  const std::vector readings = {poles(Method::rational_fit, {}, {18.134}, 0.001),
                                poles(Method::response, kHubAngle, {17.5, 18.12, 18.9}, 0.02)};
  const auto places = places_of(readings, std::nullopt);
  EXPECT_EQ(places[0][0].order, 1);
  EXPECT_FALSE(places[1][0].order);
  EXPECT_EQ(places[1][1].order, 1);
  EXPECT_FALSE(places[1][2].order);
}

TEST(ReadingClusters, KeepModesApartThatTheFitTellsApart) {
  const std::vector readings = {poles(Method::rational_fit, {}, {20.0, 20.8}, 0.01),
                                poles(Method::nyquist_circle, kHubAngle, {20.1, 20.7}, 0.1)};
  const auto places = places_of(readings, std::nullopt);
  EXPECT_EQ(places[0][1].order, 2);
  EXPECT_EQ(places[1][0].order, 1);
  EXPECT_EQ(places[1][1].order, 2);
}

TEST(ReadingClusters, CountWhatTwoReadingsHaveBesideAFit) {
  const std::vector readings = {poles(Method::rational_fit, {}, {16.0}, 0.01),
                                poles(Method::autopower, kHubAngle, {16.1, 23.0, 45.5}, 0.1),
                                poles(Method::response, kHubAngle, {16.0, 45.6, 86.8}, 0.1),
                                poles(Method::nyquist_circle, kHubAngle, {16.0, 86.9}, 0.1)};
  const auto places = places_of(readings, std::nullopt);
  EXPECT_EQ(places[1][0].order, 1);
  EXPECT_FALSE(places[1][1].order);
  EXPECT_EQ(places[1][2].order, 2);
  EXPECT_EQ(places[2][2].order, 3);
  EXPECT_EQ(places[3][1].order, 3);
}

}  // namespace
}  // namespace flexarm::compare
