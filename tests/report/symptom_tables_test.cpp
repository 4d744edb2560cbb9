#include "report/tables/symptom_tables.hpp"

#include "report/figures/diagnosis_figures.hpp"
#include "report/figures/figure_layout.hpp"
#include "report/figures/overlay_figure.hpp"
#include "report/figures/svg.hpp"
#include "report/json/diagnosis_json.hpp"
#include "report/tables/text_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::report {
namespace {

using diagnose::SymptomKind;
using testing::HasSubstr;
using testing::Not;

diagnose::Symptoms sample() {
  diagnose::Symptoms symptoms;
  auto& all = symptoms.statements;
  for (const char* sensor : {"hub_angle", "hub_velocity", "tip_acceleration", "strain@0.05"}) {
    all.push_back(symptom(SymptomKind::error,
                          std::string(sensor) + ": " + std::string(120, 'x') + " too much.", 1e-200,
                          10));
    all.back().sensor = sensor;
  }
  all.push_back(symptom(SymptomKind::hub_torque, "hub: a step.", 1e-30, 20));
  all.push_back(symptom(SymptomKind::drift, "agrees.", 0.4, 1));
  return symptoms;
}

TEST(WhatIsWrong, HasOneOfEachKindBeforeASecondOfAny) {
  const std::string text = what_is_wrong_text(sample(), 6);
  EXPECT_THAT(text, HasSubstr("- hub_angle:"));
  EXPECT_THAT(text, HasSubstr("- hub: a step."));
  EXPECT_THAT(text, HasSubstr("- agrees."));
  EXPECT_THAT(text, Not(HasSubstr("strain")));
  EXPECT_LE(std::ranges::count(text, '\n'), 7);
}

TEST(WhatIsWrong, IsNothingWithoutStatements) {
  EXPECT_EQ(what_is_wrong_text({}), "");
}

TEST(SymptomTable, HasAllStatements) {
  const Table table = symptom_table(sample());
  ASSERT_EQ(table.rows.size(), 6U);
  EXPECT_EQ(std::get<std::string>(table.rows.front()[1]), "yes");
  EXPECT_EQ(std::get<std::string>(table.rows.back()[1]), "no");
}

/// Bands of frequency, one of which holds most of the residual, and torques.
diagnose::Symptoms with_regimes() {
  using diagnose::RegimeQuantity;
  diagnose::Symptoms symptoms;
  const auto add = [&](RegimeQuantity quantity, double from, double to, double ratio,
                       std::optional<double> innovation_ratio, double p_value) {
    symptoms.regimes.push_back({.quantity = quantity,
                                .from = from,
                                .to = to,
                                .share = 0.25,
                                .before = 1.234,
                                .after = 0.1234,
                                .noise_floor = 0.01234,
                                .ratio = ratio,
                                .innovation_ratio = innovation_ratio,
                                .p_value = p_value});
  };
  add(RegimeQuantity::frequency, 0.0, 8.4, 0.5, std::nullopt, 1.0);
  add(RegimeQuantity::frequency, 8.4, 43.5, 12.0, std::nullopt, 1.2e-34);
  add(RegimeQuantity::torque, 0.00123, 0.0456, 3.0, 0.5, 0.3);
  add(RegimeQuantity::torque, 0.0456, 0.123, 0.9, 2.0, 0.0012);
  add(RegimeQuantity::hub_velocity, 0.0000163, 10.1, 0.9, 0.8, 1.0);
  return symptoms;
}

TEST(RegimeTable, HasAllByQuantity) {
  const Table table = regime_table(with_regimes());
  ASSERT_EQ(table.rows.size(), 5U);
  EXPECT_EQ(std::get<std::string>(table.rows[0][0]), "frequency");
  EXPECT_EQ(std::get<std::string>(table.rows[3][3]), "N m");
  EXPECT_TRUE(is_missing(table.rows[0][9]));
}

TEST(WhereItFailsTable, HasTheSignificantRegimesFirstAndFitsATerminal) {
  const Table table = where_it_fails_table(with_regimes());
  std::vector<double> from;
  for (const auto& row : table.rows) from.push_back(std::get<double>(row[1]));
  EXPECT_THAT(from, testing::ElementsAre(8.4, 0.0456, 0.00123, 0.0, 0.0000163));
  const std::string text = to_text(table, {.max_width = kPipeWidth, .key_columns = 4});
  EXPECT_EQ(text.find("hub_velocity"), text.rfind("hub_velocity")) << text;  // in one block
}

TEST(DiagnosisJson, HasTheRegimes) {
  diagnose::Diagnosis diagnosis;
  diagnosis.symptoms = with_regimes();
  const auto regimes = diagnosis_json(diagnosis, "")["residual"]["regimes"];
  ASSERT_EQ(regimes.size(), 5U);
  EXPECT_TRUE(regimes[1]["innovation_ratio"].is_null());
  EXPECT_EQ(regimes[3]["innovation_ratio"], 2.0);
  EXPECT_EQ(regimes[3]["unit"], "N m");
  EXPECT_EQ(regimes[3]["significant"], true);
  EXPECT_EQ(regimes[2]["significant"], false);
}

TEST(DiagnosisJson, HasTheStatementsBesideWhatWasThereBefore) {
  diagnose::Diagnosis diagnosis;
  diagnosis.symptoms = sample();
  diagnosis.symptoms.hub_torque.terms.push_back({.kind = diagnose::HubTorqueKind::coulomb_friction,
                                                 .unit = "N m",
                                                 .coefficient = 0.01,
                                                 .std_error = 1e-4,
                                                 .share = 0.97,
                                                 .probability = 0.0});
  const auto json = diagnosis_json(diagnosis, "");
  EXPECT_EQ(json.at("symptoms").size(), 6U);
  EXPECT_EQ(json.at("symptoms")[0].at("kind"), "error");
  EXPECT_EQ(json.at("symptoms")[0].at("sensor"), "hub_angle");
  EXPECT_EQ(json.at("residual").at("hub_torque")[0].at("depends_on"), "coulomb_friction");
  EXPECT_TRUE(json.at("residual").contains("channels"));
  EXPECT_TRUE(json.at("residual").at("run_consistency").is_null());
}

TEST(HubTorqueFigure, ShowsTheStepThatWasFound) {
  diagnose::HubTorque torque;
  torque.terms.push_back({.kind = diagnose::HubTorqueKind::coulomb_friction,
                          .unit = "N m",
                          .coefficient = 0.01,
                          .std_error = 1e-4});
  diagnose::HubTorqueTrace trace{"bang-bang", {}, {}, {}, {}};
  for (int k = 0; k < 400; ++k) {
    const double velocity = std::sin(0.05 * k);
    trace.time_s.push_back(0.01 * k);
    trace.velocity_rad_per_s.push_back(velocity);
    trace.angle_rad.push_back(-std::cos(0.05 * k));
    trace.torque_N_m.push_back(-0.01 * (velocity > 0.0 ? 1.0 : -1.0) + 1e-3 * std::sin(1.7 * k));
  }
  const Figure figure = hub_torque_figure(torque, trace);
  ASSERT_EQ(figure.stacks.size(), 2U);
  const auto& by_velocity = figure.stacks[0].panels[0].series;
  const auto found = std::ranges::find(by_velocity, "identified terms", &Series::name);
  ASSERT_NE(found, by_velocity.end());
  EXPECT_DOUBLE_EQ(found->y.front(), 0.01);
  EXPECT_DOUBLE_EQ(found->y.back(), -0.01);
  // Friction does not depend on the angle.
  EXPECT_EQ(figure.stacks[1].panels[0].series.size(), by_velocity.size() - 1);
  EXPECT_THAT(to_svg(figure), HasSubstr("hub velocity"));
}

/// A run of 2000 samples whose sensors are predicted with half their size in the middle.
struct OverlayCase {
  diagnose::Experiment experiment;
  diagnose::Diagnosis diagnosis;

  explicit OverlayCase(const std::vector<std::pair<std::string, double>>& errors) {
    measured::TimeRecord record;
    std::vector<double> signal;
    for (int k = 0; k < 2000; ++k) {
      record.time_s.push_back(0.002 * k);
      record.torque_N_m.push_back(0.01);
      signal.push_back(std::sin(0.1 * k));
    }
    std::vector<double> before = signal;
    std::vector<double> after = signal;
    for (std::size_t k = 1200; k < 1700; ++k) before[k] *= 0.5;
    for (double& value : after) value *= 1.001;
    for (const auto& [sensor, error] : errors) {
      record.channels.push_back({arm::parse_sensor(sensor), signal});
      diagnosis.overlays.push_back({0, sensor, signal, before, after});
      diagnosis.channels.push_back({"random", sensor, {error, 0.001, 0.0005}});
    }
    measured::MeasuredRun run;
    run.run.id = "random";
    run.data = record;
    experiment.runs.push_back(run);
  }
  std::optional<Figure> figure() const { return overlay_figure(experiment, diagnosis, 0); }
};

TEST(OverlayFigure, ShowsTheWorstSignalOfHubAndTipFirst) {
  const OverlayCase worse_angle(
      {{"hub_velocity", 0.2}, {"hub_angle", 0.4}, {"tip_acceleration", 0.3}});
  const auto panels = worse_angle.figure()->stacks.front().panels;
  ASSERT_EQ(panels.size(), 5U);
  EXPECT_EQ(panels[0].y.label, "hub angle");
  EXPECT_EQ(panels[2].y.label, "tip acceleration");
  EXPECT_EQ(panels[4].y.label, "torque");
  EXPECT_EQ(panels[0].series.size(), 2U);  // no causes, no second curve
  const OverlayCase worse_tip(
      {{"hub_velocity", 0.2}, {"hub_angle", 0.1}, {"tip_acceleration", 0.3}});
  const auto others = worse_tip.figure()->stacks.front().panels;
  EXPECT_EQ(others[0].y.label, "tip acceleration");
  EXPECT_EQ(others[2].y.label, "hub velocity");
}

TEST(OverlayFigure, HasTheWholeRunAndBesideItWhereTheBaselineIsFurthestOff) {
  const Figure figure = *OverlayCase({{"hub_angle", 0.4}}).figure();
  ASSERT_EQ(figure.stacks.size(), 2U);
  EXPECT_EQ(figure.stacks[0].panels[0].series.front().x.size(), 2000U);
  const Panel& lens = figure.stacks[1].panels[0];
  EXPECT_DOUBLE_EQ(lens.series.front().x.front(), 0.002 * 1200);
  EXPECT_EQ(lens.series.front().x.size(), kDrawnSamples);
  EXPECT_THAT(figure.title, HasSubstr("random; on the right 2.4 to 3.398 s"));
}

TEST(OverlayFigure, ResidualsBeforeAndAfterHaveScalesOfTheirOwn) {
  OverlayCase explained({{"hub_angle", 0.4}, {"tip_acceleration", 0.3}});
  explained.diagnosis.causes.emplace_back();
  const Figure figure = *explained.figure();
  const auto& panels = figure.stacks.front().panels;
  ASSERT_EQ(panels.size(), 7U);
  EXPECT_EQ(panels[0].series.size(), 3U);
  EXPECT_THAT(panels[1].note, HasSubstr("arm file, NRMSE"));
  EXPECT_THAT(panels[2].note, HasSubstr("extended arm, NRMSE"));
  const auto boxes = lay_out(figure).boxes[0];
  EXPECT_LT(boxes[2].y.to, 0.01 * boxes[1].y.to);
  EXPECT_THAT(boxes[2].note, HasSubstr("NRMSE of the run 0.1 %"));
}

TEST(OverlayFigure, ASensorThatIsNotPredictedIsLeftOut) {
  OverlayCase driven({{"hub_angle", 0.4}, {"strain@0.05", 0.3}});
  driven.diagnosis.overlays.erase(driven.diagnosis.overlays.begin());
  ASSERT_TRUE(driven.figure());
  EXPECT_EQ(driven.figure()->stacks.front().panels[0].y.label, "strain at 0.05 m");
  driven.diagnosis.overlays.clear();
  EXPECT_FALSE(driven.figure());
  EXPECT_TRUE(diagnosis_plots(driven.experiment, driven.diagnosis).plots.empty());
}

}  // namespace
}  // namespace flexarm::report
