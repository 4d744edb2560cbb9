#include "measured/files/frequency_record.hpp"
#include "measured/files/modal_table.hpp"
#include "tests/app/flexarm_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

namespace flexarm::testing_app {
namespace {

using Json = nlohmann::json;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class Identify : public Flexarm {
 protected:
  /// A measurement in `folder`: 10 s of random torque, and more runs.
  void simulate(const std::string& folder, const std::vector<std::string>& more = {}) const {
    write("rig.toml",
          "[beam]\nlength = 0.96\nthickness = 0.0032\nflexural_rigidity = 3.7\n"
          "linear_density = 0.165\n[hub]\ninertia = 0.0006\nviscous_friction = 0.002\n"
          "[damping]\nkelvin_voigt = 1e-4\n");
    std::vector<std::string> arguments = {"simulate",     "rig.toml",
                                          "--duration",   "10",
                                          "--period",     "0.005",
                                          "--sensor",     "hub_velocity,tip_acceleration",
                                          "--noise",      "0.01",
                                          "--out",        folder,
                                          "--excitation", "random:rms=0.05,to=60,id=random"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = run(arguments);
    ASSERT_EQ(ended.status, 0) << ended.errors;
  }
};

TEST_F(Identify, PrintsTablesLikeThePapers) {
  // Two modes above the band: with all of them zeros of the tip are not identifiable.
  simulate("sim", {"--modes", "5"});
  const Ended brief = run({"identify", "sim/measurement.toml"});
  EXPECT_THAT(brief.output, AllOf(testing::StartsWith("random: poles, natural"),
                                  HasSubstr("random: zeros, natural"), HasSubstr("\nnext: "),
                                  Not(HasSubstr("segment: ")), Not(HasSubstr("(48)"))));
  EXPECT_LT(std::ranges::count(brief.output, '\n'), 45) << "an answer fits on a screen";
  const Ended ended = run({"identify", "sim/measurement.toml", "--verbose"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output,
              AllOf(HasSubstr("random: spectra and frequency responses"), HasSubstr("segment: "),
                    HasSubstr("random: poles, natural"), HasSubstr("random: zeros of each sensor"),
                    HasSubstr("damping ratios"), HasSubstr("mean, std. dev."),
                    HasSubstr("Modal fit of random"), HasSubstr("(48)"), HasSubstr("(52)"),
                    HasSubstr("zeros on the real axis"), HasSubstr("next: ")));
  EXPECT_TRUE(ended.errors.empty()) << ended.errors;
}

TEST_F(Identify, WritesTablesThatCompareReadsAndResponsesThatAreRuns) {
  simulate("sim");
  const Ended ended = run({"identify", "sim/measurement.toml", "--out", "out"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(names_in("out"),
              AllOf(Contains("modal-fit-random.csv"), Contains("modal-response-random.csv"),
                    Contains("frf-random.csv"), Contains("poles-random.csv")));
  const Ended compared =
      run({"compare", "rig.toml", "--quick", "--measured", "out/modal-fit-random.csv"});
  EXPECT_EQ(compared.status, 0) << compared.errors;
  const auto record = measured::read_frequency_record(folder_ / "out/frf-random.csv");
  EXPECT_EQ(record.channels.size(), 2U);
}

TEST_F(Identify, ChosenRunsSensorsAndSettingsAreUsed) {
  simulate("sim", {"--excitation", "random:rms=0.05,to=60,id=second"});
  const Ended ended =
      run({"identify", "sim/measurement.toml", "--run", "second", "--sensor", "hub_velocity",
           "--resolution", "0.488", "--overlap", "50", "--window", "hamming", "--detrend", "line",
           "--peaks", "on-line", "--no-fit", "--json", "out.json"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  const Json json = Json::parse(text_of("out.json"));
  ASSERT_EQ(json["runs"].size(), 1U);
  EXPECT_EQ(json["runs"][0]["id"], "second");
  const auto& spectra = json["runs"][0]["spectra"];
  EXPECT_EQ(spectra["channels"].size(), 1U);
  EXPECT_NEAR(spectra["spacing_Hz"].get<double>(), 0.488, 1e-3);  // 410 samples
  EXPECT_TRUE(json["fits"].empty());
  for (const auto& root : json["readings"][0]["roots"]) {
    const double line = root["frequency_Hz"].get<double>() / spectra["spacing_Hz"].get<double>();
    EXPECT_NEAR(line, std::round(line), 1e-9);
  }
}

TEST_F(Identify, WhatCannotBeUsedIsSaidInOneLine) {
  simulate("sim");
  const auto errors = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"identify", "sim/measurement.toml"});
    const Ended ended = run(arguments);
    EXPECT_EQ(ended.status, 2) << ended.output;
    EXPECT_EQ(std::ranges::count(ended.errors, '\n'), 1) << ended.errors;
    return ended.errors;
  };
  EXPECT_THAT(errors({"--run", "randon"}), HasSubstr("did you mean random?"));
  EXPECT_THAT(errors({"--run", "random,random"}), HasSubstr("given twice"));
  EXPECT_THAT(errors({"--sensor", "hub_angle"}), HasSubstr("not measured in any run"));
  EXPECT_THAT(errors({"--sensor", "hub"}), HasSubstr("hub_angle"));
  EXPECT_THAT(errors({"--window", "han"}), HasSubstr("did you mean hann?"));
  EXPECT_THAT(errors({"--detrend", "lin"}), HasSubstr("did you mean line?"));
  EXPECT_THAT(errors({"--resolution", "0"}), HasSubstr("above 0"));
  EXPECT_THAT(errors({"--resolution", "0.001"}), HasSubstr("resolution"));
  EXPECT_THAT(errors({"--overlap", "100"}), HasSubstr("below 100"));
  EXPECT_THAT(errors({"--peaks", "line"}), HasSubstr("on-line"));
  EXPECT_THAT(errors({"--modes", "0"}), HasSubstr("1 or more"));
  EXPECT_THAT(errors({"--from-Hz", "3"}), HasSubstr("--to-Hz"));
  EXPECT_THAT(errors({"--order", "1"}), HasSubstr("2 to 100"));
  EXPECT_THAT(errors({"--total-inertia", "0"}), HasSubstr("above 0"));
  EXPECT_THAT(run({"identify", "sim/nothing.toml"}).errors, HasSubstr("nothing.toml"));
}

TEST_F(Identify, NothingThatIsReadOrOthersWroteIsReplaced) {
  simulate("sim");
  const std::string data = text_of("sim/random.csv");
  const auto refused = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"identify", "sim/measurement.toml", "--no-fit"});
    const Ended ended = run(arguments);
    EXPECT_EQ(ended.status, 2) << ended.output;
    return ended.errors;
  };
  EXPECT_THAT(refused({"--out", "sim"}), HasSubstr("has the input sim/measurement.toml in it"));
  EXPECT_THAT(refused({"--out", "sim", "--force"}), HasSubstr("has the input"));
  EXPECT_THAT(refused({"--json", "sim/random.csv"}), HasSubstr("would overwrite the input"));
  EXPECT_THAT(refused({"--out", ".", "--force"}), HasSubstr("has the input"));
  EXPECT_EQ(text_of("sim/random.csv"), data);
  EXPECT_EQ(run({"identify", "sim/measurement.toml", "--no-fit", "--out", "out"}).status, 0);
  EXPECT_EQ(run({"identify", "sim/measurement.toml", "--no-fit", "--out", "out"}).status, 2);
  EXPECT_EQ(run({"identify", "sim/measurement.toml", "--out", "out", "--force"}).status, 0);
}

TEST_F(Identify, IdsThatAreNoFileNamesMakeNoneOfTheirOwn) {
  simulate("sim");
  const std::string other = "[[run]]\nkind = \"time\"\nfile = \"random.csv\"\nid = ";
  write("sim/two.toml", "arm = \"arm.toml\"\n" + other + "\"../a b\"\n" + other + "\".._a/b\"\n" +
                            other + "\"" + std::string(300, 'x') + "\"\n");
  const Ended ended = run({"identify", "sim/two.toml", "--no-fit", "--out", "out"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(names_in("out"), AllOf(Contains("frf-.._a_b.csv"), Contains("frf-.._a_b-2.csv")));
}

TEST_F(Identify, FaultsInDataAreNamed) {
  simulate("sim");
  // A sensor that sticks for a second, one that is dead.
  auto record = text_of("sim/random.csv");
  std::istringstream lines(record);
  std::string made, line;
  for (int row = 0; std::getline(lines, line); ++row) {
    if (row > 0) line = line.substr(0, line.rfind(',')) + ",1.5";
    made += line + "\n";
  }
  write("sim/random.csv", made);
  const Ended ended = run({"identify", "sim/measurement.toml"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output, AllOf(HasSubstr("tip_acceleration: dead channel"),
                                  HasSubstr("tip_acceleration excluded"), Not(HasSubstr("(52)"))));
}

TEST_F(Identify, ReadsTheModalRunOfAMeasurement) {
  simulate("sim");
  write("modal.csv",
        "sensor,feature,order,frequency [Hz]\nhub_angle,pole,1,12.00\nhub_angle,zero,1,2.9\n"
        "tip_acceleration,pole,1,12.05\n");
  write("measurement.toml",
        "arm = \"rig.toml\"\n[[run]]\nid = \"table-4\"\nkind = \"modal\"\nfile = \"modal.csv\"\n");
  const Ended ended = run({"identify", "measurement.toml"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output, AllOf(HasSubstr("table-4: poles"), HasSubstr("12.0500"),
                                  HasSubstr("2.90000"), Not(HasSubstr("Modal fit of"))));
}

TEST_F(Identify, TheHubMotionAsInputGivesPolesWithTheHubHeld) {
  simulate("sim");
  const Ended made = run({"simulate", "rig.toml", "--duration", "60", "--period", "0.005",
                          "--sensor", "hub_angle,tip_acceleration", "--noise", "0.002",
                          "--excitation", "random:rms=0.05,to=60,id=random", "--out", "held"});
  ASSERT_EQ(made.status, 0) << made.errors;
  const Ended ended =
      run({"identify", "held/measurement.toml", "--input", "hub_angle", "--out", "out", "-v"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output,
              AllOf(HasSubstr("estimator: hub_angle to sensors"), HasSubstr("pole 1, hub held"),
                    HasSubstr("responses to the hub motion")));
  EXPECT_THAT(names_in("out"),
              AllOf(Contains("held-poles-random.csv"), Contains("frf-random.csv")));
  EXPECT_EQ(measured::read_frequency_record(folder_ / "out/frf-random.csv").input,
            (arm::Sensor{arm::SensorKind::hub_angle, 0.0}));
  // The simulated arm with another hub: that does not matter to them.
  write("other-hub.toml", text_of("rig.toml") + "[effects.hub_inertia]\nfactor = 2\n");
  EXPECT_EQ(
      run({"import", "out/frf-random.csv", "--arm", "other-hub.toml", "--out", "responses"}).status,
      0);
  const Ended diagnosed = run({"diagnose", "responses/measurement.toml", "--time-limit", "30"});
  EXPECT_EQ(diagnosed.status, 0) << diagnosed.errors;
  EXPECT_THAT(diagnosed.output, Not(HasSubstr("hub_inertia")));
}

TEST_F(Identify, AnInputThatCannotBeIsOneLine) {
  simulate("sim");
  for (const auto& [input, what] : std::map<std::string, std::string>{
           {"hub_angel", "--input hub_angel: must be torque or hub_angle or hub_velocity"},
           {"hub_angle", "run random: hub_angle: not recorded"}}) {
    const Ended ended = run({"identify", "sim/measurement.toml", "--input", input});
    EXPECT_EQ(ended.status, 2);
    EXPECT_THAT(ended.errors, HasSubstr(what));
    EXPECT_EQ(std::ranges::count(ended.errors, '\n'), 1) << ended.errors;
  }
}

TEST_F(Identify, AFitThatNoArmCanHaveIsTheHeadlineOfTextJsonAndReport) {
  simulate("sim");
  // The torque with the wrong sign: an inertia below 0.
  std::istringstream lines(text_of("sim/random.csv"));
  std::string made, line;
  for (int row = 0; std::getline(lines, line); ++row) {
    const auto first = line.find(',') + 1;
    if (row > 0) {
      line.replace(first, 0, "-");
      if (line.compare(first, 2, "--") == 0) line.erase(first, 2);
    }
    made += line + "\n";
  }
  write("sim/random.csv", made);
  const Ended ended =
      run({"identify", "sim/measurement.toml", "--json", "out.json", "--report", "out.html"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output, testing::StartsWith("Doubtful: random: the fit is unphysical: 1/I_T"));
  const Json json = Json::parse(text_of("out.json"));
  EXPECT_EQ(json["state"], "unphysical");
  EXPECT_EQ(json["doubts"].size(), 1U);
  EXPECT_THAT(json["fits"][0]["unphysical"].get<std::string>(), HasSubstr("is not positive"));
  EXPECT_THAT(text_of("out.html"), HasSubstr("the fit is unphysical"));
}

TEST_F(Identify, ASoundFitIsIdentified) {
  simulate("sim");
  const Ended ended = run({"identify", "sim/measurement.toml", "--json", "out.json"});
  const Json json = Json::parse(text_of("out.json"));
  EXPECT_EQ(json["state"], "identified");
  EXPECT_TRUE(json["doubts"].empty());
  EXPECT_TRUE(json["fits"][0]["unphysical"].is_null());
  EXPECT_THAT(ended.output, Not(HasSubstr("Doubtful")));
}

TEST_F(Identify, NeedsNoArmAndOtherCommandsNameIt) {
  simulate("sim");
  write("sim/no-arm.toml", "[[run]]\nid = \"random\"\nkind = \"time\"\nfile = \"random.csv\"\n");
  const Ended ended = run({"identify", "sim/no-arm.toml", "--out", "out", "--report", "out.html"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output,
              AllOf(testing::StartsWith("random: poles"),
                    HasSubstr("the measurement states no arm"), Not(HasSubstr("exact_tf"))));
  const Json json = Json::parse(text_of("out/identified.json"));
  EXPECT_TRUE(json["arm"].is_null());
  EXPECT_THAT(text_of("out/modal-fit-random.csv"), HasSubstr("pole"));
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"diagnose", "sim/no-arm.toml"},
        std::vector<std::string>{"compare", "--measured", "sim/no-arm.toml"}}) {
    const Ended refused = run(command);
    EXPECT_EQ(refused.status, 2) << command.front();
    EXPECT_THAT(refused.errors, HasSubstr("arm: missing")) << command.front();
    EXPECT_EQ(std::ranges::count(refused.errors, '\n'), 1) << refused.errors;
  }
}

TEST_F(Identify, TakesAnArmFileWithoutNumbersForNone) {
  simulate("sim");
  const Ended imported = run({"import", "sim/random.csv", "--out", "bench"});
  ASSERT_EQ(imported.status, 0) << imported.errors;
  EXPECT_THAT(imported.output, HasSubstr("flexarm identify bench/measurement.toml"));
  const Ended ended = run({"identify", "bench/measurement.toml"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output, HasSubstr("no number is filled in in arm.toml"));
  EXPECT_EQ(run({"diagnose", "bench/measurement.toml"}).status, 2);
}

TEST_F(Identify, AnAliasIsNoPoleAndOnePeakHasOneOrder) {
  const std::string rest =
      "linear_density = 0.25\nthickness = 0.0016\n[hub]\ninertia = 2e-3\n"
      "viscous_friction = 0.02\n[damping]\nkelvin_voigt = 2e-5\n";
  const std::string beam = "[beam]\nlength = 0.43\nflexural_rigidity = ";
  write("true.toml", beam + "2.3\n" + rest);
  const Ended made =
      run({"simulate", "true.toml", "--modes", "25", "--excitation",
           "random:rms=0.02,from=0.5,to=240,id=a,seed=3", "--duration", "20", "--period", "0.002",
           "--sensor", "hub_angle,tip_acceleration", "--noise", "0.05", "--out", "run"});
  ASSERT_EQ(made.status, 0) << made.errors;
  for (const std::string rigidity : {"1.36", "2.3", "3.6"}) {
    write("run/arm.toml", beam + rigidity + "\n" + rest);
    const Ended ended = run({"identify", "run/measurement.toml", "--json", "out.json"});
    ASSERT_EQ(ended.status, 0) << ended.errors;
    EXPECT_THAT(ended.output, HasSubstr("alias of pole 4 at 316.")) << rigidity;
    // By the transcendental equation; poles of the fit are within 0.1 %.
    const std::map<int, double> expected_Hz = {{1, 18.1440}, {2, 59.9815}, {3, 161.9332}};
    for (const auto& reading : Json::parse(text_of("out.json"))["readings"]) {
      for (const auto& root : reading["roots"]) {
        if (root["feature"] != "pole" || root["order"].is_null()) continue;
        const int order = root["order"].get<int>();
        ASSERT_TRUE(expected_Hz.contains(order)) << rigidity;
        const double off = root["frequency_Hz"].get<double>() / expected_Hz.at(order) - 1.0;
        EXPECT_LT(std::abs(off), reading["method"] == "fit" ? 1e-3 : 0.07) << rigidity;
      }
    }
    EXPECT_THAT(ended.output, testing::ContainsRegex("1 +fit +18\\.13")) << rigidity;
  }
}

TEST_F(Identify, AFreeDecayIsIdentifiedAndDiagnosed) {
  std::string csv = "time [s],torque [N m],hub_angle [rad],tip_acceleration [m/s^2]\n";
  std::minstd_rand random(5);
  std::uniform_real_distribution<double> noise(-0.006, 0.006);
  for (int k = 0; k < 4000; ++k) {
    const double t = 0.002 * k;
    const auto decay = [t](double f_Hz, double zeta) {
      return std::exp(-zeta * 2.0 * M_PI * f_Hz * t) * std::cos(2.0 * M_PI * f_Hz * t);
    };
    const double tip = 5.0 * decay(2.9, 0.010) + decay(18.0, 0.012) + noise(random);
    csv += std::to_string(t) + ",0,0.001," + std::to_string(tip) + "\n";
  }
  write("free.csv", csv);
  write("arm.toml",
        "[beam]\nlength = 0.43\nwidth = 0.02\nthickness = 0.0016\ndensity = 7800\n"
        "youngs_modulus = 2.0e11\nyoungs_modulus_uncertainty = 0.3\n[hub]\ninertia = 2e-3\n");
  const Ended made =
      run({"import", "free.csv", "--initial", "free", "--arm", "arm.toml", "--out", "run"});
  ASSERT_EQ(made.status, 0) << made.errors;
  const Ended ended = run({"identify", "run/measurement.toml", "--json", "out.json"});
  ASSERT_EQ(ended.status, 0) << ended.errors;
  const Json json = Json::parse(text_of("out.json"));
  EXPECT_EQ(json["state"], "identified");
  EXPECT_EQ(json["runs"][0]["decay_begins_s"], 0.0);
  ASSERT_EQ(json["readings"].size(), 1U);
  const auto& roots = json["readings"][0]["roots"];
  ASSERT_EQ(roots.size(), 2U);
  EXPECT_NEAR(roots[0]["frequency_Hz"].get<double>(), 2.9, 0.003);
  EXPECT_NEAR(roots[0]["damping_ratio"].get<double>(), 0.010, 0.0005);
  EXPECT_NEAR(roots[1]["frequency_Hz"].get<double>(), 18.0, 0.02);
  EXPECT_NEAR(roots[1]["damping_ratio"].get<double>(), 0.012, 0.0006);
  const Ended diagnosed = run({"diagnose", "run/measurement.toml", "--effects", "payload_mass"});
  EXPECT_EQ(diagnosed.status, 0) << diagnosed.errors;
}

TEST_F(Identify, SaysWhatTheTimeLimitLeftOut) {
  simulate("sim");
  const Ended late = run({"identify", "sim/measurement.toml", "--time-limit", "1e-6"});
  EXPECT_EQ(late.status, 2);
  EXPECT_THAT(late.errors, HasSubstr("run random: the time limit left no time for it"));
  const Ended refused = run({"identify", "sim/measurement.toml", "--time-limit", "0"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.errors, HasSubstr("--time-limit = 0 s: must be a finite number above 0"));
  const Ended done =
      run({"identify", "sim/measurement.toml", "--time-limit", "1000", "--json", "out.json"});
  EXPECT_EQ(done.status, 0) << done.errors;
  EXPECT_EQ(Json::parse(text_of("out.json"))["checks_complete"], true);
}

}  // namespace
}  // namespace flexarm::testing_app
