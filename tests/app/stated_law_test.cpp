// Laws of hub torque that an arm file states, through the program.
#include "tests/app/flexarm_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace flexarm::testing_app {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;
using testing::Not;

const std::string kStatedRig =
    "[beam]\nlength = 0.96\nthickness = 0.0032\nflexural_rigidity = 3.7\n"
    "linear_density = 0.165\n[hub]\ninertia = 0.0006\nviscous_friction = 0.002\n"
    "[damping]\nkelvin_voigt = 1e-4\n";

class StatedLaw : public Flexarm {
 protected:
  void write_rig(const std::string& effect) const { write("rig.toml", kStatedRig + effect); }
  std::string output_of(const std::vector<std::string>& arguments) const {
    const Ended ended = run(arguments);
    EXPECT_EQ(ended.status, 0) << ended.errors;
    return ended.output;
  }
  std::string simulated(const std::string& folder) const {
    return output_of({"simulate", "rig.toml", "--duration", "3", "--period", "0.002", "--sensor",
                      "hub_angle,tip_acceleration", "--noise", "0.005", "--excitation",
                      "random:rms=0.05,to=60,id=random", "--excitation",
                      "multisine:rms=0.05,from=0.5,to=60,id=multisine", "--out", folder});
  }
};

const std::string kCable = "[effects.my_cable]\nhub_torque = \"-k*theta^3\"\n";

TEST_F(StatedLaw, ActsInASimulationAndIsNamedWithItsFormula) {
  write_rig("");
  simulated("ideal");
  write_rig(kCable + "k = { value = 2.0, unit = \"N m/rad^3\" }\n");
  EXPECT_THAT(simulated("cable"),
              HasSubstr("with my_cable: k 2 N m/rad^3, hub torque -k*theta^3\n"));
  EXPECT_NE(text_of("cable/random.csv"), text_of("ideal/random.csv"));
  EXPECT_THAT(text_of("cable/arm.toml"),
              HasSubstr("[effects.my_cable]\nhub_torque = \"-k*theta^3\"\n"
                        "k = { value = 2.0, unit = \"N m/rad^3\" }\n"));
}

TEST_F(StatedLaw, IsNamedWhereLinearAnalysesLeaveItOutOrLineariseIt) {
  write_rig(kCable + "k = 2.0\n");
  EXPECT_THAT(output_of({"modes", "rig.toml"}),
              HasSubstr("not included (not part of the linear equations): my_cable\n"));
  EXPECT_THAT(output_of({"response", "rig.toml"}), HasSubstr("not included (nonlinear): my_cable"));
  write_rig("[effects.my_cable]\nhub_torque = \"-k*sin(theta)\"\nk = 2.0\n");
  const std::string sine = output_of({"modes", "rig.toml"});
  EXPECT_THAT(sine, HasSubstr("linearised at rest: my_cable\n"));
  EXPECT_THAT(sine, Not(HasSubstr("not included")));
  EXPECT_THAT(output_of({"compare", "rig.toml", "--quick"}),
              HasSubstr("linearised at rest: my_cable\n"));
  write_rig("[effects.my_cable]\nhub_torque = \"-k*theta\"\nk = 2.0\n");
  const std::string linear = output_of({"modes", "rig.toml"});
  EXPECT_THAT(linear, Not(HasSubstr("linearised")));
  EXPECT_THAT(linear, Not(HasSubstr("not included")));
}

TEST_F(StatedLaw, WithoutAValueIsNoPartOfASimulation) {
  write_rig("");
  simulated("ideal");
  write_rig(kCable + "k = { range = [0.1, 100] }\n");
  EXPECT_THAT(simulated("cable"),
              HasSubstr("not included (hypothesis, a number has no value): my_cable: hub "
                        "torque -k*theta^3\n"));
  EXPECT_EQ(text_of("cable/random.csv"), text_of("ideal/random.csv"));
}

TEST_F(StatedLaw, OfTimeHasNoSteadyState) {
  write_rig("[effects.my_cable]\nhub_torque = \"-k*theta*cos(t)\"\nk = 2.0\n");
  const Ended ended = run({"simulate", "rig.toml", "--excitation",
                           "stepped-sine:amplitude=0.05,from=1,to=5,points=3", "--out", "sim"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.errors, HasSubstr("effects.my_cable: port hub_torque: a law that depends on "
                                      "time has no steady state"));
}

TEST_F(StatedLaw, WithoutAValueSomewhereEndsASimulationWithThePlace) {
  write_rig("[effects.my_cable]\nhub_torque = \"-k*theta*sqrt(1e-4 - theta^2)\"\nk = 2.0\n");
  const Ended ended = run({"simulate", "rig.toml", "--duration", "1", "--period", "0.002",
                           "--excitation", "step:amplitude=0.1", "--out", "sim"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.errors, HasSubstr("effects.my_cable.hub_torque: nan at theta = "));
}

TEST_F(StatedLaw, ThatIsWrongIsRefusedByEveryCommandWithItsLine) {
  write_rig("[effects.my_cable]\nhub_torque = \"-k*thta^3\"\nk = 2.0\n");
  const std::string line =
      "rig.toml:12: effects.my_cable.hub_torque = \"-k*thta^3\": thta: unknown variable (did you "
      "mean theta?); allowed: theta, omega, tau, t, pi, k; a number of the law needs a key beside "
      "hub_torque";
  expect_refused(run({"modes", "rig.toml"}), line);
  expect_refused(run({"simulate", "rig.toml", "--out", "sim"}), line);
}

TEST_F(StatedLaw, IsACandidateOfADiagnosis) {
  write_rig(
      "[effects.my_cable]\nhub_torque = \"-k*max(abs(theta) - 0.05, 0)*sign(theta)\"\n"
      "k = 1.5\n");
  simulated("sim");
  write("sim/arm.toml", kStatedRig +
                            "[effects.my_cable]\n"
                            "hub_torque = \"-k*max(abs(theta) - slack, 0)*sign(theta)\"\n"
                            "k = { range = [0.05, 50], unit = \"N m/rad\" }\nslack = 0.05\n");
  const std::string output = output_of({"diagnose", "sim/measurement.toml", "--effects",
                                        "my_cable,hub_spring,payload_mass", "--out", "out"});
  EXPECT_THAT(output, HasSubstr("xplained: my_cable"));
  const Json json = Json::parse(text_of("out/diagnosis.json"));
  ASSERT_EQ(json["causes"].size(), 1U);
  EXPECT_EQ(json["causes"][0]["effect"], "my_cable");
  const Json& k = json["causes"][0]["parameters"]["k"];
  constexpr double kTwoPerCent = 0.02;
  EXPECT_NEAR(k["value"], 1.5, 1.5 * kTwoPerCent);
  EXPECT_EQ(k["unit"], "N m/rad");
  EXPECT_THAT(text_of("out/extended.toml"), HasSubstr("slack = { value = 0.05 }\n"));
  EXPECT_THAT(output_of({"modes", "out/extended.toml"}), HasSubstr("with my_cable: k 1."));
}

TEST_F(StatedLaw, WithAValueAndARangeIsNoPartOfTheBaselineOfADiagnosis) {
  write_rig("[effects.payload_mass]\nmass = 0.02\n");
  simulated("sim");
  write("sim/arm.toml", kStatedRig + kCable + "k = { value = 50, range = [0.1, 100] }\n");
  const std::string output = output_of(
      {"diagnose", "sim/measurement.toml", "--effects", "my_cable,payload_mass", "--out", "out"});
  EXPECT_THAT(output, HasSubstr("effects.my_cable has a range: it is tested as a hypothesis"));
  EXPECT_THAT(output, HasSubstr("Explained: payload_mass"));
  EXPECT_THAT(text_of("out/extended.toml"), HasSubstr("k = { range = [0.1, 100.0] }\n"));
}

}  // namespace
}  // namespace flexarm::testing_app
