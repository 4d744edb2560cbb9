#include "compare/root_numbering.hpp"

#include "compare/identification.hpp"
#include "effects/registry/vocabulary.hpp"
#include "tests/compare/models.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace flexarm::compare {
namespace {

using measured::Feature;
using measured::ModalTable;

/// 96 % stiffer: frequencies 1.4 times as high.
constexpr double kStiffer = 1.96;

ModelRoots roots_of(const arm::Arm& arm) {
  constexpr double kTo_Hz = 800.0;
  return model_roots(analytical_modes(arm, std::array{kHubAngle, kTipAcceleration}, kTo_Hz));
}

arm::Arm stiffer_arm() {
  arm::Arm arm = arm::paper_arm();
  effects::put(arm, "flexural_rigidity", {{"factor", kStiffer}});
  return arm;
}

/// A root of the true arm and what is measured of it.
struct Seen {
  std::string name;  ///< "z1", "p1"
  double frequency_Hz = 0.0;
};

/// Poles and hub zeros of the arm in their sequence.
std::vector<Seen> sequence_of(const arm::Arm& arm) {
  const ModelRoots roots = roots_of(arm);
  std::vector<Seen> seen;
  for (const auto& pole : roots.poles) {
    seen.push_back({"p" + std::to_string(pole.order), pole.frequency_Hz});
  }
  for (const auto& zero : roots.zeros[0].roots) {
    seen.push_back({"z" + std::to_string(zero.order), zero.frequency_Hz});
  }
  std::ranges::sort(seen, {}, &Seen::frequency_Hz);
  return seen;
}

ModalTable table_of(const std::vector<Seen>& seen) {
  ModalTable table;
  for (const Seen& one : seen) {
    table.push_back({.sensor = kHubAngle,
                     .feature = one.name[0] == 'p' ? Feature::pole : Feature::zero,
                     .order = {},
                     .frequency_Hz = one.frequency_Hz,
                     .frequency_std_Hz = {},
                     .damping_ratio = {},
                     .damping_ratio_std = {}});
  }
  return table;
}

/// "z1 p1 z2"; "?" for a root without an order.
std::string names(const ModalTable& table, const ModelRoots& model) {
  std::string made;
  const auto orders = number_roots(table, model);
  for (std::size_t i = 0; i < table.size(); ++i) {
    made += i == 0 ? "" : " ";
    made += table[i].feature == Feature::pole ? "p" : "z";
    made += orders[i].order ? std::to_string(*orders[i].order) : "?";
  }
  return made;
}

std::string names(const std::vector<Seen>& seen) {
  std::string made;
  for (const Seen& one : seen) made += (made.empty() ? "" : " ") + one.name;
  return made;
}

std::vector<Seen> part(const std::vector<Seen>& all, std::size_t from, std::size_t to) {
  return {all.begin() + static_cast<std::ptrdiff_t>(from),
          all.begin() + static_cast<std::ptrdiff_t>(to)};
}

void erase(std::vector<Seen>& seen, const std::string& name) {
  std::erase_if(seen, [&](const Seen& one) { return one.name == name; });
}

TEST(RootNumbering, OfAStifferBeamIsByInterlacingNotByDistance) {
  const ModelRoots model = roots_of(arm::paper_arm());
  const auto seen = part(sequence_of(stiffer_arm()), 0, 6);
  const ModalTable table = table_of(seen);
  EXPECT_EQ(names(table, model), "z1 p1 z2 p2 z3 p3");
  for (const auto& root : number_roots(table, model)) {
    EXPECT_EQ(root.basis, OrderBasis::interlacing);
  }
  // By itself, the second pole is nearest to the third of the model.
  EXPECT_EQ(names({table[3]}, model), "p3");
  EXPECT_EQ(number_roots({table[3]}, model)[0].basis, OrderBasis::distance);
}

TEST(RootNumbering, StandsNoiseOfTwoPerCent) {
  const ModelRoots model = roots_of(arm::paper_arm());
  const auto exact = part(sequence_of(stiffer_arm()), 0, 6);
  std::mt19937_64 numbers(3);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 200; ++trial) {
    auto seen = exact;
    for (Seen& one : seen) one.frequency_Hz *= 1.0 + 0.02 * normal(numbers);
    EXPECT_EQ(names(table_of(seen), model), names(exact));
  }
}

TEST(RootNumbering, CountsARootThatWasMissed) {
  const ModelRoots model = roots_of(arm::paper_arm());
  for (const std::string missed : {"p1", "z2", "p2", "z3"}) {
    auto seen = part(sequence_of(stiffer_arm()), 0, 6);
    erase(seen, missed);
    EXPECT_EQ(names(table_of(seen), model), names(seen));
  }
}

TEST(RootNumbering, OfABandThatStartsAboveRootsIsByTheCommonFactor) {
  const ModelRoots model = roots_of(arm::paper_arm());
  for (const std::size_t first : {1U, 2U, 3U, 4U}) {  // 4: above pole 2
    const auto seen = part(sequence_of(stiffer_arm()), first, first + 5);
    EXPECT_EQ(names(table_of(seen), model), names(seen));
  }
}

TEST(RootNumbering, OfPolesAloneIsByTheCommonFactor) {
  auto seen = part(sequence_of(stiffer_arm()), 0, 6);
  std::erase_if(seen, [](const Seen& one) { return one.name[0] == 'z'; });
  ModalTable table = table_of(seen);
  for (auto& entry : table) entry.sensor.reset();
  EXPECT_EQ(names(table, roots_of(arm::paper_arm())), "p1 p2 p3");
}

TEST(RootNumbering, OfOtherErrorsOfTheArmIsByInterlacingFromTheFirst) {
  const ModelRoots model = roots_of(arm::paper_arm());
  arm::Arm heavy_hub = arm::paper_arm();
  heavy_hub.hub.inertia_kg_m2 *= 4.0;
  arm::Arm loaded = arm::paper_arm();
  loaded.payload.mass_kg = 0.1;
  for (const arm::Arm& arm : {heavy_hub, loaded}) {
    for (const std::size_t count : {2U, 4U, 6U}) {
      const auto seen = part(sequence_of(arm), 0, count);
      EXPECT_EQ(names(table_of(seen), model), names(seen));
    }
  }
}

TEST(RootNumbering, IsByDistanceWhereNothingElseIsDetermined) {
  const ModelRoots model = roots_of(arm::paper_arm());
  // Two roots far up have nearly the same ratio as the two above them.
  const auto two = part(sequence_of(arm::paper_arm()), 5, 7);
  const ModalTable table = table_of(two);
  EXPECT_EQ(names(table, model), names(two));
  for (const auto& root : number_roots(table, model)) EXPECT_EQ(root.basis, OrderBasis::distance);
  // A resonance that is none of the arm's, with its antiresonance, fits into no count.
  auto seen = part(sequence_of(arm::paper_arm()), 0, 4);
  seen.insert(seen.begin() + 1, {{"p?", 5.0}, {"z?", 5.2}});
  EXPECT_EQ(names(table_of(seen), model), names(seen));
}

TEST(RootNumbering, LeavesStatedOrdersAndNumbersTheOthersBySuchAnOrder) {
  const ModelRoots model = roots_of(arm::paper_arm());
  ModalTable table = table_of(part(sequence_of(stiffer_arm()), 0, 4));
  table[1].order = 2;  // against everything that the others show
  EXPECT_EQ(number_roots(table, model)[1].order, 2);
  EXPECT_EQ(number_roots(table, model)[1].basis, OrderBasis::stated);
  // Three roots far up, which are not determined without a stated order.
  ModalTable upper = table_of(part(sequence_of(stiffer_arm()), 5, 8));
  EXPECT_EQ(number_roots(upper, model)[0].basis, OrderBasis::distance);
  upper[0].order = 3;
  EXPECT_EQ(names(upper, model), "p3 z4 p4");
}

TEST(RootNumbering, TakesTheFactorOfThePolesOutOfTipZeros) {
  arm::Arm arm = arm::paper_arm();
  arm::Arm stiffer = stiffer_arm();
  for (auto* one : {&arm, &stiffer}) one->payload = {0.05, 1e-3};  // an imaginary tip zero
  const ModelRoots model = roots_of(arm);
  const ModelRoots truth = roots_of(stiffer);
  ASSERT_FALSE(truth.zeros[1].roots.empty());
  const auto seen = part(sequence_of(stiffer), 0, 4);
  ModalTable table = table_of(seen);
  table.push_back(
      {kTipAcceleration, Feature::zero, {}, truth.zeros[1].roots[0].frequency_Hz, {}, {}, {}});
  EXPECT_EQ(names(table, model), names(seen) + " z1");
  EXPECT_EQ(names({table.back()}, model), "z?");  // 40 % from the model's
}

TEST(RootNumbering, UsesTheZerosOfACollocatedSensorForPolesOfNone) {
  ModalTable table = table_of(part(sequence_of(stiffer_arm()), 0, 4));
  for (auto& entry : table) {
    if (entry.feature == Feature::pole) entry.sensor.reset();
  }
  EXPECT_EQ(names(table, roots_of(arm::paper_arm())), "z1 p1 z2 p2");
}

TEST(RootNumbering, GivesTheModeOfAHubSpringNoOrder) {
  arm::Arm held = stiffer_arm();
  effects::put(held, "hub_spring", {{"stiffness", 1.0}});
  const double lowest_Hz = roots_of(held).lowest_Hz;
  EXPECT_GT(lowest_Hz, 0.5);
  auto seen = part(sequence_of(held), 0, 4);
  EXPECT_LT(lowest_Hz, seen[0].frequency_Hz);
  seen.insert(seen.begin(), {"p?", lowest_Hz});
  EXPECT_EQ(names(table_of(seen), roots_of(arm::paper_arm())), "p? z1 p1 z2 p2");
}

}  // namespace
}  // namespace flexarm::compare
