#include "compare/measured_verdict.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace flexarm::compare {
namespace {

/// A pole that is off by so many standard deviations, or per cent where none is known.
MeasuredRow pole_off(double deviation, double percent = 0.0) {
  MeasuredRow row;
  row.order = 1;
  row.combined_deviation = deviation;
  row.error_percent = percent;
  return row;
}

MeasuredComparison of_rows(std::vector<MeasuredRow> rows) {
  return {std::move(rows), {}, {}};
}

MeasuredTimeRun run_with(double nrmse_percent) {
  MeasuredTimeRun run;
  run.run = "steps";
  run.signals = {{"hub_angle", "rad", {}, {}, {}, nrmse_percent}};
  return run;
}

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

TEST(MeasuredVerdict, NothingComparedIsNoVerdict) {
  EXPECT_EQ(judge(MeasuredComparison{}).agreement, MeasuredAgreement::none);
  EXPECT_EQ(judge(of_rows({pole_off(kUnknown, kUnknown)})).agreement, MeasuredAgreement::none);
}

TEST(MeasuredVerdict, OneNumberAgreesWithinTwoStandardDeviations) {
  EXPECT_EQ(judge(of_rows({pole_off(1.999)})).agreement, MeasuredAgreement::agrees);
  EXPECT_EQ(judge(of_rows({pole_off(-2.001)})).agreement, MeasuredAgreement::differs);
}

TEST(MeasuredVerdict, SeveralNumbersAreJudgedTogether) {
  // 20 numbers of which one is at 2.5: by chance in 22 % of cases.
  std::vector<MeasuredRow> rows(19, pole_off(0.7));
  rows.push_back(pole_off(2.5));
  const auto chance = judge(of_rows(rows));
  EXPECT_EQ(chance.agreement, MeasuredAgreement::agrees);
  EXPECT_EQ(chance.judged_by_std, 20U);
  EXPECT_DOUBLE_EQ(chance.in_std.size, 2.5);
  // All of them at 1.4 are not.
  EXPECT_EQ(judge(of_rows(std::vector<MeasuredRow>(40, pole_off(1.4)))).agreement,
            MeasuredAgreement::differs);
}

TEST(MeasuredVerdict, AnEndlessDeviationDiffers) {
  const auto verdict = judge(of_rows({pole_off(1e200)}));
  EXPECT_EQ(verdict.agreement, MeasuredAgreement::differs);
  EXPECT_DOUBLE_EQ(verdict.p_value, 0.0);
}

TEST(MeasuredVerdict, WithoutAStandardDeviationPerCentDecide) {
  EXPECT_EQ(judge(of_rows({pole_off(kUnknown, 4.9)})).agreement, MeasuredAgreement::agrees);
  const auto far = judge(of_rows({pole_off(kUnknown, 1.0), pole_off(kUnknown, -45.0)}));
  EXPECT_EQ(far.agreement, MeasuredAgreement::differs);
  EXPECT_DOUBLE_EQ(far.in_percent.size, 45.0);
  EXPECT_EQ(far.in_percent.of, "pole 1 frequency");
  MeasuredComparison tolerant = of_rows({pole_off(kUnknown, -45.0)});
  tolerant.tolerance_percent = 45.0;
  EXPECT_EQ(judge(tolerant).agreement, MeasuredAgreement::agrees);
}

TEST(MeasuredVerdict, AStandardDeviationTakesThePlaceOfPerCent) {
  const auto verdict = judge(of_rows({pole_off(0.5, 45.0)}));
  EXPECT_EQ(verdict.agreement, MeasuredAgreement::agrees);
  EXPECT_EQ(verdict.judged_by_percent, 0U);
}

TEST(MeasuredVerdict, ASignalCountsBesideFrequencies) {
  MeasuredComparison measured = of_rows({pole_off(0.5)});
  measured.runs = {run_with(6.0)};
  const auto verdict = judge(measured);
  EXPECT_EQ(verdict.agreement, MeasuredAgreement::differs);
  EXPECT_EQ(verdict.in_percent.of, "hub_angle of run steps");
  EXPECT_TRUE(verdict.agrees_by_std());
  measured.runs = {run_with(kUnknown)};  // a constant signal
  EXPECT_EQ(judge(measured).agreement, MeasuredAgreement::agrees);
}

TEST(MeasuredVerdict, ADampingRatioIsANumberOfItsOwn) {
  MeasuredRow row = pole_off(0.1);
  row.damping_deviation = 5.0;
  const auto verdict = judge(of_rows({row}));
  EXPECT_EQ(verdict.agreement, MeasuredAgreement::differs);
  EXPECT_EQ(verdict.judged_by_std, 2U);
  EXPECT_EQ(verdict.in_std.of, "pole 1 damping ratio");
}

}  // namespace
}  // namespace flexarm::compare
