#include "arm/hub_torque_table.hpp"

#include "arm/input_error.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <ostream>
#include <string>

namespace flexarm::arm {
namespace {

constexpr double kAnyAngle = 0.37;
constexpr double kRounding = 1e-15;

TEST(HubTorqueTable, OverVelocityIsLinearBetweenThePlacesAndConstantBeyond) {
  const HubTorqueTable table{.velocity_rad_per_s = {-1.0, 0.5, 2.0},
                             .torque_N_m = {0.03, 0.0, -0.06}};
  EXPECT_NO_THROW(require_valid(table));
  const auto at = [&](double velocity) { return table.smooth(kAnyAngle, velocity); };
  EXPECT_EQ(at(-7.0).torque_N_m, 0.03);
  EXPECT_EQ(at(-7.0).per_velocity_N_m_s, 0.0);
  EXPECT_EQ(at(-1.0).torque_N_m, 0.03);
  EXPECT_NEAR(at(-0.25).torque_N_m, 0.015, kRounding);
  EXPECT_NEAR(at(-0.25).per_velocity_N_m_s, -0.02, kRounding);
  EXPECT_EQ(at(0.5).torque_N_m, 0.0);
  EXPECT_NEAR(at(1.0).torque_N_m, -0.02, kRounding);
  EXPECT_NEAR(at(1.0).per_velocity_N_m_s, -0.04, kRounding);
  EXPECT_EQ(at(2.0).torque_N_m, -0.06);
  EXPECT_EQ(at(9.0).torque_N_m, -0.06);
  EXPECT_EQ(at(9.0).per_velocity_N_m_s, 0.0);
  EXPECT_EQ(table.friction_N_m(), 0.0);
}

TEST(HubTorqueTable, OverAngleDoesNotDependOnVelocity) {
  const HubTorqueTable table{.angle_rad = {-0.5, 0.5}, .torque_N_m = {0.1, -0.1}};
  EXPECT_NO_THROW(require_valid(table));
  for (const double velocity : {-3.0, 0.0, 5.0}) {
    EXPECT_NEAR(table.smooth(0.25, velocity).torque_N_m, -0.05, kRounding);
    EXPECT_EQ(table.smooth(0.25, velocity).per_velocity_N_m_s, 0.0);
    EXPECT_EQ(table.smooth(4.0, velocity).torque_N_m, -0.1);
  }
}

TEST(HubTorqueTable, OverBothIsBilinear) {
  const HubTorqueTable table{.angle_rad = {0.0, 1.0, 3.0},
                             .velocity_rad_per_s = {-1.0, 1.0},
                             .torque_N_m = {0.0, 0.4, 1.0, 2.0, 5.0, 3.0}};
  EXPECT_NO_THROW(require_valid(table));
  // a + b angle + c velocity + d angle velocity through the four corners of a cell.
  EXPECT_NEAR(table.smooth(0.5, 0.0).torque_N_m, 0.25 * (0.0 + 0.4 + 1.0 + 2.0), kRounding);
  EXPECT_NEAR(table.smooth(0.5, 0.0).per_velocity_N_m_s, 0.5 * (0.2 + 0.5), kRounding);
  EXPECT_NEAR(table.smooth(2.0, 0.5).torque_N_m,
              0.5 * (0.25 * 1.0 + 0.75 * 2.0) + 0.5 * (0.25 * 5.0 + 0.75 * 3.0), kRounding);
  EXPECT_EQ(table.smooth(7.0, -3.0).torque_N_m, 5.0);
  EXPECT_NEAR(table.smooth(-1.0, 0.5).torque_N_m, 0.3, kRounding);
}

TEST(HubTorqueTable, JumpsWhereTheVelocityZeroStandsTwice) {
  const HubTorqueTable table{.velocity_rad_per_s = {-2.0, 0.0, 0.0, 2.0},
                             .torque_N_m = {0.05, 0.03, -0.01, -0.05}};
  EXPECT_NO_THROW(require_valid(table));
  EXPECT_NEAR(table.friction_N_m(), 0.02, kRounding);
  const auto at = [&](double velocity) { return table.smooth(kAnyAngle, velocity).torque_N_m; };
  EXPECT_NEAR(at(0.0), 0.01, kRounding);
  EXPECT_NEAR(at(-1e-300), 0.01, kRounding);
  EXPECT_NEAR(at(1e-300), 0.01, kRounding);
  // With the friction it is the table again.
  EXPECT_NEAR(at(-1.0) + 0.02, 0.04, kRounding);
  EXPECT_NEAR(at(1.0) - 0.02, -0.03, kRounding);
  EXPECT_NEAR(at(5.0) - 0.02, -0.05, kRounding);
}

TEST(HubTorqueTable, MayHaveTheJumpAtAnEnd) {
  const HubTorqueTable table{.velocity_rad_per_s = {0.0, 0.0, 1.0},
                             .torque_N_m = {0.01, -0.01, -0.03}};
  EXPECT_NO_THROW(require_valid(table));
  EXPECT_NEAR(table.friction_N_m(), 0.01, kRounding);
  EXPECT_NEAR(table.smooth(0.0, -4.0).torque_N_m, 0.0, kRounding);
  EXPECT_NEAR(table.smooth(0.0, 1.0).torque_N_m, -0.02, kRounding);
}

struct WrongTable {
  const char* name;
  HubTorqueTable table;
  std::string error;
};

void PrintTo(const WrongTable& wrong, std::ostream* out) {
  *out << wrong.name;
}

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
const std::string kKey = "effects.measured_hub_torque";

const std::vector<WrongTable> kWrongTables = {
    {"WithoutAnAxis", {{}, {}, {0.1}}, kKey + ": needs angle_rad, velocity_rad_per_s or both"},
    {"OnePlace",
     {{}, {1.0}, {0.1}},
     kKey + ".velocity_rad_per_s: has one place; needs two or more"},
    {"Descends",
     {{}, {0.0, 1.0, 0.5}, {0.1, 0.1, 0.1}},
     kKey + ".velocity_rad_per_s: 0.5 at place 3 is not above 1; must ascend; 0 alone may stand "
            "twice, for dry friction"},
    {"AngleTwice",
     {{0.0, 0.0, 1.0}, {}, {0.1, 0.1, 0.1}},
     kKey + ".angle_rad: 0 at place 2 is not above 0; must ascend"},
    {"AnotherVelocityTwice",
     {{}, {0.0, 1.0, 1.0}, {0.1, 0.1, 0.1}},
     kKey + ".velocity_rad_per_s: 1 at place 3 is not above 1; must ascend; 0 alone may stand "
            "twice, for dry friction"},
    {"ZeroThrice",
     {{}, {0.0, 0.0, 0.0}, {0.1, 0.1, 0.1}},
     kKey + ".velocity_rad_per_s: 0 at place 3 is not above 0; must ascend; 0 alone may stand "
            "twice, for dry friction"},
    {"VelocityNotFinite",
     {{}, {0.0, kNaN}, {0.1, 0.1}},
     kKey + ".velocity_rad_per_s: nan at place 2; must be finite"},
    {"TorqueNotFinite",
     {{}, {0.0, 1.0}, {0.1, kNaN}},
     kKey + ".torque_N_m: nan at place 2; must be finite"},
    {"TooFewTorques",
     {{0.0, 1.0}, {0.0, 1.0}, {0.1, 0.1, 0.2}},
     kKey + ".torque_N_m: has 3 values; must have 4 (angles 2, velocities 2)"},
    {"FrictionThatDrives",
     {{}, {0.0, 0.0}, {-0.1, 0.1}},
     kKey + ".torque_N_m: rises by 0.2 N m at velocity 0; dry friction acts against the motion, so "
            "that it must fall there"},
    {"FrictionOfTheAngle",
     {{0.0, 1.0}, {0.0, 0.0}, {0.1, -0.1, 0.2, -0.2}},
     kKey +
         ".torque_N_m: falls by 0.2 N m at velocity 0 at the first angle, by 0.4 N m at angle 2; "
         "must be the same at every angle"}};

class HubTorqueTableMistake : public testing::TestWithParam<WrongTable> {};

TEST_P(HubTorqueTableMistake, IsNamed) {
  try {
    require_valid(GetParam().table);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), GetParam().error);
  }
}

INSTANTIATE_TEST_SUITE_P(, HubTorqueTableMistake, testing::ValuesIn(kWrongTables),
                         [](const auto& wrong) { return std::string(wrong.param.name); });

}  // namespace
}  // namespace flexarm::arm
