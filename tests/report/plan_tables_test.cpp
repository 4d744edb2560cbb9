#include "report/tables/plan_tables.hpp"

#include "report/page/plan_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <variant>
#include <vector>

namespace flexarm::report {
namespace {

using testing::ElementsAre;

/// Delay and lag are tied, gravity is not detectable, inertia is far from both.
diagnose::Plan plan() {
  constexpr std::size_t kInertia = 0, kGravity = 1, kDelay = 2, kLag = 3;
  diagnose::Plan made;
  for (const char* effect : {"hub_inertia", "gravity", "time_delay", "actuator_lag"}) {
    auto& detection = made.effects.emplace_back();
    detection.hypothesis.effect = effect;
    detection.shows = made.effects.size() - 1 != kGravity;
  }
  made.separations.assign(4, std::vector<std::optional<diagnose::Separation>>(4));
  const auto lead = [&made](std::size_t truth, std::size_t rival, double value) {
    made.separations[truth][rival].emplace().lead = value;
  };
  lead(kInertia, kDelay, 500.0);
  lead(kInertia, kLag, 400.0);
  lead(kDelay, kInertia, 300.0);
  lead(kDelay, kLag, 3.0);
  lead(kLag, kInertia, 200.0);
  lead(kLag, kDelay, 0.4);
  made.ties = {{kLag, kDelay, 0.4}};
  made.classes = {{kDelay, kLag}};
  return made;
}

std::vector<std::string> texts(const Table& table, std::size_t column) {
  std::vector<std::string> cells;
  for (const auto& row : table.rows) cells.push_back(std::get<std::string>(row[column]));
  return cells;
}

TEST(PlanTables, EffectsThatAreTiedComeFirst) {
  const Table table = detection_table(plan());
  EXPECT_THAT(texts(table, 0), ElementsAre("actuator_lag", "time_delay", "gravity", "hub_inertia"));
  EXPECT_THAT(texts(table, 2), ElementsAre("time_delay", "actuator_lag", "", ""));
}

TEST(PlanTables, PairsAscendInTheirLead) {
  const Table table = separation_table(plan());
  std::vector<double> leads;
  for (const auto& row : table.rows) leads.push_back(std::get<double>(row[3]));
  EXPECT_THAT(leads, ElementsAre(0.4, 3.0, 200.0, 300.0, 400.0, 500.0));
  EXPECT_THAT(texts(table, 5), ElementsAre("no", "no", "yes", "yes", "yes", "yes"));
}

TEST(PlanPage, HasIndistinguishablePairsOnItsFirstScreen) {
  const auto page = page::plan_page(plan(), {});
  ASSERT_EQ(page.results.size(), 1U);
  EXPECT_EQ(page.results[0].label, "Actuator lag and time delay");
  EXPECT_EQ(page.results[0].value, "indistinguishable, delta BIC 0");
  // The ranking has the order of the table.
  const auto& ranking = std::get<page::RankingBlock>(page.headline.value());
  std::vector<std::string> names;
  for (const auto& item : ranking.items) names.push_back(item.label);
  EXPECT_THAT(names, ElementsAre("Actuator lag", "Time delay", "Gravity", "Hub inertia"));
}

}  // namespace
}  // namespace flexarm::report
