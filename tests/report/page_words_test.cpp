#include "report/page/page_words.hpp"

#include "report/page/page_table.hpp"
#include "report/words.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace flexarm::report::page {
namespace {

TEST(PageWords, StandInThePlaceOfIdentifiers) {
  EXPECT_EQ(text_in_words("coulomb_friction"), "Coulomb friction");
  EXPECT_EQ(text_in_words("Explained by coulomb_friction + stribeck_friction."),
            "Explained by Coulomb friction + Stribeck friction.");
  EXPECT_EQ(text_in_words("hub_angle zero 3"), "hub angle zero 3");
  EXPECT_EQ(text_in_words("strain@0.05, strain@1e-3"), "strain at 0.05 m, strain at 1e-3 m");
  EXPECT_EQ(text_in_words("fem and exact_tf"), "finite elements and exact transfer function");
}

TEST(PageWords, KeysAndFilesStayAsTheyAre) {
  EXPECT_EQ(text_in_words("beam.youngs_modulus = 7e10"), "beam.youngs_modulus = 7e10");
  EXPECT_EQ(text_in_words("in my_run/hub_angle.csv"), "in my_run/hub_angle.csv");
}

TEST(PageWords, UnitsArePrinted) {
  EXPECT_EQ(unit_text("m/s^2"), "m/s²");
  EXPECT_EQ(unit_text("1"), "");
  EXPECT_EQ(response_unit({arm::SensorKind::tip_acceleration, 0.0}), "(m/s²)/(N m)");
  EXPECT_EQ(response_unit({arm::SensorKind::hub_angle, 0.0}), "rad/(N m)");
  EXPECT_EQ(response_unit({arm::SensorKind::strain, 0.1}), "1/(N m)");
  EXPECT_EQ(in_words("effects.root_compliance.stiffness"), "root compliance stiffness");
  EXPECT_EQ(in_words("payload.mass"), "payload mass");
}

TEST(PageWords, WhatIsNoNumberIsADash) {
  EXPECT_EQ(percent_of(NAN), "–");
  EXPECT_EQ(percent_of(0.605), "60.5 %");
  EXPECT_EQ(percent_of(13.83), "1383 %");
  EXPECT_EQ(number_of(INFINITY, 3), "–");
}

TEST(PageWords, AnEstimateHasTheDigitsOfItsStandardError) {
  EXPECT_EQ(estimate_of(0.00215408712345, 5.4e-8, "N m"), "0.002154087 ± 5.4e-08 N m");
  EXPECT_EQ(estimate_of(786.4321, 2.34, "N m/rad"), "786.4 ± 2.3 N m/rad");
  EXPECT_EQ(estimate_of(0.3, 0.9, "1"), "0.3 ± 0.9");
  EXPECT_EQ(estimate_of(1.0 / 3.0, NAN, "s"), "0.333333 ± – s");
  EXPECT_EQ(estimate_of(-12.0, 1e-30, "m/s^2"), "-12 ± 1e-30 m/s²");
}

TEST(PageTable, HasTheDigitsOfTheTextAndNoEmptyColumn) {
  Table table{"Some_title",
              {{.name = "effect"},
               {.name = "value", .unit = "m/s^2", .significant_digits = 3},
               {.name = "nothing"}}};
  table.add_row({std::string("time_delay"), 1.23456, Cell{}});
  table.add_row({std::string("hub_inertia"), NAN, Cell{}});
  const TableBlock block = table_block(table, "some");
  EXPECT_EQ(block.head.title, "Some title");
  ASSERT_EQ(block.columns.size(), 2U);
  EXPECT_FALSE(block.columns[0].numeric);
  EXPECT_TRUE(block.columns[1].numeric);
  EXPECT_EQ(block.columns[1].unit, "m/s²");
  EXPECT_EQ(block.rows,
            (std::vector<std::vector<std::string>>{{"time delay", "1.23"}, {"hub inertia", "–"}}));
}

TEST(PageTable, AOneIsNothingWhereAUnitStandsAlone) {
  Table table{"", {{.name = "pairs"}, {.name = "unit"}}};
  table.add_row({std::string("1"), std::string("1")});
  table.add_row({std::string("·"), std::string("m^2")});
  EXPECT_EQ(table_block(table, "some").rows,
            (std::vector<std::vector<std::string>>{{"1", ""}, {"·", "m²"}}));
}

}  // namespace
}  // namespace flexarm::report::page
