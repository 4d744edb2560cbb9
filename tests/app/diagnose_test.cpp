#include "tests/app/flexarm_fixture.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <csignal>
#include <functional>
#include <random>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::testing_app {
namespace {

using Json = nlohmann::json;
using testing::Contains;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;

const std::string kDiagnosedArm =
    "[beam]\nlength = 0.96\nthickness = 0.0032\nflexural_rigidity = 3.7\n"
    "linear_density = 0.165\n[hub]\ninertia = 0.0006\nviscous_friction = 0.002\n"
    "[damping]\nkelvin_voigt = 1e-4\n";

class Diagnose : public Flexarm {
 protected:
  /// Two runs in sim/, of an arm with `effect` (TOML), beside an arm file without it.
  void simulate(const std::string& effect) const {
    write("true.toml", kDiagnosedArm + effect);
    const Ended ended = run({"simulate", "true.toml", "--duration", "3", "--period", "0.002",
                             "--sensor", "hub_angle,tip_acceleration", "--noise", "0.005",
                             "--excitation", "random:rms=0.05,to=60,id=random", "--excitation",
                             "multisine:rms=0.05,from=0.5,to=60,id=multisine", "--out", "sim"});
    ASSERT_EQ(ended.status, 0) << ended.errors;
    write("sim/arm.toml", kDiagnosedArm);
  }

  /// In the run under random torque.
  void replace_angle(const std::function<double()>& angle_rad) const {
    std::istringstream lines(text_of("sim/random.csv"));
    std::string replaced;
    for (std::string line; std::getline(lines, line);) {
      const bool is_sample = !line.empty() && (std::isdigit(line.front()) != 0);
      const auto at = line.find(',', line.find(',') + 1);
      replaced += is_sample ? fmt::format("{},{:.6f}{}", line.substr(0, at), angle_rad(),
                                          line.substr(line.find(',', at + 1)))
                            : line;
      replaced += "\n";
    }
    write("sim/random.csv", replaced);
  }
};

TEST_F(Diagnose, NamesTheCauseAndWritesAnArmThatOtherCommandsAccept) {
  simulate("[effects.payload_mass]\nmass = 0.02\n");
  const Ended ended = run({"diagnose", "sim/measurement.toml", "--effects",
                           "payload_mass,time_delay,hub_inertia", "--out", "out"});
  ASSERT_EQ(ended.status, 0) << ended.errors;
  EXPECT_EQ(ended.errors, "");
  EXPECT_THAT(ended.output, HasSubstr("Explained: payload_mass"));
  EXPECT_THAT(ended.output, HasSubstr("is used for validation, the others for estimation"));
  EXPECT_THAT(names_in("out"),
              IsSupersetOf({"causes.csv", "channels.csv", "diagnosis.json", "extended.toml"}));
  const Json json = Json::parse(text_of("out/diagnosis.json"));
  EXPECT_EQ(json["schema"], "flexarm.diagnosis/3");
  EXPECT_EQ(json["verdict"], "explained");
  ASSERT_EQ(json["causes"].size(), 1U);
  const double mass = json["causes"][0]["parameters"]["mass"]["value"];
  EXPECT_NEAR(mass, 0.02, 0.02 * 1e-2);
  EXPECT_LT(json["gain"]["validation"]["after"], json["gain"]["validation"]["before"]);
  EXPECT_EQ(json["formulations"]["agree"], true);
  EXPECT_EQ(json["extended_arm"], "extended.toml");
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"modes", "out/extended.toml"},
        {"compare", "out/extended.toml", "--quick"},
        {"diagnose", "sim/measurement.toml", "--effects", "time_delay"}}) {
    EXPECT_EQ(run(command).status, 0) << command[0];
  }
}

TEST_F(Diagnose, FindsNothingLeftWithTheExtendedArm) {
  simulate("[effects.payload_mass]\nmass = 0.02\n");
  ASSERT_EQ(
      run({"diagnose", "sim/measurement.toml", "--effects", "payload_mass", "--json", "first.json"})
          .status,
      0);
  EXPECT_EQ(Json::parse(text_of("first.json"))["extended_arm"], "first.extended.toml");
  write("sim/arm.toml", text_of("first.extended.toml"));
  const Ended again = run({"diagnose", "sim/measurement.toml"});
  EXPECT_EQ(again.status, 0) << again.errors;
  EXPECT_THAT(again.output, HasSubstr("Adequate: "));
  EXPECT_THAT(again.output, Not(HasSubstr("Where it fails")));
}

TEST_F(Diagnose, WhatCannotBeUsedIsOneLineAndNothingIsWritten) {
  simulate("");
  const std::string file = "sim/measurement.toml";
  const Ended misspelt = run({"diagnose", file, "--effects", "payload_mas", "--out", "out"});
  EXPECT_EQ(misspelt.status, 2);
  EXPECT_THAT(misspelt.errors,
              HasSubstr("--effects payload_mas: unknown effect (did you mean payload_mass?)"));
  EXPECT_EQ(run({"diagnose", file, "--max-causes", "0"}).status, 2);
  const Ended number = run({"diagnose", file, "--policy", "baem=3"});
  EXPECT_EQ(number.status, 2);
  EXPECT_THAT(number.errors, HasSubstr("--policy baem: unknown number of the search (did you mean "
                                       "beam?)"));
  EXPECT_EQ(run({"diagnose", file, "--force"}).status, 2);
  EXPECT_EQ(run({"diagnose", "no.toml"}).status, 2);
  // What was read is not replaced by what is written.
  const std::string before = text_of(file);
  EXPECT_EQ(run({"diagnose", file, "--json", file}).status, 2);
  EXPECT_EQ(text_of(file), before);
  write("sim/extended.toml", "mine");
  EXPECT_THAT(names_in(), Not(Contains("out")));

  write("sim/random.csv", "time [s],torque [N m],hub_angle [rad]\n0,0,0\n0.01,0,0.1\n0.02,0,0.2\n");
  const Ended silent = run({"diagnose", file});
  EXPECT_EQ(silent.status, 2);
  EXPECT_THAT(silent.errors, HasSubstr("random.csv: run random: "));
  EXPECT_THAT(silent.errors, HasSubstr("torque"));
  EXPECT_EQ(silent.output, "");
}

TEST_F(Diagnose, ExcludedEffectsAreNotSearchedForAndListed) {
  simulate("[effects.payload_mass]\nmass = 0.02\n");
  const std::string file = "sim/measurement.toml";
  const Ended ended =
      run({"diagnose", file, "--effects", "payload_mass,time_delay,sensor_gain", "--exclude",
           "payload_mass", "--exclude", "sensor_gain on tip_acceleration", "--json", "out.json"});
  ASSERT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(
      ended.output,
      HasSubstr("Excluded from the search: payload_mass, sensor_gain on tip_acceleration."));
  const Json json = Json::parse(text_of("out.json"));
  EXPECT_EQ(json["search"]["excluded"],
            Json::array({"payload_mass", "sensor_gain on tip_acceleration"}));
  EXPECT_EQ(json["search"]["complete"], true);
  EXPECT_THAT(ended.output, HasSubstr("Where it fails"));
  EXPECT_FALSE(json["residual"]["regimes"].empty());
  for (const auto& cause : json["causes"]) EXPECT_NE(cause["effect"], "payload_mass");
  for (const auto& [names, what] : std::vector<std::pair<std::string, std::string>>{
           {"payload_mas", "--exclude payload_mas: unknown effect (did you mean payload_mass?)"},
           {"payload_mass on hub_angle", "payload_mass acts on no sensor"},
           {"sensor_gain on hub_angel", "did you mean hub_angle?"},
           {"payload_mass,time_delay,sensor_gain", "no effect is left to search for"}}) {
    const Ended refused = run(
        {"diagnose", file, "--effects", "payload_mass,time_delay,sensor_gain", "--exclude", names});
    EXPECT_EQ(refused.status, 2) << names;
    EXPECT_THAT(refused.errors, HasSubstr(what));
    EXPECT_EQ(std::ranges::count(refused.errors, '\n'), 1) << refused.errors;
  }
}

TEST_F(Diagnose, AnAcceptedCheckExcludesNoChannel) {
  simulate("");
  // The noise of a hub that is held.
  replace_angle([noise = std::minstd_rand(1)]() mutable {
    return 0.25 + 1e-6 * static_cast<double>(noise() % 2001);
  });
  const std::vector<std::string> plain = {
      "diagnose", "sim/measurement.toml", "--effects", "hub_inertia", "--json", "out.json"};
  const auto channels = [&](const std::vector<std::string>& command) {
    const Ended ended = run(command);
    EXPECT_EQ(ended.status, 0) << ended.errors;
    return Json::parse(text_of("out.json"))["residual"]["channels"].size();
  };
  EXPECT_EQ(channels(plain), 3U);
  std::vector<std::string> accepting = plain;
  accepting.insert(accepting.end(), {"--accept", "dead_channel"});
  EXPECT_EQ(channels(accepting), 4U);
  const Json accepted = Json::parse(text_of("out.json"))["accepted_checks"];
  ASSERT_EQ(accepted.size(), 1U);
  EXPECT_EQ(accepted[0]["check"], "dead_channel");
  EXPECT_EQ(accepted[0]["channel"], "hub_angle");
  accepting.back() = "dead_channel";
  replace_angle([] { return 0.25; });
  EXPECT_EQ(channels(accepting), 3U) << "a constant has no noise";
  accepting.back() = "dead_chanel";
  const Ended misspelt = run(accepting);
  EXPECT_EQ(misspelt.status, 2);
  EXPECT_THAT(misspelt.errors, HasSubstr("--accept dead_chanel: unknown data check (did you mean "
                                         "dead_channel?)"));
}

TEST_F(Diagnose, EndsAtItsTimeLimitWithWhatItHas) {
  simulate("[effects.coulomb_friction]\ntorque = 0.01\n[effects.hub_spring]\nstiffness = 0.5\n");
  const std::string file = "sim/measurement.toml";
  const Ended ended = run({"diagnose", file, "--time-limit", "0.01", "--json", "out.json"});
  ASSERT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output, HasSubstr("The search is incomplete: the time limit of 0.01 s ended"));
  const Json json = Json::parse(text_of("out.json"));
  EXPECT_EQ(json["search"]["complete"], false);
  EXPECT_EQ(json["search"]["time_limit"], 0.01);
  EXPECT_EQ(json["verdict"], "unexplained");
  EXPECT_EQ(json["extended_arm"], nullptr);
  EXPECT_THAT(names_in(), Not(Contains("out.extended.toml")));
  for (const char* limit : {"0", "-1", "inf", "nan", "soon"}) {
    const Ended refused = run({"diagnose", file, "--time-limit", limit});
    EXPECT_EQ(refused.status, 2) << limit;
    EXPECT_THAT(refused.errors, HasSubstr("--time-limit")) << limit;
  }
}

/// Diagnoses with a limit of 3 s end soon after it.
class TimeLimit : public Diagnose {
 protected:
  /// Expects it of one, by the clock or by the processor, whichever is less: other programs make it
  /// wait.
  Ended in_time(const std::string& file) const {
    constexpr double kMost_s = 5.0;
    const auto begun = std::chrono::steady_clock::now();
    const double used_before_s = processor_s();
    const Ended ended = run({"diagnose", file, "--time-limit", "3"});
    const std::chrono::duration<double> clock = std::chrono::steady_clock::now() - begun;
    EXPECT_LT(std::min(clock.count(), processor_s() - used_before_s), kMost_s);
    return ended;
  }
};

TEST_F(TimeLimit, HoldsOnTheLongestDataOfTheRepository) {
  const std::string ruler = FLEXARM_SOURCE_DIR "/data/ruler/";
  const Ended imported =
      run({"import", ruler + "random-low.csv", ruler + "random-high.csv", ruler + "bang-bang.csv",
           "--arm", ruler + "ruler.toml", "--out", "ruler"});
  ASSERT_EQ(imported.status, 0) << imported.errors;
  const Ended ended = in_time("ruler/measurement.toml");
  EXPECT_EQ(ended.status, 0) << ended.errors;
}

/// Runs of 25,000 samples are used whole; friction and an unknown initial state make the evaluation
/// of a model take seconds. Where that of the arm as filed takes longer, there is nothing to tell.
TEST_F(TimeLimit, HoldsOnLongRuns) {
  write("rig.toml", std::string(kDiagnosedArm) + "[effects.coulomb_friction]\ntorque = 0.01\n");
  std::vector<std::string> command = {
      "simulate", "rig.toml", "--duration", "24.9", "--period", "0.001",
      "--noise",  "0.003",    "--modes",    "8",    "--sensor", "hub_angle,tip_acceleration",
      "--out",    "sim"};
  for (const char* seed : {"1", "2", "3", "4"}) {
    command.emplace_back("--excitation");
    command.push_back(fmt::format("random:rms=0.05,from=0.2,to=200,id=r{0},seed={0}", seed));
  }
  const Ended simulated = run(command);
  ASSERT_EQ(simulated.status, 0) << simulated.errors;
  const std::string free =
      std::regex_replace(text_of("sim/measurement.toml"), std::regex("kind = \"time\""),
                         "kind = \"time\"\ninitial = \"free\"");
  write("sim/measurement.toml", free);
  const Ended ended = in_time("sim/measurement.toml");
  if (ended.status == 0) {
    EXPECT_THAT(ended.output, HasSubstr("The search is incomplete: the time limit of 3 s ended"));
  } else {
    EXPECT_EQ(ended.status, 2);
    EXPECT_THAT(ended.errors, HasSubstr("--time-limit = 3 s: the arm as filed could not be "
                                        "simulated within the limit; raise it"));
  }
}

class LateTorque : public Diagnose, public testing::WithParamInterface<double> {
 protected:
  /// The torque column of a run moved one row down.
  void log_late(const std::string& file) const {
    std::istringstream lines(text_of(file));
    std::string all;
    std::string before = "0";
    for (std::string line; std::getline(lines, line);) {
      const bool is_sample = !line.empty() && (std::isdigit(line.front()) != 0);
      const auto begin = line.find(',') + 1;
      const auto end = line.find(',', begin);
      const std::string torque = line.substr(begin, end - begin);
      all += is_sample ? line.substr(0, begin) + before + line.substr(end) : line;
      all += "\n";
      if (is_sample) before = torque;
    }
    write(file, all);
  }

  void expect_delay(const char* measurement, double delay_s, const char* effects) const {
    const Ended ended = run({"diagnose", measurement, "--effects", effects, "--json", "out.json"});
    ASSERT_EQ(ended.status, 0) << ended.errors;
    const Json json = Json::parse(text_of("out.json"));
    EXPECT_EQ(json["verdict"], "explained") << ended.output;
    ASSERT_EQ(json["causes"].size(), 1U) << ended.output;
    EXPECT_EQ(json["causes"][0]["effect"], "time_delay");
    EXPECT_NEAR(json["causes"][0]["parameters"]["delay"]["value"].get<double>(), delay_s,
                0.01 * std::abs(delay_s));
  }
};

/// At these sampling periods [s].
INSTANTIATE_TEST_SUITE_P(, LateTorque, testing::Values(0.001, 0.002, 0.004));

TEST_P(LateTorque, IsATimeDelayBelowZero) {
  write("rig.toml", std::string(kDiagnosedArm));
  const Ended simulated =
      run({"simulate", "rig.toml", "--duration", "6", "--period", fmt::format("{}", GetParam()),
           "--noise", "0.01", "--modes", "20", "--sensor", "hub_angle,tip_acceleration",
           "--excitation", "random:rms=0.05,from=0.2,to=60,id=a,seed=1", "--excitation",
           "random:rms=0.05,from=0.2,to=60,id=b,seed=2", "--out", "sim"});
  ASSERT_EQ(simulated.status, 0) << simulated.errors;
  log_late("sim/a.csv");
  log_late("sim/b.csv");
  expect_delay("sim/measurement.toml", -GetParam(),
               "time_delay,torque_gain,actuator_lag,hub_viscous_friction");
}

TEST_P(LateTorque, InClosedLoopIsOneToo) {
  write("rig.toml", std::string(kDiagnosedArm));
  const std::string period = fmt::format("{}", GetParam());
  const Ended simulated = run({"simulate",     "rig.toml",
                               "--duration",   "6",
                               "--period",     period,
                               "--noise",      "0.003",
                               "--modes",      "20",
                               "--sensor",     "hub_angle,hub_velocity",
                               "--controller", "kp=0.5,kd=0.05,sample_time=" + period,
                               "--reference",  "staircase:amplitude=0.3,dwell=0.7,id=a",
                               "--reference",  "staircase:amplitude=0.2,dwell=0.5,id=b",
                               "--out",        "sim"});
  ASSERT_EQ(simulated.status, 0) << simulated.errors;
  log_late("sim/a.csv");
  log_late("sim/b.csv");
  expect_delay("sim/measurement.toml", -GetParam(), "time_delay,torque_gain,hub_viscous_friction");
}

TEST_F(Diagnose, InterruptedItWritesNothing) {
  simulate("[effects.coulomb_friction]\ntorque = 0.01\n[effects.hub_spring]\nstiffness = 0.5\n");
  const Ended ended = interrupt_flexarm({"diagnose", (folder_ / "sim/measurement.toml").string(),
                                         "--out", (folder_ / "out").string()},
                                        SIGINT);
  EXPECT_EQ(ended.status, 128 + SIGINT);
  EXPECT_THAT(names_in(), Not(Contains("out")));
}

}  // namespace
}  // namespace flexarm::testing_app
