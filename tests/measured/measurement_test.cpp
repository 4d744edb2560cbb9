#include "measured/files/measurement.hpp"

#include "arm/input_error.hpp"
#include "measured/files/text_file.hpp"
#include "tests/measured/mistake.hpp"

#include <gtest/gtest.h>

#include <random>

namespace flexarm::measured {
namespace {

const std::string kMeasurementHead = "name = \"bench\"\narm = \"arm.toml\"\n";
const std::string kRun = "[[run]]\nid = \"a\"\nkind = \"time\"\nfile = \"a.csv\"\n";

TEST(Measurement, EveryKeyReachesItsMember) {
  const Measurement measurement = parse_measurement(
      kMeasurementHead + kRun +
          "purpose = \"validation\"\ntorque_hold = \"first\"\ninitial = \"free\"\n"
          "payload = { mass = 0.06, inertia = 1 }\n[[run]]\nid = \"b\"\nkind = \"modal\"\n"
          "file = \"b.csv\"\npayload = { mass = 0 }\n",
      "m.toml");
  EXPECT_EQ(measurement.name, "bench");
  EXPECT_EQ(measurement.arm, "arm.toml");
  ASSERT_EQ(measurement.runs.size(), 2U);
  EXPECT_EQ(measurement.runs[0],
            (measured::Run{"a", RunKind::time, "a.csv", Purpose::validation, TorqueHold::first,
                           arm::Payload{0.06, 1.0}, InitialState::free}));
  EXPECT_EQ(measurement.runs[1],
            (measured::Run{"b", RunKind::modal, "b.csv", std::nullopt, TorqueHold::zero,
                           arm::Payload{}, InitialState::rest}));
}

TEST(Measurement, ColumnsAreMappedByStandardName) {
  const Measurement measurement = parse_measurement(
      kMeasurementHead + kRun +
          "columns = { time = { name = \"Time (ms)\", unit = \"ms\" }, torque = { name = \"Vm\", "
          "unit = \"V\", scale = 0.0215 }, \"strain@0.050\" = { name = \"eps\" } }\n",
      "m.toml");
  EXPECT_EQ(measurement.runs[0].columns, (ColumnMappings{{"time", {"Time (ms)", "ms", 1.0}},
                                                         {"torque", {"Vm", "V", 0.0215}},
                                                         {"strain@0.05", {"eps", "", 1.0}}}));
}

TEST(Measurement, AColumnMayBeComputed) {
  const Measurement measurement = parse_measurement(
      kMeasurementHead + kRun +
          "columns.torque = { expression = \"0.1574*(V - 0.518*omega)\" }\n"
          "columns.hub_velocity = { expression = \"ddt([Angle (deg)])\", unit = \"deg/s\" }\n",
      "m.toml");
  EXPECT_EQ(measurement.runs[0].columns,
            (ColumnMappings{{"torque", {"", "", 1.0, "0.1574*(V - 0.518*omega)"}},
                            {"hub_velocity", {"", "deg/s", 1.0, "ddt([Angle (deg)])"}}}));
}

/// A scale beside such a unit repeats its factor; any other may be meant in the unit or in SI.
TEST(Measurement, AUnitBeyondThoseOfARecordStandsForItsScale) {
  const auto scale_of = [](const std::string& keys) {
    return parse_measurement(
               kMeasurementHead + kRun + "columns.torque = { name = \"T\", unit = " + keys + " }\n",
               "m.toml")
        .runs[0]
        .columns.at("torque")
        .scale;
  };
  EXPECT_EQ(scale_of("\"N cm\""), 0.01);
  EXPECT_EQ(scale_of("\"N cm\", scale = 0.01"), 0.01);
  EXPECT_EQ(scale_of("\"N cm\", scale = -0.01"), -0.01);
  EXPECT_EQ(scale_of("\"N mm\", scale = 0.5"), 0.5);
  EXPECT_EQ(scale_of("\"N mm\""), 1.0);
}

TEST(Measurement, WhatIsLeftOutHasItsDefault) {
  const Measurement measurement = parse_measurement("arm = \"x.toml\"\n" + kRun, "m.toml");
  EXPECT_EQ(measurement.name, "");
  EXPECT_EQ(measurement.runs[0],
            (measured::Run{.id = "a", .file = "a.csv", .torque_hold_is_known = false}));
}

TEST(Measurement, WhatIsWrittenReadsBackEqual) {
  std::mt19937_64 random(20261120);
  const auto chance = [&] { return random() % 2 == 0; };
  Measurement measurement{"quoted \"name\" \\ \n\xc3\xa4", "../arm.toml", {}};
  for (int i = 0; i < 200; ++i) {
    measured::Run run;
    run.id = "run " + std::to_string(i);
    run.file = "a\"b.csv";
    run.kind = static_cast<RunKind>(random() % 3);
    if (chance()) run.purpose = chance() ? Purpose::estimation : Purpose::validation;
    if (chance()) run.torque_hold = TorqueHold::first;
    if (chance()) run.initial = InitialState::free;
    if (chance()) {
      run.payload = arm::Payload{static_cast<double>(random()) * 0x1p-64,
                                 static_cast<double>(random()) * 0x1p-80};
    }
    if (run.kind == RunKind::time && chance()) {
      run.columns = {{"time", {"t \"s\"", "", 1.0}},
                     {"torque", {"", "N mm", 2.0, "[a \"b\"]*2"}},
                     {"strain@0.05", {"eps", "V", static_cast<double>(random()) * 0x1p-70}}};
    }
    measurement.runs.push_back(run);
  }
  EXPECT_EQ(parse_measurement(format_measurement(measurement), "m.toml"), measurement);
}

TEST(Measurement, TheExampleOfTheFormatsDocumentIsRead) {
  const std::string text = measured::read_text_file(FLEXARM_SOURCE_DIR "/docs/formats.md", 1 << 20);
  const auto heading = text.find("\n## Measurement");
  const auto begin = text.find('\n', text.find("```toml", heading)) + 1;
  const Measurement measurement =
      parse_measurement(text.substr(begin, text.find("```", begin) - begin), "docs/formats.md");
  ASSERT_EQ(measurement.runs.size(), 1U);
  EXPECT_EQ(measurement.runs[0].payload->mass_kg, 0.06);
}

TEST(Measurement, FilesStandBesideTheMeasurement) {
  EXPECT_EQ(beside("bench/m.toml", "a.csv"), "bench/a.csv");
  EXPECT_EQ(beside("m.toml", "a.csv"), "a.csv");
  EXPECT_EQ(beside("bench/m.toml", "/data/a.csv"), "/data/a.csv");
}

const std::vector<Mistake> kMeasurementMistakes = {
    {"Empty", " \n", "1: empty; a measurement file needs at least one [[run]]"},
    {"RunMissing", kMeasurementHead, "1: run: missing; must be at least one [[run]]"},
    {"RunIsATable", kMeasurementHead + "[run]\nid = \"a\"\n",
     "3: run: a table; must be one [[run]] table per run"},
    {"KeyMisspelt", kMeasurementHead + "[[runs]]\nid = \"a\"\n",
     "3: runs: unknown key (did you mean run?); allowed: name, arm, run"},
    {"KeyOfARunMisspelt", kMeasurementHead + kRun + "purpos = \"estimation\"\n",
     "7: run.purpos: unknown key (did you mean purpose?); allowed: id, kind, file, purpose, "
     "torque_hold, payload, initial, columns, reference, controller"},
    {"KindUnknown", kMeasurementHead + "[[run]]\nid = \"a\"\nkind = \"tme\"\nfile = \"a.csv\"\n",
     "5: run.kind = \"tme\": must be time or frf or modal (did you mean time?)"},
    {"KindMissing", kMeasurementHead + "[[run]]\nid = \"a\"\nfile = \"a.csv\"\n",
     "3: run.kind: missing; must be \"time\", \"frf\" or \"modal\""},
    {"FileMissing", kMeasurementHead + "[[run]]\nid = \"a\"\nkind = \"time\"\n",
     "3: run.file: missing; must be the run's CSV file, relative to this file"},
    {"FileIsANumber", kMeasurementHead + "[[run]]\nid = \"a\"\nkind = \"time\"\nfile = 3\n",
     "6: run.file = 3: a number; must be a quoted file name"},
    {"IdTwice", kMeasurementHead + kRun + kRun, "8: run.id = \"a\": given twice; first on line 4"},
    {"HoldUnknown", kMeasurementHead + kRun + "torque_hold = \"second\"\n",
     "7: run.torque_hold = \"second\": must be zero or first"},
    {"PurposeIsABoolean", kMeasurementHead + kRun + "purpose = true\n",
     "7: run.purpose = true: a boolean; must be estimation or validation, in quotes"},
    {"PayloadIsANumber", kMeasurementHead + kRun + "payload = 0.06\n",
     "7: run.payload = 0.06: a number; must be a table, as in { mass = 0.06, inertia = 0.0 }"},
    {"PayloadNegative", kMeasurementHead + kRun + "payload = { mass = -0.06 }\n",
     "7: run.payload.mass = -0.06 kg: must be a finite number, 0 or more"},
    {"PayloadMisspelt", kMeasurementHead + kRun + "payload = { mas = 0.06 }\n",
     "7: run.payload.mas: unknown key (did you mean mass?); allowed: mass, inertia"},
    {"ColumnsOfAModalRun",
     kMeasurementHead + "[[run]]\nid = \"a\"\nkind = \"modal\"\nfile = \"a.csv\"\n"
                        "columns = { time = { name = \"t\" } }\n",
     "7: run.columns: only for time runs"},
    {"ColumnOfNoQuantity", kMeasurementHead + kRun + "columns = { hub_angel = { name = \"a\" } }\n",
     "7: run.columns: sensor hub_angel: unknown (did you mean hub_angle?); allowed: hub_angle, "
     "hub_velocity, tip_acceleration, tip_displacement, tip_deflection, strain@X (X in metres from "
     "the hub); besides time and torque"},
    {"ColumnWithoutName", kMeasurementHead + kRun + "columns = { time = { unit = \"ms\" } }\n",
     "7: run.columns.time.name: missing; must be a column of the file, or expression a formula of "
     "its "
     "columns"},
    {"ColumnIsAText", kMeasurementHead + kRun + "columns = { time = \"t\" }\n",
     "7: run.columns.time = \"t\": a string; must be a table, as in { name = \"Time (ms)\", unit = "
     "\"ms\", scale = 1.0 }"},
    {"ColumnsAreAText", kMeasurementHead + kRun + "columns = \"t\"\n",
     "7: run.columns = \"t\": a string; must be a table, as in { torque = { name = \"Vm\", unit = "
     "\"N m\" } }"},
    {"ForeignUnitWithoutScale",
     kMeasurementHead + kRun + "columns = { torque = { name = \"Vm\", unit = \"V\" } }\n",
     "7: run.columns.torque.unit = V: not one of N m, N mm, N cm, kN m, MN m, kgf cm, lbf in, lbf "
     "ft, "
     "ozf "
     "in, uN m, cN m, daN m, gf cm; give scale in N m per V"},
    {"NameBesideExpression",
     kMeasurementHead + kRun + "columns = { torque = { name = \"Vm\", expression = \"2*Vm\" } }\n",
     "7: run.columns.torque.expression: given beside name; only one of the two"},
    {"ExpressionThatDoesNotParse",
     kMeasurementHead + kRun + "columns = { torque = { expression = \"0.1*(V - w\" } }\n",
     "7: run.columns.torque.expression = 0.1*(V - w: a parenthesis is not closed"},
    {"ExpressionInAForeignUnit",
     kMeasurementHead + kRun + "columns = { time = { expression = \"V\", unit = \"A\" } }\n",
     "7: run.columns.time.unit = A: not one of s, ms, us, ns, min, h; give scale in s per A"},
    {"ScaleOfTheUnitTwice",
     kMeasurementHead + kRun +
         "columns = { time = { name = \"t\", unit = \"ms\", scale = 0.001 } }\n",
     "7: run.columns.time.scale = 0.001: the factor of unit ms, which is applied already; leave "
     "scale out"},
    {"ScaleOfAUnitThatIsNoneOfARecord",
     kMeasurementHead + kRun +
         "columns = { torque = { name = \"T\", unit = \"N cm\", scale = 0.5 } }\n",
     "7: run.columns.torque.scale = 0.5: in N cm, or from N cm to N m; write unit = \"N m\", with "
     "scale = 0.005 if it is in N cm, 0.5 if not"},
    {"ScaleNearThatOfTheUnit",
     kMeasurementHead + kRun +
         "columns = { time = { name = \"t\", unit = \"ms\", scale = 0.00098 } }\n",
     "7: run.columns.time.scale = 0.00098: 2 % off the conversion of ms, 0.001; write unit s, with "
     "scale 0.00098 if it is the whole conversion, 9.8e-07 if it is in ms"},
    {"ScaleZero", kMeasurementHead + kRun + "columns = { torque = { name = \"Vm\", scale = 0 } }\n",
     "7: run.columns.torque.scale = 0: must be a finite number, not 0"},
    {"ScaleIsAText",
     kMeasurementHead + kRun + "columns = { torque = { name = \"Vm\", scale = \"1\" } }\n",
     "7: run.columns.torque.scale = \"1\": a string; must be a finite number, not 0"},
    {"ColumnKeyMisspelt", kMeasurementHead + kRun + "columns = { torque = { nam = \"Vm\" } }\n",
     "7: run.columns.torque.nam: unknown key (did you mean name?); allowed: name, expression, "
     "unit, "
     "scale"},
    {"PlaceAlongTheBeamTwice",
     kMeasurementHead + kRun +
         "columns.\"strain@0.05\" = { name = \"a\" }\ncolumns.\"strain@0.050\" = { name = \"b\" "
         "}\n",
     "8: run.columns.strain@0.050: strain@0.05 is given twice"},
    {"TheFirstMistakeOfTheFile", kMeasurementHead + kRun + "initial = \"fre\"\npurpose = 1\n",
     "7: run.initial = \"fre\": must be rest or free (did you mean free?)"},
};

class MeasurementMistake : public testing::TestWithParam<Mistake> {};

TEST_P(MeasurementMistake, GivesOneLineWithPlaceReasonAndRemedy) {
  expect_line(GetParam(), "m.toml", parse_measurement);
}

INSTANTIATE_TEST_SUITE_P(, MeasurementMistake, testing::ValuesIn(kMeasurementMistakes),
                         name_of_mistake);

}  // namespace
}  // namespace flexarm::measured
