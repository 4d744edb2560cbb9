#include "report/tables/comparison_tables.hpp"

#include "report/tables/csv.hpp"
#include "report/tables/measured_tables.hpp"
#include "report/tables/text_table.hpp"
#include "tests/report/comparison_sample.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace flexarm::report {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

const ComparedArm kSample = sample_comparison();
const compare::Comparison& kComparison = kSample.comparison;

TEST(ComparisonTables, OneTableAFamilyAndOneRowARoot) {
  const auto tables = root_tables(kComparison);
  ASSERT_EQ(tables.size(), 4U);
  EXPECT_EQ(tables[0].caption, "Poles, on the imaginary axis [Hz]");
  EXPECT_EQ(tables[0].rows.size(), 2U);
  EXPECT_EQ(tables[1].caption, "Zeros of torque to hub_angle, on the imaginary axis [Hz]");
  EXPECT_EQ(tables[1].rows.size(), 1U);
  EXPECT_EQ(tables[2].caption,
            "Zeros of torque to tip_acceleration, on the real axis (non-minimum phase) [rad/s]");
  EXPECT_EQ(tables[2].rows.size(), 1U);
  EXPECT_EQ(tables[3].caption, "Zeros of torque to strain@0.25");
  EXPECT_EQ(tables[3].rows.size(), 2U);
}

TEST(ComparisonTables, RootsOffTheAxesSayWhatIsShown) {
  const std::string text = to_text(root_tables(kComparison)[3]);
  EXPECT_THAT(text,
              AllOf(HasSubstr("imaginary, Hz"), HasSubstr("complex (non-minimum phase), |s| Hz")));
}

TEST(ComparisonTables, WhatAModelDoesNotHaveIsADash) {
  const auto table = root_tables(kComparison)[0];
  EXPECT_TRUE(is_missing(table.rows[1][2]));
  EXPECT_TRUE(is_missing(table.rows[1][3]));
  EXPECT_THAT(to_csv(root_listing(kComparison)), testing::Not(HasSubstr("nan")));
}

TEST(ComparisonTables, ListingsHaveOneRowAValue) {
  EXPECT_EQ(root_listing(kComparison).rows.size(), 6U * 2U);
  EXPECT_EQ(notes_table(kComparison).rows.size(), 4U * 2U);
  EXPECT_EQ(convergence_listing(kComparison).rows.size(), 3U);
  EXPECT_EQ(refinement_listing(kComparison).rows.size(), 9U);
  EXPECT_EQ(shapes_table(kComparison).rows.size(), 1U);
  EXPECT_EQ(shapes_listing(kComparison).rows.size(), 3U * 3U);
  EXPECT_EQ(responses_table(kComparison).rows.size(), 3U);
  EXPECT_EQ(responses_listing(kComparison).rows.size(), 3U * 2U * 3U);
  EXPECT_EQ(subjects_table(kComparison).rows.size(), 2U);
}

TEST(MeasuredTables, HaveAColumnForEachModelsDeviation) {
  const auto& measured = kSample.measured;
  const auto table = measured_table(measured.rows, kComparison.subjects);
  ASSERT_EQ(table.rows.size(), 2U);
  ASSERT_EQ(table.columns.size(), 9U) << "no uncertain number, so no column for one";
  EXPECT_EQ(table.columns[7].name, "exact_tf");
  EXPECT_EQ(std::get<double>(table.rows[0][7]), 1.4);
  EXPECT_TRUE(is_missing(table.rows[0][8]));
  EXPECT_EQ(measured_damping_table(measured.rows).rows.size(), 1U);
  EXPECT_EQ(measured_response_table(measured.responses).rows.size(), 2U);
  EXPECT_EQ(mac_table(measured.shapes.front()).columns.size(), 3U + 2U);
  EXPECT_EQ(mac_listing(measured.shapes).rows.size(), 2U * 2U);
  EXPECT_THAT(measured_summary(measured.rows),
              HasSubstr("1 of 1 measured frequencies are within 2 standard deviations"));
  EXPECT_EQ(measured_summary({}), "");
}

TEST(MeasuredTables, WithoutStandardDeviationsAreAsNarrowAsTheyWere) {
  auto rows = kSample.measured.rows;
  for (auto& row : rows) row.measured.frequency_std_Hz.reset();
  EXPECT_EQ(measured_table(rows, kComparison.subjects).columns.size(), 6U);
}

TEST(ComparisonTables, CsvHasTheBitsOfEveryRoot) {
  EXPECT_THAT(to_csv(root_listing(kComparison)), HasSubstr("0.30000000000000004"));
}

TEST(ComparisonTables, ConvergenceIsTheWorstRootsAndRangesOverAll) {
  const auto tables = convergence_tables(kComparison);
  ASSERT_EQ(tables.size(), 2U) << "families without a series have no table";
  ASSERT_EQ(tables[0].rows.size(), 1U);
  const auto& row = tables[0].rows[0];
  EXPECT_EQ(std::get<std::string>(row[2]), "4.00 to 4.00");
  EXPECT_EQ(std::get<double>(row[4]), 1e-3);
  EXPECT_TRUE(is_missing(row[6])) << "no root is within 1e-9";
  EXPECT_TRUE(is_missing(tables[1].rows[0][4])) << "a zero that no setting has";
}

TEST(ComparisonTables, TheVerdictNamesTheWorstPair) {
  EXPECT_EQ(verdict_line(kComparison),
            "Verdict: DISAGREE. Largest difference relative to its tolerance: pole 2: missing in "
            "exact_tf or fem.");
  compare::Comparison other = kComparison;
  other.findings.pop_back();
  other.verdict = compare::judge(other.findings);
  EXPECT_EQ(verdict_line(other),
            "Verdict: DISAGREE. Largest difference relative to its tolerance: pole 1: relative "
            "difference of exact_tf and "
            "fem 1.0e-02, tolerance "
            "1e-09.");
  other.findings = {{"pole 1", "exact_tf", "fem", 1e-16, 1e-9}};
  other.verdict = compare::judge(other.findings);
  EXPECT_THAT(verdict_line(other),
              StartsWith("Verdict: agree. Largest difference relative to its tolerance: pole 1: "));
}

TEST(ComparisonTables, TheLegendNamesTheAccuracy) {
  EXPECT_THAT(convergence_legend(kComparison), HasSubstr("1e-09"));
}

}  // namespace
}  // namespace flexarm::report
