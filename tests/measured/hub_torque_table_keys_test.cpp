// A measured law of hub torque in an arm file.
#include "arm/given_effects.hpp"
#include "arm/input_error.hpp"
#include "effects/registry/vocabulary.hpp"
#include "measured/files/arm_file.hpp"

#include <gtest/gtest.h>

#include <ostream>
#include <random>
#include <string>
#include <variant>
#include <vector>

namespace flexarm::measured {
namespace {

using namespace arm;

const std::string kHubAlone = "[hub]\ninertia = 0.1\n";
const std::string kTable = "[effects.measured_hub_torque]\n";

Arm hub_with(const std::string& text) {
  return parse_arm(kHubAlone + text, "hub.toml", effects::vocabulary());
}

const HubTorqueTable& table_of(const Arm& arm) {
  return std::get<HubTorqueTable>(arm.effects.at(std::string(kHubTorqueTable)).definition->given);
}

TEST(HubTorqueTableFile, HasOneAxisOrBoth) {
  const Arm velocity = hub_with(
      kTable + "velocity_rad_per_s = [-1, 0.0, 0, 1]\ntorque_N_m = [0.2, 0.1, -0.1, -0.2]\n");
  EXPECT_EQ(table_of(velocity), (HubTorqueTable{.velocity_rad_per_s = {-1.0, 0.0, 0.0, 1.0},
                                                .torque_N_m = {0.2, 0.1, -0.1, -0.2}}));
  const Arm both = hub_with(kTable +
                            "angle_rad = [0, 1]\nvelocity_rad_per_s = [-1, 0, 1]\n"
                            "torque_N_m = [[1, 2, 3], [4, 5, 6.5]]\n");
  EXPECT_EQ(table_of(both), (HubTorqueTable{.angle_rad = {0.0, 1.0},
                                            .velocity_rad_per_s = {-1.0, 0.0, 1.0},
                                            .torque_N_m = {1.0, 2.0, 3.0, 4.0, 5.0, 6.5}}));
}

TEST(HubTorqueTableFile, IsWrittenInAFormToRead) {
  Arm arm = hub_with("");
  arm.effects[std::string(kHubTorqueTable)] = {
      .definition = define_effect(HubTorqueTable{.angle_rad = {0.0, 1.0},
                                                 .velocity_rad_per_s = {-1.0, 1.0},
                                                 .torque_N_m = {0.25, 2.0, 3.0, 4.0}})};
  EXPECT_EQ(format_arm(arm),
            "\n[hub]\ninertia = 0.1  # kg m^2\n"
            "\n[effects.measured_hub_torque]\n"
            "angle_rad = [0.0, 1.0]\n"
            "velocity_rad_per_s = [-1.0, 1.0]\n"
            "torque_N_m = [\n  [0.25, 2.0],\n  [3.0, 4.0]\n]\n");
}

TEST(HubTorqueTableFile, IsReadBackBitForBit) {
  std::mt19937_64 random(20261122);
  std::uniform_real_distribution<double> step(1e-9, 3.0);
  std::normal_distribution<double> torque(0.0, 0.1);
  for (int i = 0; i < 200; ++i) {
    HubTorqueTable table;
    const auto axis = [&](std::size_t places) {
      std::vector<double> made;
      double at = -2.0 * step(random);
      for (std::size_t k = 0; k < places; ++k) made.push_back(at += step(random));
      return made;
    };
    if (i % 3 != 0) table.angle_rad = axis(2 + random() % 5);
    if (i % 3 != 1) table.velocity_rad_per_s = axis(2 + random() % 5);
    const std::size_t rows = table.angle_rad.empty() ? 1 : table.angle_rad.size();
    for (std::size_t k = 0; k < rows * table.columns(); ++k) {
      table.torque_N_m.push_back(torque(random));
    }
    Arm arm = hub_with("");
    arm.effects[std::string(kHubTorqueTable)] = {.definition = define_effect(table)};
    const std::string text = format_arm(arm);
    const Arm again = parse_arm(text, "again", effects::vocabulary());
    EXPECT_EQ(again, arm) << text;
    EXPECT_EQ(table_of(again), table);
    EXPECT_EQ(format_arm(again), text);
  }
}

struct TableMistake {
  const char* name;
  std::string text;  ///< behind the hub, which has two lines
  std::string error;
};

void PrintTo(const TableMistake& mistake, std::ostream* out) {
  *out << mistake.name;
}

const std::string kOf = "effects.measured_hub_torque";

const std::vector<TableMistake> kTableMistakes = {
    {"NoTable", "[effects]\nmeasured_hub_torque = 3\n",
     "4: " + kOf +
         " = 3: a number; must be a table with angle_rad, velocity_rad_per_s or both, and "
         "torque_N_m"},
    {"KeyMisspelt", kTable + "velocity = [0, 1]\ntorque_N_m = [0, 1]\n",
     "4: " + kOf +
         ".velocity: unknown key (did you mean velocity_rad_per_s?); allowed: angle_rad, "
         "velocity_rad_per_s, torque_N_m"},
    {"Formula", kTable + "hub_torque = \"-theta\"\n",
     "4: " + kOf + ".hub_torque: unknown key; allowed: angle_rad, velocity_rad_per_s, torque_N_m"},
    {"AxisAsANumber", kTable + "velocity_rad_per_s = 1\ntorque_N_m = [0, 1]\n",
     "4: " + kOf + ".velocity_rad_per_s = 1: a number; must be a list of numbers"},
    {"AxisEmpty", kTable + "angle_rad = []\ntorque_N_m = [0, 1]\n",
     "4: " + kOf + ".angle_rad: an array; must be a list of numbers"},
    {"TextInAList", kTable + "angle_rad = [0, \"1\"]\ntorque_N_m = [0, 1]\n",
     "4: " + kOf + ".angle_rad = \"1\": a string; must be a list of numbers"},
    {"TorqueMissing", kTable + "angle_rad = [0, 1]\n",
     "3: " + kOf + ".torque_N_m: has 0 values; must have 2 (angles 2, velocities 1)"},
    {"AxesMissing", kTable + "torque_N_m = [0, 1]\n",
     "3: " + kOf + ": needs angle_rad, velocity_rad_per_s or both"},
    {"Descends", kTable + "angle_rad = [1, 0]\ntorque_N_m = [0, 1]\n",
     "4: " + kOf + ".angle_rad: 0 at place 2 is not above 1; must ascend"},
    {"FlatTorquesOfBoth",
     kTable + "angle_rad = [0, 1]\nvelocity_rad_per_s = [0, 1]\ntorque_N_m = [0, 1, 2, 3]\n",
     "6: " + kOf +
         ".torque_N_m: an array; must be a list with a list for each angle, of the torques at the "
         "velocities"},
    {"RowsOfUnlikeLength",
     kTable + "angle_rad = [0, 1]\nvelocity_rad_per_s = [0, 1]\ntorque_N_m = [[0, 1], [2]]\n",
     "6: " + kOf + ".torque_N_m: 1 torques at one angle, 2 at the first; must be as many"}};

class TableFileMistake : public testing::TestWithParam<TableMistake> {};

TEST_P(TableFileMistake, IsNamedWithItsLine) {
  try {
    hub_with(GetParam().text);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), "hub.toml:" + GetParam().error);
  }
}

INSTANTIATE_TEST_SUITE_P(, TableFileMistake, testing::ValuesIn(kTableMistakes),
                         [](const auto& mistake) { return std::string(mistake.param.name); });

}  // namespace
}  // namespace flexarm::measured
