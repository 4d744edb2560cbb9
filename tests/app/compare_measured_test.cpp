#include "tests/app/flexarm_fixture.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace flexarm::testing_app {
namespace {

using Json = nlohmann::json;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kUncertainArm =
    "[beam]\nlength = 0.96\nthickness = 0.0032\nflexural_rigidity = 3.6918\n"
    "flexural_rigidity_uncertainty = 0.02\nlinear_density = 0.164858\n"
    "[hub]\ninertia = 5.86e-4\n";

/// Its highest modes are overdamped: few modes make its motion.
constexpr const char* kDampedArm =
    "[beam]\nlength = 0.96\nthickness = 0.0032\nflexural_rigidity = 3.6918\n"
    "linear_density = 0.164858\n[hub]\ninertia = 5.86e-4\n[damping]\nkelvin_voigt = 5e-4\n";
/// What the default of --measured-tolerance allows: 100 % less 5 %.
constexpr double kLeastFit_percent = 95.0;

class CompareMeasured : public Flexarm {
 protected:
  /// The comparison of rig.toml with a measurement, and its text.
  Json compared(const std::string& measured, const std::vector<std::string>& more = {},
                int status = 0) {
    std::vector<std::string> arguments = {"compare", "rig.toml", "--quick", "--poles",
                                          "3",       "--zeros",  "1",       "--measured",
                                          measured,  "--json",   "c.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = run(arguments);
    EXPECT_EQ(ended.status, status) << ended.errors << ended.output;
    text_ = ended.output;
    return Json::parse(text_of("c.json"))["comparisons"][0];
  }

  /// The response of the arm at the frequencies as a frequency record.
  void write_response(const std::string& frequencies) {
    run({"response", "rig.toml", "--frequencies", frequencies, "--sensor", "hub_angle", "--out",
         "response"});
    write("frf.csv", text_of("response/frf.csv"));
  }

  std::string text_;
};

TEST_F(CompareMeasured, SaysHowManyStandardDeviationsEachFormulationIsOff) {
  write("rig.toml", kUncertainArm);
  write("modal.csv",
        "sensor,feature,order,frequency [Hz],frequency_std [Hz],damping_ratio,damping_ratio_std\n"
        "hub_angle,pole,1,12.00,0.02,0.01,0.002\nhub_angle,zero,1,2.87,,,\n");
  const Json comparison = compared("modal.csv", {}, 1);
  const Json pole = comparison["measured"][0];
  const double model_Hz = pole["model_Hz"];
  ASSERT_EQ(pole["models"].size(), 3U);
  for (const auto& model : pole["models"]) {
    EXPECT_NEAR(model["deviation_std"].get<double>(), (12.0 - model_Hz) / 0.02, 1e-5);
  }
  // A frequency is proportional to the root of the rigidity.
  EXPECT_NEAR(pole["model_std_Hz"].get<double>(), 0.01 * model_Hz, 1e-4);
  EXPECT_NEAR(pole["damping_deviation_std"].get<double>(), 5.0, 1e-9) << "the file has no damping";
  EXPECT_THAT(text_, AllOf(HasSubstr("arm file std"), HasSubstr("assumed_modes"),
                           HasSubstr("2 of 2 measured frequencies are within 2 standard "
                                     "deviations"),
                           HasSubstr("Measured damping ratios")));
  const Json& verdict = comparison["measured_verdict"];
  EXPECT_EQ(verdict["verdict"], "differs");
  EXPECT_EQ(verdict["largest_deviation_of"], "pole 1 damping ratio");
  EXPECT_EQ(verdict["degrees_of_freedom"], 3);
  EXPECT_THAT(text_, AllOf(testing::StartsWith("Measurement: DIFFERS from the model."),
                           HasSubstr("\nFormulations: agree.")));
}

TEST_F(CompareMeasured, OverlaysAFrequencyRecordOnTheBodeDiagram) {
  write("rig.toml", kUncertainArm);
  write_response("0.5,2.5,9.1,20.5,40.5");
  const Json response = compared("frf.csv", {"--out", "out"})["measured_responses"][0];
  EXPECT_EQ(response["sensor"], "hub_angle");
  EXPECT_TRUE(response["run"].is_null());
  for (const auto& model : response["models"]) {
    EXPECT_LT(model["relative_error_percent"].get<double>(), 1e-4);
  }
  EXPECT_THAT(names_in("out"),
              AllOf(Contains("bode-measured-hub_angle.svg"), Contains("measured-responses.csv")));
  EXPECT_THAT(text_, HasSubstr("Measured frequency responses"));
}

TEST_F(CompareMeasured, TakesTheRunsOfAMeasurementThatAreOfThisArm) {
  write("rig.toml", kUncertainArm);
  write_response("0.5,2.5,9.1");
  write("modal.csv", "sensor,feature,order,frequency [Hz]\nhub_angle,pole,1,12.00\n");
  write("m.toml",
        "arm = \"rig.toml\"\n"
        "[[run]]\nid = \"sine\"\nkind = \"frf\"\nfile = \"frf.csv\"\n"
        "[[run]]\nid = \"loaded\"\nkind = \"frf\"\nfile = \"frf.csv\"\npayload = { mass = 0.1 }\n"
        "[[run]]\nid = \"table\"\nkind = \"modal\"\nfile = \"modal.csv\"\n");
  const Json document = compared("m.toml");
  ASSERT_EQ(document["measured_responses"].size(), 1U);
  EXPECT_EQ(document["measured_responses"][0]["run"], "sine");
  EXPECT_EQ(document["measured"].size(), 1U);
  EXPECT_THAT(run({"compare", "rig.toml", "--measured", "m.toml", "--json", "frf.csv"}).errors,
              HasSubstr("--json frf.csv: would overwrite the input frf.csv"));
}

TEST_F(CompareMeasured, ItsVerdictDecidesTheExitStatus) {
  write("rig.toml", kDampedArm);
  write("near.csv", "sensor,feature,order,frequency [Hz]\nhub_angle,pole,1,12.00\n");
  write("far.csv", "sensor,feature,order,frequency [Hz]\nhub_angle,pole,1,17.20\n");
  EXPECT_EQ(compared("near.csv")["measured_verdict"]["verdict"], "agrees");
  EXPECT_THAT(text_, testing::StartsWith("Measurement: agrees with the model."));
  const Json far = compared("far.csv", {}, 1);
  EXPECT_EQ(far["verdict"], "agree");
  EXPECT_EQ(far["measured_verdict"]["verdict"], "differs");
  EXPECT_NEAR(far["measured_verdict"]["largest_difference_percent"].get<double>(), 45.0, 0.1);
  EXPECT_EQ(Json::parse(text_of("c.json"))["measured_verdict"], "differs");
  EXPECT_THAT(text_, HasSubstr("45 % (pole 1 frequency), tolerance 5 %."));
  EXPECT_EQ(compared("far.csv", {"--measured-tolerance", "46"})["measured_verdict"]["verdict"],
            "agrees");
  expect_refused(run({"compare", "rig.toml", "--measured", "far.csv", "--measured-tolerance=-1"}),
                 "--measured-tolerance = -1 %: must be a finite number, 0 or more");
  // Without a measurement there is no verdict on one.
  const Ended alone = run({"compare", "rig.toml", "--quick", "--poles", "3", "--json", "c.json"});
  EXPECT_EQ(alone.status, 0);
  EXPECT_TRUE(Json::parse(text_of("c.json"))["measured_verdict"].is_null());
}

TEST_F(CompareMeasured, SaysWhichOfSeveralArmsTheMeasurementIsOf) {
  write("rig.toml", kUncertainArm);
  write("modal.csv", "sensor,feature,order,frequency [Hz]\nhub_angle,pole,2,32.26\n");
  const Ended ended = run({"compare", "rig.toml", "--quick", "--poles", "3", "--zeros", "1",
                           "--payload-mass", "0,0.3", "--measured", "modal.csv"});
  EXPECT_EQ(ended.status, 1) << ended.errors;
  EXPECT_THAT(ended.output, testing::StartsWith("Measurement: DIFFERS from 1 of 2 arms.\n"
                                                "Formulations, All 2 arms: agree.\n"));
}

/// Payload, material and hub damp so much that |s| of a damped pole is not the undamped frequency.
constexpr const char* kHeavilyDampedArm =
    "[beam]\nlength = 0.5\nthickness = 0.001\nflexural_rigidity = 0.5\nlinear_density = 0.2355\n"
    "[hub]\ninertia = 0.002\nviscous_friction = 0.08\n[payload]\nmass = 0.03\ninertia = 1e-5\n"
    "[damping]\nkelvin_voigt = 0.002\n";

TEST_F(CompareMeasured, PolesOfADampedArmAreComparedWithDampedPoles) {
  write("rig.toml", kHeavilyDampedArm);
  ASSERT_EQ(run({"simulate", "rig.toml", "--excitation", "random:rms=0.2,from=0.3,to=60,seed=5",
                 "--duration", "20", "--period", "0.002", "--noise", "0.002", "--seed", "3",
                 "--sensor", "hub_angle,tip_acceleration", "--out", "test"})
                .status,
            0);
  ASSERT_EQ(run({"identify", "test/measurement.toml", "--out", "identified"}).status, 0);
  const Json comparison = compared("identified/modal-fit-random.csv");
  EXPECT_EQ(comparison["measured_verdict"]["verdict"], "agrees");
  double largest_shift = 0.0;
  for (const auto& row : comparison["measured"]) {
    if (row["feature"] != "pole") continue;
    const double model_Hz = row["model_Hz"];
    const double off_std =
        (row["measured_Hz"].get<double>() - model_Hz) / row["measured_std_Hz"].get<double>();
    EXPECT_LT(std::abs(off_std), 3.5) << row;
    EXPECT_LT(std::abs(row["damping_deviation_std"].get<double>()), 3.5) << row;
    const double shift_std =
        (row["model_undamped_Hz"].get<double>() - model_Hz) / row["measured_std_Hz"].get<double>();
    largest_shift = std::max(largest_shift, std::abs(shift_std));
  }
  EXPECT_GT(largest_shift, 30.0) << "the damped pole is not the undamped one";
  EXPECT_THAT(text_, AllOf(HasSubstr("natural frequencies |s|/2 pi of damped poles"),
                           HasSubstr("Measurement: agrees with the model.")));
}

TEST_F(CompareMeasured, SimulatesTimeRunsOfTheMeasurementsOwnArm) {
  write("rig.toml", kDampedArm);
  ASSERT_EQ(run({"simulate", "rig.toml", "--modes", "16", "--duration", "2", "--out", "s"}).status,
            0);
  const Ended ended = run({"compare", "--quick", "--poles", "2", "--measured", "s/measurement.toml",
                           "--json", "c.json", "--out", "out", "--report", "out/report.html"});
  ASSERT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output, AllOf(testing::StartsWith("Measurement: agrees with the model."),
                                  HasSubstr("Formulations: agree."), HasSubstr("NRMSE")));
  const Json runs = Json::parse(text_of("c.json"))["comparisons"][0]["measured_runs"];
  ASSERT_EQ(runs.size(), 1U);
  for (const auto& channel : runs[0]["channels"]) {
    EXPECT_GT(channel["fit_percent"].get<double>(), kLeastFit_percent) << channel["channel"];
    EXPECT_NEAR(channel["nrmse_percent"].get<double>(),
                100.0 - channel["fit_percent"].get<double>(), 1e-9);
    EXPECT_EQ(channel["simulated"].size(), runs[0]["time_s"].size());
  }
  const std::string id = runs[0]["run"];
  EXPECT_THAT(names_in("out"),
              AllOf(Contains("measured-runs.csv"), Contains("overlay-" + id + ".csv"),
                    Contains("overlay-" + id + ".svg"), Contains("report.html")));
  EXPECT_THAT(text_of("out/overlay-" + id + ".svg"),
              AllOf(HasSubstr("measured"), HasSubstr("simulated"), HasSubstr("fit of the run")));
  EXPECT_THAT(text_of("out/report.html"), HasSubstr("Measured and simulated runs"));
}

TEST_F(CompareMeasured, ARunThatAnotherArmMadeDiffers) {
  write("rig.toml", kDampedArm);
  write("rubbing.toml", std::string(kDampedArm) + "[effects.coulomb_friction]\ntorque = 0.05\n");
  ASSERT_EQ(
      run({"simulate", "rubbing.toml", "--modes", "16", "--duration", "2", "--out", "s"}).status,
      0);
  const Json comparison = compared("s/measurement.toml", {}, 1);
  EXPECT_EQ(comparison["measured_verdict"]["verdict"], "differs");
  EXPECT_THAT(text_, HasSubstr("flexarm diagnose s/measurement.toml\n"));
  EXPECT_THAT(text_, HasSubstr("note: the measurement names the arm s/arm.toml; compared with "
                               "rig.toml"));
}

TEST_F(CompareMeasured, SimulatesAClosedLoopByItsReference) {
  write("rig.toml", std::string(kDampedArm) + "[effects.coulomb_friction]\ntorque = 0.01\n");
  ASSERT_EQ(run({"simulate", "rig.toml", "--modes", "16", "--duration", "3", "--period", "0.002",
                 "--reference", "staircase:amplitude=0.3,dwell=0.7,levels=2", "--controller",
                 "kp=0.2,kd=0.05,limit=0.15,sample_time=0.004", "--out", "loop"})
                .status,
            0);
  const Json comparison = compared("loop/measurement.toml");
  const Json& channels = comparison["measured_runs"][0]["channels"];
  EXPECT_TRUE(comparison["measured_runs"][0]["closed_loop"].get<bool>());
  EXPECT_EQ(channels.back()["channel"], "torque");
  for (const auto& channel : channels) {
    EXPECT_GT(channel["fit_percent"].get<double>(), kLeastFit_percent) << channel["channel"];
  }
}

TEST_F(CompareMeasured, SimulatesRunsOfAHubWithoutABeam) {
  write("rig.toml",
        "name = \"axis\"\n[hub]\ninertia = 0.01\nviscous_friction = 0.02\n"
        "[effects.coulomb_friction]\ntorque = 0.01\n");
  ASSERT_EQ(run({"simulate", "rig.toml", "--duration", "2", "--sensor", "hub_angle", "--out", "s"})
                .status,
            0);
  const Json comparison = compared("s/measurement.toml", {"--out", "out", "--report", "r.html"});
  EXPECT_GT(comparison["measured_runs"][0]["channels"][0]["fit_percent"].get<double>(), 99.0);
  EXPECT_THAT(text_, AllOf(testing::StartsWith("Measurement: agrees with the model."),
                           HasSubstr("Formulations: agree. Without a beam they are the same.")));
  EXPECT_TRUE(comparison["worst"].is_null());
  EXPECT_THAT(names_in("out"), Contains("measured-runs.csv"));
  EXPECT_THAT(text_of("r.html"), HasSubstr("Measured and simulated runs"));
  // Poles and responses need a beam.
  EXPECT_EQ(run({"compare", "rig.toml"}).status, 2);
}

TEST_F(CompareMeasured, RunsOfAnotherPayloadAreNamed) {
  write("rig.toml", kUncertainArm);
  write_response("0.5,2.5,9.1");
  write("m.toml",
        "arm = \"rig.toml\"\n"
        "[[run]]\nid = \"loaded\"\nkind = \"frf\"\nfile = \"frf.csv\"\npayload = { mass = 0.1 }\n");
  const Json comparison = compared("m.toml");
  EXPECT_TRUE(comparison["measured_verdict"].is_null());
  EXPECT_EQ(comparison["runs_left_out"], Json{"loaded"});
  EXPECT_THAT(text_, HasSubstr("note: of another payload than this arm, and not compared: loaded"));
}

TEST_F(CompareMeasured, CorrelatesMeasuredModeShapes) {
  write("rig.toml", kUncertainArm);
  // Strain of the first mode falls from root to tip; of the second it changes its sign.
  write("modal.csv",
        "sensor,feature,order,frequency [Hz],shape_re\n"
        "strain@0,pole,1,12.0,1\nstrain@0.3,pole,1,12.0,1.55\nstrain@0.6,pole,1,,0.8\n"
        "strain@0,pole,2,32.0,1\nstrain@0.3,pole,2,32.0,0.1\nstrain@0.6,pole,2,,-1.2\n");
  const Json document = compared("modal.csv", {"--out", "out"});
  ASSERT_EQ(document["mac"].size(), 1U);
  ASSERT_EQ(document["mac"][0]["models"].size(), 3U);
  EXPECT_EQ(document["mac"][0]["measured"][1]["sensors"],
            (Json{"strain@0", "strain@0.3", "strain@0.6"}));
  EXPECT_THAT(text_, HasSubstr("MAC of measured mode shapes"));
  EXPECT_THAT(names_in("out"), AllOf(Contains("mac.svg"), Contains("mac.csv")));
  const auto plain = text_;
  write("modal.csv", "sensor,feature,order,frequency [Hz]\nstrain@0,pole,1,12.0\n");
  EXPECT_TRUE(compared("modal.csv")["mac"].empty());
  EXPECT_THAT(text_, Not(HasSubstr("MAC of")));
}

TEST_F(CompareMeasured, FailsWhereTheTimeLimitLeavesNothingToCompare) {
  write("rig.toml", kDampedArm);
  ASSERT_EQ(
      run({"simulate", "rig.toml", "--duration", "1", "--period", "0.002", "--out", "sim"}).status,
      0);
  const std::vector<std::string> command = {"compare", "--measured", "sim/measurement.toml",
                                            "--time-limit"};
  const auto with_limit = [&](const char* limit) {
    std::vector<std::string> arguments = command;
    arguments.emplace_back(limit);
    return run(arguments);
  };
  const Ended late = with_limit("1e-6");
  EXPECT_EQ(late.status, 2);
  EXPECT_THAT(late.errors, HasSubstr("--time-limit = 1e-06 s: no run could be simulated within the "
                                     "limit; raise it"));
  EXPECT_EQ(with_limit("1000").status, 0);
  EXPECT_EQ(with_limit("0").status, 2);
  const Ended study = run({"compare", "rig.toml", "--verbose", "--time-limit", "1e-6"});
  EXPECT_EQ(study.status, 0) << study.errors;
  EXPECT_THAT(study.output,
              HasSubstr("warning: the time limit left no time for the whole convergence study"));
}

}  // namespace
}  // namespace flexarm::testing_app
