#include "effects/registry/vocabulary.hpp"
#include "measured/files/arm_file.hpp"
#include "measured/files/measurement.hpp"
#include "measured/files/time_record.hpp"
#include "tests/app/flexarm_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <sstream>
#include <string>
#include <vector>

namespace flexarm::testing_app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* kRigWithFriction =
    "name = \"rig\"\n[beam]\nlength = 0.96\nwidth = 0.019008\nthickness = 0.0032004\n"
    "density = 2710.0\nyoungs_modulus = 7.11e10\n[hub]\ninertia = 5.86e-4\n"
    "viscous_friction = 0.002\n[damping]\nkelvin_voigt = 1.2e-4\n"
    "[effects.coulomb_friction]\ntorque = 0.01\n[effects.torque_gain]\nfactor = 0.9\n";

/// The text with single blanks in place of line ends and indentation.
std::string in_one_line(const std::string& text) {
  std::istringstream words(text);
  std::string line;
  for (std::string word; words >> word;) line += (line.empty() ? "" : " ") + word;
  return line;
}

class Simulate : public Flexarm {
 protected:
  /// The same with a short record, to be quick.
  Ended run_short(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"simulate", "--duration", "1", "--period", "0.002"});
    return run(arguments);
  }
  measured::TimeRecord record(const std::string& name) const {
    return measured::read_time_record(folder_ / name);
  }
};

TEST_F(Simulate, WithoutArgumentsItIsThePapersArmAndABangBang) {
  const Ended ended = run({"simulate"});
  EXPECT_EQ(ended.status, 0);
  EXPECT_EQ(ended.errors, "");
  EXPECT_THAT(ended.output, AllOf(HasSubstr("aluminium link"), HasSubstr(" flexible modes; "),
                                  HasSubstr(" flexible modes chosen; estimated error 1.0e-04"),
                                  HasSubstr("bang-bang, amplitude 0.3 N"),
                                  HasSubstr("tip_acceleration"), HasSubstr("\nEnergy balance: "),
                                  HasSubstr("\nnote: modes up to "), HasSubstr("\nnext: ")));
  EXPECT_TRUE(names_in().empty());
}

TEST_F(Simulate, TheFolderIsAMeasurementOfTheArm) {
  write("rig.toml", kRigWithFriction);
  const Ended ended =
      run_short({"rig.toml", "--excitation", "bang-bang:pulse=0.2,purpose=estimation",
                 "--excitation", "random:id=noise,payload=0.06,to=80,purpose=validation",
                 "--sensor", "hub_angle,strain@0.05", "--out", "bench/out", "--name", "bench"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(names_in("bench/out"), ElementsAre("arm.toml", "bang-bang.csv", "bang-bang.svg",
                                                 "measurement.toml", "noise.csv", "noise.svg"));
  EXPECT_THAT(names_in("bench"), ElementsAre("out"));
  const auto measurement = measured::read_measurement(folder_ / "bench/out/measurement.toml");
  EXPECT_EQ(measurement.name, "bench");
  ASSERT_EQ(measurement.runs.size(), 2U);
  EXPECT_EQ(measurement.runs[0].id, "bang-bang");
  EXPECT_EQ(measurement.runs[0].payload, std::nullopt);
  EXPECT_EQ(measurement.runs[0].purpose, measured::Purpose::estimation);
  EXPECT_EQ(measurement.runs[1].payload, (arm::Payload{0.06, 0.0}));
  EXPECT_EQ(measurement.runs[1].purpose, measured::Purpose::validation);
  EXPECT_EQ(measured::read_arm_file(folder_ / "bench/out/arm.toml", effects::vocabulary()),
            measured::read_arm_file(folder_ / "rig.toml", effects::vocabulary()));
  const auto noise = record("bench/out/noise.csv");
  EXPECT_EQ(noise.time_s.size(), 500U);
  EXPECT_EQ(noise.time_s[7], 0.014);
  ASSERT_EQ(noise.channels.size(), 2U);
  EXPECT_EQ(noise.channels[0].values[0], 0.0);
}

TEST_F(Simulate, EffectsAreHiddenFromTheArmFileAndNotFromTheArm) {
  write("rig.toml", kRigWithFriction);
  const auto simulated = [&](const std::string& hidden) {
    const Ended ended = run_short({"rig.toml", "--hide-effects", hidden, "--out", hidden});
    EXPECT_EQ(ended.status, 0) << ended.errors;
    return record(hidden + "/bang-bang.csv");
  };
  EXPECT_EQ(simulated("all"), simulated("coulomb_friction"));
  EXPECT_TRUE(
      measured::read_arm_file(folder_ / "all/arm.toml", effects::vocabulary()).effects.empty());
  EXPECT_EQ(measured::read_arm_file(folder_ / "coulomb_friction/arm.toml", effects::vocabulary())
                .effects.size(),
            1U);
}

TEST_F(Simulate, EveryFormulationGivesTheSameMotion) {
  write("rig.toml", kRigWithFriction);
  const auto by = [&](const std::string& formulation) {
    const Ended ended = run_short({"rig.toml", "--formulation", formulation, "--out", formulation});
    EXPECT_EQ(ended.status, 0) << ended.errors;
    return record(formulation + "/bang-bang.csv");
  };
  const auto exact = by("exact_tf");
  for (const std::string formulation : {"fem", "assumed_modes"}) {
    const auto other = by(formulation);
    for (std::size_t i = 0; i < exact.channels.size(); ++i) {
      double peak = 0.0;
      double worst = 0.0;
      for (std::size_t k = 0; k < exact.time_s.size(); ++k) {
        const double value = exact.channels[i].values[k];
        peak = std::max(peak, std::abs(value));
        worst = std::max(worst, std::abs(other.channels[i].values[k] - value));
      }
      EXPECT_LT(worst, 1e-8 * peak) << formulation << i;
    }
  }
}

TEST_F(Simulate, ATorqueFromAFileGivesTheSameRunAgain) {
  EXPECT_EQ(run_short({"--excitation", "multisine:to=60,detection=4", "--hold", "first", "--out",
                       "first"})
                .status,
            0);
  const Ended ended =
      run({"simulate", "--torque", "first/multisine.csv", "--hold", "first", "--out", "again"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_EQ(record("again/multisine.csv"), record("first/multisine.csv"));
  EXPECT_EQ(measured::read_measurement(folder_ / "again/measurement.toml").runs[0].torque_hold,
            measured::TorqueHold::first);
}

TEST_F(Simulate, NoiseAndExcitationsComeFromTheSeed) {
  const auto simulated = [&](const std::string& seed, const std::string& name) {
    const Ended ended =
        run_short({"--excitation", "random:to=80", "--noise", "0.01", "--noise-of", "hub_angle=0.1",
                   "--quantisation", "hub_angle=0.25", "--seed", seed, "--out", name});
    EXPECT_EQ(ended.status, 0) << ended.errors;
    return record(name + "/random.csv");
  };
  const auto first = simulated("3", "a");
  EXPECT_EQ(first, simulated("3", "b"));
  EXPECT_NE(first.torque_N_m, simulated("4", "c").torque_N_m);
  for (const double value : first.channels[0].values)
    EXPECT_EQ(value * 4.0, std::round(value * 4.0));
}

TEST_F(Simulate, EachExcitationIsRunWithEachPayload) {
  const Ended ended = run_short({"--excitation", "step", "--excitation", "step:amplitude=0.1",
                                 "--payload-mass", "0,0.05", "--out", "out"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  const auto measurement = measured::read_measurement(folder_ / "out/measurement.toml");
  std::vector<std::string> ids;
  for (const auto& entry : measurement.runs) ids.push_back(entry.id);
  EXPECT_THAT(ids, ElementsAre("step-0kg", "step-0kg-2", "step-0.05kg", "step-0.05kg-2"));
  EXPECT_EQ(measurement.runs[2].payload, (arm::Payload{0.05, 0.0}));
}

TEST_F(Simulate, TheStepErrorIsToldOnRequest) {
  write("rig.toml", kRigWithFriction);
  const Ended ended = run_short({"rig.toml", "--check-step", "--json", "out.json"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output, HasSubstr("step-size error"));
  const Json document = Json::parse(text_of("out.json"));
  for (const auto& channel : document["runs"][0]["channels"]) {
    EXPECT_LT(channel["step_error"].get<double>(), 1e-6) << channel["sensor"];
  }
}

TEST_F(Simulate, ASamplingTooCoarseForTheModesIsSaidOnce) {
  const Ended ended =
      run_short({"--modes", "8", "--excitation", "bang-bang", "--excitation", "step"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  const std::string note = "note: modes up to ";
  const auto first = ended.output.find(note);
  ASSERT_NE(first, std::string::npos);
  EXPECT_EQ(ended.output.find(note, first + note.size()), std::string::npos);
}

TEST_F(Simulate, TheSamplingNoteSaysAPeriodThatShowsAllVisibleModes) {
  write("rig.toml",
        "[beam]\nlength = 0.96\nthickness = 0.0032\nflexural_rigidity = 3.7\n"
        "linear_density = 0.165\n[hub]\ninertia = 0.0006\n[damping]\nkelvin_voigt = 1e-4\n");
  for (const char* excitation :
       {"bang-bang:pulse=0.1", "step", "random:to=40", "chirp:to=40", "prbs", "sine"}) {
    const auto with_period = [&](const std::string& period) {
      return run({"simulate", "rig.toml", "--excitation", excitation, "--duration", "0.2",
                  "--period", period})
          .output;
    };
    const std::string coarse = with_period("0.01");
    const std::string words = "a sampling period (--period) of ";
    const std::string text = in_one_line(coarse);
    const auto at = text.find(words);
    ASSERT_NE(at, std::string::npos) << excitation << coarse;
    const auto from = at + words.size();
    const std::string period = text.substr(from, text.find(' ', from) - from);
    EXPECT_THAT(with_period(period), Not(HasSubstr("note: modes up to"))) << excitation << period;
  }
  EXPECT_THAT(
      in_one_line(run({"simulate", "--duration", "1"}).output),
      AllOf(HasSubstr("state damping.kelvin_voigt in its file"), Not(HasSubstr("--period"))));
}

TEST_F(Simulate, APrbsASineAndAStepAreRuns) {
  const Ended ended = run_short({"--excitation", "prbs:amplitude=0.02,clock=0.01,register=5",
                                 "--excitation", "sine:amplitude=0.03,frequency=2,offset=0.01",
                                 "--excitation", "step:amplitude=0.04,start=0.1", "--out", "out"});
  ASSERT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output,
              AllOf(HasSubstr("prbs, amplitude 0.02 N m, clock 0.01 s, register 5, seed 1"),
                    HasSubstr("sine, amplitude 0.03 N m, frequency 2 Hz, offset 0.01 N m")));
  const auto prbs = record("out/prbs.csv").torque_N_m;
  for (std::size_t k = 0; k < prbs.size(); ++k) {
    ASSERT_EQ(std::abs(prbs[k]), 0.02);
    ASSERT_EQ(prbs[k], prbs[k - k % 5]);
  }
  const auto sine = record("out/sine.csv").torque_N_m;
  EXPECT_NEAR(*std::ranges::max_element(sine), 0.04, 1e-4);
  EXPECT_NEAR(*std::ranges::min_element(sine), -0.02, 1e-4);
  const auto step = record("out/step.csv").torque_N_m;
  EXPECT_EQ(step[49], 0.0);
  EXPECT_EQ(step[50], 0.04);
  EXPECT_EQ(run({"diagnose", "out/measurement.toml", "--effects", "torque_gain"}).status, 0);
  EXPECT_THAT(run_short({"--excitation", "prbs:register=99"}).errors,
              HasSubstr("prbs.register = 99: must be from 2 to 24"));
  EXPECT_THAT(run_short({"--excitation", "sine:frequency=900"}).errors,
              HasSubstr("must be above 0 and at most the Nyquist frequency, 250 Hz"));
}

TEST_F(Simulate, GivenModesAreSaidToTruncateWithTheirError) {
  const Ended given = run_short({"--modes", "5", "--json", "out.json"});
  EXPECT_THAT(given.output, HasSubstr("\nTruncation: 5 flexible modes given; estimated error"));
  EXPECT_THAT(in_one_line(given.output), HasSubstr("the model is truncated"));
  const Json truncation = Json::parse(text_of("out.json"))["truncation"];
  EXPECT_FALSE(truncation["chosen"].get<bool>());
  EXPECT_EQ(truncation["modes"], 5);
  EXPECT_EQ(truncation["errors"].size(), 3U);
  EXPECT_GT(truncation["errors"][2]["error"].get<double>(), truncation["tolerance"].get<double>());
  write("rig.toml", kRigWithFriction);
  EXPECT_EQ(run_short({"rig.toml", "--json", "out.json"}).status, 0);
  const Json chosen = Json::parse(text_of("out.json"))["truncation"];
  EXPECT_TRUE(chosen["chosen"].get<bool>());
  for (const Json& sensor : chosen["errors"]) {
    EXPECT_LE(sensor["error"].get<double>(), chosen["tolerance"].get<double>());
  }
}

TEST_F(Simulate, EnergyIsBalanced) {
  write("rig.toml", kRigWithFriction);
  EXPECT_EQ(run_short({"rig.toml", "--json", "out.json"}).status, 0);
  const auto energy = Json::parse(text_of("out.json"))["runs"][0]["energy"];
  EXPECT_LT(std::abs(energy["relative_residual"].get<double>()), 1e-6);
  EXPECT_GT(energy["dry_friction_J"].get<double>(), 0.0);
}

TEST_F(Simulate, AFolderIsReplacedOnlyWhenItIsAMeasurementAndAsked) {
  EXPECT_EQ(run_short({"--out", "out"}).status, 0);
  EXPECT_THAT(run_short({"--out", "out"}).errors,
              StartsWith("out: cannot be written: is a folder with files in it; --force"));
  EXPECT_EQ(run_short({"--out", "out", "--excitation", "step", "--force"}).status, 0);
  EXPECT_THAT(names_in("out"), ElementsAre("arm.toml", "measurement.toml", "step.csv", "step.svg"));
  write("out/notes.txt", "mine");
  EXPECT_EQ(run_short({"--out", "out", "--force"}).errors,
            "out/notes.txt: not part of a measurement; folder not overwritten by --force\n");
  EXPECT_EQ(text_of("out/notes.txt"), "mine");
  fs::create_directory(folder_ / "other");
  write("other/thesis.csv", "mine");
  EXPECT_EQ(run_short({"--out", "other", "--force"}).errors,
            "other: contains no measurement.toml; not overwritten by --force\n");
}

TEST_F(Simulate, AnInterruptLeavesNoFolder) {
  const Ended ended = interrupt_flexarm(
      {"simulate", "--modes", "40", "--duration", "1000", "--out", (folder_ / "out").string()},
      SIGINT);
  EXPECT_EQ(ended.status, 130);
  EXPECT_TRUE(names_in().empty());
}

TEST_F(Simulate, BadInputIsOneLineAndStatusTwo) {
  write("rig.toml", kRigWithFriction);
  write("gap.csv",
        "time [s],torque [N m]\n0,1\n0.1,1\n0.2,1\n0.3,1\n0.4,1\n0.5,1\n0.6,1\n0.7,1\n"
        "0.8,1\n0.9,1\n1,1\n1.4,1\n");
  expect_refused(run({"simulate", "--torque", "gap.csv"}),
                 "gap.csv:13: gap: 3 samples are missing between 1 s and 1.4 s, where the step is "
                 "0.4 s and the period 0.1 s; split the record there, or fill it (flexarm import "
                 "does)");
  expect_refused(run({"simulate", "--torque", "gap.csv", "--duration", "3"}),
                 "--duration: only with --excitation; a torque file has its own");
  expect_refused(run({"simulate", "--excitation", "randm"}),
                 "--excitation randm: excitation randm: unknown (did you mean random?); allowed: "
                 "bang-bang, step, random, multisine, chirp, staircase, prbs, sine, stepped-sine");
  expect_refused(
      run({"simulate", "--excitation", "random:rsm=1"}),
      "--excitation random:rsm=1: random.rsm: unknown (did you mean rms?); allowed: rms, "
      "from, to, seed, id, payload, purpose");
  expect_refused(run({"simulate", "--excitation", "step:amplitude=1Nm"}),
                 "--excitation step:amplitude=1Nm: step.amplitude = 1Nm: must be a number [N m]");
  expect_refused(run({"simulate", "--excitation", "step:id=../x"}),
                 "--excitation step:id=../x: id = ../x: must be letters, digits, - _ and ., "
                 "because it is a file name");
  EXPECT_THAT(
      run({"simulate", "--excitation", "random:to=2000"}).errors,
      HasSubstr("random.to = 2000 Hz: must be above 0.1 Hz and at most the Nyquist frequency"));
  expect_refused(run({"simulate", "--hold", "second"}),
                 "--hold second: must be zero (zero-order hold) or first (first-order hold)");
  expect_refused(run({"simulate", "--modes", "0"}), "--modes = 0: must be 1 or more");
  expect_refused(run({"simulate", "--period", "0"}),
                 "--period = 0 s: must be a finite number above 0");
  expect_refused(run({"simulate", "--sensor", "hub_angle,hub_angle"}),
                 "--sensor: hub_angle given twice");
  expect_refused(run({"simulate", "--noise-of", "tip_deflection=1"}),
                 "--noise-of tip_deflection=1: tip_deflection is not among --sensor");
  expect_refused(run({"simulate", "rig.toml", "--hide-effects", "torque_gian"}),
                 "--hide-effects torque_gian: not an effect of the arm (did you mean "
                 "torque_gain?); its effects are coulomb_friction, torque_gain, all");
  expect_refused(run({"simulate", "--json", "none/out.json"}),
                 "none/out.json: cannot be written: there is no folder none");
}

TEST_F(Simulate, TheExampleInItsHelpWorks) {
  EXPECT_THAT(output_of_example("simulate"), HasSubstr("wrote measured"));
}

}  // namespace
}  // namespace flexarm::testing_app
