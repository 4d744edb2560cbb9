#include "report/tables/symptom_tables.hpp"

#include "report/figures/diagnosis_figures.hpp"
#include "report/figures/svg.hpp"
#include "report/json/diagnosis_json.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <string>
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

TEST(OverlayFigure, ShowsHubAndTipWithWhatIsMissed) {
  diagnose::Experiment experiment;
  measured::TimeRecord record;
  std::vector<double> signal;
  for (int k = 0; k < 2000; ++k) {
    record.time_s.push_back(0.002 * k);
    record.torque_N_m.push_back(0.01);
    signal.push_back(std::sin(0.1 * k));
  }
  diagnose::Diagnosis diagnosis;
  for (const char* sensor : {"hub_angle", "hub_velocity", "tip_acceleration"}) {
    record.channels.push_back({arm::parse_sensor(sensor), signal});
    std::vector<double> simulated = signal;
    for (std::size_t k = 1200; k < 1700; ++k) simulated[k] *= 0.5;
    diagnosis.overlays.push_back({0, sensor, signal, simulated, signal});
  }
  measured::MeasuredRun run;
  run.run.id = "random";
  run.data = record;
  experiment.runs.push_back(run);
  const Figure figure = overlay_figure(experiment, diagnosis, 0);
  ASSERT_EQ(figure.stacks.front().panels.size(), 4U);
  const auto& first = figure.stacks.front().panels.front();
  EXPECT_EQ(first.y.label, "hub velocity");
  EXPECT_DOUBLE_EQ(first.series.front().x.front(), 0.002 * 1200);  // where it is furthest off
  EXPECT_EQ(first.series.size(), 2U);                              // no causes, no second curve
  diagnosis.causes.emplace_back();
  EXPECT_EQ(overlay_figure(experiment, diagnosis, 0).stacks.front().panels.front().series.size(),
            3U);
}

}  // namespace
}  // namespace flexarm::report
