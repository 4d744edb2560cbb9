#include "report/json/comparison_json.hpp"

#include "report/tables/modes_report.hpp"
#include "tests/report/comparison_sample.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace flexarm::report {
namespace {

using Json = nlohmann::json;

TEST(ComparisonJson, ParsesAndCarriesTheVerdict) {
  const auto document = Json::parse(comparison_json({sample_comparison()}));
  EXPECT_EQ(document["schema"], "flexarm.compare/1");
  EXPECT_EQ(document["verdict"], "disagree");
  EXPECT_EQ(document["comparisons"].size(), 1U);
  EXPECT_EQ(document["comparisons"][0]["worst"]["quantity"], "pole 2");
}

TEST(ComparisonJson, OneArmThatDisagreesMakesAllDisagree) {
  ComparedArm agreeing = sample_comparison();
  agreeing.comparison.verdict.agree = true;
  EXPECT_EQ(Json::parse(comparison_json({agreeing, agreeing}))["verdict"], "agree");
  EXPECT_EQ(Json::parse(comparison_json({agreeing, sample_comparison()}))["verdict"], "disagree");
}

TEST(ComparisonJson, DoublesReadBackToTheSameBits) {
  const auto sample = sample_comparison();
  const auto document = Json::parse(comparison_json({sample}));
  const auto roots = document["comparisons"][0]["roots"];
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const auto& row = sample.comparison.roots[i];
    const auto value = roots[i]["values"][0]["s_rad_per_s"];
    EXPECT_EQ(value["re"].get<double>(), row.s_rad_per_s[0]->real());
    EXPECT_EQ(value["im"].get<double>(), row.s_rad_per_s[0]->imag());
  }
  EXPECT_EQ(document["comparisons"][0]["arm"]["flexural_rigidity_N_m2"].get<double>(),
            arm::paper_arm().beam.flexural_rigidity_N_m2());
}

TEST(ComparisonJson, WhatIsMissingIsNull) {
  const auto compared = Json::parse(comparison_json({sample_comparison()}))["comparisons"][0];
  const auto second_pole = compared["roots"][1]["values"][1];
  EXPECT_TRUE(second_pole["s_rad_per_s"].is_null());
  EXPECT_TRUE(second_pole["relative_distance"].is_null());
  EXPECT_TRUE(compared["roots"][0]["sensor"].is_null());
  EXPECT_TRUE(compared["counts"][1]["counted"].is_null());
  EXPECT_TRUE(compared["counts"][1]["rejected"][0]["relative_change"].is_null());
  EXPECT_TRUE(compared["responses"][0]["models"][1]["re"][1].is_null());
  EXPECT_TRUE(compared["responses"][0]["models"][1]["largest_error"].is_null());
  EXPECT_TRUE(compared["refinements"][2]["smallest_error"].is_null());
  EXPECT_TRUE(compared["refinements"][2]["observed_order"].is_null());
  EXPECT_TRUE(compared["refinements"][2]["accurate_from"].is_null());
  EXPECT_TRUE(compared["measured"][0]["sensor"].is_null());
  EXPECT_EQ(compared["measured"][0]["measured_std_Hz"], 0.1);
  EXPECT_EQ(compared["measured"][0]["models"][0]["deviation_std"], 1.4);
  EXPECT_TRUE(compared["measured"][0]["models"][1]["frequency_Hz"].is_null());
  EXPECT_EQ(compared["measured_responses"][0]["models"][0]["relative_error_percent"], 4.5);
  EXPECT_EQ(compared["mac"][0]["models"][0]["rows"][0]["mac"][0], 0.98);
  EXPECT_TRUE(compared["measured"][1]["model_Hz"].is_null());
  EXPECT_TRUE(compared["worst"]["distance"].is_null());
}

TEST(ModesJson, HasAnObjectOfSensorValuesEvenWithoutSensors) {
  response::ModalSummary summary;
  summary.modes = {{75.0, 3.2, 0.0, {}, {0.0, 1.0}}};
  summary.stations_m = {0.0, 0.96};
  const auto json = modes_json(arm::paper_arm(), summary);
  EXPECT_TRUE(json["modes"][0]["sensor_values"].is_object());
  EXPECT_EQ(json["modes"][0]["displacement_m"].size(), json["stations_m"].size());
  EXPECT_TRUE(json["zeros"].empty());
}

}  // namespace
}  // namespace flexarm::report
