#include "tests/app/flexarm_fixture.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace flexarm::testing_app {
namespace {

using Json = nlohmann::json;

class JsonSchema : public Flexarm {
 protected:
  void succeed(const std::vector<std::string>& arguments) const {
    const Ended ended = run(arguments);
    EXPECT_EQ(ended.status, 0) << ended.errors;
  }
  /// What these write with --json.
  Json written_by(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--json", "out.json"});
    succeed(arguments);
    return Json::parse(text_of("out.json"));
  }
};

/// The types seen, or allowed, for the value at each path.
using Types = std::map<std::string, std::set<std::string>>;

std::string type_of(const Json& value) {
  if (value.is_number_integer()) return "integer";
  return value.type_name();
}

/// What stands in the document for the keys of an object that are names, or "".
std::string placeholder(const std::string& path) {
  return path.ends_with(".sensor_values") ? "SENSOR"
         : path.ends_with(".parameters")  ? "PARAMETER"
                                          : "";
}

/// Adds every path below `value` and the type of what is there. Arrays of plain values are one
/// entry: "array of number".
void walk(const Json& value, const std::string& path, Types& seen) {
  const std::string dot = path.empty() ? "" : ".";
  if (value.is_object()) {
    if (!path.ends_with("[]") && !path.empty()) seen[path].insert("object");
    for (const auto& [key, member] : value.items()) {
      const std::string name = placeholder(path);
      walk(member, path + dot + (name.empty() ? key : name), seen);
    }
  } else if (value.is_array()) {
    seen[path].insert("array");
    for (const auto& element : value) walk(element, path + "[]", seen);
  } else {
    seen[path].insert(type_of(value));
  }
}

/// "array of number or null" is an array of numbers and nulls.
void allow(const std::string& path, const std::string& type, Types& documented) {
  constexpr std::string_view kArrayOf = "array of ";
  const bool is_array = type.starts_with(kArrayOf);
  if (is_array) documented[path].insert("array");
  auto& allowed = documented[is_array ? path + "[]" : path];
  std::istringstream words(is_array ? type.substr(kArrayOf.size()) : type);
  for (std::string word; words >> word;) {
    if (word != "or") allowed.insert(word);
  }
}

/// The table under the heading `schema` in docs/json.md.
Types documented(const std::string& schema) {
  const std::string text = measured::read_text_file(FLEXARM_SOURCE_DIR "/docs/json.md", 1 << 20);
  const auto begin = text.find("## `" + schema + "`");
  std::istringstream lines(text.substr(begin, text.find("\n## ", begin) - begin));
  Types keys;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("| `")) continue;
    const auto key_end = line.find("` | ");
    const auto type_end = line.find(" |", key_end + 4);
    allow(line.substr(3, key_end - 3), line.substr(key_end + 4, type_end - key_end - 4), keys);
  }
  return keys;
}

/// `documents` are of one schema and show all of its keys together.
void expect_as_documented(const std::vector<Json>& documents, const std::string& schema) {
  const Types allowed = documented(schema);
  ASSERT_FALSE(allowed.empty());
  Types seen;
  for (const auto& document : documents) {
    EXPECT_EQ(document["schema"], schema);
    walk(document, "", seen);
  }
  for (const auto& [path, types] : seen) {
    const auto row = allowed.find(path);
    if (row == allowed.end()) {
      ADD_FAILURE() << path << " is written, but not in docs/json.md";
      continue;
    }
    for (const auto& type : types) {
      EXPECT_TRUE(row->second.contains(type)) << path << " is written as " << type;
    }
  }
  for (const auto& [path, types] : allowed) {
    EXPECT_TRUE(seen.contains(path)) << path << " is in docs/json.md, but not written";
  }
}

/// An arm file with a linear effect.
const char* const kSoftRoot =
    "[beam]\nlength = 0.96\nthickness = 0.003\nflexural_rigidity = 3.7\n"
    "linear_density = 0.165\n[hub]\ninertia = 0.0006\n"
    "[effects.root_compliance]\nstiffness = 30.0\n";

TEST_F(JsonSchema, WhatCompareWritesIsWhatTheDocumentSays) {
  write("soft.toml", kSoftRoot);
  write("modal.csv",
        "sensor,feature,order,frequency [Hz],frequency_std [Hz],damping_ratio,damping_ratio_std,"
        "shape_re\n,pole,1,12.00,0.1,0.01,0.001,\nhub_angle,zero,1,,,,,\n"
        "strain@0,pole,1,,,,,1\nstrain@0.3,pole,1,,,,,1.5\n");
  write("frf.csv",
        "sensor,frequency [Hz],re,im,coherence\nhub_angle,1,0.1,0,0.9\n"
        "hub_angle,2,0.2,0,\n");
  write("m.toml",
        "arm = \"soft.toml\"\n"
        "[[run]]\nid = \"sine\"\nkind = \"frf\"\nfile = \"frf.csv\"\n"
        "[[run]]\nid = \"loaded\"\nkind = \"frf\"\nfile = \"frf.csv\"\n"
        "payload = { mass = 0.1 }\n");
  write("uncertain.toml", std::string(kSoftRoot).replace(7, 0, "length_uncertainty = 0.01\n"));
  succeed({"simulate", "soft.toml", "--duration", "1", "--modes", "8", "--out", "run"});
  write("late.toml",
        "arm = \"soft.toml\"\n"
        "[[run]]\nid = \"sine\"\nkind = \"frf\"\nfile = \"frf.csv\"\n"
        "[[run]]\nid = \"log\"\nkind = \"time\"\nfile = \"run/bang-bang.csv\"\n");
  const auto compared = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "compare");
    arguments.insert(arguments.end(), {"--poles", "2", "--zeros", "2", "--json", "out.json"});
    EXPECT_LT(run(arguments).status, 2);  // 1: it differs
    return Json::parse(text_of("out.json"));
  };
  expect_as_documented({compared({"--sensor", "strain@0.25", "--measured", "modal.csv"}),
                        compared({"uncertain.toml", "--quick", "--measured", "modal.csv"}),
                        compared({"--quick", "--measured", "frf.csv"}),
                        compared({"--quick", "--measured", "m.toml"}),
                        compared({"--quick", "--measured", "run/measurement.toml"}),
                        compared({"--measured", "late.toml", "--time-limit", "1e-6"}),
                        compared({"soft.toml", "--quick"})},
                       "flexarm.compare/1");
}

TEST_F(JsonSchema, WhatModesWritesIsWhatTheDocumentSays) {
  write("soft.toml", kSoftRoot);
  expect_as_documented({written_by({"modes", "--certificate"}), written_by({"modes", "soft.toml"}),
                        written_by({"modes", "--formulation", "assumed_modes", "--functions", "12",
                                    "--modes", "9", "--sensor", "strain@0.25"})},
                       "flexarm.modes/1");
}

TEST_F(JsonSchema, WhatResponseWritesIsWhatTheDocumentSays) {
  run({"new", "rig.toml"});
  write("rig.toml", text_of("rig.toml") +
                        "\n[effects.coulomb_friction]\ntorque = 0.01\n"
                        "[effects.sensor_lag]\ntime_constant = 0.001\n");
  expect_as_documented(
      {written_by({"response"}), written_by({"response", "rig.toml", "--state-space", "arm.json"})},
      "flexarm.response/1");
  expect_as_documented({Json::parse(text_of("arm.json"))}, "flexarm.state_space/1");
}

TEST_F(JsonSchema, WhatNewWritesIsWhatTheDocumentSays) {
  expect_as_documented({written_by({"new", "rig.toml"})}, "flexarm.new/1");
}

TEST_F(JsonSchema, WhatImportWritesIsWhatTheDocumentSays) {
  write("log.csv", "t_s,torque_Nm,theta_rad,room,door\n0,1,0,2,1\n1,1,0,2,1\n2,1,0,2,1\n");
  write("p.csv", "sensor,feature,order,frequency [Hz]\n,pole,1,11.8\nhub_angle,zero,1,2.9\n");
  expect_as_documented(
      {written_by({"import", "log.csv", "--rows", "2:", "--compute", "hub_velocity=0*room"}),
       written_by({"import", "p.csv"})},
      "flexarm.import/2");
}

TEST_F(JsonSchema, WhatIdentifyWritesIsWhatTheDocumentSays) {
  write("rig.toml", std::string(kSoftRoot) + "[damping]\nkelvin_voigt = 2e-4\n");
  succeed({"simulate", "rig.toml", "--period", "0.005", "--duration", "20", "--noise", "0.005",
           "--sensor", "hub_velocity,tip_acceleration", "--excitation",
           "multisine:rms=0.05,period=5,detection=4,to=60", "--excitation",
           "random:rms=0.05,payload=0.06", "--out", "sim"});
  std::vector<Json> documents = {written_by(
      {"identify", "sim/measurement.toml", "--sensor", "hub_velocity,tip_acceleration"})};
  // A torque of the wrong sign, which no arm can have.
  write("reversed.toml",
        "arm = \"rig.toml\"\n[[run]]\nid = \"random\"\nkind = \"time\"\n"
        "file = \"sim/random.csv\"\n"
        "columns.time = { name = \"time\", unit = \"s\" }\n"
        "columns.torque = { name = \"torque\", unit = \"N m\", scale = -1.0 }\n"
        "columns.hub_velocity = { name = \"hub_velocity\", unit = \"rad/s\" }\n");
  documents.push_back(written_by({"identify", "reversed.toml"}));
  // A dead sensor, a torque that is none, no gains, a table of which one frequency is missing.
  write(
      "dead.csv", "time [s],torque [N m],hub_angle [rad],tip_acceleration [m/s^2]\n" + [&] {
        std::string rows;
        for (int k = 0; k < 400; ++k) {
          rows += fmt::format("{},{},0.5,{}\n", 0.005 * k, k % 3 - 1.0, (k * k) % 17 - 8.0);
        }
        return rows;
      }());
  write("none.csv", "time [s],torque [N m],hub_angle [rad]\n0,0,0\n0.1,0,0\n0.2,0,0\n");
  write("modal.csv",
        "sensor,feature,order,frequency [Hz]\nhub_angle,pole,1,\nhub_angle,pole,2,30\n");
  write("measurement.toml",
        "arm = \"rig.toml\"\n[[run]]\nid = \"dead\"\nkind = \"time\"\nfile = \"dead.csv\"\n"
        "[[run]]\nid = \"none\"\nkind = \"time\"\nfile = \"none.csv\"\n"
        "[[run]]\nid = \"table\"\nkind = \"modal\"\nfile = \"modal.csv\"\n");
  documents.push_back(
      written_by({"identify", "measurement.toml", "--sensor", "hub_angle,tip_acceleration"}));
  expect_as_documented(documents, "flexarm.identify/1");
}

TEST_F(JsonSchema, WhatSimulateWritesIsWhatTheDocumentSays) {
  write("rig.toml",
        "[beam]\nlength = 0.96\nthickness = 0.003\nflexural_rigidity = 3.7\n"
        "linear_density = 0.165\n[hub]\ninertia = 0.0006\n"
        "[effects.sensor_lag]\ntime_constant = 0.001\nsensor = \"hub_angle\"\n"
        "[effects.coulomb_friction]\ntorque = 0.01\n");
  expect_as_documented(
      {written_by({"simulate", "rig.toml", "--excitation", "multisine:to=60,detection=3",
                   "--excitation", "bang-bang", "--check-step", "--duration", "1"}),
       written_by({"simulate"}),
       written_by({"simulate", "--excitation", "stepped-sine:from=1,to=5,points=3", "--noise-of",
                   "hub_angle=1e-3"}),
       written_by({"simulate", "--reference", "step", "--controller", "kp=0.1,kd=0.05"})},
      "flexarm.simulate/1");
}

TEST_F(JsonSchema, WhatDoctorWritesIsWhatTheDocumentSays) {
  expect_as_documented({written_by({"doctor"})}, "flexarm.doctor/1");
}

TEST_F(JsonSchema, WhatPaperWritesIsWhatTheDocumentSays) {
  expect_as_documented({written_by({"paper"})}, "flexarm.paper/1");
}

TEST_F(JsonSchema, WhatDiagnoseWritesIsWhatTheDocumentSays) {
  const std::string arm =
      "[beam]\nlength = 0.96\nthickness = 0.003\nflexural_rigidity = 3.7\n"
      "linear_density = 0.165\n[hub]\ninertia = 0.0006\n[damping]\nkelvin_voigt = 1e-4\n";
  std::vector<Json> documents;
  const auto diagnose = [&](const std::string& measurement, const std::string& effects,
                            const std::vector<std::string>& further = {}) {
    std::vector<std::string> arguments = {"diagnose", measurement, "--effects", effects};
    arguments.insert(arguments.end(), further.begin(), further.end());
    documents.push_back(written_by(arguments));
  };
  std::string uncertain = arm;
  uncertain.replace(uncertain.find("\n[damping]"), 1, "\ninertia_uncertainty = 0.02\n");
  const auto simulate = [&](const std::string& folder, const std::string& hidden) {
    write("true.toml", arm + hidden + "[effects.sensor_lag]\ntime_constant = 0.004\n");
    succeed({"simulate", "true.toml", "--duration", "4", "--period", "0.002", "--sensor",
             "hub_angle,tip_acceleration", "--noise", "0.005", "--excitation",
             "multisine:rms=0.05,from=0.5,to=60,period=1,detection=3,id=odd", "--excitation",
             "random:rms=0.05,to=60,id=random", "--out", folder});
    write(folder + "/arm.toml", uncertain);
  };
  simulate("named", "[effects.payload_mass]\nmass = 0.02\n");
  diagnose("named/measurement.toml",
           "payload_mass,sensor_lag,root_compliance,linear_density,flexural_rigidity,beam_length,"
           "air_damping,hub_viscous_friction,torque_gain,payload_inertia,time_delay");
  simulate("unnamed", "[effects.coulomb_friction]\ntorque = 0.01\n");
  diagnose("unnamed/measurement.toml", "payload_mass,hub_inertia");
  // Laws of hub torque that no effect to be tested is, over velocity and over angle.
  for (const auto* law : {"[effects.coulomb_friction]\ntorque = 0.01\n",
                          "[effects.cogging]\nhub_torque = \"-0.03*sin(3*theta)\"\n"}) {
    write("true.toml", arm + law);
    succeed({"simulate", "true.toml", "--duration", "6", "--period", "0.002", "--sensor",
             "hub_angle", "--noise", "0.0002", "--excitation", "random:rms=0.05,to=3,id=first",
             "--excitation", "random:rms=0.05,to=3,id=second", "--out", "described", "--force"});
    write("described/arm.toml", arm);
    diagnose("described/measurement.toml", "payload_mass", {"--predictor", "torque_balance"});
  }
  diagnose("described/measurement.toml", "payload_mass", {"--predictor", "grey_box"});
  // A missing force whose port is determined.
  write("true.toml", arm + "[effects.coulomb_friction]\ntorque = 0.01\n");
  succeed({"simulate", "true.toml", "--duration", "4", "--period", "0.002", "--sensor",
           "hub_angle,tip_acceleration,strain@0.05", "--noise", "0.005", "--excitation",
           "random:rms=0.05,to=60,id=first", "--excitation", "random:rms=0.05,to=60,id=second",
           "--out", "missing"});
  write("missing/arm.toml", arm);
  diagnose("missing/measurement.toml", "payload_mass", {"--predictor", "output_error"});
  EXPECT_FALSE(documents.back()["missing_force"]["force"].is_null());
  // A search that ends at once, and a sensor that shows noise, which counts as no fault.
  std::minstd_rand random(1);
  std::istringstream lines(measured::read_text_file(folder_ / "unnamed/random.csv", 1 << 24));
  std::string stuck;
  for (std::string line; std::getline(lines, line);) {
    const bool is_sample = !line.empty() && line.find_first_of("0123456789") == 0;
    const double noise = 0.25 + 1e-6 * static_cast<double>(random() % 2001);
    stuck += (is_sample ? fmt::format("{},{:.6f}", line.substr(0, line.rfind(',')), noise) : line) +
             "\n";
  }
  write("unnamed/random.csv", stuck);
  diagnose("unnamed/measurement.toml", "payload_mass,hub_inertia",
           {"--exclude", "hub_inertia", "--time-limit", "0.001"});
  diagnose("unnamed/measurement.toml", "payload_mass", {"--accept", "dead_channel"});

  write("arm.toml", arm);
  write("modal.csv",
        "sensor,feature,order,frequency [Hz],frequency_std [Hz],damping_ratio,damping_ratio_std\n"
        ",pole,1,11.5,0.05,0.005,0.001\n,pole,2,31.2,0.1,,\nhub_angle,zero,1,2.8,0.03,,\n");
  write("modal.toml",
        "arm = \"arm.toml\"\n[[run]]\nid = \"table\"\nkind = \"modal\"\n"
        "file = \"modal.csv\"\n");
  diagnose("modal.toml", "payload_mass,flexural_rigidity,linear_density,root_compliance");
  expect_as_documented(documents, "flexarm.diagnosis/3");
}

TEST_F(JsonSchema, WhatExportWritesIsWhatTheDocumentSays) {
  write("rig.toml",
        "[beam]\nlength = 0.5\nflexural_rigidity = 3.7\nlinear_density = 0.165\n[hub]\n"
        "inertia = 0.0006\ninertia_uncertainty = 0.02\n"
        "[effects.coulomb_friction]\ntorque = 0.01\n");
  const auto state_space =
      written_by({"export", "rig.toml", "--state-space", "samples.json", "--samples", "3"});
  const auto fmu = written_by({"export", "rig.toml", "--fmu"});
  expect_as_documented({state_space, fmu}, "flexarm.export/1");
  expect_as_documented({Json::parse(text_of("samples.json"))}, "flexarm.state_space_samples/1");
}

TEST_F(JsonSchema, WhatPlanWritesIsWhatTheDocumentSays) {
  run({"new", "rig.toml"});
  const auto planned = [&](const std::string& plan) {
    write("plan.toml", plan);
    return written_by(
        {"plan", "rig.toml", "plan.toml", "--effects", "time_delay,actuator_lag,hub_inertia"});
  };
  expect_as_documented(
      {planned("[[run]]\nid = \"hub\"\nkind = \"frf\"\nsensors = [\"hub_angle\"]\n"
               "noise = 0.01\nfrequencies = { from = 0.5, to = 60.0, count = 60 }\n"),
       planned("[[run]]\nid = \"a\"\nkind = \"time\"\nsensors = [\"hub_angle\"]\n"
               "excitation = { kind = \"step\" }\nduration = 0.5\nsample_time = 0.002\n"
               "payload = { mass = 0.05 }\n")},
      "flexarm.plan/2");
}

TEST_F(JsonSchema, WhatSweepWritesIsWhatTheDocumentSays) {
  const auto swept = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "sweep");
    arguments.insert(arguments.end(), {"--json", "out.json"});
    EXPECT_NE(run(arguments).status, 2);
    return Json::parse(text_of("out.json"));
  };
  write("soft.toml", kSoftRoot);
  // Assumed modes cannot tell the sixth zero of the tip of this beam, soft in shear, from rounding.
  write("shear.toml",
        "[beam]\nlength = 0.465\nwidth = 5.12\nthickness = 0.0083\ndensity = 214300\n"
        "youngs_modulus = 149.2e9\nshear_modulus = 145.6e6\n[hub]\ninertia = 0.0345\n"
        "[payload]\nmass = 0.0876\ninertia = 2.13e-7\n"
        "[effects.root_compliance]\nstiffness = 8.34\n"
        "[effects.shear_and_rotary_inertia]\nshear_coefficient = 36.28\n");
  expect_as_documented(
      {swept({"soft.toml", "--over", "payload.mass=0,0.1", "--poles", "2", "--zeros", "1"}),
       swept({"--over", "damping.kelvin_voigt=0:1e-4:2", "--over", "payload.inertia=0:0.002:3"}),
       swept({"shear.toml", "--over", "payload.mass=0.08,0.0876", "--poles", "2", "--zeros", "6"}),
       swept({"--over", "payload.mass=log:0.01:1:2", "--roots-only", "--formulation", "fem"})},
      "flexarm.sweep/1");
}

TEST(JsonSchemaWalk, SeesEveryKeyAndType) {
  Types seen;
  walk(Json::parse(R"({"a": [{"b": 1}, {"b": null}], "c": [1.5], "d": {"e": "x"}})"), "", seen);
  EXPECT_EQ(seen, (Types{{"a", {"array"}},
                         {"a[].b", {"integer", "null"}},
                         {"c", {"array"}},
                         {"c[]", {"number"}},
                         {"d", {"object"}},
                         {"d.e", {"string"}}}));
}

}  // namespace
}  // namespace flexarm::testing_app
