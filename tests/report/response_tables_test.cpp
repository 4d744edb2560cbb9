#include "report/tables/response_tables.hpp"

#include "report/figures/response_plots.hpp"
#include "report/figures/svg.hpp"
#include "report/tables/csv.hpp"
#include "report/tables/text_table.hpp"
#include "report/utf8_text.hpp"
#include "tests/report/response_sample.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

namespace flexarm::report {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST(ResponseTables, WhatIsInTheResponseAndWhatIsNotIsSaid) {
  EXPECT_THAT(chain_notes(sample_study()),
              ElementsAre("included: delay 0.001 s, torque gain 1.5, actuator lag 0.002 s, "
                          "delay of tip_acceleration 0.004 s, lag of tip_acceleration 0.001 s, "
                          "gain of hub_angle 0.9",
                          "not included (nonlinear): coulomb_friction"));
  EXPECT_THAT(chain_notes(sample_study(arm::paper_arm())), ElementsAre());
}

TEST(ResponseTables, LagsAddPoles) {
  const std::string text = to_text(response_poles_table(sample_study(), 3));
  EXPECT_THAT(text, HasSubstr("actuator lag"));
  EXPECT_THAT(text, HasSubstr("-500"));
  EXPECT_THAT(text, HasSubstr("sensor lag"));
  EXPECT_THAT(to_text(response_poles_table(sample_study(arm::paper_arm()), 3)),
              Not(HasSubstr("lag")));
}

TEST(ResponseTables, ARealPairHasARowForEachRoot) {
  auto study = sample_study();
  study.damped_poles.flexible[2] = {{-10.0, 0.0}, {-4000.0, 0.0}};
  const Table table = response_poles_table(study, 3);
  int rows = 0;
  for (const auto& row : table.rows) rows += row[0] == Cell(std::string("3")) ? 1 : 0;
  EXPECT_EQ(rows, 2);
}

TEST(ResponseTables, TheGainInFrontOfTheProductIsThatOfTheRigidArm) {
  const auto study = sample_study(arm::paper_arm());
  const double inertia = arm::total_inertia_kg_m2(arm::paper_arm());
  EXPECT_THAT(formulas(study, 0)[0], HasSubstr("s^-2 prod"));
  EXPECT_NEAR(study.products[0].gain, 1.0 / inertia, 1e-12 / inertia);
  EXPECT_NEAR(study.fractions[0][0].residue, 1.0 / inertia, 1e-12 / inertia);
  EXPECT_THAT(formulas(study, 1)[1], HasSubstr("G = s^2 sum"));
  EXPECT_EQ(factors_table(study, 0).rows.size(), 4U);
}

TEST(ResponseTables, PickedRowsKeepBothEndsAndThePhaseOfAllOfThem) {
  const auto study = sample_study();
  const Table all = response_table(study.response, 0);
  const Table picked = response_table(study.response, 10);
  EXPECT_EQ(all.rows.size(), study.response.frequency_Hz.size());
  EXPECT_LE(picked.rows.size(), 10U);
  EXPECT_GE(picked.rows.size(), 9U);
  EXPECT_EQ(picked.rows.front(), all.rows.front());
  EXPECT_EQ(picked.rows.back(), all.rows.back());
}

TEST(ResponseTables, NoLineIsWiderThanATerminal) {
  const auto study = sample_study();
  std::string text = to_text(response_poles_table(study, 3)) + to_text(factors_table(study, 1)) +
                     to_text(response_table(study.response, 10)) +
                     to_text(state_space_table(study));
  for (std::size_t k = 0; k < 2; ++k) {
    for (const auto& formula : formulas(study, k)) text += "  " + formula + "\n";
  }
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(display_width(line), 100U) << line;
}

TEST(ResponseTables, TheFrfListingHasTheColumnsOfAMeasurement) {
  const std::string csv = to_csv(frf_listing(sample_study().response));
  EXPECT_THAT(csv, testing::StartsWith("frequency [Hz],sensor,re,im,coherence\n"));
}

TEST(ResponsePlots, AnArmWithoutDampingHasNoNyquistCircles) {
  std::vector<std::string> names;
  for (const auto& plot : response_plots("exact_tf", sample_study(arm::paper_arm()))) {
    names.push_back(plot.name);
  }
  EXPECT_THAT(names, ElementsAre("bode-hub_angle", "bode-tip_acceleration"));
}

TEST(ResponsePlots, ADampedArmHasBodeAndNyquistOfEachSensor) {
  std::vector<std::string> names;
  for (const auto& plot : response_plots("exact_tf", sample_study())) {
    names.push_back(plot.name);
    EXPECT_THAT(to_svg(plot.figure), HasSubstr("</svg>"));
  }
  EXPECT_THAT(names, ElementsAre("bode-hub_angle", "nyquist-hub_angle", "bode-tip_acceleration",
                                 "nyquist-tip_acceleration"));
}

}  // namespace
}  // namespace flexarm::report
