#include "report/page/identify_page.hpp"

#include "report/json/identification_json.hpp"
#include "report/page/page_curves.hpp"
#include "report/page/root_map.hpp"
#include "report/tables/identification_tables.hpp"
#include "report/tables/identified_overview.hpp"
#include "report/tables/zero_kind.hpp"
#include "tests/report/identified_sample.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

namespace flexarm::report::page {
namespace {

using measured::Method;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

PageDocument page_of(const IdentifiedSample& sample) {
  return identify_page(sample.identification, sample.conditions, {}, {});
}

std::string state_of(const IdentifiedSample& sample) {
  return identification_json(sample.identification, sample.conditions)["state"].get<std::string>();
}

TEST(IdentifyPage, CountsARootByItsBestMethodWhereTheFitHasNoNumber) {
  // The log of a ruler: the fit has an alias alone, circles and responses have poles 2 and 3.
  IdentifiedSample sample;
  sample.add_fit(true, 0.5);
  sample.add_pole(Method::nyquist_circle, 2, {45.58, 0.03});
  sample.add_pole(Method::response, 2, {45.7, 0.1});
  sample.add_pole(Method::response, 3, {87.2, 0.09});
  sample.add_pole(Method::rational_fit, {}, {16.07, 0.05});
  const PageDocument page = page_of(sample);
  EXPECT_EQ(page.verdict.status, Status::good);
  EXPECT_EQ(page.verdict.sentence, "2 poles and 0 zeros identified.");
  const auto text = identified_poles_overview({sample.identification, sample.conditions[0], "log"});
  EXPECT_EQ(text.rows.size(), 2U);
  EXPECT_EQ(state_of(sample), "identified");
}

TEST(IdentifyPage, ComparesTheBestEstimateWithTheArmFile) {
  IdentifiedSample sample;
  sample.add_fit(true, 0.5);
  sample.add_pole(Method::nyquist_circle, 1, {13.0, 0.1});
  sample.add_pole(Method::rational_fit, 1, {12.1, 0.01});
  for (auto& roots : sample.conditions[0].roots) roots[0].analytical_Hz = 12.0;
  EXPECT_THAT(page_of(sample).verdict.sentence, AllOf(StartsWith("1 pole and 0 zeros identified."),
                                                      HasSubstr("is 0.833 %, in pole 1")));
}

TEST(IdentifyPage, TellsNothingReadFromNothingOfTheArmFile) {
  IdentifiedSample sample;
  EXPECT_THAT(page_of(sample).verdict.sentence, HasSubstr("identified in these data"));
  EXPECT_EQ(state_of(sample), "nothing identified");
  sample.add_pole(Method::response, {}, {16.07, 0.05});
  EXPECT_THAT(page_of(sample).verdict.sentence, HasSubstr("of the arm file"));
}

TEST(IdentifyPage, AFitThatDidNotConvergeIsTheHeadlineOfTextJsonAndReport) {
  IdentifiedSample sample;
  sample.add_fit(false, 0.5);
  sample.add_pole(Method::rational_fit, 1, {12.0, 0.1});
  EXPECT_THAT(doubts(sample.identification),
              ElementsAre(StartsWith("log: the fit did not converge in 60 iterations")));
  EXPECT_EQ(state_of(sample), "not converged");
  const PageDocument page = page_of(sample);
  EXPECT_NE(page.verdict.status, Status::good);
  EXPECT_EQ(page.verdict.word, "doubtful");
  EXPECT_THAT(page.verdict.sentence, StartsWith("log: the fit did not converge"));
}

TEST(IdentifyPage, ARefusedFitIsNoDoubt) {
  IdentifiedSample sample;
  sample.add_fit(false, 0.5).refusal = "the torque is zero";
  sample.add_pole(Method::response, 1, {12.0, 0.1});
  EXPECT_THAT(doubts(sample.identification), IsEmpty());
  EXPECT_EQ(state_of(sample), "identified");
  EXPECT_THAT(page_of(sample).verdict.sentence, Not(HasSubstr("converge")));
}

TEST(IdentifyPage, AZeroIsNonMinimumPhaseBeyondItsInterval) {
  const auto is_marked = [](double damping_ratio) {
    MapBlock map = root_map("map", "Torque to hub angle", "");
    add_root(map, {"measured", Role::measured},
             {Mark::zero, "zero 1", 2.9, 0.01, damping_ratio, 0.002});
    return map.points.front().non_minimum_phase;
  };
  EXPECT_FALSE(is_marked(0.01));
  EXPECT_FALSE(is_marked(-0.001)) << "half a standard error";
  EXPECT_TRUE(is_marked(-0.005));
  measured::FittedZero zero{.s_rad_per_s = {0.01, 18.0}, .damping_ratio = -0.001};
  zero.damping_ratio_std = 0.002;
  EXPECT_FALSE(is_non_minimum_phase(zero));
  zero.damping_ratio_std = 0.0004;
  EXPECT_TRUE(is_non_minimum_phase(zero));
  zero = {.s_rad_per_s = 57.0, .frequency_std_Hz = 1.0, .damping_ratio = -1.0};
  EXPECT_TRUE(is_non_minimum_phase(zero)) << "of a tip";
  zero.frequency_std_Hz = 10.0;
  EXPECT_FALSE(is_non_minimum_phase(zero));
}

TEST(IdentifyPage, PhasesOfFitAndArmFileAreOnOneBranch) {
  BodeCurve arm{"arm file", Role::before, {1, 2, 3, 4, 5, 6}, {1.0, -1.0, -1.0, 1.0, 1.0, -1.0}};
  BodeCurve fit{"fit", Role::after, arm.frequency_Hz, {}};
  for (const double phase_deg : {0.0, -180.0, -200.0, -300.0, -358.0, -535.0}) {
    fit.response.push_back(std::polar(1.0, phase_deg * std::numbers::pi / 180.0));
  }
  const auto panels = bode_panels("rad/(N m)", {arm, fit});
  const auto& shown = std::get<Samples>(panels.at(1).series.at(1).data);
  const auto& phase = std::get<std::vector<float>>(shown.y);
  ASSERT_EQ(phase.size(), 6U);
  EXPECT_TRUE(std::isnan(phase[3])) << "a gap where the fit turns the other way";
  EXPECT_NEAR(phase[2], -200.0, 1e-3);
  EXPECT_NEAR(phase[4], 2.0, 1e-3);
  EXPECT_NEAR(phase[5], -175.0, 1e-3);
}

}  // namespace
}  // namespace flexarm::report::page
