#include "tests/app/flexarm_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace flexarm::testing_app {
namespace {

using Json = nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

using Modes = Flexarm;

TEST_F(Modes, WithoutArgumentsItIsThePapersArm) {
  const Ended ended = run({"modes"});
  EXPECT_EQ(ended.status, 0);
  EXPECT_EQ(ended.errors, "");
  EXPECT_THAT(ended.output, AllOf(HasSubstr("\nby exact_tf\n"), HasSubstr("11.8618286445"),
                                  HasSubstr("57.4408932468"), HasSubstr("\nnext: ")));
}

TEST_F(Modes, EveryFormulationGivesTheSameDigits) {
  const auto roots_by = [&](const std::string& formulation) {
    const Ended ended = run(
        {"modes", "--modes", "3", "--formulation", formulation, "--json", formulation + ".json"});
    EXPECT_EQ(ended.status, 0) << ended.errors;
    EXPECT_THAT(ended.output, HasSubstr("\nby " + formulation));
    return Json::parse(text_of(formulation + ".json"))["arms"][0];
  };
  const auto exact = roots_by("exact_tf");
  for (const std::string name : {"fem", "assumed_modes"}) {
    const auto other = roots_by(name);
    for (std::size_t i = 0; i < 3; ++i) {
      const double expected = exact["modes"][i]["omega_rad_per_s"];
      EXPECT_NEAR(other["modes"][i]["omega_rad_per_s"], expected, 1e-9 * expected) << name;
    }
  }
}

TEST_F(Modes, ANumberInAnotherUnitIsNoted) {
  write("rig.toml",
        "[beam]\nlength = 0.5\nwidth = 0.02\nthickness = 0.002\ndensity = 2.71\n"
        "youngs_modulus = 7e10\n[hub]\ninertia = 1e-3\n");
  const Ended ended = run({"modes", "rig.toml"});
  EXPECT_EQ(ended.status, 0);
  EXPECT_THAT(ended.output,
              HasSubstr("note: beam.density = 2.71 kg/m^3: implausible; 10 to 23000 kg/m^3"));
}

TEST_F(Modes, ACertificateIsPrintedAndWritten) {
  const Ended ended = run({"modes", "--certificate", "--modes", "2", "--json", "out.json"});
  EXPECT_EQ(ended.status, 0);
  EXPECT_THAT(ended.output, HasSubstr("Certificate (ball arithmetic)"));
  const auto document = Json::parse(text_of("out.json"));
  for (const auto& list : document["arms"][0]["certificate"]) {
    EXPECT_TRUE(list["proved"].get<bool>()) << list["roots"];
    EXPECT_EQ(list["enclosures"].size(), 2U);
  }
}

TEST_F(Modes, TheCertificateIsOfTheExactRootsWhicheverFormulationIsShown) {
  const Ended ended = run({"modes", "--certificate", "--formulation", "assumed_modes"});
  EXPECT_EQ(ended.status, 0) << ended.output;
}

TEST_F(Modes, MoreModesThanADiscreteModelIsMadeForAreRefused) {
  const Ended ended = run({"modes", "--formulation", "fem", "--modes", "1000"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.errors,
              HasSubstr("--modes: needs 1000 roots; must be at most 90 for fem; exact_tf"));
}

TEST_F(Modes, RootsThatAModelDoesNotHaveAreCounted) {
  const Ended ended = run({"modes", "--formulation", "assumed_modes", "--functions", "4", "--modes",
                           "9", "--sensor", "hub_angle,tip_acceleration"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output, AllOf(HasSubstr("\n3 of 9 modes: assumed_modes has 4 degrees of "
                                            "freedom\n3 of 9 zeros of hub_angle found; "),
                                  HasSubstr("of 9 zeros of tip_acceleration found; ")));
}

TEST_F(Modes, TheFolderHoldsTablesAndShapes) {
  const Ended ended = run({"modes", "--out", "out", "--payload-mass", "0.06"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(names_in("out"), ElementsAre("damped_poles.csv", "modes.csv", "shapes.csv",
                                           "shapes.svg", "zeros.csv"));
}

TEST_F(Modes, BadInputIsOneLineAndStatusTwo) {
  expect_refused(run({"modes", "none.toml"}), "none.toml: no such file");
  expect_refused(run({"modes", "--formulation", "fme"}),
                 "--formulation fme: unknown (did you mean fem?); allowed: exact_tf, fem, "
                 "assumed_modes");
  expect_refused(run({"modes", "--elements", "3"}), "--elements: not a setting of exact_tf");
  expect_refused(run({"modes", "--formulation", "fem", "--functions", "9"}),
                 "--functions: not a setting of fem");
  expect_refused(run({"modes", "--formulation", "assumed_modes", "--degree", "9"}),
                 "--degree: not a setting of assumed_modes");
  EXPECT_THAT(run({"modes", "--formulation", "assumed_modes", "--basis", "legendr"}).errors,
              StartsWith("--basis legendr: unknown (did you mean legendre?)"));
  expect_refused(run({"modes", "--modes", "0"}), "--modes = 0: must be 1 or more");
  expect_refused(run({"modes", "--sensor", "strain@0.96"}),
                 "--sensor strain@0.96: strain at the tip is identically zero without "
                 "payload.inertia; place it below 0.96 m");
}

TEST_F(Modes, StrainOfAnArmWithoutThicknessIsRefused) {
  write("rig.toml",
        "[beam]\nlength = 1.0\nflexural_rigidity = 1.0\nlinear_density = 1.0\n"
        "[hub]\ninertia = 0.1\n");
  EXPECT_EQ(run({"modes", "rig.toml"}).status, 0);
  const Ended ended = run({"modes", "rig.toml", "--sensor", "strain@0.5"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.errors, HasSubstr("thickness"));
}

TEST_F(Modes, TheExampleInItsHelpWorks) {
  EXPECT_THAT(output_of_example("modes"), HasSubstr("zeros of strain@0.05"));
}

}  // namespace
}  // namespace flexarm::testing_app
