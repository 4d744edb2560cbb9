// Arm files without [beam]: the commands that take them, and those that do not.
#include "tests/app/flexarm_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace flexarm::testing_app {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

const std::string kHub = "[hub]\ninertia = 95.1\nviscous_friction = 203.5\n";
const std::string kFriction =
    "[effects.coulomb_friction]\ntorque = 20.4\n[effects.torque_bias]\ntorque = -3.16\n";

class RigidHubCommand : public Flexarm {
 protected:
  RigidHubCommand() {
    write("hub.toml", kHub);
    write("true.toml", kHub + kFriction);
  }
  Ended simulate(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"simulate",       "true.toml", "--period", "0.005",
                                          "--duration",     "8",         "--noise",  "0.002",
                                          "--hide-effects", "all",       "--out",    "sim"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
};

TEST_F(RigidHubCommand, IsSimulatedWithSensorsOfTheHub) {
  const Ended ended = run({"simulate", "hub.toml", "--json", "out.json"});
  ASSERT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output, HasSubstr("rigid hub without a beam"));
  const Json json = Json::parse(text_of("out.json"));
  EXPECT_EQ(json["model"], "rigid_hub");
  EXPECT_TRUE(json["arm"]["length_m"].is_null());
  EXPECT_EQ(json["arm"]["total_inertia_kg_m2"], 95.1);
  EXPECT_EQ(json["runs"][0]["channels"].size(), 2U);
}

TEST_F(RigidHubCommand, HasAFrequencyResponse) {
  const Ended ended = run({"response", "hub.toml", "--json", "out.json", "--out", "out"});
  ASSERT_EQ(ended.status, 0) << ended.errors;
  EXPECT_EQ(Json::parse(text_of("out.json"))["arms"][0]["model"], "rigid_hub");
}

TEST_F(RigidHubCommand, IsIdentified) {
  ASSERT_EQ(simulate({"--excitation", "multisine:rms=200,from=0.2,to=40,period=4"}).status, 0);
  const Ended ended = run({"identify", "sim/measurement.toml"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
}

TEST_F(RigidHubCommand, IsPlanned) {
  write(
      "measurement-plan.toml",
      "[[run]]\nid = \"steps\"\nkind = \"time\"\nsensors = [\"hub_angle\"]\nexcitation = { kind = "
      "\"bang-bang\", amplitude = 200.0, pulse = 0.5, pairs = 0 }\nduration = 4.0\nsample_time = "
      "0.01\n");
  const Ended ended = run({"plan", "hub.toml", "measurement-plan.toml", "--effects",
                           "coulomb_friction,torque_bias,time_delay"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output, HasSubstr("coulomb_friction"));
}

TEST_F(RigidHubCommand, ItsFrictionAndBiasAreDiagnosed) {
  ASSERT_EQ(simulate({"--excitation", "random:rms=100,from=0.1,to=5,id=random", "--excitation",
                      "bang-bang:amplitude=120,pulse=1,pairs=0,id=pulses"})
                .status,
            0);
  const Ended ended =
      run({"diagnose", "sim/measurement.toml", "--effects",
           "coulomb_friction,torque_bias,hub_viscous_friction,torque_gain", "--json", "out.json"});
  ASSERT_EQ(ended.status, 0) << ended.errors;
  const Json json = Json::parse(text_of("out.json"));
  EXPECT_EQ(json["verdict"], "explained");
  std::vector<std::string> names;
  for (const auto& cause : json["causes"]) {
    names.push_back(cause["effect"]);
    const double value = cause["parameters"]["torque"]["value"];
    const double expected = names.back() == "coulomb_friction" ? 20.4 : -3.16;
    EXPECT_NEAR(value, expected, 0.02 * std::abs(expected));
  }
  EXPECT_THAT(names, UnorderedElementsAre("coulomb_friction", "torque_bias"));
  // The extended arm is a rigid hub again.
  const std::string extended = text_of("out.extended.toml");
  EXPECT_EQ(extended.find("beam"), std::string::npos) << extended;
  EXPECT_EQ(run({"simulate", "out.extended.toml"}).status, 0);
}

TEST_F(RigidHubCommand, WhatNeedsABeamIsRefusedInOneLine) {
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& what) {
    const Ended ended = run(arguments);
    EXPECT_EQ(ended.status, 2) << arguments[0];
    EXPECT_EQ(ended.errors, what + ": needs a beam; the arm file has no [beam]\n");
  };
  refused({"modes", "hub.toml"}, "modes");
  refused({"compare", "hub.toml"}, "compare");
  refused({"sweep", "hub.toml", "--over", "hub.inertia=1.0,2.0"}, "sweep");
  refused({"simulate", "hub.toml", "--sensor", "tip_acceleration"}, "--sensor tip_acceleration");
  refused({"response", "hub.toml", "--sensor", "strain@0.05"}, "--sensor strain@0.05");
  refused({"simulate", "hub.toml", "--payload-mass", "0.1"}, "--payload-mass = 0.1 kg");
}

}  // namespace
}  // namespace flexarm::testing_app
