// What `flexarm export` writes, and what it refuses. FMUs are imported and run in tests/export.
#include "tests/app/flexarm_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace flexarm::testing_app {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

class ExportCommand : public Flexarm {
 protected:
  static constexpr const char* kArm =
      "[beam]\nlength = 0.96\nthickness = 0.003\nflexural_rigidity = 3.7\n"
      "linear_density = 0.165\n[hub]\ninertia = 0.0006\n[damping]\nkelvin_voigt = 1e-4\n";
};

TEST_F(ExportCommand, WritesTheSameFmuForTheSameArm) {
  write("rig.toml", kArm);
  const Ended first = run({"export", "--fmu", "rig.toml"});
  ASSERT_EQ(first.status, 0) << first.errors;
  EXPECT_THAT(first.output, HasSubstr("wrote rig.fmu: FMI 2.0 for co-simulation"));
  ASSERT_EQ(run({"export", "rig.toml", "--fmu", "--out", "other/../rig.fmu"}).status, 2);
  std::filesystem::create_directory(folder_ / "other");
  ASSERT_EQ(run({"export", "rig.toml", "--fmu", "--out", "other/rig.fmu"}).status, 0);
  EXPECT_EQ(text_of("rig.fmu"), text_of("other/rig.fmu"));
}

TEST_F(ExportCommand, TheFmuHasAsManyModesAsItsErrorAsksFor) {
  write("rig.toml", kArm);
  const auto exported = [&](std::vector<std::string> further) {
    std::vector<std::string> arguments = {"export", "--fmu", "rig.toml", "--json", "out.json"};
    arguments.insert(arguments.end(), further.begin(), further.end());
    const Ended ended = run(arguments);
    EXPECT_EQ(ended.status, 0) << ended.errors;
    return Json::parse(text_of("out.json"));
  };
  const Json chosen = exported({})["fmu"]["truncation"];
  EXPECT_TRUE(chosen["chosen"].get<bool>());
  ASSERT_FALSE(chosen["errors"].empty());
  for (const Json& sensor : chosen["errors"]) {
    EXPECT_LE(sensor["error"].get<double>(), chosen["tolerance"].get<double>()) << sensor;
  }
  const Json given = exported({"--modes", "2"});
  EXPECT_EQ(given["modes"], 2);
  EXPECT_FALSE(given["fmu"]["truncation"]["chosen"].get<bool>());
}

TEST_F(ExportCommand, RefusesWhatDoesNotGoTogether) {
  write("rig.toml", kArm);
  expect_refused(run({"export", "rig.toml"}), "export: needs --fmu, or --state-space FILE");
  expect_refused(run({"export", "rig.toml", "--fmu", "--fmi", "1"}),
                 "--fmi = 1: must be 2 (FMI 2.0) or 3 (FMI 3.0)");
  expect_refused(run({"export", "rig.toml", "--fmu", "--samples", "3"}),
                 "--samples: needs --state-space FILE");
  expect_refused(run({"export", "rig.toml", "--state-space", "a.mat", "--period", "0.001"}),
                 "--period: needs --fmu");
  expect_refused(run({"export", "rig.toml", "--state-space", "a.csv"}),
                 "--state-space a.csv: unknown extension; allowed: .json, .mat");
  expect_refused(run({"export", "rig.toml", "--fmu", "--period", "0"}),
                 "--period = 0 s: must be a finite number above 0");
  expect_refused(run({"export", "rig.toml", "--fmu", "--modes", "0"}),
                 "--modes = 0: must be 1 to 2000");
  EXPECT_EQ(names_in(), std::vector<std::string>{"rig.toml"});
}

TEST_F(ExportCommand, RefusesFilesThatAreNoDiagnosis) {
  write("a.json", "{");
  expect_refused(
      run({"export", "--fmu", "a.json"}),
      "a.json: is not JSON; must be an arm file (.toml) or the JSON of flexarm diagnose");
  write("b.json", "{\"schema\": \"flexarm.modes/1\"}");
  expect_refused(run({"export", "--fmu", "b.json"}),
                 "b.json: schema is not flexarm.diagnosis/3; must be an arm file (.toml) or the "
                 "JSON of flexarm diagnose");
  write("c.json", "{\"schema\": \"flexarm.diagnosis/2\", \"extended_arm\": null}");
  expect_refused(run({"export", "--fmu", "c.json"}),
                 "c.json: extended_arm: the diagnosis has none");
}

TEST_F(ExportCommand, HasTheUncertaintiesOfADiagnosis) {
  const std::string friction = "[effects.coulomb_friction]\ntorque = 0.01\n";
  write("true.toml", kArm + friction);
  ASSERT_EQ(run({"simulate", "true.toml", "--duration", "3", "--period", "0.002", "--sensor",
                 "hub_angle,tip_acceleration", "--noise", "0.01", "--excitation",
                 "random:rms=0.05,to=20,id=first", "--excitation",
                 "random:rms=0.05,to=20,id=second", "--out", "bench"})
                .status,
            0);
  std::string known = kArm;
  known.replace(known.find("\n[damping]"), 1, "\ninertia_uncertainty = 0.02\n");
  write("bench/arm.toml", known);
  const Ended diagnosed = run({"diagnose", "bench/measurement.toml", "--effects",
                               "coulomb_friction,payload_mass", "--json", "out.json"});
  ASSERT_EQ(diagnosed.status, 0) << diagnosed.errors;
  const Json diagnosis = Json::parse(text_of("out.json"));
  const Json& set = diagnosis.at("posterior").at(0);
  ASSERT_EQ(set.at("effects").at(0).at("effect"), "coulomb_friction");
  const Json& friction_torque = set.at("parameters").at(0);
  EXPECT_EQ(friction_torque.at("key"), "effects.coulomb_friction.torque");
  EXPECT_EQ(friction_torque.at("value"),
            diagnosis.at("causes").at(0).at("parameters").at("torque").at("value"));
  EXPECT_EQ(friction_torque.at("std_error"),
            diagnosis.at("causes").at(0).at("parameters").at("torque").at("std_error"));
  EXPECT_EQ(set.at("parameters").at(1).at("key"), "hub.inertia");
  const double correlation = set.at("correlation").at(0).at(1);
  EXPECT_EQ(set.at("correlation").at(0).at(0), 1.0);
  EXPECT_LT(std::abs(correlation), 1.0);
  EXPECT_NE(correlation, 0.0);

  ASSERT_EQ(run({"export", "out.json", "--fmu", "--state-space", "samples.json", "--samples", "400",
                 "--seed", "2", "--json", "exported.json"})
                .status,
            0);
  const Json exported = Json::parse(text_of("exported.json"));
  const auto& variables = exported.at("fmu").at("variables");
  const auto variable = std::ranges::find_if(variables, [](const Json& one) {
    return one.at("name") == "effects.coulomb_friction.torque";
  });
  ASSERT_NE(variable, variables.end());
  EXPECT_EQ(variable->at("standard_deviation"), friction_torque.at("std_error"));
  const auto& torque = exported.at("state_space").at("numbers").at(0);
  EXPECT_EQ(torque.at("nominal"), friction_torque.at("value"));
  // 400 samples: 15 % is four standard deviations of a standard deviation.
  EXPECT_NEAR(
      torque.at("std_deviation").get<double>() / friction_torque.at("std_error").get<double>(), 1.0,
      0.15);
  EXPECT_EQ(exported.at("state_space").at("left_out_effects"), Json({"coulomb_friction"}));
}

}  // namespace
}  // namespace flexarm::testing_app
