#include "report/figures/comparison_plots.hpp"

#include "report/tables/modes_report.hpp"
#include "tests/report/comparison_sample.hpp"

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace flexarm::report {
namespace {

using testing::UnorderedElementsAre;

void expect_well_formed(const std::string& svg, const std::string& name) {
  std::istringstream stream(svg);
  boost::property_tree::ptree tree;
  EXPECT_NO_THROW(read_xml(stream, tree)) << name;
  EXPECT_TRUE(tree.get_child_optional("svg")) << name;
}

std::vector<std::string> names_of(const std::vector<NamedPlot>& plots) {
  std::vector<std::string> names;
  for (const auto& plot : plots) names.push_back(plot.file_name);
  return names;
}

TEST(ComparisonPlots, AreWellFormedThoughRootsAndResponsesAreMissing) {
  const auto plots = comparison_plots(sample_comparison().comparison);
  for (const auto& plot : plots) expect_well_formed(plot.svg, plot.file_name);
  EXPECT_THAT(
      names_of(plots),
      UnorderedElementsAre("convergence-poles.svg", "pole-zero-hub_angle.svg", "bode-hub_angle.svg",
                           "pole-zero-tip_acceleration.svg", "bode-tip_acceleration.svg",
                           "pole-zero-strain@0.25.svg", "bode-strain@0.25.svg", "mode-shapes.svg"));
}

TEST(ComparisonPlots, WhatWasMeasuredIsDrawn) {
  const auto sample = sample_comparison();
  const auto plots = comparison_plots(sample.comparison, sample.measured);
  for (const auto& plot : plots) expect_well_formed(plot.svg, plot.file_name);
  const auto names = names_of(plots);
  EXPECT_THAT(names, testing::IsSupersetOf({"bode-measured-hub_angle-sine.svg", "mac.svg"}));
  const auto without = comparison_plots(sample.comparison);
  const auto map_of = [](const std::vector<NamedPlot>& all) {
    return std::ranges::find(all, "pole-zero-hub_angle.svg", &NamedPlot::file_name)->svg;
  };
  EXPECT_THAT(map_of(plots), testing::HasSubstr("measured"));
  EXPECT_THAT(map_of(without), testing::Not(testing::HasSubstr("measured")));
}

TEST(ComparisonPlots, AModelWithoutAnyRootOrNumberIsDrawnAllTheSame) {
  auto comparison = sample_comparison().comparison;
  for (auto& row : comparison.roots) row.s_rad_per_s[1].reset();
  comparison.modes[1].clear();
  for (auto& response : comparison.responses) {
    response.values[1] = {NAN, NAN, NAN};
    response.one_minus_coherence = {NAN, NAN, NAN};
  }
  for (auto& curve : comparison.refinements) {
    for (auto& point : curve.points) point.relative_error = NAN;
  }
  for (const auto& plot : comparison_plots(comparison)) {
    expect_well_formed(plot.svg, plot.file_name);
  }
}

TEST(ComparisonPlots, ExactAgreementIsDrawn) {
  auto comparison = sample_comparison().comparison;
  for (auto& response : comparison.responses) {
    response.values[1] = response.values[0];
    response.one_minus_coherence = {0, 0, 0};
  }
  for (auto& curve : comparison.refinements) {
    for (auto& point : curve.points) point.relative_error = 0.0;
  }
  for (const auto& plot : comparison_plots(comparison)) {
    expect_well_formed(plot.svg, plot.file_name);
  }
}

TEST(ComparisonPlots, WithoutRefinementsThereAreNoConvergencePlots) {
  auto comparison = sample_comparison().comparison;
  comparison.refinements.clear();
  EXPECT_EQ(comparison_plots(comparison).size(), 7U);
}

TEST(ModesPlot, IsWellFormed) {
  response::ModalSummary summary;
  summary.stations_m = {0.0, 0.48, 0.96};
  summary.modes.assign(12, {75.0, 3.2, 0.0, {}, {0.0, 0.5, -1.0}});
  expect_well_formed(shapes_svg("exact_tf", summary), "shapes");
}

}  // namespace
}  // namespace flexarm::report
