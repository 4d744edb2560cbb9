// What `flexarm simulate` refuses, rounds or warns of.
#include "tests/app/flexarm_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace flexarm::testing_app {
namespace {

using Json = nlohmann::json;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class SimulateLimits : public Flexarm {
 protected:
  /// The paper's arm with an effect.
  void write_arm(const std::string& effect, const std::string& parameter) const {
    run({"new", "rig.toml"});
    write("rig.toml", text_of("rig.toml") + "\n[effects." + effect + "]\n" + parameter + "\n");
  }
  Ended run_short(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"simulate", "--duration", "1", "--period", "0.002"});
    return run(arguments);
  }
};

TEST_F(SimulateLimits, AClosedOutputCostsNoFile) {
  const Ended ended =
      run_flexarm({"simulate", "--duration", "1", "--out", "out", "--json", "o.json"},
                  folder_.string(), Output::closed_pipe);
  EXPECT_EQ(ended.status, 141);
  EXPECT_EQ(ended.errors, "");
  EXPECT_THAT(names_in("out"),
              ElementsAre("arm.toml", "bang-bang.csv", "bang-bang.svg", "measurement.toml"));
  EXPECT_THAT(names_in(), Contains("o.json"));
}

TEST_F(SimulateLimits, AHeavilyDampedLinearArmIsSimulatedAtOnce) {
  for (const auto& [effect, parameter] : {std::pair("hub_viscous_friction", "coefficient = 1e6"),
                                          std::pair("structural_damping", "time = 10.0"),
                                          std::pair("actuator_lag", "time_constant = 1e-9")}) {
    write_arm(effect, parameter);
    const Ended ended = run({"simulate", "rig.toml", "--json", "out.json"});
    EXPECT_EQ(ended.status, 0) << effect << ended.errors;
    const auto all = Json::parse(text_of("out.json"))["runs"][0];
    EXPECT_EQ(all["stepping"]["inner_steps"], all["stepping"]["steps"]) << effect;
    EXPECT_LT(std::abs(all["energy"]["relative_residual"].get<double>()), 1e-6) << effect;
  }
}

TEST_F(SimulateLimits, AnEffectThatNeedsInnerStepsIsNamedWhereThereAreTooMany) {
  write_arm("hub_viscous_friction", "coefficient = 1e6");
  write("rig.toml", text_of("rig.toml") + "[effects.coulomb_friction]\ntorque = 0.01\n");
  const Ended ended = run({"simulate", "rig.toml", "--modes", "5"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_EQ(ended.output, "");
  EXPECT_THAT(ended.errors, StartsWith("bang-bang: effects.coulomb_friction: needs 1.18"));
}

TEST_F(SimulateLimits, AMotionTooLargeForANumberIsRefusedBeforeAnythingIsPrinted) {
  const Ended ended = run_short({"--excitation", "step:amplitude=1e300", "--out", "out"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_EQ(ended.output, "");
  EXPECT_THAT(ended.errors, StartsWith("step: energy at 0.002 s: numeric overflow; "));
  write("torque.csv", "time [s],torque [N m]\n0,0\n0.001,1e308\n0.002,-1e308\n");
  const Ended other = run({"simulate", "--torque", "torque.csv"});
  EXPECT_EQ(other.status, 2);
  EXPECT_EQ(other.output, "");
  EXPECT_THAT(other.errors,
              AllOf(StartsWith("torque: "), HasSubstr("at 0.001 s: numeric overflow")));
  EXPECT_EQ(run_short({"--noise-of", "hub_angle=1e308"}).status, 2);
  EXPECT_THAT(names_in(), ElementsAre("torque.csv"));
}

TEST_F(SimulateLimits, AnArmThatStandsUpIsSaidToFall) {
  write_arm("gravity", "acceleration = -9.81");
  EXPECT_THAT(
      run_short({"rig.toml"}).output,
      HasSubstr("\nnote: bang-bang: statically unstable (inverted) arm: undamped poles at s = +-"));
  EXPECT_THAT(run_short({}).output, Not(HasSubstr("falls")));
}

TEST_F(SimulateLimits, TimesThatAreRoundedToSamplesAreSaid) {
  const Ended ended = run({"simulate", "--excitation", "bang-bang:pulse=0.3007,start=0.0003",
                           "--period", "0.1", "--json", "out.json"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output,
              AllOf(HasSubstr("pulse 0.3 s, start 0 s"),
                    HasSubstr("note: bang-bang: pulse 0.3007 s is 0.3 s, start 0.0003 s is 0 s")));
  const auto keys = Json::parse(text_of("out.json"))["runs"][0]["excitation"]["keys"];
  EXPECT_EQ(keys[1]["value"], "0.3");
  EXPECT_THAT(run_short({"--excitation", "multisine:period=0.4999,to=50"}).output,
              HasSubstr("note: multisine: period 0.4999 s is 0.5 s"));
}

TEST_F(SimulateLimits, NothingIsPrintedBesideARefusal) {
  write_arm("gravity", "acceleration = -1000.0");
  const Ended ended = run_short({"rig.toml"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_EQ(ended.output, "");
  expect_refused(run_short({"--substeps", "1000000000"}),
                 "--substeps = 1000000000: must be from 0 to 100000");
}

TEST_F(SimulateLimits, NumbersOfSamplesAreShort) {
  expect_refused(run({"simulate", "--duration", "1e300"}),
                 "--duration = 1e+300 s at --period = 0.0005 s: 2e+303 samples; must be from 2 to "
                 "2e+07");
  expect_refused(
      run({"simulate", "--period", "1e-300"}),
      "--duration = 4 s at --period = 1e-300 s: 4e+300 samples; must be from 2 to 2e+07");
}

TEST_F(SimulateLimits, WhatIsGivenTwiceIsRefused) {
  expect_refused(run({"simulate", "--excitation", "bang-bang:amplitude=0.2,amplitude=0.3"}),
                 "--excitation bang-bang:amplitude=0.2,amplitude=0.3: amplitude: given twice");
  expect_refused(run({"simulate", "--noise-of", "hub_angle=0.1,hub_angle=0.2"}),
                 "--noise-of hub_angle=0.2: hub_angle given twice");
  expect_refused(
      run({"simulate", "--quantisation", "hub_angle=0.1", "--quantisation", "hub_angle=0.2"}),
      "--quantisation hub_angle=0.2: hub_angle given twice");
  expect_refused(run_short({"--excitation", "step:id=a", "--excitation", "bang-bang:id=a"}),
                 "--excitation bang-bang:id=a: id = a: is that of another run");
  EXPECT_EQ(
      run_short({"--excitation", "step", "--excitation", "random:id=step,to=80", "--out", "out"})
          .status,
      0);
  EXPECT_THAT(names_in("out"), AllOf(Contains("step.csv"), Contains("step-2.csv")));
}

TEST_F(SimulateLimits, ASeedIsAWholeNumber) {
  const Ended ended = run({"simulate", "--seed", "-1"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.errors, HasSubstr("--seed: -1: must be a whole number, 0 or more"));
}

TEST_F(SimulateLimits, OptionsThatWouldDoNothingAreRefused) {
  write_arm("coulomb_friction", "torque = 0.01");
  expect_refused(run({"simulate", "--force"}), "--force: needs --out FOLDER");
  expect_refused(run({"simulate", "rig.toml", "--hide-effects", "all"}),
                 "--hide-effects: needs --out FOLDER");
  expect_refused(run({"simulate", "--name", "bench"}), "--name: needs --out FOLDER");
}

TEST_F(SimulateLimits, ModesThatAModelDoesNotHaveAreSaid) {
  const std::vector<std::string> fem = {"--formulation", "fem", "--elements", "1",
                                        "--degree",      "3",   "--modes",    "5"};
  auto arguments = fem;
  arguments.insert(arguments.end(), {"--json", "out.json"});
  EXPECT_THAT(run_short(arguments).output,
              HasSubstr("\nnote: 2 of 5 modes: fem has 3 degrees of freedom\n"));
  EXPECT_EQ(Json::parse(text_of("out.json"))["modes"], 2);
  EXPECT_THAT(run_short({}).output, Not(HasSubstr("degrees of freedom")));
}

}  // namespace
}  // namespace flexarm::testing_app
