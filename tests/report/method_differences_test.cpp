#include "report/tables/method_differences.hpp"

#include "report/tables/identified_root_tables.hpp"
#include "tests/report/identified_sample.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

namespace flexarm::report {
namespace {

using measured::Method;
using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kWhite = 0.5;
constexpr double kColoured = 0.0;

std::vector<std::string> differences(const IdentifiedSample& sample) {
  return method_differences({sample.identification, sample.conditions[0], "log"});
}

/// The cells of the column "differs", an empty one as ""; none where there is no such column.
std::vector<std::string> marks(const Table& table) {
  std::vector<std::string> cells;
  const auto column = std::ranges::find(table.columns, "differs", &Column::name);
  if (column == table.columns.end()) return cells;
  const auto at = static_cast<std::size_t>(column - table.columns.begin());
  for (const auto& row : table.rows) {
    const auto* text = std::get_if<std::string>(&row[at]);
    cells.push_back(text == nullptr ? "" : *text);
  }
  return cells;
}

/// The damping ratios of issue 66: 0.065 by the circle and 0.032 by the fit.
IdentifiedSample unlike_damping(double whiteness_probability) {
  IdentifiedSample sample;
  sample.add_fit(true, whiteness_probability);
  sample.add_pole(Method::nyquist_circle, 1, {12.0, 0.02}, Stated{0.065, 0.002});
  sample.add_pole(Method::rational_fit, 1, {12.01, 0.01}, Stated{0.032, 0.001});
  return sample;
}

TEST(MethodDifferences, OfDampingNameFrictionWhereResidualsAreNoNoise) {
  const auto sample = unlike_damping(kColoured);
  EXPECT_THAT(differences(sample),
              ElementsAre(AllOf(HasSubstr("log: pole 1: damping ratio by circle of hub_angle, "
                                          "0.065 +- 0.002, is 103 % off that by fit, "
                                          "0.032 +- 0.001"),
                                HasSubstr("likely friction"), HasSubstr("are not noise"))));
  const IdentifiedData data{sample.identification, sample.conditions[0], "log"};
  EXPECT_THAT(marks(damping_table(data)), ElementsAre("pole 1", ""));
  EXPECT_THAT(marks(pole_table(data)), IsEmpty());  // the frequencies agree
}

TEST(MethodDifferences, OfDampingNameFrictionWhereThereIsDistortion) {
  auto sample = unlike_damping(kWhite);
  measured::ChannelDistortion channel;
  channel.odd.found = true;
  sample.identification.runs[0].distortion = {
      .testable = true, .reason = "", .channels = {channel}};
  EXPECT_THAT(differences(sample),
              ElementsAre(AllOf(HasSubstr("likely friction"), HasSubstr("nonlinear distortion"))));
}

TEST(MethodDifferences, OfDampingNameTheWindowWhereLinesAreCoarse) {
  auto sample = unlike_damping(kColoured);
  measured::FrequencyResponseEstimate estimate;
  estimate.spacing_Hz = 0.5;  // half-power bandwidth 2 * 0.032 * 12.01 Hz = 0.77 Hz
  sample.identification.runs[0].estimate = estimate;
  EXPECT_THAT(differences(sample),
              ElementsAre(AllOf(HasSubstr("likely the window, which widens peaks: lines 0.5 Hz "
                                          "apart, half-power bandwidth 0.77 Hz"))));
  sample.identification.runs[0].estimate->spacing_Hz = 0.05;
  EXPECT_THAT(differences(sample), ElementsAre(HasSubstr("likely friction")));
}

TEST(MethodDifferences, OfDampingWithoutEvidenceHaveNoReason) {
  EXPECT_THAT(differences(unlike_damping(kWhite)),
              ElementsAre(EndsWith("no reason is evident from these data")));
}

TEST(MethodDifferences, AreNoneWithinTheErrors) {
  IdentifiedSample sample;
  sample.add_fit(true, kColoured);
  sample.add_pole(Method::nyquist_circle, 1, {12.2, 0.1}, Stated{0.05, 0.02});
  sample.add_pole(Method::rational_fit, 1, {12.0, 0.01}, Stated{0.032, 0.001});
  EXPECT_THAT(differences(sample), IsEmpty());
  const IdentifiedData data{sample.identification, sample.conditions[0], "log"};
  EXPECT_THAT(marks(pole_table(data)), IsEmpty());
  EXPECT_THAT(marks(damping_table(data)), IsEmpty());
}

TEST(MethodDifferences, MarkACircleFarOffTheFitWhateverItsErrors) {
  IdentifiedSample sample;
  sample.add_fit(true, kWhite);
  sample.add_pole(Method::nyquist_circle, 1, {12.696, 1.0});  // 5.8 %
  sample.add_pole(Method::response, 1, {12.05, 0.3});
  sample.add_pole(Method::rational_fit, 1, {12.0, 0.01});
  EXPECT_THAT(differences(sample),
              ElementsAre("log: pole 1: frequency by circle of hub_angle, 12.7 +- 1 Hz, is 5.8 % "
                          "off that by fit, 12 +- 0.01 Hz"));
  EXPECT_THAT(marks(pole_table({sample.identification, sample.conditions[0], "log"})),
              ElementsAre("pole 1", "", ""));
}

TEST(MethodDifferences, StateTheFurthestAndCountTheOthers) {
  IdentifiedSample sample;
  sample.add_fit(true, kWhite);
  sample.add_pole(Method::response, 2, {33.0, 0.1});
  sample.add_pole(Method::nyquist_circle, 2, {34.0, 0.1});
  sample.add_pole(Method::rational_fit, 2, {32.0, 0.01});
  EXPECT_THAT(differences(sample),
              ElementsAre(AllOf(HasSubstr("by circle of hub_angle, 34 +- 0.1 Hz"),
                                EndsWith(", as 1 more estimate is"))));
  EXPECT_THAT(marks(pole_table({sample.identification, sample.conditions[0], "log"})),
              ElementsAre("pole 2", "pole 2", ""));
}

}  // namespace
}  // namespace flexarm::report
