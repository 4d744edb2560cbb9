#include "arm/input_error.hpp"
#include "effects/registry/vocabulary.hpp"
#include "measured/files/arm_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ostream>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::measured {
namespace {

using namespace arm;

constexpr std::string_view kGood = R"(name = "rig"
[beam]
length = 0.96
width = 0.019
thickness = 0.0032
density = 2710
youngs_modulus = 7.11e10
[hub]
inertia = 5.86e-4
# end
)";

/// A way to get a file wrong: in the good one the first `old_text` becomes `new_text`. The error is
/// "rig.toml:" and `error`.
struct Mistake {
  const char* name;
  std::string_view old_text;
  std::string_view new_text;
  std::string error;
};

void PrintTo(const Mistake& mistake, std::ostream* out) {
  *out << mistake.name;
}

const std::string kTopLevel =
    "; allowed: name, [beam], [hub], [payload], [damping], [effects.NAME]";
const std::string kBeamKeys =
    "; allowed in [beam]: length, width, thickness, density, youngs_modulus, shear_modulus, "
    "flexural_rigidity, linear_density";
const std::string kEffectNames = [] {
  std::string names;
  for (const auto& definition : effects::vocabulary()) {
    names += (names.empty() ? "; allowed: " : ", ") + definition->name;
  }
  return names;
}();
const std::string kSensorNames =
    "; allowed: hub_angle, hub_velocity, tip_acceleration, tip_displacement, tip_deflection, "
    "strain@X (X in metres from the hub)";
const std::string kNumberAlone =
    "write the number alone; its unit may follow as a comment, after #";

const std::vector<Mistake> kMistakes = {
    {"KeyMisspelt", "length", "lenght",
     "3: beam.lenght: unknown key (did you mean length?)" + kBeamKeys},
    {"TableMisspelt", "[beam]", "[baem]",
     "2: baem: unknown table (did you mean beam?)" + kTopLevel},
    {"TableInCapitals", "[beam]", "[Beam]",
     "2: Beam: unknown table (did you mean beam?)" + kTopLevel},
    {"UnitInTheKey",
     "length =", "length_m =", "3: beam.length_m: unknown key (did you mean length?)" + kBeamKeys},
    {"SymbolForTheKey", "youngs_modulus", "E",
     "7: beam.E: unknown key (did you mean youngs_modulus?)" + kBeamKeys},
    {"SymbolOfTheHub", "inertia =", "Ih =",
     "9: hub.Ih: unknown key (did you mean inertia?); allowed in [hub]: inertia, viscous_friction"},
    {"KeyInAnotherTable", "[hub]\n", "mass = 0.1\n[hub]\n",
     "8: beam.mass: unknown key (did you mean payload.mass?)" + kBeamKeys},
    {"TableForgotten", "[beam]\n", "",
     "2: length: unknown key (did you mean beam.length?)" + kTopLevel},
    {"KeyWithALineFeed", "width", "\"wi\\ndth\"", "4: beam.wi\\x0adth: unknown key" + kBeamKeys},
    {"KeyOfAMeasurement", "# end\n", "[[run]]\n", "10: run: unknown key" + kTopLevel},
    {"EffectAtTheTop", "# end\n", "[coulomb_friction]\ntorque = 0.01\n",
     "10: coulomb_friction: unknown table (did you mean effects.coulomb_friction?)" + kTopLevel},
    {"EffectsInTheSingular", "# end\n", "[effect.coulomb_friction]\ntorque = 0.01\n",
     "10: effect: unknown table (did you mean effects?)" + kTopLevel},
    {"EffectMisspelt", "# end\n", "[effects.columb_friction]\ntorque = 0.01\n",
     "10: effects.columb_friction: unknown effect (did you mean coulomb_friction?)" + kEffectNames +
         "; a law of your own needs the key hub_torque"},
    {"EffectWithoutATable", "# end\n", "[effects]\ncoulomb_friction = 0.01\n",
     "11: effects.coulomb_friction = 0.01: a number; must be a table: a line "
     "[effects.coulomb_friction], then its keys torque"},
    {"EffectSwitchedOnByTrue", "# end\n", "[effects]\ngravity = true\n",
     "11: effects.gravity = true: a boolean; must be a table: a line [effects.gravity], then its "
     "keys acceleration"},
    {"EffectsAsANumber", "name = \"rig\"", "effects = 3",
     "1: effects = 3: a number; must be a table: a line [effects], then its keys"},
    {"PayloadInQuotes", "# end\n", "[payload]\nmass = '1'\n",
     "11: payload.mass = \"1\": a string; must be a finite number, 0 or more [kg], without quotes "
     "or unit"},
    {"EffectParameterMisspelt", "# end\n", "[effects.coulomb_friction]\ntorqe = 0.01\n",
     "11: effects.coulomb_friction.torqe: unknown key (did you mean torque?); allowed: torque"},
    {"EffectParameterMissing", "# end\n",
     "[effects.stribeck_friction]\ntorque = 0.01\nvelocity = 0.1\n",
     "10: effects.stribeck_friction.static_torque: missing; must be a finite number, 0 or more [N "
     "m]"},
    {"EffectParameterNegative", "# end\n", "[effects.coulomb_friction]\ntorque = -0.01\n",
     "11: effects.coulomb_friction.torque = -0.01 N m: must be a finite number, 0 or more"},
    {"EffectParameterInQuotes", "# end\n", "[effects.coulomb_friction]\ntorque = '0.01'\n",
     "11: effects.coulomb_friction.torque = \"0.01\": a string; must be a finite number, 0 or more "
     "[N m], without quotes or unit"},
    {"CrackBeyondTheBeam", "# end\n",
     "[effects.local_stiffness_loss]\nposition = 1.5\nstiffness = 10\n",
     "11: effects.local_stiffness_loss.position = 1.5 m: must be 0 or more and less than the "
     "beam's length, 0.96 m"},
    {"SensorMisspelt", "# end\n",
     "[effects.sensor_lag]\ntime_constant = 1e-3\nsensor = 'hub_angel'\n",
     "12: effects.sensor_lag.sensor: sensor hub_angel: unknown (did you mean hub_angle?)" +
         kSensorNames},
    {"SensorAsANumber", "# end\n", "[effects.sensor_lag]\ntime_constant = 1e-3\nsensor = 3\n",
     "12: effects.sensor_lag.sensor = 3: a number; must be a quoted sensor name, e.g. "
     "\"tip_acceleration\""},
    {"SensorOfAnotherEffect", "# end\n",
     "[effects.actuator_lag]\ntime_constant = 1e-3\nsensor = 'hub_angle'\n",
     "12: effects.actuator_lag.sensor: unknown key; allowed: time_constant"},
    {"SensorBeyondTheBeam", "# end\n",
     "[effects.sensor_lag]\ntime_constant = 1e-3\nsensor = 'strain@2'\n",
     "12: effects.sensor_lag.sensor: sensor strain@2: position must be from 0 to the beam's "
     "length, 0.96 m"},
    {"NumberInQuotes", "0.96", "\"0.96\"",
     "3: beam.length = \"0.96\": a string; must be a finite number above 0 [m], without quotes or "
     "unit"},
    {"NumberWithUnitInQuotes", "0.96", "\"960 mm\"",
     "3: beam.length = \"960 mm\": a string; must be a finite number above 0 [m], without quotes "
     "or unit"},
    {"LongTextForANumber", "0.96",
     "\"abcdefghijabcdefghijabcdefghijabcdefghijabcdefghijabcdefghijabcdefghijabcdefghij\"",
     "3: beam.length = \"abcdefghijabcdefghijabcdefghijabcdefghijabcdefghijabcdefghij...\": a "
     "string; must be a finite number above 0 [m], without quotes or unit"},
    {"Boolean", "0.96", "true",
     "3: beam.length = true: a boolean; must be a finite number above 0 [m]"},
    {"Array", "0.96", "[0.96]", "3: beam.length: an array; must be a finite number above 0 [m]"},
    {"TableForANumber",
     "length =", "length.m =", "3: beam.length: a table; must be a finite number above 0 [m]"},
    {"InlineTableForANumber", "0.96", "{ value = 0.96, unit = \"m\" }",
     "3: beam.length: a table; must be a finite number above 0 [m]"},
    {"Date", "0.96", "2024-01-02",
     "3: beam.length: a date or time; must be a finite number above 0 [m]"},
    {"Negative", "0.96", "-0.96", "3: beam.length = -0.96 m: must be a finite number above 0"},
    {"Zero", "0.96", "0", "3: beam.length = 0 m: must be a finite number above 0"},
    {"NotANumber", "0.96", "nan", "3: beam.length = nan m: must be a finite number above 0"},
    {"Infinite", "0.96", "inf", "3: beam.length = inf m: must be a finite number above 0"},
    {"TooLargeForADouble", "0.96", "1e999",
     "3: not TOML: floating-point: '1e999' could not be interpreted as a value; the line reads: "
     "length = 1e999"},
    {"HubInertiaNegative", "5.86e-4", "-5.86e-4",
     "9: hub.inertia = -0.000586 kg m^2: must be a finite number, 0 or more"},
    {"LengthMissing", "length = 0.96\n", "",
     "2: beam.length: missing; must be a finite number above 0 [m]"},
    {"HubMissing", "[hub]\ninertia = 5.86e-4\n", "",
     "1: hub.inertia: missing; must be a finite number, 0 or more [kg m^2]"},
    {"HubInertiaMissing", "inertia = 5.86e-4\n", "",
     "8: hub.inertia: missing; must be a finite number, 0 or more [kg m^2]"},
    {"ModulusMissing", "youngs_modulus = 7.11e10\n", "",
     "2: beam.flexural_rigidity: missing; give it [N m^2], or width, thickness and youngs_modulus"},
    {"DensityMissing", "density = 2710\n", "",
     "2: beam.linear_density: missing; give it [kg/m], or width, thickness and density"},
    {"TwoRigiditiesThatDisagree", "[hub]\n", "flexural_rigidity = 36.9\n[hub]\n",
     "8: beam.flexural_rigidity = 36.9 N m^2 differs from 3.68886 N m^2 computed from dimensions "
     "and "
     "material: give one of them, or two that agree within 0.1 %"},
    {"TwoDensitiesThatDisagree", "[hub]\n", "linear_density = 0.5\n[hub]\n",
     "8: beam.linear_density = 0.5 kg/m differs from 0.164768 kg/m computed from dimensions and "
     "material: "
     "give one of them, or two that agree within 0.1 %"},
    {"RigidityThatOverflows", "youngs_modulus = 7.11e10", "youngs_modulus = 1e308\nwidth = 1e10\n#",
     "8: not TOML: key-value pair: cannot redefine existing floating-point 'width'; the line "
     "reads: width = 1e10"},
    {"NameAsANumber", "\"rig\"", "7", "1: name = 7: a number; must be a quoted string"},
    {"NameWithoutQuotes", "\"rig\"", "rig",
     "1: not TOML: value: could not determine value type; write text in quotes; the line reads: "
     "name = rig"},
    {"TableAsANumber", "name = \"rig\"\n[beam]\n", "beam = 3\n[x]\n",
     "1: beam = 3: a number; must be a table: a line [beam], then its keys"},
    {"ArrayOfTables", "[beam]", "[[beam]]",
     "2: beam: an array; must be a table: a line [beam], then its keys"},
    {"DecimalComma", "0.96", "0,96",
     "3: not TOML: key-value pair: expected a comment or whitespace, saw ','; write numbers with a "
     "decimal point and no comma; the line reads: length = 0,96"},
    {"ThousandsComma", "2710", "2,710",
     "6: not TOML: key-value pair: expected a comment or whitespace, saw ','; write numbers with a "
     "decimal point and no comma; the line reads: density = 2,710"},
    {"NoDigitBeforeThePoint", "0.96", ".96",
     "3: not TOML: floating-point: expected decimal digit, saw '.'; write a digit before the "
     "point, as in 0.5; the line reads: length = .96"},
    {"NoDigitAfterThePoint", "0.96", "1.",
     "3: not TOML: floating-point: expected decimal digit, the line ended; write a digit after the "
     "point, as in 1.0; the line reads: length = 1."},
    {"UnitAfterTheNumber", "0.96", "960 mm",
     "3: not TOML: key-value pair: expected a comment or whitespace, saw 'm'; " + kNumberAlone +
         "; the line reads: length = 960 mm"},
    {"UnitTouchingTheNumber", "0.96", "0.96m",
     "3: not TOML: floating-point: expected decimal digit, saw 'm'; " + kNumberAlone +
         "; the line reads: length = 0.96m"},
    {"UnitInBrackets", "0.96", "0.96 [m]",
     "3: not TOML: key-value pair: expected a comment or whitespace, saw '['; " + kNumberAlone +
         "; the line reads: length = 0.96 [m]"},
    {"FortranExponent", "7.11e10", "7.11d10",
     "7: not TOML: floating-point: expected decimal digit, saw 'd'; write the exponent with e, as "
     "in 1e-3; the line reads: youngs_modulus = 7.11d10"},
    {"Product", "7.11e10", "7.11*10^10",
     "7: not TOML: floating-point: expected decimal digit, saw '*'; write one number, not an "
     "expression; the line reads: youngs_modulus = 7.11*10^10"},
    {"Fraction", "0.96", "96/100",
     "3: not TOML: decimal integer: expected digit, saw '/'; write one number, not an expression; "
     "the line reads: length = 96/100"},
    {"Colon", "length =", "length:",
     "3: not TOML: key-value pair: expected '=', saw ':'; write key = value, with an equals sign; "
     "the line reads: length: 0.96"},
    {"NoEqualsSign", "length =", "length",
     "3: not TOML: key-value pair: expected '=', saw '0'; write key = value, with an equals sign; "
     "the line reads: length 0.96"},
    {"NoValue", "0.96", "",
     "3: not TOML: key-value pair: expected value, the line ended; the line reads: length = "},
    {"BracketNotClosed", "[beam]", "[beam",
     "2: not TOML: table header: expected ']', the line ended; the line reads: [beam"},
    {"KeyTwice", "width = 0.019", "length = 0.97",
     "4: not TOML: key-value pair: cannot redefine existing floating-point 'length'; the line "
     "reads: length = 0.97"},
    {"TableTwice", "# end\n", "[beam]\nwidth = 1\n",
     "10: not TOML: table header: cannot redefine existing table 'beam'; the line reads: [beam]"},
    {"PercentComment", "0.96", "0.96 % m",
     "3: not TOML: key-value pair: expected a comment or whitespace, saw '%'; a comment begins "
     "with #; the line reads: length = 0.96 % m"},
    {"SlashComment", "0.96", "0.96 // m",
     "3: not TOML: key-value pair: expected a comment or whitespace, saw '/'; a comment begins "
     "with #; the line reads: length = 0.96 // m"},
    {"Semicolon", "0.96", "0.96;",
     "3: not TOML: floating-point: expected decimal digit, saw ';'; end the line without a "
     "semicolon; the line reads: length = 0.96;"},
    {"QuotesNotClosed", "\"rig\"", "\"rig",
     "1: not TOML: string: unescaped control characters other than TAB (U+0009) are explicitly "
     "prohibited; close the quotes on the same line; the line reads: name = \"rig"},
    {"TypographicQuotes", "\"rig\"", "“rig”",
     "1: not TOML: value: could not determine value type; write straight quotes; the line reads: "
     "name = “rig”"},
    {"TypographicMinus", "e-4", "e−4",
     "9: not TOML: floating-point: expected decimal digit, saw '−'; write the minus sign as -; the "
     "line reads: inertia = 5.86e−4"},
    {"NoBreakSpace", "length =", "length =",
     "3: not TOML: key: expected space or tab, saw '\\u00A0'; there is a no-break space; write a "
     "plain one; the line reads: length = 0.96"},
    {"LeadingZero", "2710", "02710",
     "6: not TOML: decimal integer: leading zeroes are prohibited; the line reads: density = "
     "02710"},
    {"IntegerTooLarge", "2710", "99999999999999999999",
     "6: not TOML: decimal integer: '99999999999999999999' is not representable in 64 bits; the "
     "line reads: density = 99999999999999999999"},
    {"TwoMistakes", "width = 0.019", "widht = 0.019\ninirtia = 1",
     "4: beam.widht: unknown key (did you mean width?)" + kBeamKeys},
    {"Empty", kGood, "",
     "1: empty; an arm file needs at least [hub], and [beam] unless it is a rigid hub; flexarm new "
     "writes an example"},
    {"Blank", kGood, " \n\t\n",
     "1: empty; an arm file needs at least [hub], and [beam] unless it is a rigid hub; flexarm new "
     "writes an example"},
    {"CommentsAlone", kGood, "# nothing\n",
     "1: hub.inertia: missing; must be a finite number, 0 or more [kg m^2]"},
    {"BeamEmpty", kGood, "[beam]\n[hub]\ninertia = 1\n",
     "1: beam.length: missing; must be a finite number above 0 [m]"},
    {"NoInertiaWithoutBeam", kGood, "[hub]\ninertia = 0\n",
     "2: hub.inertia = 0 kg m^2: must be above 0 without a [beam]"},
    {"PayloadWithoutBeam", kGood, "[hub]\ninertia = 1\n[payload]\nmass = 0.1\n",
     "4: payload.mass = 0.1 kg: needs a beam; the arm file has no [beam]"},
    {"DampingWithoutBeam", kGood, "[hub]\ninertia = 1\n[damping]\nkelvin_voigt = 1e-4\n",
     "4: damping.kelvin_voigt = 0.0001 s: needs a beam; the arm file has no [beam]"},
    {"EffectOfTheBeamWithoutBeam", kGood,
     "[hub]\ninertia = 1\n[effects.root_compliance]\nstiffness = 30\n",
     "3: effects.root_compliance: needs a beam; the arm file has no [beam]"},
    {"SensorOfTheBeamWithoutBeam", kGood,
     "[hub]\ninertia = 1\n[effects.sensor_lag]\ntime_constant = 1e-3\nsensor = "
     "\"strain@0.05\"\n",
     "5: effects.sensor_lag.sensor: sensor strain@0.05: needs a beam; the arm file has no [beam]"},
    {"Json", kGood, "{\n \"beam\": 1\n}\n",
     "1: not TOML: root table: expected keys, tables, whitespace or comments, saw '{'; the line "
     "reads: {"},
    {"Csv", kGood, "sensor,feature,order\nhub_angle,pole,1\n",
     "1: not TOML: key-value pair: expected '=', saw ','; the line reads: sensor,feature,order"},
    {"Yaml", kGood, "beam:\n  length: 0.96\n",
     "1: not TOML: key-value pair: expected '=', saw ':'; write key = value, with an equals sign; "
     "the line reads: beam:"},
};

class ArmFileMistake : public testing::TestWithParam<Mistake> {};

TEST_P(ArmFileMistake, GivesOneLineWithPlaceReasonAndRemedy) {
  const Mistake& mistake = GetParam();
  std::string text(kGood);
  const auto place = text.find(mistake.old_text);
  ASSERT_NE(place, std::string::npos);
  text.replace(place, mistake.old_text.size(), mistake.new_text);
  try {
    parse_arm(text, "rig.toml", effects::vocabulary());
    FAIL() << "accepted:\n" << text;
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), "rig.toml:" + mistake.error);
  }
}

INSTANTIATE_TEST_SUITE_P(, ArmFileMistake, testing::ValuesIn(kMistakes),
                         [](const auto& mistake) { return std::string(mistake.param.name); });

TEST(ArmFileErrors, TheGoodFileOfTheTableIsGood) {
  EXPECT_NO_THROW(parse_arm(kGood, "rig.toml", effects::vocabulary()));
}

TEST(ArmFileErrors, BytesThatAreNoTextGiveOnePrintableLine) {
  std::string every_byte;
  for (int byte = 0; byte < 256; ++byte) every_byte += static_cast<char>(byte);
  const std::vector<std::string> blobs = {every_byte,
                                          std::string("\x7f"
                                                      "ELF\x02\x01\0\0",
                                                      8),
                                          std::string("\xff\xfe[\0b\0]\0", 8),
                                          "name = \"r\xe9g\"\n",
                                          "name = \"rig\"\r[beam]\rlength = 1\r",
                                          std::string(5000, '[')};
  for (const auto& blob : blobs) {
    try {
      parse_arm(blob, "blob", effects::vocabulary());
      FAIL();
    } catch (const InputError& error) {
      const std::string_view line = error.what();
      EXPECT_TRUE(line.starts_with("blob:1: not TOML: ")) << line;
      for (const char c : line) EXPECT_TRUE(c >= 0x20 && c < 0x7f) << line;
    }
  }
}

TEST(ArmFileErrors, BytesAtRandomGiveAnArmOrOneLine) {
  std::mt19937_64 random(20261120);
  const std::string good = fmt::format(
      "{}[effects.sensor_lag]\ntime_constant = 1e-3\nsensor = \"strain@0.05\"\n", kGood);
  constexpr int kFiles = 5000;
  for (int i = 0; i < kFiles; ++i) {
    std::string text = good;
    for (auto changes = 1 + random() % 4; changes > 0; --changes) {
      const std::size_t place = random() % text.size();
      switch (random() % 3) {
        case 0:
          text[place] = static_cast<char>(random() % 256);
          break;
        case 1:
          text.erase(place, 1 + random() % 8);
          break;
        default:
          text.insert(place, good, random() % good.size(), 1 + random() % 8);
      }
    }
    try {
      parse_arm(text, "rig.toml", effects::vocabulary());
    } catch (const InputError& error) {
      const std::string line = error.what();
      EXPECT_EQ(line.find_first_of("\r\n"), std::string::npos) << line;
      EXPECT_TRUE(line.starts_with("rig.toml:")) << line;
    }
  }
}

TEST(ArmFileErrors, AFileThatIsNotThereIsNamed) {
  try {
    read_arm_file("/nowhere/rig.toml", effects::vocabulary());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "/nowhere/rig.toml: no such file");
  }
}

}  // namespace
}  // namespace flexarm::measured
