#include "tests/app/flexarm_fixture.hpp"
#include "tests/app/page_contract.hpp"
#include "tests/environment_variable.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

namespace flexarm::testing_app {
namespace {

using Json = nlohmann::json;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing_environment::EnvironmentVariable;

const std::string kArmOfReport =
    "[beam]\nlength = 0.96\nthickness = 0.0032\nflexural_rigidity = 3.7\n"
    "linear_density = 0.165\n[hub]\ninertia = 0.0006\nviscous_friction = 0.002\n"
    "[damping]\nkelvin_voigt = 1e-4\n";

class Report : public Flexarm {
 protected:
  /// Two runs in sim/, of an arm with a payload that the arm file beside them lacks.
  void simulate() const {
    write("true.toml", kArmOfReport + "[effects.payload_mass]\nmass = 0.02\n");
    const Ended ended = run({"simulate", "true.toml", "--duration", "3", "--period", "0.002",
                             "--sensor", "hub_angle,tip_acceleration", "--noise", "0.005",
                             "--excitation", "random:rms=0.05,to=60,id=random", "--excitation",
                             "multisine:rms=0.05,from=0.5,to=60,id=multisine", "--out", "sim"});
    ASSERT_EQ(ended.status, 0) << ended.errors;
    write("sim/arm.toml", kArmOfReport);
  }

  /// Runs a command with a report and JSON, and reads the page, which must obey the contract.
  ReadPage page_of(std::vector<std::string> command) const {
    command.insert(command.end(), {"--report", "page.html", "--json", "out.json"});
    const Ended ended = run(command);
    EXPECT_EQ(ended.status, 0) << ended.errors;
    EXPECT_THAT(ended.output, EndsWith("wrote page.html\n"));
    ReadPage page = read_page(text_of("page.html"));
    EXPECT_THAT(contract_faults(page), IsEmpty());
    EXPECT_THAT(page.document["program"].get<std::string>(), HasSubstr("flexarm 0."));
    EXPECT_THAT(page.document["command"].get<std::string>(),
                HasSubstr("flexarm " + command.front()));
    return page;
  }
  Json json() const { return Json::parse(text_of("out.json")); }
};

/// Cells of a column, by its title.
std::vector<std::string> column_of(const Json& table, const std::string& title) {
  std::vector<std::string> cells;
  for (std::size_t c = 0; c < table["columns"].size(); ++c) {
    if (table["columns"][c]["title"] != title) continue;
    for (const Json& row : table["rows"]) cells.push_back(row[c]);
  }
  return cells;
}

double rms(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

TEST_F(Report, OfADiagnosisShowsTheCauseAndTheNumbersOfTheJson) {
  simulate();
  const ReadPage page = page_of(
      {"diagnose", "sim/measurement.toml", "--effects", "payload_mass,time_delay,hub_inertia"});
  const Json told = json();
  EXPECT_EQ(page.document["verdict"]["status"], "good");
  EXPECT_EQ(page.document["verdict"]["word"], "explained");
  EXPECT_THAT(page.document["verdict"]["sentence"].get<std::string>(), HasSubstr("payload mass"));
  const Json ranking = page.block("ranking");
  EXPECT_EQ(ranking["items"][0]["label"], "Payload mass");
  EXPECT_EQ(ranking["items"][0]["share"], told["causes"][0]["confidence"]);
  EXPECT_EQ(ranking["items"][0]["chosen"], true);
  EXPECT_THAT(ranking["items"], SizeIs(told["causes"].size())) << "and nothing else";

  // The first screen has the cause with its value, what is left, and the next step.
  ASSERT_THAT(page.document["results"], SizeIs(1));
  EXPECT_EQ(page.document["results"][0]["label"], "Payload mass, mass");
  EXPECT_THAT(page.document["results"][0]["value"].get<std::string>(),
              testing::MatchesRegex("0\\.0[0-9]+ ± .* kg, probability .*"));
  EXPECT_THAT(page.document["facts"][0]["value"].get<std::string>(), HasSubstr(" % → "));
  EXPECT_THAT(page.document["next_step"].get<std::string>(), HasSubstr("extended arm"));

  const auto mass = column_of(page.block("cause-table"), "value");
  ASSERT_THAT(mass, SizeIs(1));
  const double value = told["causes"][0]["parameters"]["mass"]["value"];
  EXPECT_NEAR(std::stod(mass.front()), value, 1e-5 * value);  // six digits

  // NRMSE of each channel, from the signals and residuals that the page draws.
  const Json overlay = page.block("overlay");
  ASSERT_EQ(overlay["views"].size(), told["residual"]["channels"].size());
  for (const Json& view : overlay["views"]) {
    const auto signal = page.numbers(view["panels"][0]["series"][0]["data"]["y"]);
    double mean = 0.0;
    for (const double one : signal) mean += one / static_cast<double>(signal.size());
    double variance = 0.0;
    for (const double one : signal) {
      variance += (one - mean) * (one - mean) / static_cast<double>(signal.size());
    }
    const auto before = page.numbers(view["panels"][1]["series"][0]["data"]["y"]);
    const auto after = page.numbers(view["panels"][2]["series"][0]["data"]["y"]);
    for (const Json& channel : told["residual"]["channels"]) {
      const bool is_angle = channel["sensor"] == "hub_angle";
      if (channel["run"] != view["labels"][0] || is_angle != (view["labels"][1] == "hub angle")) {
        continue;
      }
      constexpr double kSinglePrecision = 1e-4;
      EXPECT_NEAR(rms(before) / std::sqrt(variance), channel["before"],
                  kSinglePrecision * channel["before"].get<double>());
      EXPECT_NEAR(rms(after) / std::sqrt(variance), channel["after"],
                  kSinglePrecision * channel["after"].get<double>());
    }
  }
  // The worst channel is first, and on the first screen.
  double worst = 0.0;
  std::string worst_run;
  for (const Json& channel : told["residual"]["channels"]) {
    const double beyond = channel["before"].get<double>() - channel["noise_floor"].get<double>();
    if (beyond <= worst) continue;
    worst = beyond;
    worst_run = channel["run"];
  }
  EXPECT_EQ(overlay["views"][0]["labels"][0], worst_run);
  EXPECT_EQ(page.document["headline"]["id"], "overlay");
  // The whole run is in the page, a part of it is in view first; the torque is below.
  const Json first = overlay["views"][0];
  const Json torque = first["panels"].back();
  EXPECT_EQ(torque["y"]["label"], "torque");
  EXPECT_EQ(torque["series"][0]["data"]["y"]["count"], 1500);
  EXPECT_EQ(first["panels"][0]["series"][0]["data"]["y"]["count"], 1500);
  EXPECT_NEAR(first["shown"][1].get<double>() - first["shown"][0].get<double>(), 499 * 0.002, 1e-9);

  for (const char* id : {"correlation", "response", "map-hub-angle", "map-tip-acceleration",
                         "statements", "nrmse-by-channel", "evidence"}) {
    EXPECT_FALSE(page.block(id).is_null()) << id;
  }
  // Residuals of the extended arm are white: few lags are beyond the bounds. Those of the arm file
  // are not.
  Json correlation;
  const Json correlation_views = page.block("correlation")["views"];
  for (const Json& view : correlation_views) {
    if (view["labels"] == Json({"random", "hub angle"})) correlation = view["panels"][0];
  }
  const double bound = correlation["levels"][1]["y"];
  const auto beyond = [&](const Json& series) {
    const auto r = page.numbers(series["data"]["y"]);
    EXPECT_EQ(r[100], 1.0);
    return std::count_if(r.begin() + 101, r.end(),
                         [&](double one) { return std::abs(one) > bound; });
  };
  EXPECT_GE(beyond(correlation["series"][0]), 30);
  EXPECT_LE(beyond(correlation["series"][1]), 5);
  // Tip zeros in the right half plane are marked.
  std::size_t marked = 0;
  const Json tip_points = page.block("map-tip-acceleration")["points"];
  for (const Json& point : tip_points) {
    marked += point["non_minimum_phase"].get<bool>() ? 1U : 0U;
  }
  EXPECT_GE(marked, 2U);
}

TEST_F(Report, OfModalTablesShowsThemInAMap) {
  const std::string measurement =
      std::string(FLEXARM_SOURCE_DIR) + "/data/paper/diagnosis/tables-4-5.toml";
  const ReadPage page = page_of({"diagnose", measurement, "--effects", "hub_inertia"});
  EXPECT_EQ(page.document["headline"]["kind"], "map");
  EXPECT_TRUE(page.block("overlay").is_null());
}

TEST_F(Report, OfResponsesShowsTheWorstOne) {
  write("true.toml", kArmOfReport + "[effects.payload_mass]\nmass = 0.02\n");
  const Ended simulated =
      run({"simulate", "true.toml", "--noise", "0.001", "--sensor", "hub_angle,tip_acceleration",
           "--excitation", "stepped-sine:amplitude=0.05,bands=2.5:3.5/11:13/34:37,step=0.1",
           "--out", "sim"});
  ASSERT_EQ(simulated.status, 0) << simulated.errors;
  write("sim/arm.toml", kArmOfReport);
  const ReadPage page = page_of({"diagnose", "sim/measurement.toml", "--effects", "payload_mass"});
  // No curve crosses a band that was not measured: a gap before each of the second and third.
  const Json views = page.block("response")["views"];
  ASSERT_THAT(views, SizeIs(2));
  for (const Json& panel : views[0]["panels"]) {
    for (const Json& series : panel["series"]) {
      const auto y = page.numbers(series["data"]["y"]);
      EXPECT_GE(std::count_if(y.begin(), y.end(), [](double one) { return std::isnan(one); }), 2)
          << panel["y"]["label"];
    }
  }
}

TEST_F(Report, OfAComparisonHasTheRootsOfTheJson) {
  write("arm.toml", kArmOfReport);
  const ReadPage page = page_of({"compare", "arm.toml", "--poles", "4", "--zeros", "3", "--quick",
                                 "--payload-mass", "0,0.05"});
  EXPECT_EQ(page.document["verdict"]["word"], "formulations agree");
  EXPECT_EQ(page.document["headline"]["choices"], Json({"arm", "sensor"}));
  std::size_t points = 0;
  const Json hub_points = page.block("map-hub-angle")["points"];
  for (const Json& point : hub_points) {
    points += point["mark"] == "pole" ? 1U : 0U;
  }
  EXPECT_EQ(points, 2U * 4U);  // conjugates; the formulations coincide
  // The slider moves the poles: heavier payloads, lower frequencies.
  const Json sweep = page.section("payload")["blocks"][0];
  EXPECT_EQ(sweep["parameter"]["label"], "payload mass");
  const auto first_pole = page.numbers(sweep["tracks"][0]["frequency"]);
  EXPECT_EQ(first_pole.size(), 41U);
  EXPECT_GT(first_pole.front(), 1.2 * first_pole.back());
}

/// Re s of the zeros beside the Re s that Kelvin-Voigt damping alone makes of undamped ones,
/// -kv |s|^2/2 (s^2 + kv w^2 s + w^2 = 0).
void expect_kelvin_voigt_zeros(const Json& points, const std::string& role, double kelvin_voigt_s) {
  int zeros = 0;
  for (const Json& point : points) {
    if (point["mark"] != "zero" || point["role"] != role) continue;
    const double real = point["real"];
    const double imaginary = point["imaginary"];
    const double expected = -0.5 * kelvin_voigt_s * (real * real + imaginary * imaginary);
    EXPECT_NEAR(real, expected, 1e-6 * std::abs(expected));
    ++zeros;
  }
  EXPECT_GT(zeros, 0);
}

TEST_F(Report, MapsHaveTheZerosOfTheDampedArm) {
  constexpr double kKelvinVoigt_s = 1e-4;  // of the arm; friction of the hub moves none of them
  write("arm.toml", kArmOfReport);
  const ReadPage compared = page_of({"compare", "arm.toml", "--poles", "4", "--zeros", "3",
                                     "--quick", "--sensor", "hub_angle"});
  const Json compared_points = compared.block("map-hub-angle")["points"];
  expect_kelvin_voigt_zeros(compared_points, compared_points[0]["role"], kKelvinVoigt_s);

  ASSERT_EQ(run({"simulate", "arm.toml", "--duration", "4", "--period", "0.002", "--sensor",
                 "hub_angle", "--noise", "0.001", "--excitation",
                 "random:rms=0.05,to=60,id=random", "--out", "sim"})
                .status,
            0);
  const ReadPage identified = page_of({"identify", "sim/measurement.toml"});
  expect_kelvin_voigt_zeros(identified.block("map-hub-angle")["points"], "before", kKelvinVoigt_s);
}

TEST_F(Report, OfASweepHasItsTracks) {
  write("arm.toml", kArmOfReport);
  const ReadPage page = page_of(
      {"sweep", "arm.toml", "--over", "payload.mass=0.2:0:6", "--poles", "3", "--zeros", "2"});
  const Json headline = page.document["headline"];
  EXPECT_EQ(headline["kind"], "sweep");
  const auto values = page.numbers(headline["values"]);
  EXPECT_THAT(values,
              testing::Pointwise(testing::DoubleNear(1e-15), {0.0, 0.04, 0.08, 0.12, 0.16, 0.2}));
  EXPECT_FALSE(page.block("agreement-table").is_null());
}

TEST_F(Report, OfASweepOverTwoParametersHasRows) {
  write("arm.toml", kArmOfReport);
  const ReadPage page =
      page_of({"sweep", "arm.toml", "--over", "hub.inertia=0.001,0.01", "--over",
               "payload.mass=0:0.2:5", "--poles", "2", "--zeros", "2", "--sensor", "hub_angle"});
  EXPECT_EQ(page.block("sweep-curves")["choices"], Json({"numbers", "hub inertia"}));
}

TEST_F(Report, OfAnIdentificationHasPolesWithStandardErrors) {
  simulate();
  const ReadPage page = page_of({"identify", "sim/measurement.toml"});
  bool has_error = false;
  const Json hub_points = page.block("map-hub-angle")["points"];
  for (const Json& point : hub_points) {
    if (point["role"] == "measured" && point.contains("imaginary_std")) has_error = true;
  }
  EXPECT_TRUE(has_error);
  for (const char* id : {"responses", "autopower", "stabilisation", "recorded", "settings"}) {
    EXPECT_FALSE(page.block(id).is_null()) << id;
  }
  // Recorded signals are whole.
  const Json torque = page.block("recorded")["views"][0]["panels"][0]["series"][0]["data"];
  EXPECT_EQ(torque["kind"], "samples");
  EXPECT_EQ(torque["y"]["count"], 1500);
}

TEST_F(Report, OfAPlanHasTheEffectsOfTheJson) {
  const std::string plans = std::string(FLEXARM_SOURCE_DIR) + "/data/plans/";
  const ReadPage page = page_of({"plan", plans + "arm.toml", plans + "modal-table.toml",
                                 "--effects", "payload_mass,hub_inertia,root_compliance"});
  EXPECT_THAT(page.document["headline"]["items"], SizeIs(3));
  EXPECT_THAT(page.block("effects")["rows"], SizeIs(json()["effects"].size()));
  EXPECT_THAT(page.block("standard-errors")["rows"], SizeIs(testing::Ge(1U)));
}

TEST_F(Report, OfASimulationThatIsRightHasNoExtendedArm) {
  write("true.toml", kArmOfReport);
  const Ended ended =
      run({"simulate", "true.toml", "--duration", "2", "--period", "0.002", "--sensor", "hub_angle",
           "--noise", "0.01", "--excitation", "random:rms=0.05,to=60,id=random", "--out", "right"});
  ASSERT_EQ(ended.status, 0) << ended.errors;
  const ReadPage page =
      page_of({"diagnose", "right/measurement.toml", "--effects", "payload_mass,time_delay"});
  EXPECT_EQ(page.document["verdict"]["word"], "adequate");
  EXPECT_THAT(page.document["results"], IsEmpty());
  EXPECT_EQ(page.document.dump().find("extended arm"), std::string::npos);
}

TEST_F(Report, HasTheDateOfTheRunOrTheOneAskedFor) {
  write("arm.toml", kArmOfReport);
  const EnvironmentVariable epoch("SOURCE_DATE_EPOCH", "86400");
  const ReadPage page =
      page_of({"sweep", "arm.toml", "--over", "payload.mass=0:0.2:3", "--poles", "2"});
  EXPECT_EQ(page.document["date"], "1970-01-02");
}

TEST_F(Report, IsRefusedBeforeTheWork) {
  write("arm.toml", kArmOfReport);
  const auto refused = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"compare", "arm.toml"});
    const Ended ended = run(options);
    EXPECT_EQ(ended.status, 2) << ended.output;
    EXPECT_EQ(ended.output, "");
    return ended.errors;
  };
  EXPECT_THAT(refused({"--report", "page.txt"}), HasSubstr("--report page.txt: must end in .html"));
  EXPECT_THAT(refused({"--report", "none/page.html"}), HasSubstr("none/page.html"));
  EXPECT_THAT(refused({"--report", "x.html", "--json", "x.html"}),
              HasSubstr("same file as --json"));
  write("arm.html", kArmOfReport);
  const Ended ended = run({"compare", "arm.html", "--report", "arm.html"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.errors, HasSubstr("--report arm.html: would overwrite the input"));
  EXPECT_EQ(text_of("arm.html"), kArmOfReport);
}

}  // namespace
}  // namespace flexarm::testing_app
