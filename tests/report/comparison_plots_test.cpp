#include "report/figures/comparison_plots.hpp"

#include "report/figures/svg.hpp"
#include "report/tables/modes_report.hpp"
#include "tests/report/comparison_sample.hpp"

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
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

std::vector<std::string> names_of(const std::vector<NamedFigure>& plots) {
  std::vector<std::string> names;
  for (const auto& plot : plots) names.push_back(plot.name);
  return names;
}

TEST(ComparisonPlots, AreWellFormedThoughRootsAndResponsesAreMissing) {
  const auto plots = comparison_plots(sample_comparison().comparison);
  for (const auto& plot : plots) expect_well_formed(to_svg(plot.figure), plot.name);
  EXPECT_THAT(names_of(plots),
              UnorderedElementsAre("convergence-poles", "pole-zero-hub_angle", "bode-hub_angle",
                                   "pole-zero-tip_acceleration", "bode-tip_acceleration",
                                   "pole-zero-strain@0.25", "bode-strain@0.25", "mode-shapes"));
}

TEST(ComparisonPlots, WhatWasMeasuredIsDrawn) {
  const auto sample = sample_comparison();
  const auto plots = comparison_plots(sample.comparison, sample.measured);
  for (const auto& plot : plots) expect_well_formed(to_svg(plot.figure), plot.name);
  const auto names = names_of(plots);
  EXPECT_THAT(names, testing::IsSupersetOf({"bode-measured-hub_angle-sine", "mac"}));
  const auto without = comparison_plots(sample.comparison);
  const auto map_of = [](const std::vector<NamedFigure>& all) {
    return to_svg(std::ranges::find(all, "pole-zero-hub_angle", &NamedFigure::name)->figure);
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
    expect_well_formed(to_svg(plot.figure), plot.name);
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
    expect_well_formed(to_svg(plot.figure), plot.name);
  }
}

TEST(ComparisonPlots, SpeakInWords) {
  for (const auto& [name, figure] : comparison_plots(sample_comparison().comparison)) {
    EXPECT_THAT(to_svg(figure),
                testing::Not(testing::ContainsRegex("<text>[^<]*[a-z][_^][a-z0-9]")))
        << name;
  }
}

TEST(ComparisonPlots, ADampedArmHasItsDampedRoots) {
  auto comparison = sample_comparison().comparison;
  for (std::size_t k = 0; k < comparison.subjects.size(); ++k) {
    comparison.damped.push_back({{{-1.0, 75.0}, {-1.0, -75.0}},
                                 std::vector<std::vector<std::complex<double>>>(
                                     comparison.responses.size(), {{-2.0, 18.0}})});
  }
  const auto plots = comparison_plots(comparison);
  const auto map = std::ranges::find(plots, "pole-zero-hub_angle", &NamedFigure::name);
  ASSERT_NE(map, plots.end());
  const auto& series = map->figure.stacks[0].panels[0].series;
  const auto zeros = std::ranges::find(series, "exact transfer function, zeros", &Series::name);
  ASSERT_NE(zeros, series.end());
  EXPECT_EQ(zeros->x.size(), 1U) << "no mirror images";
  EXPECT_LT(zeros->x[0], 0.0);
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
  expect_well_formed(to_svg(shapes_figure("exact_tf", summary)), "shapes");
}

}  // namespace
}  // namespace flexarm::report
