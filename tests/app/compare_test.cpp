#include "tests/app/flexarm_fixture.hpp"
#include "tests/environment_variable.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <sys/resource.h>

namespace flexarm::testing_app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;
using testing::StartsWith;

using Compare = Flexarm;

constexpr const char* kArm =
    "name = \"rig\"\n"
    "[beam]\nlength = 0.8\nwidth = 0.02\nthickness = 0.003\ndensity = 2700.0\n"
    "youngs_modulus = 7e10\n"
    "[hub]\ninertia = 1e-3\n";

/// The user's CPU seconds of all programs run so far.
double cpu_s() {
  rusage usage{};
  ::getrusage(RUSAGE_CHILDREN, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

TEST_F(Compare, WithoutArgumentsItIsThePapersArmAndAgrees) {
  const Ended ended = run({"compare", "--quick"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_EQ(ended.errors, "");
  EXPECT_THAT(
      ended.output,
      AllOf(StartsWith("Verdict: agree. Largest difference relative to its tolerance: "),
            HasSubstr("\naluminium link of the paper's Table 1\nl 0.96 m, "), HasSubstr("11.86183"),
            HasSubstr("2.873375"), HasSubstr("assumed_modes"), Not(HasSubstr("11.8618286445"))));
  EXPECT_LT(std::ranges::count(ended.output, '\n'), 40) << "an answer fits on a screen";
  EXPECT_THAT(ended.output, HasSubstr("\nnext: write plots and tables with  flexarm compare"));
  EXPECT_TRUE(names_in().empty());
}

TEST_F(Compare, VerboseShowsTheRootsOfEachFormulation) {
  const Ended ended = run({"compare", "--quick", "--verbose", "--poles", "2"});
  EXPECT_THAT(ended.output, AllOf(StartsWith("Verdict: agree."), HasSubstr("11.8618286445"),
                                  HasSubstr("\nMode shapes compared with exact_tf\n")));
}

TEST_F(Compare, QuickTakesLessThanASecond) {
  if (kIsSanitized) GTEST_SKIP() << "the sanitizers take their own time";
  const double before = cpu_s();
  EXPECT_EQ(run({"compare", "--quick"}).status, 0);
  EXPECT_LT(cpu_s() - before, 1.0);
}

TEST_F(Compare, NoLineIsWiderThanATerminal) {
  constexpr std::size_t kColumns = 100;
  const Ended ended =
      run({"compare", "--full", "--poles", "2", "--zeros", "2", "--sensor", "strain@0.25"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  std::istringstream lines(ended.output);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), kColumns) << line;
  }
}

TEST_F(Compare, FormulationsThatDisagreeGiveStatusOneAndTheWorstPair) {
  // No formulation is right to 1e-18.
  const Ended ended = run({"compare", "--quick", "--poles", "2", "--tolerance", "1e-18"});
  EXPECT_EQ(ended.status, 1);
  EXPECT_EQ(ended.errors, "");
  EXPECT_THAT(ended.output,
              AllOf(StartsWith("Verdict: DISAGREE. Largest difference relative to its tolerance: "),
                    HasSubstr("\nBeyond the tolerance\n")));
}

TEST_F(Compare, BadInputIsOneLineAndStatusTwo) {
  expect_refused(run({"compare", "none.toml"}), "none.toml: no such file");
  write("bad.toml", "[beam]\nlenght = 1.0\n");
  EXPECT_THAT(run({"compare", "bad.toml"}).errors,
              StartsWith("bad.toml:2: beam.lenght: unknown key (did you mean length?)"));
  expect_refused(run({"compare", "--sensor", "hub_angel"}),
                 "--sensor hub_angel: unknown (did you mean hub_angle?); allowed: hub_angle, "
                 "hub_velocity, tip_acceleration, tip_displacement, tip_deflection, strain@X (X in "
                 "metres from the hub)");
  expect_refused(run({"compare", "--sensor", "strain@3"}),
                 "--sensor strain@3: position must be from 0 to the beam's length, 0.96 m");
  expect_refused(run({"compare", "--poels", "3"}),
                 "flexarm: --poels: unknown option (did you mean --poles?); "
                 "see flexarm compare --help");
  expect_refused(run({"compare", "--poles", "0"}), "--poles = 0: must be 1 or more");
  expect_refused(run({"compare", "--poles", "1000000"}), "--poles = 1000000: must be 90 or less");
  expect_refused(run({"compare", "--payload-mass", "-1"}),
                 "--payload-mass -1 kg: payload.mass = -1 kg: must be a finite number, 0 or more");
  EXPECT_EQ(names_in(), (std::vector<std::string>{"bad.toml"}));
}

TEST_F(Compare, AMeasuredTableWithAnErrorIsNamedByFileAndLine) {
  write("modal.csv",
        "sensor,feature,order,frequency [Hz]\nhub_angle,pole,1,12\nhub_angle,pol,2,3\n");
  const Ended ended = run({"compare", "--quick", "--measured", "modal.csv"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_EQ(ended.output, "");
  EXPECT_THAT(ended.errors, StartsWith("modal.csv:3: "));
  EXPECT_THAT(run({"compare", "--measured", "none.csv"}).errors,
              HasSubstr("none.csv: no such file"));
}

class MeasuredTable : public Flexarm {
 protected:
  /// What stands beside the model for the rows of a table.
  Json rows_beside_model(const std::string& modal_csv) {
    write("modal.csv", modal_csv);
    const Ended ended = run({"compare", "--quick", "--measured", "modal.csv", "--json", "c.json"});
    EXPECT_LE(ended.status, 1) << ended.errors;  // 1 where a table differs from the model
    EXPECT_THAT(ended.output, HasSubstr("Measured and exact_tf"));
    return Json::parse(text_of("c.json"))["comparisons"][0]["measured"];
  }
};

TEST_F(MeasuredTable, WithoutOrdersIsNumberedByInterlacing) {
  // The default arm with a beam 96 % stiffer: 1.4 times its frequencies, pole 2 nearest to pole 3.
  const std::string table =
      "sensor,feature,frequency [Hz]\nhub_angle,zero,4.02\nhub_angle,pole,16.6\n"
      "hub_angle,zero,25.2\nhub_angle,pole,45.2\n";
  // A root that is none of the arm's leaves nothing determined; without it all are.
  const Json with_foreign = rows_beside_model(table + "hub_angle,pole,5000\n");
  ASSERT_EQ(with_foreign.size(), 5U);
  EXPECT_TRUE(with_foreign[4]["order"].is_null());
  std::vector<int> orders;
  for (const auto& row : rows_beside_model(table)) {
    orders.push_back(row["order"]);
    EXPECT_NEAR(row["error_percent"].get<double>(), 40.0, 0.5);
  }
  EXPECT_EQ(orders, (std::vector<int>{1, 1, 2, 2}));
}

TEST_F(MeasuredTable, StandsBesideTheModels) {
  const Json rows = rows_beside_model(
      "sensor,feature,order,frequency [Hz]\nhub_angle,pole,1,12.00\n"
      "strain@0.25,zero,1,20.508\n");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_NEAR(rows[0]["model_Hz"].get<double>(), 11.8618, 1e-4);
  EXPECT_NEAR(rows[0]["error_percent"].get<double>(), 1.165, 1e-3);
  EXPECT_NEAR(rows[1]["model_Hz"].get<double>(), 20.3793, 1e-4) << "of a sensor not asked for";
}

TEST_F(Compare, LinearEffectsAreHonouredAndOthersNamedAsLeftOut) {
  write("rig.toml", std::string(kArm) +
                        "[effects.hub_spring]\nstiffness = 1.0\n"
                        "[effects.coulomb_friction]\ntorque = 0.01\n");
  const Ended compared = run({"compare", "rig.toml", "--quick"});
  EXPECT_EQ(compared.status, 0) << compared.output;
  const Ended modes = run({"modes", "rig.toml"});
  EXPECT_THAT(modes.output, HasSubstr("lowest undamped mode at"));
  for (const Ended& ended : {compared, modes}) {
    EXPECT_THAT(ended.output, HasSubstr("with hub_spring: stiffness 1 N m/rad"));
    EXPECT_THAT(ended.output,
                HasSubstr("not included (not part of the linear equations): coulomb_friction"));
  }
}

TEST_F(Compare, TheFolderHoldsTablesAndPlots) {
  write("modal.csv", "sensor,feature,order,frequency [Hz]\nhub_angle,pole,1,12.00\n");
  const Ended ended = run({"compare", "--poles", "2", "--zeros", "2", "--measured", "modal.csv",
                           "--out", "new/compared"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output, HasSubstr("\nwrote new/compared\n"));
  EXPECT_THAT(names_in("new/compared"),
              IsSupersetOf({"roots.csv", "shapes.csv", "responses.csv", "measured.csv",
                            "convergence.csv", "refinement.csv", "convergence-poles.svg",
                            "convergence-zeros-tip_acceleration.svg", "bases-poles.svg",
                            "pole-zero-hub_angle.svg", "bode-hub_angle.svg",
                            "bode-tip_acceleration.svg", "mode-shapes.svg"}));
  for (const auto& name : names_in("new/compared")) {
    const std::string text = text_of("new/compared/" + name);
    if (name.ends_with(".svg")) {
      EXPECT_THAT(text, AllOf(HasSubstr("<svg"), EndsWith("</svg>\n"))) << name;
    } else {
      EXPECT_GE(std::ranges::count(text, '\n'), 2) << name;
    }
  }
}

TEST_F(Compare, SeveralPayloadsAreComparedOneByOne) {
  const Ended ended = run({"compare", "--quick", "--poles", "2", "--payload-mass", "0,0.06",
                           "--out", "out", "--json", "out.json"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output, StartsWith("All 2 arms: agree.\n"));
  EXPECT_THAT(names_in("out"), ElementsAre("payload-0.06kg", "payload-0kg"));
  const auto document = Json::parse(text_of("out.json"));
  ASSERT_EQ(document["comparisons"].size(), 2U);
  EXPECT_EQ(document["comparisons"][0]["arm"]["payload_mass_kg"], 0.0);
  EXPECT_EQ(document["comparisons"][1]["arm"]["payload_mass_kg"], 0.06);
  EXPECT_EQ(document["verdict"], "agree");
}

TEST_F(Compare, AnArmFileMayFollowAList) {
  write("rig.toml", kArm);
  for (const std::vector<std::string>& list :
       {std::vector<std::string>{"--payload-mass", "0.06"}, {"--sensor", "tip_deflection"}}) {
    const Ended ended = run({"compare", "--quick", "--poles", "1", list[0], list[1], "rig.toml"});
    EXPECT_EQ(ended.status, 0) << ended.errors;
    EXPECT_THAT(ended.output, HasSubstr("\nrig\nl 0.8 m, "));
  }
  EXPECT_EQ(run({"modes", "--sensor", "hub_angle", "rig.toml"}).status, 0);
}

TEST_F(Compare, WhatCannotBeWrittenIsRefusedBeforeTheWork) {
  write("file", "");
  for (const std::string command : {"compare", "modes"}) {
    expect_refused(run({command, "--json", "none/out.json"}),
                   "none/out.json: cannot be written: there is no folder none");
    expect_refused(run({command, "--json", "."}), ".: cannot be written: is a folder");
    expect_refused(run({command, "--out", "file"}), "file: cannot be made: Not a directory");
  }
  EXPECT_THAT(names_in(), ElementsAre("file"));
  // The folder is there once it is made.
  EXPECT_EQ(run({"modes", "--out", "out", "--json", "out/modes.json"}).status, 0);
}

TEST_F(Compare, WithoutGnuplotAFolderIsRefusedAndTablesArePrinted) {
  const testing_environment::EnvironmentVariable path("PATH", folder_.c_str());
  for (const std::string command : {"compare", "modes"}) {
    expect_refused(run({command, "--out", "out"}),
                   "figures need gnuplot, which is not on PATH (Debian package gnuplot-nox)");
  }
  EXPECT_EQ(run({"compare", "--quick", "--poles", "1"}).status, 0);
  EXPECT_TRUE(names_in().empty());
}

TEST_F(Compare, AnEmptyValueIsNotTheDefault) {
  for (const std::string option : {"--json", "--out", "--payload-mass", "--measured"}) {
    expect_refused(run({"compare", option, ""}),
                   "flexarm: " + option + ": is empty; see flexarm compare --help");
  }
  expect_refused(run({"modes", ""}), "flexarm: ARM: is empty; see flexarm modes --help");
}

TEST_F(Compare, APayloadGivenTwiceIsRefused) {
  expect_refused(run({"compare", "--payload-mass", "0.05,0,5e-2", "--out", "out"}),
                 "--payload-mass: 0.05 given twice");
  EXPECT_TRUE(names_in().empty());
}

TEST_F(Compare, AnOldJsonFileIsReplacedWhole) {
  write("out.json", "old");
  fs::create_symlink("out.json", folder_ / "link.json");
  EXPECT_EQ(run({"compare", "--quick", "--poles", "1", "--json", "link.json"}).status, 0);
  EXPECT_EQ(Json::parse(text_of("out.json"))["schema"], "flexarm.compare/1");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.json"));
  EXPECT_THAT(names_in(), ElementsAre("link.json", "out.json"));
}

TEST_F(Compare, AClosedPipeEndsItWithoutAWord) {
  for (const std::string command : {"compare", "modes"}) {
    std::vector<std::string> arguments = {command};
    if (command == "compare") arguments.emplace_back("--quick");
    const Ended ended = run_flexarm(arguments, folder_.string(), Output::closed_pipe);
    EXPECT_EQ(ended.status, 128 + SIGPIPE);
    EXPECT_EQ(ended.errors, "");
  }
}

TEST_F(Compare, AClosedPipeCostsNoFile) {
  for (const std::string command : {"compare", "modes", "response"}) {
    std::vector<std::string> arguments = {command, "--out", command, "--json", command + ".json"};
    if (command == "compare") arguments.emplace_back("--quick");
    const Ended ended = run_flexarm(arguments, folder_.string(), Output::closed_pipe);
    EXPECT_EQ(ended.status, 128 + SIGPIPE);
    EXPECT_FALSE(names_in(command).empty());
    EXPECT_TRUE(fs::exists(folder_ / (command + ".json")));
  }
}

TEST_F(Compare, CtrlCLeavesNothingHalfWritten) {
  const Ended ended =
      interrupt_flexarm({"compare", "--poles", "40", "--out", (folder_ / "out").string(), "--json",
                         (folder_ / "out.json").string()},
                        SIGINT);
  EXPECT_EQ(ended.status, 128 + SIGINT);
  EXPECT_EQ(ended.errors, "flexarm: interrupted\n");
  EXPECT_FALSE(fs::exists(folder_ / "out.json"));
  EXPECT_TRUE(!fs::exists(folder_ / "out") || names_in("out").empty());
}

TEST_F(Compare, TheExampleInItsHelpWorks) {
  const Ended help = run({"compare", "--help"});
  EXPECT_EQ(help.status, 0);
  EXPECT_THAT(help.output, AllOf(HasSubstr("Usage: flexarm compare"), HasSubstr("Exit status: ")));
  run({"new", "rig.toml"});
  const Ended ended = run(example_in(help.output));
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(names_in(), ElementsAre("compared", "rig.toml"));
}

}  // namespace
}  // namespace flexarm::testing_app
