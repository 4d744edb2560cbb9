#include "report/json/diagnosis_json.hpp"

#include "report/json/plan_json.hpp"
#include "report/json/symptom_json.hpp"

#include <nlohmann/json.hpp>

namespace flexarm::report {

namespace {

using Json = nlohmann::ordered_json;

Json gain_json(const diagnose::Gain& gain) {
  return {{"before", gain.before}, {"after", gain.after}, {"noise_floor", gain.noise_floor}};
}

Json cause_json(const diagnose::Cause& cause) {
  Json parameters = Json::object();
  for (const auto& parameter : cause.parameters) {
    parameters[parameter.name] = {
        {"value", parameter.value}, {"std_error", parameter.std_error}, {"unit", parameter.unit}};
  }
  Json json = {{"effect", cause.effect}};
  if (!cause.sensor.empty()) json["sensor"] = cause.sensor;
  json["parameters"] = parameters;
  json["confidence"] = cause.confidence;
  json["share"] = cause.share;
  json["confusable_with"] = cause.confusable_with;
  json["evidence"] = cause.evidence;
  json["refuted_by"] = cause.refuted_by;
  return json;
}

Json formulations_json(const diagnose::FormulationCheck& check) {
  if (!check.refused.empty()) return {{"refused", check.refused}};
  return {{"agree", check.agree},
          {"largest_distance", check.largest_distance},
          {"tolerance", check.tolerance},
          {"quantity", check.quantity}};
}

}  // namespace

Json diagnosis_json(const diagnose::Diagnosis& diagnosis, const std::string& extended_arm) {
  Json causes = Json::array();
  for (const auto& cause : diagnosis.causes) causes.push_back(cause_json(cause));
  Json gain = {{"estimation", gain_json(diagnosis.estimation)}};
  gain["validation"] = diagnosis.validation ? gain_json(*diagnosis.validation) : Json(nullptr);
  Json channels = Json::array();
  for (const auto& channel : diagnosis.channels) {
    Json json = {{"run", channel.run}, {"sensor", channel.sensor}};
    json.update(gain_json(channel.error));
    channels.push_back(json);
  }
  Json refitted = Json::array();
  for (const auto& number : diagnosis.refitted) {
    refitted.push_back({{"key", number.key},
                        {"file_value", number.file_value},
                        {"uncertainty", number.uncertainty},
                        {"value", number.value},
                        {"std_error", number.std_error},
                        {"unit", number.unit}});
  }
  const diagnose::Symptoms& symptoms = diagnosis.symptoms;
  Json near_misses = Json::array();
  for (const auto& miss : diagnosis.near_misses) {
    near_misses.push_back({{"effects", miss.effects},
                           {"share", miss.share},
                           {"information", miss.information},
                           {"error", miss.error}});
  }
  return {{"verdict", to_string(diagnosis.verdict)},
          {"symptoms", statements_json(symptoms)},
          {"causes", causes},
          {"gain", gain},
          {"residual",
           {{"channels", channels},
            {"bands", bands_json(symptoms)},
            {"roots", root_shifts_json(symptoms)},
            {"hub_torque", hub_torque_json(symptoms)},
            {"distortion", distortion_json(symptoms)},
            {"run_by_run", run_by_run_json(symptoms)}}},
          {"near_misses", near_misses},
          {"refitted", refitted},
          {"formulations", formulations_json(diagnosis.formulations)},
          {"extended_arm", extended_arm.empty() ? Json(nullptr) : Json(extended_arm)},
          {"next_experiments", further_runs_json(diagnosis.next_experiments)},
          {"notices", diagnosis.notices}};
}

}  // namespace flexarm::report
