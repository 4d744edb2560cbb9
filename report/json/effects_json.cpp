#include "report/json/effects_json.hpp"

#include "arm/arm_keys.hpp"
#include "arm/uncertainties.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <string>

namespace flexarm::report {

namespace {

using Json = nlohmann::ordered_json;

Json number_schema(const arm::Range& range, const std::string& unit, const std::string& meaning) {
  Json schema = {{"type", "number"}, {"description", "[" + unit + "] " + meaning}};
  if (std::isfinite(range.minimum)) {
    schema[range.exclusive ? "exclusiveMinimum" : "minimum"] = range.minimum;
  }
  return schema;
}

Json object_schema(Json properties, Json required) {
  Json schema = {
      {"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
  if (!required.empty()) schema["required"] = std::move(required);
  return schema;
}

/// `[effects.NAME]` of a law of hub torque that the file states.
Json stated_law_schema() {
  const Json number = {{"type", "number"}};
  const Json searched = object_schema(
      {{"value", number},
       {"range", {{"type", "array"}, {"items", number}, {"minItems", 2}, {"maxItems", 2}}},
       {"unit", {{"type", "string"}}}},
      Json::array());
  Json schema = object_schema(
      {{"hub_torque",
        {{"type", "string"},
         {"description", "[N m] formula in theta [rad], omega [rad/s], tau [N m] and t [s]"}}}},
      {"hub_torque"});
  schema["description"] = "a stated law of hub torque; its other keys are the formula's numbers";
  schema["additionalProperties"] = {{"anyOf", {number, searched}}};
  return schema;
}

/// `[effects.measured_hub_torque]`.
Json hub_torque_table_schema() {
  const Json numbers = {{"type", "array"}, {"items", {{"type", "number"}}}};
  Json schema = object_schema(
      {{"angle_rad", numbers},
       {"velocity_rad_per_s", numbers},
       {"torque_N_m", {{"anyOf", {numbers, {{"type", "array"}, {"items", numbers}}}}}}},
      {"torque_N_m"});
  schema["description"] = "a measured law of hub torque over angle, velocity or both";
  return schema;
}

/// The kinds of runs, as measurement files name them.
Json kinds_of_data(effects::Shows shows) {
  Json kinds = {"time"};
  if (shows != effects::Shows::in_time) kinds.push_back("frf");
  if (shows == effects::Shows::in_all) kinds.push_back("modal");
  return kinds;
}

}  // namespace

Json effects_json(const std::vector<effects::Entry>& entries) {
  Json all = Json::array();
  for (const auto& entry : entries) {
    const arm::EffectDefinition& definition = *entry.definition;
    Json parameters = Json::array();
    for (const auto& parameter : definition.parameters) {
      const bool bounded = std::isfinite(parameter.range.minimum);
      parameters.push_back(
          {{"name", parameter.name},
           {"unit", parameter.unit},
           {"minimum", bounded ? Json(parameter.range.minimum) : Json(nullptr)},
           {"minimum_is_allowed", !parameter.range.exclusive},
           {"neutral", parameter.neutral ? Json(*parameter.neutral) : Json(nullptr)},
           {"default", parameter.otherwise ? Json(*parameter.otherwise) : Json(nullptr)},
           {"example", parameter.example},
           {"meaning", parameter.meaning}});
    }
    Json ports = Json::array();
    for (const arm::Port port : definition.ports()) ports.push_back(to_string(port));
    all.push_back(
        {{"effect", definition.name},
         {"meaning", definition.meaning},
         {"ports", ports},
         {"shows_in", kinds_of_data(entry.shows)},
         {"contains", entry.contains},
         {"same_as", entry.same_as},
         {"sensor", definition.sensor ? Json(arm::to_string(*definition.sensor)) : Json(nullptr)},
         {"parameters", parameters},
         {"evidence_for", entry.speaks_for},
         {"evidence_against", entry.refuted_by}});
  }
  return {{"effects", all}};
}

Json arm_file_schema(const std::vector<effects::Entry>& entries) {
  Json tables = {{"name", {{"type", "string"}, {"description", "of the arm"}}}};
  for (const std::string& table : arm::arm_tables()) {
    Json properties = Json::object();
    Json required = Json::array();
    for (const auto& key : arm::arm_keys()) {
      if (key.table != table) continue;
      properties[key.leaf] = number_schema(key.range, key.unit, key.meaning);
      Json uncertainty =
          number_schema({0.0, true}, "1", "relative standard deviation of " + key.leaf);
      uncertainty["exclusiveMaximum"] = 1;
      properties[key.leaf + std::string(arm::kUncertaintySuffix)] = std::move(uncertainty);
      if (key.required) required.push_back(key.leaf);
    }
    tables[table] = object_schema(std::move(properties), std::move(required));
  }
  Json known = Json::object();
  for (const auto& entry : entries) {
    const arm::EffectDefinition& definition = *entry.definition;
    Json properties = Json::object();
    Json required = Json::array();
    for (const auto& parameter : definition.parameters) {
      properties[parameter.name] =
          number_schema(parameter.range, parameter.unit, parameter.meaning);
      if (!parameter.otherwise) required.push_back(parameter.name);
    }
    if (definition.sensor) {
      properties["sensor"] = {{"type", "string"}, {"description", "the sensor that it acts on"}};
    }
    known[definition.name] = object_schema(std::move(properties), std::move(required));
    known[definition.name]["description"] = definition.meaning;
  }
  known[std::string(arm::kHubTorqueTable)] = hub_torque_table_schema();
  tables["effects"] = object_schema(std::move(known), Json::array());
  tables["effects"]["additionalProperties"] = stated_law_schema();
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                 {"title", "flexarm arm file"}};
  schema.update(object_schema(std::move(tables), {"hub"}));
  return schema;
}

}  // namespace flexarm::report
