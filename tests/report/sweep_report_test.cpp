#include "arm/input_error.hpp"
#include "report/figures/svg.hpp"
#include "report/figures/sweep_figures.hpp"
#include "report/json/sweep_json.hpp"
#include "report/tables/csv.hpp"
#include "report/tables/sweep_tables.hpp"
#include "report/tables/text_table.hpp"

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <numbers>
#include <sstream>

namespace flexarm::report {
namespace {

using compare::SweepEvent;
using compare::SweepResult;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

const arm::Sensor kTip{arm::SensorKind::tip_acceleration, 0.0};

/// Two models of one pole and two tracks, made by hand: the second track begins at the second
/// point, where its zero is imaginary, and the second model does not have it.
SweepResult sample(bool damped = true) {
  using Complex = std::complex<double>;
  SweepResult result;
  result.task.arm = arm::paper_arm();
  result.task.axes = {compare::parse_axis("payload.inertia=0,1e-4,2e-4")};
  result.task.models = compare::standard_models(1);
  result.task.models.resize(2);
  result.task.questions.poles = 1;
  result.task.questions.sensors = {kTip};
  result.degrees_of_freedom = {0, 43};
  const compare::SweepFamily tip_zeros{kTip, false};
  result.curves = {
      {{},
       1,
       {{Complex(0, 75), Complex(0, 70), Complex(0, 66)},
        {Complex(0, 75), Complex(0, 70.7), Complex(0, 66)}}},
      {tip_zeros, 1, {{Complex(57), Complex(58), Complex(40, 30)}, {Complex(57), Complex(58), {}}}},
      {tip_zeros, 2, {{{}, Complex(0, 300), Complex(0, 200)}, {{}, {}, {}}}},
  };
  if (damped) {
    const compare::SweepFamily damped_poles{std::nullopt, true};
    result.curves.push_back(
        {damped_poles, 1, {{Complex(-3, 4), Complex(-4, 3), Complex(-5)}, {{}, {}, {}}}});
  }
  result.modes.hub_slope = {{{4.0, 3.5, 3.0}}, {{4.0, 3.5, 3.0}}};
  result.modes.tip_value_m = {{{-0.6, -0.5, -0.4}}, {{-0.6, -0.5, -0.4}}};
  result.events = {
      {SweepEvent::Kind::appears_beyond, tip_zeros, 2, compare::kNoTrack, 0, 0.0, 1e-5},
      {SweepEvent::Kind::meet, tip_zeros, 1, 3, 0, 1e-4, 2e-4},
      {SweepEvent::Kind::ambiguous, tip_zeros, compare::kNoTrack, compare::kNoTrack, 0, 1e-4,
       2e-4}};
  result.agreement = {{"poles", "fem", 0.01, 1, 1, 1e-9, 3, 0, 0},
                      {"tip_acceleration zeros", "fem", 0.0, 0, 1, 1e-9, 2, 3, 2}};
  return result;
}

/// The same over a grid of two by three points.
SweepResult sample_of_two() {
  SweepResult result = sample();
  result.task.axes.insert(result.task.axes.begin(), compare::parse_axis("payload.mass=0,0.1"));
  const auto twice = [](auto& values) {
    const auto once = values;
    values.insert(values.end(), once.begin(), once.end());
  };
  for (auto& curve : result.curves) std::ranges::for_each(curve.s_rad_per_s, twice);
  for (auto* table : {&result.modes.hub_slope, &result.modes.tip_value_m}) {
    for (auto& of_model : *table) std::ranges::for_each(of_model, twice);
  }
  return result;
}

TEST(SweepTables, ShowFirstLastAndExtremesNotEveryPoint) {
  const auto tables = sweep_range_tables(sample());
  ASSERT_EQ(tables.size(), 4);
  EXPECT_EQ(to_csv(tables[1]),
            "zero,axis,first [rad/s],last [rad/s],lowest [rad/s],at [kg m^2],highest [rad/s],"
            "at [kg m^2]\n"
            "1,\"real, complex\",57,50,50,0.0002,58,0.0001\n"
            "2,imaginary,,200,200,0.0002,300,0.0001\n");
  EXPECT_EQ(to_csv(tables[3]),
            "pole,first,last,lowest,at [kg m^2],highest,at [kg m^2]\n"
            "1,0.6,1,0.6,0,1,0.0002\n");
  EXPECT_EQ(sweep_range_tables(sample(false)).size(), 2);
  EXPECT_EQ(sweep_mode_tables(sample()).size(), 2);
  SweepResult without_modes = sample();
  without_modes.modes = {};
  EXPECT_TRUE(sweep_mode_tables(without_modes).empty());
}

TEST(SweepTables, FitATerminal) {
  constexpr std::size_t kColumns = 100;
  for (const auto& result : {sample(), sample_of_two()}) {
    auto tables = sweep_range_tables(result);
    for (auto& table : sweep_mode_tables(result)) tables.push_back(std::move(table));
    tables.push_back(sweep_agreement_table(result));
    tables.push_back(sweep_events_table(result, 10));
    tables.push_back(sweep_models_table(result));
    for (const auto& table : tables) {
      std::istringstream lines(to_text(table));
      for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), kColumns) << line;
    }
  }
}

TEST(SweepTables, EventsAreCutOffWhereAsked) {
  EXPECT_EQ(sweep_events_table(sample(), 10).rows.size(), 3);
  EXPECT_EQ(sweep_events_table(sample(), 1).rows.size(), 1);
  EXPECT_THAT(to_text(sweep_events_table(sample(), 10)), HasSubstr("enters the range"));
}

TEST(SweepTables, TheVerdictNamesTheWorstPlace) {
  SweepResult result = sample();
  EXPECT_EQ(sweep_verdict_line(result),
            "DISAGREE: tip_acceleration zeros by fem: 3 of 5 missing, the first at "
            "payload.inertia = 0.0002 kg m^2\n");
  result.agreement.pop_back();
  EXPECT_EQ(sweep_verdict_line(result),
            "DISAGREE: largest relative difference 0.01 in poles of fem (tolerance 1e-09) at "
            "payload.inertia = "
            "0.0001 kg m^2\n");
  result.agreement.front().worst = 1e-12;
  EXPECT_THAT(sweep_verdict_line(result),
              StartsWith("Agree: largest relative difference 1e-12 in poles of fem"));
  result.agreement.clear();
  EXPECT_EQ(sweep_verdict_line(result), "");
}

TEST(SweepCsv, HasARowForEachRootThatThereIs) {
  const std::string csv = sweep_csv(sample());
  EXPECT_THAT(csv, StartsWith("payload.inertia [kg m^2],model,feature,sensor,number,re [rad/s],"
                              "im [rad/s],frequency [Hz],damping_ratio,hub_slope,tip_value [m]\n"));
  // The header, poles of two models, zeros of the first and of the second, damped poles.
  EXPECT_EQ(std::ranges::count(csv, '\n'), 1 + 2 * 3 + 5 + 2 + 3);
  EXPECT_THAT(csv, HasSubstr("\n0,exact_tf,damped pole,,1,-3,4,"));
  EXPECT_THAT(csv, HasSubstr("\n0.0001,exact_tf,zero,tip_acceleration,2,0,300,"));
  EXPECT_THAT(sweep_csv(sample_of_two()),
              StartsWith("payload.mass [kg],payload.inertia [kg m^2],"));
}

TEST(SweepJson, HasNullWhereATrackHasNoRoot) {
  const auto json = nlohmann::json::parse(sweep_json(sample()));
  EXPECT_EQ(json["schema"], "flexarm.sweep/1");
  EXPECT_EQ(json["verdict"], "disagree");
  EXPECT_EQ(json["zeros"][1]["values"][0]["im_rad_per_s"], (nlohmann::json{nullptr, 300.0, 200.0}));
  EXPECT_EQ(json["damped_poles"][0]["values"][0]["damping_ratio"], (nlohmann::json{0.6, 0.8, 1.0}));
  EXPECT_EQ(json["events"][2]["track"], nullptr);
  EXPECT_TRUE(nlohmann::json::parse(sweep_json(sample(false)))["damped_poles"].empty());
}

std::vector<std::string> drawn(const SweepResult& result) {
  std::vector<std::string> names;
  for (const auto& [name, figure] : sweep_plots(result)) {
    names.push_back(name);
    std::istringstream stream(to_svg(figure));
    boost::property_tree::ptree tree;
    EXPECT_NO_THROW(read_xml(stream, tree)) << name;
  }
  return names;
}

TEST(SweepFigures, AreWellFormedOverOneParameterAndTwo) {
  EXPECT_THAT(drawn(sample()),
              ElementsAre("poles", "damped-poles", "zeros-tip_acceleration", "modes"));
  EXPECT_THAT(drawn(sample_of_two()),
              ElementsAre("poles", "damped-poles", "damped-poles-2", "zeros-tip_acceleration",
                          "zeros-tip_acceleration-2", "modes", "modes-2"));
}

TEST(SweepFigures, ASinglePointAndAModelWithoutRootsAreDrawn) {
  SweepResult result = sample(false);
  for (auto& curve : result.curves) {
    for (auto& s : curve.s_rad_per_s[1]) s.reset();
  }
  EXPECT_EQ(drawn(result).size(), 3);
}

TEST(SweepFigures, WithAPayloadWithoutBoundTheSecondZeroIsThatOfAClampedPinnedBeam) {
  const auto figure = compare::paper_sweep(19, arm::paper_arm());
  // The first goes to 0. tan lambda = tanh lambda has the root 3.926602312; a payload of 1e8 m l
  // is off by its inverse.
  const double omega = 3.926602312 * 3.926602312 * arm::omega_scale_rad_per_s(arm::paper_arm());
  ASSERT_EQ(figure.limits.size(), 1);
  EXPECT_NEAR(figure.limits.front().y, omega / (2.0 * std::numbers::pi), 1e-6);
}

TEST(SweepFigures, FiguresOfThePaperHaveLimitsAndMeasuredValues) {
  for (const int number : {18, 19}) {
    const auto figure = compare::paper_sweep(number, arm::paper_arm());
    ASSERT_EQ(figure.limits.size(), number == 18 ? 2 : 1);
    EXPECT_EQ(figure.measured.size(), 2);
    const auto result = compare::assemble(figure.task, compare::evaluate(figure.task, {}), {}, {});
    const auto drawing = paper_sweep_figure(figure, result);
    const auto& panel = drawing.stacks.front().panels.front();
    EXPECT_EQ(panel.series.size(), 2 * 3 + figure.limits.size() + 2);
    EXPECT_THAT(to_svg(drawing), HasSubstr("measured (Table 6)"));
  }
  EXPECT_THROW(compare::paper_sweep(17, arm::paper_arm()), arm::InputError);
}

}  // namespace
}  // namespace flexarm::report
