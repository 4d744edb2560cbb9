// Model descriptions obey the rules of the standard, and the checker of them finds what does not.
#include "arm/input_error.hpp"
#include "effects/registry/vocabulary.hpp"
#include "export/fmu/embedded_files.hpp"
#include "export/fmu/fmu_export.hpp"
#include "tests/export/fmi_rules.hpp"
#include "tests/export/unpacked_fmu.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>

namespace flexarm::testing_export {
namespace {

using fmu::FmiVersion;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

/// An arm with all effects that can stand together.
fmu::FmuRequest full_request(FmiVersion version) {
  arm::Arm arm = arm::paper_arm();
  arm.name = "rig <1> & \"2\"";
  arm.beam.given_flexural_rigidity_N_m2.reset();
  arm.relative_uncertainties["beam.youngs_modulus"] = 0.03;
  for (const char* const name : {"coulomb_friction", "time_delay", "sensor_gain", "sensor_offset",
                                 "torque_ripple", "quadratic_drag", "gravity"}) {
    arm.effects[name] = effects::example(arm::find_effect(effects::vocabulary(), name));
  }
  return {.arm = arm,
          .settings = {.sensors = {{arm::SensorKind::hub_angle},
                                   {arm::SensorKind::tip_acceleration},
                                   {arm::SensorKind::strain, 0.05}}},
          .version = version,
          .model_identifier = "rig_1",
          .standard_deviations = {{"effects.coulomb_friction.torque", 4e-4}}};
}

std::string platform(FmiVersion version) {
  return std::string(version == FmiVersion::v2 ? fmu::kFmi2Platform : fmu::kFmi3Platform);
}

/// Made once.
const UnpackedFmu& full_fmu(FmiVersion version) {
  static std::map<FmiVersion, std::unique_ptr<UnpackedFmu>> made;
  auto& fmu = made[version];
  if (!fmu) {
    fmu = std::make_unique<UnpackedFmu>(fmu::make_fmu(full_request(version)).archive,
                                        platform(version));
  }
  return *fmu;
}

class ModelDescription : public testing::TestWithParam<FmiVersion> {
 protected:
  ModelDescription() : fmu_(full_fmu(GetParam())) {}

  bool is_v2() const { return GetParam() == FmiVersion::v2; }
  const UnpackedFmu& fmu_;
};

TEST_P(ModelDescription, ObeysTheRules) {
  EXPECT_THAT(faults_of(fmu_.description(), GetParam()), IsEmpty());
}

TEST_P(ModelDescription, StatesUnitsStartValuesAndUncertainties) {
  const auto& variables = fmu_.description().one("ModelVariables").children;
  const auto of = [&](const std::string& name) -> const XmlNode& {
    const auto found = std::ranges::find_if(
        variables, [&](const XmlNode& node) { return node.get("name") == name; });
    if (found == variables.end()) throw std::runtime_error(name);
    return *found;
  };
  const auto value = [&](const std::string& name) -> const XmlNode& {
    return is_v2() ? of(name).one("Real") : of(name);
  };
  const auto deviation = [&](const std::string& name) {
    const XmlNode& annotations = of(name).one("Annotations");
    return std::stod(annotations.children.at(0).one("Uncertainty").get("standardDeviation"));
  };
  EXPECT_EQ(value("beam.youngs_modulus").get("start"), "71100000000");
  EXPECT_EQ(value("beam.youngs_modulus").get("unit"), "Pa");
  EXPECT_DOUBLE_EQ(deviation("beam.youngs_modulus"), 0.03 * 7.11e10);
  EXPECT_THAT(of("beam.youngs_modulus").get("description"),
              HasSubstr("standard deviation 2.13e+09 Pa"));
  EXPECT_EQ(value("effects.coulomb_friction.torque").get("unit"), "N m");
  EXPECT_DOUBLE_EQ(deviation("effects.coulomb_friction.torque"), 4e-4);
  EXPECT_EQ(value("'strain@0.05'").get("unit"), "1");
  EXPECT_EQ(fmu_.description().get("modelName"), "rig <1> & \"2\"");
}

TEST_P(ModelDescription, HasTheLibraryAndItsSourcesBesideIt) {
  const auto& names = fmu_.names();
  EXPECT_EQ(names.front(), "modelDescription.xml");
  for (const char* const name :
       {"resources/arm.toml", "resources/settings.toml", "sources/CMakeLists.txt",
        "sources/export/fmu_wrapper/fmi2_functions.cpp", "documentation/index.html",
        "documentation/licenses/license.txt"}) {
    EXPECT_THAT(names, Contains(name));
  }
  EXPECT_THAT(names, Contains("binaries/" + platform(GetParam()) + "/rig_1.so"));
  if (is_v2()) {
    for (const XmlNode& file : fmu_.description().one("CoSimulation").one("SourceFiles").children) {
      EXPECT_THAT(names, Contains("sources/" + file.get("name")));
    }
  } else {
    const XmlNode build = parse_xml(fmu_.text_of("sources/buildDescription.xml"));
    EXPECT_THAT(faults_of_build(build), IsEmpty());
    for (const XmlNode* file :
         build.one("BuildConfiguration").one("SourceFileSet").all("SourceFile")) {
      EXPECT_THAT(names, Contains("sources/" + file->get("name")));
    }
  }
}

TEST_P(ModelDescription, IsTheSameForTheSameArmAndHasAnotherTokenForAnother) {
  const auto first = fmu::make_fmu(full_request(GetParam()));
  EXPECT_EQ(fmu::make_fmu(full_request(GetParam())).archive, first.archive);
  auto other = full_request(GetParam());
  other.arm.payload.mass_kg = 0.01;
  EXPECT_NE(fmu::make_fmu(other).description.settings.token, first.description.settings.token);
}

/// Something that the standard does not allow, and what the checker says of it.
struct Violation {
  std::string says;
  std::function<void(XmlNode&)> make;
};

XmlNode& child(XmlNode& node, const std::string& name) {
  const auto found = std::ranges::find(node.children, name, &XmlNode::name);
  if (found == node.children.end()) throw std::runtime_error(name);
  return *found;
}

TEST_P(ModelDescription, IsRefusedByTheCheckerWhereItBreaksARule) {
  const auto variables = [](XmlNode& root) -> std::vector<XmlNode>& {
    return child(root, "ModelVariables").children;
  };
  const bool v2 = is_v2();
  const auto value = [&](XmlNode& root, std::size_t i) -> XmlNode& {
    XmlNode& variable = variables(root)[i];
    return v2 ? child(variable, "Real") : variable;
  };
  const auto outputs = [&](XmlNode& root) -> std::vector<XmlNode>& {
    XmlNode& structure = child(root, "ModelStructure");
    return v2 ? child(structure, "Outputs").children : structure.children;
  };
  constexpr std::size_t kTorque = 1;
  constexpr std::size_t kOutput = 2;
  constexpr std::size_t kParameter = 5;
  const std::vector<Violation> violations = {
      {"attribute modelName is missing", [](XmlNode& root) { root.attributes.erase("modelName"); }},
      {"unknown attribute colour", [](XmlNode& root) { root.attributes["colour"] = "red"; }},
      {"is not of type", [](XmlNode& root) { root.attributes["fmiVersion"] = "1.0"; }},
      {"is not of type boolean",
       [](XmlNode& root) {
         child(root, "CoSimulation").attributes["needsExecutionTool"] = "maybe";
       }},
      {"may not stand there", [](XmlNode& root) { std::swap(root.children[0], root.children[1]); }},
      {"elements ModelStructure",
       [](XmlNode& root) {
         std::erase_if(root.children,
                       [](const XmlNode& node) { return node.name == "ModelStructure"; });
       }},
      {"is not unique",
       [&](XmlNode& root) {
         variables(root)[kOutput].attributes["name"] = variables(root)[kTorque].get("name");
       }},
      {"valueReference 1 is not unique",
       [&](XmlNode& root) { variables(root)[kOutput].attributes["valueReference"] = "1"; }},
      {"is not defined",
       [&](XmlNode& root) { value(root, kParameter).attributes["unit"] = "furlong"; }},
      {"start value", [&](XmlNode& root) { value(root, kParameter).attributes.erase("start"); }},
      {"start value", [&](XmlNode& root) { value(root, kOutput).attributes["start"] = "0"; }},
      {"start value below min",
       [&](XmlNode& root) { value(root, kParameter).attributes["start"] = "-1"; }},
      {"causality, variability, initial",
       [&](XmlNode& root) {
         variables(root)[kParameter].attributes["variability"] = "continuous";
       }},
      {"causality, variability, initial",
       [&](XmlNode& root) { variables(root)[kTorque].attributes["initial"] = "exact"; }},
      {"not a structured name",
       [&](XmlNode& root) { variables(root)[kParameter].attributes["name"] = "beam length"; }},
      {"Outputs: not exactly", [&](XmlNode& root) { outputs(root).erase(outputs(root).begin()); }},
      {"Outputs: not in the order",
       [&](XmlNode& root) { std::swap(outputs(root)[0], outputs(root)[1]); }},
      {"Outputs: depends on",
       [&](XmlNode& root) {
         outputs(root)[0].attributes["dependencies"] = "4";
         outputs(root)[0].attributes["dependenciesKind"] = "dependent";
       }},
      {"another length than dependencies",
       [&](XmlNode& root) { outputs(root)[0].attributes["dependenciesKind"] = "dependent"; }},
  };
  for (const Violation& violation : violations) {
    XmlNode root = fmu_.description();
    violation.make(root);
    EXPECT_THAT(faults_of(root, GetParam()), Contains(HasSubstr(violation.says)));
  }
}

INSTANTIATE_TEST_SUITE_P(Versions, ModelDescription,
                         testing::Values(FmiVersion::v2, FmiVersion::v3), [](const auto& of) {
                           return of.param == FmiVersion::v2 ? "fmi2" : "fmi3";
                         });

TEST(FmuRequest, OfAnEffectThatIsNotModelledIsRefusedByItsName) {
  auto refused = full_request(FmiVersion::v2);
  refused.arm.effects["torque_bias"] =
      effects::example(arm::find_effect(effects::vocabulary(), "torque_bias"));
  arm::Effect late = effects::effect("torque_dead_zone", {{"width", 0.01}});
  late = arm::redefined(late, [](arm::EffectDefinition& definition) {
    definition.torque_path = [](const arm::Effect&) {
      return arm::TorqueStage{arm::torque_order::kLag, arm::Lag{0.01}};
    };
  });
  refused.arm.effects["torque_dead_zone"] = late;
  refused.arm.effects["actuator_lag"] = effects::effect("actuator_lag", {{"time_constant", 0.01}});
  try {
    fmu::make_fmu(refused);
    FAIL();
  } catch (const arm::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("torque_dead_zone"));
  }
}

TEST(FmuRequest, OfASensorThatTheArmCannotCarryIsRefused) {
  auto refused = full_request(FmiVersion::v2);
  refused.settings.sensors = {{arm::SensorKind::strain, 5.0}};
  EXPECT_THROW(fmu::make_fmu(refused), arm::InputError);
}

TEST(FmuIdentifier, IsOneOfC) {
  EXPECT_EQ(fmu::identifier_of("arm-2 b"), "arm_2_b");
  EXPECT_EQ(fmu::identifier_of("2arm"), "arm_2arm");
  EXPECT_EQ(fmu::identifier_of(""), "arm_");
}

}  // namespace
}  // namespace flexarm::testing_export
