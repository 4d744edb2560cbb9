// flexarm simulate --excitation stepped-sine: a run of kind frf.
#include "measured/files/frequency_record.hpp"
#include "measured/files/measurement.hpp"
#include "measured/files/run_data.hpp"
#include "measured/modal/nyquist_circle.hpp"
#include "tests/app/flexarm_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <csignal>
#include <variant>

namespace flexarm::testing_app {
namespace {

using Json = nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kLinearRig =
    "name = \"rig\"\n[beam]\nlength = 0.96\nflexural_rigidity = 3.69180\n"
    "linear_density = 0.164858\n[hub]\ninertia = 5.86e-4\nviscous_friction = 2e-4\n"
    "[damping]\nkelvin_voigt = 1e-4\n";

class SteppedSine : public Flexarm {
 protected:
  SteppedSine() {
    write("rig.toml", kLinearRig);
    write("dry.toml", std::string(kLinearRig) + "[effects.coulomb_friction]\ntorque = 0.01\n");
    write("up.toml", std::string(kLinearRig) + "[effects.gravity]\nacceleration = -9.81\n");
  }
  measured::RunData run_of(const std::string& folder, std::size_t index) const {
    const auto file = folder_ / folder / "measurement.toml";
    return measured::read_run(file, measured::read_measurement(file).runs.at(index));
  }
};

TEST_F(SteppedSine, IsARunOfTheMeasurementBesideOthers) {
  const Ended ended =
      run({"simulate", "rig.toml", "--excitation",
           "stepped-sine:bands=2.8:2.9/11.8:11.9,step=0.05,id=fine,payload=0.02,purpose=validation",
           "--excitation", "bang-bang", "--duration", "1", "--sensor", "hub_angle,tip_acceleration",
           "--out", "out", "--json", "out.json"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_EQ(ended.errors, "");
  EXPECT_THAT(ended.output,
              AllOf(HasSubstr("2.8:2.9/11.8:11.9"), HasSubstr("step 0.05"), HasSubstr("rad/(N m)"),
                    HasSubstr("\nEnergy balance: "), Not(HasSubstr("the response changed")),
                    HasSubstr("flexarm identify out/measurement.toml")));
  EXPECT_THAT(names_in("out"),
              ElementsAre("arm.toml", "bang-bang.csv", "bang-bang.svg", "fine-hub_angle.svg",
                          "fine-tip_acceleration.svg", "fine.csv", "measurement.toml"));
  const auto measurement = measured::read_measurement(folder_ / "out/measurement.toml");
  ASSERT_EQ(measurement.runs.size(), 2U);
  EXPECT_EQ(measurement.runs[0].kind, measured::RunKind::frf);
  EXPECT_EQ(measurement.runs[0].purpose, measured::Purpose::validation);
  EXPECT_EQ(measurement.runs[0].payload, (arm::Payload{0.02, 0.0}));
  EXPECT_EQ(measurement.runs[1].kind, measured::RunKind::time);
  const auto record = std::get<measured::FrequencyRecord>(run_of("out", 0));
  ASSERT_EQ(record.channels.size(), 2U);
  EXPECT_THAT(record.channels[0].frequency_Hz, ElementsAre(2.8, 2.85, 2.9, 11.8, 11.85, 11.9));
  EXPECT_TRUE(std::isnan(record.channels[0].coherence[0]));
  EXPECT_TRUE(std::holds_alternative<measured::TimeRecord>(run_of("out", 1)));

  const Json json = Json::parse(text_of("out.json"));
  EXPECT_EQ(json["runs"].size(), 1U);
  const Json& stepped = json["stepped_runs"][0];
  EXPECT_EQ(stepped["id"], "fine");
  EXPECT_EQ(stepped["unsettled"], 0);
  EXPECT_EQ(stepped["channels"][1]["re"][3], record.channels[1].response[3].real());
  EXPECT_TRUE(stepped["channels"][1]["coherence"][3].is_null());
}

TEST_F(SteppedSine, CirclesOfWhatWasWrittenAreThePoles) {
  ASSERT_EQ(run({"simulate", "rig.toml", "--excitation",
                 "stepped-sine:from=11.6,to=12.1,step=0.001", "--noise", "0.001", "--out", "out"})
                .status,
            0);
  // The pole of Table 1, 11.8618 Hz, and of this damping.
  constexpr double kPole_Hz = 11.8618;
  const double zeta = 0.5 * 1e-4 * 2.0 * 3.14159265358979 * kPole_Hz;
  const auto record = std::get<measured::FrequencyRecord>(run_of("out", 0));
  for (const auto& channel : record.channels) {
    ASSERT_GT(channel.coherence[250], 0.999);
    const auto found = measured::nyquist_circles(channel, {.near_Hz = {kPole_Hz}});
    ASSERT_EQ(found.circles.size(), 1U) << arm::to_string(channel.sensor);
    // As tests/measured/nyquist_circle_test.cpp has it of the exact response; the viscous friction
    // of the hub adds to Kelvin-Voigt's kv omega/2.
    EXPECT_NEAR(found.circles[0].natural_frequency_Hz, kPole_Hz, 2e-4 * kPole_Hz);
    EXPECT_GT(found.circles[0].damping_ratio, zeta);
    EXPECT_LT(found.circles[0].damping_ratio, 1.5 * zeta);
  }
}

TEST_F(SteppedSine, TellsOfFrictionAndOfTransientsThatAreLeft) {
  const Ended steady = run({"simulate", "dry.toml", "--excitation",
                            "stepped-sine:from=2,to=20,points=7,amplitude=0.05"});
  EXPECT_EQ(steady.status, 0) << steady.errors;
  EXPECT_THAT(steady.output, AllOf(HasSubstr("Stick and slip of the hub in the measured cycles"),
                                   Not(HasSubstr("note:")), Not(HasSubstr("Energy"))));
  const Ended early = run(
      {"simulate", "dry.toml", "--excitation", "stepped-sine:from=11,to=12,step=0.5,settle=0.5"});
  EXPECT_THAT(early.output, HasSubstr("note: stepped-sine: at 3 of 3 frequencies the response "
                                      "changed by more than 1e-06"));
}

TEST_F(SteppedSine, NoiseIsThatOfItsSeed) {
  const auto noisy = [&](const std::string& seed, const std::string& folder) {
    const Ended ended = run({"simulate", "rig.toml", "--excitation", "stepped-sine:from=5,to=6",
                             "--noise-of", "hub_angle=0.001", "--seed", seed, "--out", folder});
    EXPECT_EQ(ended.status, 0) << ended.errors;
    return std::get<measured::FrequencyRecord>(run_of(folder, 0));
  };
  const auto first = noisy("1", "a");
  EXPECT_EQ(first, noisy("1", "b"));
  const auto other = noisy("2", "c");
  EXPECT_NE(first.channels[0], other.channels[0]);
  EXPECT_EQ(first.channels[1], other.channels[1]);  // without noise
  EXPECT_LE(first.channels[0].coherence[0], 1.0);
  EXPECT_TRUE(std::isnan(first.channels[1].coherence[0]));
}

TEST_F(SteppedSine, AnInterruptLeavesNoFolder) {
  const Ended ended = interrupt_flexarm(
      {"simulate", "--modes", "40", "--excitation",
       "stepped-sine:from=1,to=50,step=0.001,settle=100", "--out", (folder_ / "out").string()},
      SIGINT);
  EXPECT_EQ(ended.status, 130);
  EXPECT_THAT(names_in(), ElementsAre("dry.toml", "rig.toml", "up.toml"));
}

TEST_F(SteppedSine, BadInputIsOneLineAndStatusTwo) {
  const auto refused = [&](const std::string& keys, const std::string& line) {
    const std::string excitation = "stepped-sine:" + keys;
    expect_refused(run({"simulate", "--excitation", excitation}),
                   "--excitation " + excitation + ": " + line);
  };
  refused("form=3",
          "stepped-sine.form: unknown (did you mean from?); allowed: amplitude, offset, from, to, "
          "bands, step, points, settle, cycles, id, payload, purpose");
  refused("step=-1", "stepped-sine.step = -1 Hz: must be a finite number above 0");
  refused("from=3,from=4", "from: given twice");
  refused("bands=1:2/2:3",
          "stepped-sine.bands = 2 Hz: must be above 2, the end of the previous band");
  expect_refused(run({"simulate", "--excitation", "stepped-sin"}),
                 "--excitation stepped-sin: excitation stepped-sin: unknown (did you mean "
                 "stepped-sine?); allowed: bang-bang, step, random, multisine, chirp, staircase, "
                 "prbs, sine, "
                 "stepped-sine");
  expect_refused(run({"simulate", "--excitation", "stepped-sine", "--duration", "3"}),
                 "--duration: not with a stepped sine");
  expect_refused(run({"simulate", "--excitation", "stepped-sine:id=a", "--check-step"}),
                 "--check-step: only for time runs; a is a stepped sine");
  expect_refused(run({"simulate", "up.toml", "--excitation", "stepped-sine"}),
                 "stepped-sine: stepped-sine: the inverted arm is unstable and has no steady "
                 "state; use another excitation");
}

}  // namespace
}  // namespace flexarm::testing_app
