// Laws of hub torque that an arm file states.
#include "arm/input_error.hpp"
#include "effects/registry/vocabulary.hpp"
#include "measured/files/arm_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

namespace flexarm::measured {
namespace {

using namespace arm;

const std::string kRig =
    "[beam]\nlength = 1\nflexural_rigidity = 3.7\nlinear_density = 0.16\n[hub]\ninertia = 1e-3\n";

Arm with_table(const std::string& text) {
  return parse_arm(kRig + text, "rig.toml", effects::vocabulary());
}

const HubTorqueFormula& formula_of(const Effect& effect) {
  return std::get<HubTorqueFormula>(effect.definition->given);
}

TEST(StatedEffect, WithAValueForEveryNumberIsAnEffectOfTheArm) {
  const Arm arm = with_table(
      "[effects.my_cable]\nhub_torque = \"-k*theta^3 + b\"\nk = 0.05\n"
      "b = { value = -1e-3, unit = \"N m\" }\n");
  const Effect& effect = arm.effects.at("my_cable");
  EXPECT_EQ(effect.definition->name, "my_cable");
  EXPECT_EQ(formula_of(effect).text, "-k*theta^3 + b");
  EXPECT_EQ(effect.value("k"), 0.05);
  EXPECT_EQ(effect.value("b"), -1e-3);
  ASSERT_EQ(effect.definition->parameters.size(), 2U);
  EXPECT_EQ(effect.definition->parameters[0].name, "b");
  EXPECT_EQ(effect.definition->parameters[0].unit, "N m");
  EXPECT_EQ(effect.definition->parameters[1].unit, "SI");
  EXPECT_TRUE(arm.hypotheses.empty());
}

TEST(StatedEffect, WithARangeInPlaceOfAValueIsAHypothesisAndNotInTheArm) {
  const Arm arm = with_table(
      "[effects.my_cable]\nhub_torque = \"-k*abs(theta)^n*sign(theta)\"\n"
      "k = { range = [0.001, 10], unit = \"N m/rad^n\" }\nn = 3\n");
  EXPECT_TRUE(arm.effects.empty());
  const HubTorqueHypothesis& hypothesis = arm.hypotheses.at("my_cable");
  EXPECT_EQ(hypothesis.ranges, (std::map<std::string, Interval>{{"k", Interval{0.001, 10.0}}}));
  EXPECT_EQ(hypothesis.known, (std::map<std::string, double>{{"n", 3.0}}));
  EXPECT_DOUBLE_EQ(hypothesis.typical().at("k"), 0.1);
  EXPECT_EQ(hypothesis.typical().at("n"), 3.0);
}

TEST(StatedEffect, WithARangeAndAValueIsBoth) {
  const Arm arm = with_table(
      "[effects.my_cable]\nhub_torque = \"-k*theta^3\"\n"
      "k = { value = 0.05, range = [0.001, 10] }\n");
  EXPECT_EQ(arm.effects.at("my_cable").value("k"), 0.05);
  EXPECT_TRUE(arm.hypotheses.at("my_cable").known.empty());
  const Arm without = without_hypotheses(arm);
  EXPECT_TRUE(without.effects.empty());
  EXPECT_EQ(without.hypotheses, arm.hypotheses);
}

TEST(StatedEffect, WithoutNumbersIsAnEffect) {
  EXPECT_EQ(with_table("[effects.a2]\nhub_torque = \"-0.1*theta^3\"\n").effects.count("a2"), 1U);
}

TEST(StatedEffect, IsReadBackAsItWasWritten) {
  for (const std::string& text : std::vector<std::string>{
           "[effects.my_cable]\nhub_torque = \"-k*theta^3\"\nk = 0.1234567890123456789\n",
           "[effects.x]\nhub_torque = '-k*theta^3 - c*omega'\nk = { value = 1e-300, unit = \"N m\" "
           "}\n"
           "c = { range = [-1, 1e300] }\n",
           "[effects.x]\nhub_torque = '-k*theta^3'\nk = { value = 2, range = [1, 3] }\n"
           "[effects.y]\nhub_torque = '-k*theta'\nk = { range = [1, 3], unit = \"N m/rad\" }\n"
           "[effects.coulomb_friction]\ntorque = 0.1\n"}) {
    const Arm arm = with_table(text);
    const std::string written = format_arm(arm);
    EXPECT_EQ(parse_arm(written, "again", effects::vocabulary()), arm) << written;
    EXPECT_EQ(format_arm(parse_arm(written, "again", effects::vocabulary())), written);
  }
}

TEST(StatedEffect, DiffersFromAnotherByFormulaUnitNameOrValue) {
  const auto arm = [](const std::string& name, const std::string& formula, const std::string& k) {
    return with_table(fmt::format("[effects.{}]\nhub_torque = \"{}\"\nk = {}\n", name, formula, k));
  };
  const Arm one = arm("a", "-k*theta^3", "{ value = 1, unit = \"N m\" }");
  EXPECT_EQ(arm("a", "-k*theta^3", "{ value = 1, unit = \"N m\" }"), one);
  EXPECT_NE(arm("b", "-k*theta^3", "{ value = 1, unit = \"N m\" }"), one);
  EXPECT_NE(arm("a", "-k*theta^5", "{ value = 1, unit = \"N m\" }"), one);
  EXPECT_NE(arm("a", "-k*theta^3", "{ value = 1, unit = \"N\" }"), one);
  EXPECT_NE(arm("a", "-k*theta^3", "{ value = 2, unit = \"N m\" }"), one);
}

TEST(StatedEffect, ARigidHubMayHaveOne) {
  const Arm arm = parse_arm(
      "[hub]\ninertia = 0.1\n[effects.my_cable]\nhub_torque = \"-k*theta - 2*omega\"\nk = 3\n",
      "hub.toml", effects::vocabulary());
  EXPECT_EQ(arm.effects.size(), 1U);
}

struct StatedMistake {
  const char* name;
  std::string table;  ///< behind kRig, which has six lines
  std::string error;
};

void PrintTo(const StatedMistake& mistake, std::ostream* out) {
  *out << mistake.name;
}

const std::string kCable = "[effects.my_cable]\nhub_torque = \"-k*theta^3\"\n";
const std::string kNumber =
    "must be a finite number, or a table { value = NUMBER, range = [LOWEST, HIGHEST], unit = "
    "\"UNIT\" }";
const std::string kEnds = "[LOWEST, HIGHEST], two finite numbers in ascending order";

const std::vector<StatedMistake> kStatedMistakes = {
    {"LawThatDoesNotParse", "[effects.my_cable]\nhub_torque = \"-k*(theta\"\nk = 1\n",
     "8: effects.my_cable.hub_torque = \"-k*(theta\": a parenthesis is not closed"},
    {"VariableMisspelt", "[effects.my_cable]\nhub_torque = \"-k*thta^3\"\nk = 1\n",
     "8: effects.my_cable.hub_torque = \"-k*thta^3\": thta: unknown variable (did you mean "
     "theta?); "
     "allowed: theta, omega, tau, t, pi, k; a number of the law needs a key beside hub_torque"},
    {"LawAsANumber", "[effects.my_cable]\nhub_torque = 3\n",
     "8: effects.my_cable.hub_torque = 3: a number; must be a formula in quotes, in theta [rad], "
     "omega [rad/s], tau [N m] and t [s]"},
    {"NumberNotUsed", kCable + "k = 1\nc = 0.1\n",
     "10: effects.my_cable.c: does not stand in the formula (hub_torque = \"-k*theta^3\")"},
    {"NumberMissing", kCable,
     "8: effects.my_cable.hub_torque = \"-k*theta^3\": k: unknown variable; allowed: theta, omega, "
     "tau, t, pi; a number of the law needs a key beside hub_torque"},
    {"NumberInQuotes", kCable + "k = \"0.05\"\n",
     "9: effects.my_cable.k = \"0.05\": a string; " + kNumber},
    {"NumberInfinite", kCable + "k = inf\n", "9: effects.my_cable.k = inf: a number; " + kNumber},
    {"NumberWithoutValue", kCable + "k = { unit = \"N m\" }\n",
     "9: effects.my_cable.k: needs a value, or the range in which it is to be found"},
    {"PropertyMisspelt", kCable + "k = { valeu = 1 }\n",
     "9: effects.my_cable.k.valeu: unknown key (did you mean value?); allowed: value, range, unit"},
    {"ValueInQuotes", kCable + "k = { value = \"1\" }\n",
     "9: effects.my_cable.k.value = \"1\": a string; must be a finite number"},
    {"UnitAsANumber", kCable + "k = { value = 1, unit = 2 }\n",
     "9: effects.my_cable.k.unit = 2: a number; must be a text in quotes, such as \"N m/rad^3\""},
    {"RangeEmpty", kCable + "k = { range = [10, 0.001] }\n",
     "9: effects.my_cable.k.range = [10, 0.001]: is empty; must be " + kEnds},
    {"RangeOfOnePlace", kCable + "k = { range = [2, 2] }\n",
     "9: effects.my_cable.k.range = [2, 2]: is empty; must be " + kEnds},
    {"RangeOfThree", kCable + "k = { range = [1, 2, 3] }\n",
     "9: effects.my_cable.k.range: an array; must be " + kEnds},
    {"RangeInQuotes", kCable + "k = { range = \"1 to 2\" }\n",
     "9: effects.my_cable.k.range = \"1 to 2\": a string; must be " + kEnds},
    {"RangeWithoutEnd", kCable + "k = { range = [1, inf] }\n",
     "9: effects.my_cable.k.range: an array; must be " + kEnds},
    {"ValueOutOfItsRange", kCable + "k = { value = 20, range = [0.001, 10] }\n",
     "9: effects.my_cable.k.value = 20: must be within its range, 0.001 to 10"},
    {"NameOfALibraryEffect", "[effects.hub_spring]\nhub_torque = \"-k*theta\"\nk = 1\n",
     "8: effects.hub_spring.hub_torque: hub_spring is an effect of the library; a law of your own "
     "needs another name"},
    {"NameWithABlank", "[effects.\"my cable\"]\nhub_torque = \"-k*theta\"\nk = 1\n",
     "7: effects.my cable: the name of a stated law must be letters, digits and _"},
    {"NumberNamedAsAVariable", "[effects.my_cable]\nhub_torque = \"-t*theta\"\nt = 1\n",
     "9: effects.my_cable.t: a variable, constant or function of formulas has this name; a number "
     "needs another (hub_torque = \"-t*theta\")"},
    {"LawThatJumps", "[effects.my_cable]\nhub_torque = \"omega > 0 ? -k : k\"\nk = 1\n",
     "8: effects.my_cable.hub_torque: jumps at omega = 0; dry friction is written with "
     "sign(omega)"}};

class StatedEffectMistake : public testing::TestWithParam<StatedMistake> {};

TEST_P(StatedEffectMistake, IsNamedWithItsLine) {
  try {
    with_table(GetParam().table);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), "rig.toml:" + GetParam().error);
  }
}

INSTANTIATE_TEST_SUITE_P(, StatedEffectMistake, testing::ValuesIn(kStatedMistakes),
                         [](const auto& mistake) { return std::string(mistake.param.name); });

}  // namespace
}  // namespace flexarm::measured
