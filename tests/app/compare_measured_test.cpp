#include "tests/app/flexarm_fixture.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

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

class CompareMeasured : public Flexarm {
 protected:
  /// The comparison of rig.toml with a measurement, and its text.
  Json compared(const std::string& measured, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"compare", "rig.toml", "--quick", "--poles",
                                          "3",       "--zeros",  "1",       "--measured",
                                          measured,  "--json",   "c.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = run(arguments);
    EXPECT_EQ(ended.status, 0) << ended.errors;
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
  const Json pole = compared("modal.csv")["measured"][0];
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

TEST_F(CompareMeasured, SimulatesTimeRunsOfTheMeasurementsOwnArm) {
  write("rig.toml", kUncertainArm);
  ASSERT_EQ(run({"simulate", "rig.toml", "--modes", "16", "--duration", "2", "--out", "s"}).status,
            0);
  const Ended ended = run({"compare", "--quick", "--poles", "2", "--measured", "s/measurement.toml",
                           "--json", "c.json"});
  ASSERT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output, AllOf(HasSubstr("Measurement: no standard deviation is known"),
                                  HasSubstr("Formulations: agree.")));
  const Json runs = Json::parse(text_of("c.json"))["comparisons"][0]["measured_runs"];
  ASSERT_EQ(runs.size(), 1U);
  for (const auto& channel : runs[0]["channels"]) {
    EXPECT_GT(channel["fit_percent"].get<double>(), 99.0) << channel["channel"];
  }
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

}  // namespace
}  // namespace flexarm::testing_app
