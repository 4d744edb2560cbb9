#include "report/page/diagnose_page.hpp"

#include "report/page/cause_blocks.hpp"
#include "report/page/page_json.hpp"
#include "report/page/response_blocks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

namespace flexarm::report::page {
namespace {

using diagnose::Diagnosis;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST(CauseRanking, TicksNoCauseThatExplainsNothing) {
  Diagnosis diagnosis;
  for (const double share : {0.4, 0.0, -0.5}) {
    auto& cause = diagnosis.causes.emplace_back();
    cause.effect = "coulomb_friction";
    cause.confidence = 0.9;
    cause.share = share;
  }
  const RankingBlock block = cause_ranking(diagnosis);
  std::vector<bool> ticked;
  std::vector<std::string> explained;
  for (const RankingItem& item : block.items) {
    ticked.push_back(item.chosen);
    explained.push_back(item.details.back().value);
  }
  EXPECT_THAT(ticked, ElementsAre(true, false, false));
  EXPECT_THAT(explained, ElementsAre("40 %", "0 %", "0 %"));
}

/// Tested by a Kalman filter, whose own simulation of whole runs is among the errors.
Diagnosis tested_by_filter() {
  Diagnosis diagnosis;
  diagnosis.is_tested_by_filter = true;
  diagnosis.prediction_errors = {{"a", "hub_angle", 1, 0.002, 0.01, 0.004},
                                 {"a", "hub_angle", {}, 0.0, 2.0, 0.5}};
  return diagnosis;
}

PageDocument page_of(const Diagnosis& diagnosis) {
  PageDocument document = diagnose_page({}, diagnosis, {});
  make_ids_unique(document);
  return document;
}

/// The table of that id; an empty one where there is none.
TableBlock table_of(const PageDocument& document, const std::string& id) {
  for (const Section& section : document.sections) {
    for (const Block& block : section.blocks) {
      const auto* table = std::get_if<TableBlock>(&block);
      if (table != nullptr && table->head.id == id) return *table;
    }
  }
  return {};
}

TEST(DiagnosePage, SaysWhereResponsesAreFromTheMotionOfTheHub) {
  for (const bool from_hub : {false, true}) {
    measured::FrequencyRecord record{
        {{{arm::SensorKind::tip_deflection, 0.0}, {1.0, 2.0}, {1.0, 2.0}, {0.9, 0.9}}}};
    if (from_hub) record.input = arm::Sensor{arm::SensorKind::hub_angle, 0.0};
    const measured::MeasuredRun run{{}, record};
    const std::vector<double> parts = {1.0, 0.0, 2.0, 0.0};
    const diagnose::Overlay overlay{0, "tip_deflection", parts, parts, parts};
    const diagnose::Gain error;
    const CurvesBlock block =
        diagnosed_responses({{&run, &overlay, &error, "tip deflection", "m"}}, {}, false);
    EXPECT_EQ(block.head.title,
              from_hub ? "Frequency responses of each sensor" : "Torque to each sensor");
    ASSERT_EQ(block.views.size(), 1U);
    EXPECT_EQ(block.views.front().facts.front().label == "input", from_hub);
    EXPECT_EQ(block.views.front().panels.front().y.unit, from_hub ? "m/rad" : "m/(N m)");
  }
}

TEST(DiagnosePage, WithoutACauseHasNoExtendedArm) {
  Diagnosis diagnosis = tested_by_filter();
  diagnosis.verdict = diagnose::Verdict::adequate;
  const PageDocument document = page_of(diagnosis);
  EXPECT_EQ(table_of(document, "prediction-errors").rows.size(), 1U);
  EXPECT_THAT(page_texts(document).document, Not(HasSubstr("xtended arm")));
}

TEST(DiagnosePage, HasNoSecondExtendedArmOfTheKalmanFilter) {
  Diagnosis diagnosis = tested_by_filter();
  diagnosis.verdict = diagnose::Verdict::explained;
  diagnosis.causes.emplace_back().effect = "coulomb_friction";
  const PageDocument document = page_of(diagnosis);
  const TableBlock table = table_of(document, "prediction-errors-by-channel");
  EXPECT_EQ(std::ranges::count(table.columns, "extended arm", &TableColumn::title), 1);
  ASSERT_EQ(table.rows.size(), 1U) << "errors of a simulation are of the reported arm alone";
  EXPECT_THAT(table.rows[0], Not(testing::Contains("simulation")));
}

}  // namespace
}  // namespace flexarm::report::page
