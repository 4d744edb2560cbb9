#include "compare/identification.hpp"

#include "effects/registry/vocabulary.hpp"
#include "tests/compare/models.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace flexarm::compare {
namespace {

using measured::Feature;
using measured::ModalEntry;

ModalEntry entry(const std::optional<arm::Sensor>& sensor, Feature feature,
                 std::optional<int> order, double frequency_Hz) {
  return {sensor, feature, order, frequency_Hz, {}, {}, {}};
}

AnalyticalModes modes_of(const arm::Arm& arm) {
  return analytical_modes(arm, std::array{kHubAngle, kTipAcceleration}, 40.0);
}

TEST(AnalyticalModes, OfThePapersArmAreTheCheckedOnes) {
  const auto modes = modes_of(arm::paper_arm());
  // ../shared/design.md states these to five digits and more.
  constexpr double kDigits = 2e-5;
  ASSERT_EQ(modes.poles.size(), 3U);  // to the first one beyond 40 Hz
  EXPECT_NEAR(modes.poles[0].frequency_Hz / 11.8618, 1.0, kDigits);
  EXPECT_NEAR(modes.poles[1].frequency_Hz / 32.2606, 1.0, kDigits);
  EXPECT_EQ(modes.poles[0].damping_ratio, 0.0);
  ASSERT_EQ(modes.zeros.size(), 2U);
  EXPECT_NEAR(modes.zeros[1].s_rad_per_s[0].real() / 57.4409, 1.0, kDigits);
  ASSERT_EQ(modes.gains.size(), 3U);
  for (const auto& gains : modes.gains) {
    EXPECT_NEAR(gains.hub_slope[0] / modes.gains[0].hub_slope[0], 1.0, 1e-9) << gains.model;
    EXPECT_NEAR(gains.tip_gain_m[1] / modes.gains[0].tip_gain_m[1], 1.0, 1e-9) << gains.model;
  }
}

TEST(AnalyticalModes, HaveTheDampingOfTheDampedPoles) {
  arm::Arm arm = arm::paper_arm();
  arm.damping.kelvin_voigt_s = 1e-4;
  const auto modes = modes_of(arm);
  // Kelvin-Voigt damping alone: zeta = kv omega/2 exactly.
  for (const auto& pole : modes.poles) {
    EXPECT_NEAR(pole.damping_ratio / (0.5e-4 * 2.0 * M_PI * pole.frequency_Hz), 1.0, 1e-9);
  }
}

TEST(AnalyticalModes, HaveZerosOfStrainAtTheTipWhereAPayloadBendsIt) {
  const arm::Sensor at_the_tip{arm::SensorKind::strain, 0.960};
  arm::Arm arm = arm::paper_arm();
  EXPECT_TRUE(analytical_modes(arm, std::array{at_the_tip}, 40.0).zeros.empty());
  effects::put(arm, "payload_inertia", {{"inertia", 1e-3}});
  EXPECT_EQ(analytical_modes(arm, std::array{at_the_tip}, 40.0).zeros.size(), 1U);
}

TEST(BesideAnalytical, FindsRootsWithoutOrders) {
  const auto modes = modes_of(arm::paper_arm());
  // The first pole was missed, and something else was seen: by distance.
  const auto roots = beside_analytical(
      {entry(kHubAngle, Feature::pole, {}, 20.5), entry(kHubAngle, Feature::pole, {}, 32.5),
       entry(kHubAngle, Feature::zero, {}, 18.2)},
      modes);
  EXPECT_FALSE(roots[0].order);
  EXPECT_TRUE(std::isnan(roots[0].error_percent()));
  EXPECT_EQ(roots[1].order, 2);
  EXPECT_NEAR(roots[1].error_percent(), 100.0 * (32.5 / modes.poles[1].frequency_Hz - 1.0), 1e-12);
  EXPECT_EQ(roots[2].order, 2);
  const auto table = in_analytical_order(roots);
  ASSERT_EQ(table.size(), 2U);
  EXPECT_EQ(table[0].order, 2);
}

TEST(BesideAnalytical, TakesARootOnce) {
  const auto roots = beside_analytical(
      {entry(kHubAngle, Feature::pole, {}, 11.7), entry(kHubAngle, Feature::pole, {}, 11.9),
       entry(kTipAcceleration, Feature::pole, {}, 11.7)},
      modes_of(arm::paper_arm()));
  EXPECT_FALSE(roots[0].order);
  EXPECT_EQ(roots[1].order, 1);
  EXPECT_EQ(roots[2].order, 1);  // each sensor has its own
}

TEST(BesideAnalytical, HasNoAntiresonanceWhereZerosAreReal) {
  const auto roots = beside_analytical({entry(kTipAcceleration, Feature::zero, {}, 9.1)},
                                       modes_of(arm::paper_arm()));
  EXPECT_FALSE(roots[0].order);
}

TEST(BesideAnalytical, LeavesAStatedOrder) {
  const auto modes = modes_of(arm::paper_arm());
  const auto roots = beside_analytical(
      {entry(kHubAngle, Feature::pole, 1, 32.0), entry(kHubAngle, Feature::pole, 9, 58.0)}, modes);
  EXPECT_EQ(roots[0].order, 1);
  EXPECT_EQ(roots[0].analytical_Hz, modes.poles[0].frequency_Hz);
  EXPECT_FALSE(roots[1].order);  // not among these analytical ones
}

TEST(ConditionsOf, AreOneAPayload) {
  measured::MeasuredRun bare{{.id = "bare", .kind = measured::RunKind::modal, .file = "a.csv"},
                             measured::ModalTable{entry({}, Feature::pole, 1, 12.0)}};
  measured::MeasuredRun loaded = bare;
  loaded.run.id = "loaded";
  loaded.run.payload = arm::Payload{0.1, 0.0};
  const auto identification = measured::identify({bare, loaded});
  const auto conditions = conditions_of(identification, arm::paper_arm());
  ASSERT_EQ(conditions.size(), 2U);
  EXPECT_EQ(conditions[1].payload, (arm::Payload{0.1, 0.0}));
  EXPECT_LT(conditions[1].analytical.poles[0].frequency_Hz,
            conditions[0].analytical.poles[0].frequency_Hz);
  EXPECT_EQ(conditions[0].readings, (std::vector<std::size_t>{0}));
  EXPECT_EQ(conditions[1].readings, (std::vector<std::size_t>{1}));
}

TEST(ConditionsOf, NumberPolesOfASensorByTheZerosOfAnotherInTheSameRun) {
  // A beam 96 % stiffer. Tip poles by themselves are nearest to none, and to pole 3.
  constexpr double kHigher = 1.4;
  const auto modes = modes_of(arm::paper_arm());
  measured::ModalTable table;
  for (const std::size_t k : {0U, 1U}) {
    const double pole_Hz = kHigher * modes.poles[k].frequency_Hz;
    const double zero_Hz = kHigher * modes.zeros[0].s_rad_per_s[k].imag() / (2.0 * M_PI);
    table.push_back(entry(kTipAcceleration, Feature::pole, {}, pole_Hz));
    table.push_back(entry(kHubAngle, Feature::pole, {}, pole_Hz));
    table.push_back(entry(kHubAngle, Feature::zero, {}, zero_Hz));
  }
  const auto conditions = conditions_of(
      measured::identify({{{.id = "a", .kind = measured::RunKind::modal, .file = "a.csv"}, table}}),
      arm::paper_arm());
  ASSERT_EQ(conditions[0].roots.size(), 2U);  // of the tip, of the hub
  ASSERT_EQ(conditions[0].roots[0].size(), 2U);
  for (const std::size_t k : {0U, 1U}) {
    EXPECT_EQ(conditions[0].roots[0][k].order, static_cast<int>(k) + 1);
    EXPECT_NEAR(conditions[0].roots[0][k].error_percent(), 40.0, 1e-9);
  }
}

}  // namespace
}  // namespace flexarm::compare
