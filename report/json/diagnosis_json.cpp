#include "report/json/diagnosis_json.hpp"

#include "report/json/plan_json.hpp"
#include "report/json/symptom_json.hpp"
#include "report/tables/table.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstddef>
#include <utility>

namespace flexarm::report {

namespace {

using Json = nlohmann::ordered_json;

Json gain_json(const diagnose::Gain& gain) {
  return {{"before", gain.before},
          {"after", gain.after},
          {"noise_floor", gain.noise_floor},
          {"numerical_error", gain.numerical_error}};
}

/// Returns the grade of a cause and the figures that it has.
Json figures_json(const diagnose::Cause& cause) {
  const diagnose::EffectEvidence& figures = *cause.figures;
  Json runs = Json::array();
  for (const auto& run : figures.runs) {
    runs.push_back({{"run", run.run}, {"values", run.values}, {"std_errors", run.std_errors}});
  }
  return {{"grade", to_string(cause.grade)},
          {"family", cause.family},
          {"names_family", cause.names_family},
          {"loss",
           {{"score", figures.score},
            {"estimation", figures.estimation},
            {"validation", figures.held_out ? Json(*figures.held_out) : Json(nullptr)},
            {"nrmse_without", figures.error_without},
            {"nrmse_increase", figures.error_increase},
            {"nrmse_increase_std_error", figures.error_increase_std_error}}},
          {"runs", runs},
          {"agreement_p_value", figures.agreement}};
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
  json["class_confidence"] = cause.class_confidence;
  json["explained_share"] = explained_share(cause.share);
  json["confusable_with"] = cause.confusable_with;
  if (cause.figures) json.update(figures_json(cause));
  json["evidence"] = cause.evidence;
  json["evidence_against"] = cause.refuted_by;
  return json;
}

Json test_json(const diagnose::ResidualTest& test) {
  return {{"is_noise", test.is_noise()},
          {"level_p_value", test.level_p_value},
          {"whiteness_p_value", test.whiteness_p_value},
          {"uncertain_numbers_p_value", test.nuisance_p_value}};
}

Json formulations_json(const diagnose::FormulationCheck& check) {
  if (!check.refused.empty()) return {{"refused", check.refused}};
  return {{"agree", check.agree},
          {"largest_distance", check.largest_distance},
          {"tolerance", check.tolerance},
          {"quantity", check.quantity}};
}

Json empirical_law_json(const std::optional<diagnose::EmpiricalLaw>& law) {
  if (!law) return nullptr;
  const arm::HubTorqueTable& table = law->table;
  Json means = Json::array();
  for (std::size_t curve = 0; curve < law->means.size(); ++curve) {
    for (const diagnose::TorqueMean& mean : law->means[curve]) {
      Json& made = means.emplace_back(Json{{"angle", nullptr}, {"velocity", nullptr}});
      made[table.angle_rad.empty() ? "velocity" : "angle"] = mean.at;
      if (law->means.size() > 1) made["velocity"] = table.velocity_rad_per_s[curve];
      made["torque"] = mean.torque_N_m;
      made["std_error"] = mean.std_error_N_m;
    }
  }
  return {{"angle", table.angle_rad},
          {"velocity", table.velocity_rad_per_s},
          {"torque", table.torque_N_m},
          {"std_error", law->std_error_N_m},
          {"std_errors", law->std_errors_N_m},
          {"residual_means", std::move(means)},
          {"explained_share", explained_share(law->share)},
          {"before", law->error_before},
          {"after", law->error_after}};
}

Json missing_force_json(const std::optional<diagnose::MissingForce>& force) {
  if (!force) return nullptr;
  Json json = {{"lines", force->lines}, {"ports", Json::array()}, {"force", nullptr}};
  for (std::size_t i = 0; i < force->ports.size(); ++i) {
    const diagnose::PortShare& port = force->ports[i];
    json["ports"].push_back({{"port", to_string(port.port)},
                             {"sensors", port.sensors},
                             {"place", port.place},
                             {"explained_share", explained_share(port.share)},
                             {"std_error", port.std_error},
                             {"distance_std_error", port.distance_std_error},
                             {"stated", i < force->stated}});
  }
  if (const auto& size = force->size) {
    json["force"] = {{"unit", size->unit},
                     {"rms", size->rms},
                     {"std_error", size->std_error ? Json(*size->std_error) : Json(nullptr)},
                     {"from", size->from_Hz},
                     {"to", size->to_Hz},
                     {"spectrum", Json::array()}};
    for (const diagnose::ForceBand& band : size->spectrum) {
      const auto limit = [&](double std_errors) {
        return band.std_error ? Json(band.rms_at(std_errors)) : Json(nullptr);
      };
      json["force"]["spectrum"].push_back({{"from", band.from_Hz},
                                           {"to", band.to_Hz},
                                           {"rms", band.rms()},
                                           {"low", limit(-diagnose::kDistance)},
                                           {"high", limit(diagnose::kDistance)}});
    }
  }
  return json;
}

Json prediction_json(const diagnose::Diagnosis& diagnosis) {
  Json json = {{"predictor", to_string(diagnosis.predictor)},
               {"reason", diagnosis.predictor_reason},
               {"torque", diagnosis.torque ? gain_json(*diagnosis.torque) : Json(nullptr)},
               {"disturbance", nullptr},
               {"errors", Json::array()}};
  if (const auto& disturbance = diagnosis.disturbance) {
    json["disturbance"] = {{"before", disturbance->before_N_m},
                           {"after", disturbance->after_N_m},
                           {"torque_rms", disturbance->torque_rms_N_m},
                           {"correlation_time", disturbance->correlation_time_s},
                           {"modal_force", disturbance->modal_force_N_m}};
  }
  for (const diagnose::PredictionError& error : diagnosis.prediction_errors) {
    Json& made = json["errors"].emplace_back(
        Json{{"run", error.run},
             {"sensor", error.sensor},
             {"samples_ahead", nullptr},
             {"time_ahead", nullptr},
             {"before", std::isfinite(error.before) ? Json(error.before) : Json(nullptr)},
             {"after", std::isfinite(error.after) ? Json(error.after) : Json(nullptr)}});
    if (error.samples_ahead) {
      made["samples_ahead"] = *error.samples_ahead;
      made["time_ahead"] = error.ahead_s;
    }
  }
  return json;
}

Json search_json(const diagnose::Diagnosis& diagnosis) {
  Json json = {{"complete", !diagnosis.search_end.has_value()},
               {"time_limit", nullptr},
               {"ended_at", nullptr},
               {"untried", Json::array()},
               {"excluded", diagnosis.excluded}};
  if (diagnosis.time_limit_s) json["time_limit"] = *diagnosis.time_limit_s;
  if (const auto& end = diagnosis.search_end) {
    json["ended_at"] = end->stage;
    json["untried"] = end->untried;
  }
  return json;
}

Json accepted_json(const std::vector<diagnose::AcceptedFinding>& accepted) {
  Json json = Json::array();
  for (const auto& [run, finding] : accepted) {
    json.push_back({{"run", run},
                    {"check", measured::check_name(finding.fault)},
                    {"channel", finding.channel},
                    {"text", finding.text}});
  }
  return json;
}

Json posterior_json(const std::vector<diagnose::PosteriorSet>& sets) {
  Json json = Json::array();
  for (const diagnose::PosteriorSet& set : sets) {
    Json& made = json.emplace_back(Json{{"effects", Json::array()},
                                        {"probability", set.probability},
                                        {"parameters", Json::array()},
                                        {"correlation", Json::array()}});
    for (const auto& effect : set.effects) {
      Json& its = made["effects"].emplace_back(Json{{"effect", effect.name}});
      if (!effect.sensor.empty()) its["sensor"] = effect.sensor;
    }
    for (const auto& parameter : set.parameters) {
      made["parameters"].push_back({{"key", parameter.key},
                                    {"value", parameter.value},
                                    {"std_error", parameter.std_error},
                                    {"unit", parameter.unit},
                                    {"logarithmic", parameter.is_logarithmic}});
    }
    for (const auto& row : set.correlation.rowwise()) {
      made["correlation"].push_back(std::vector<double>(row.begin(), row.end()));
    }
  }
  return json;
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
  Json uncertain_numbers = Json::array();
  for (const auto& number : diagnosis.refitted) {
    uncertain_numbers.push_back({{"key", number.key},
                                 {"nominal_value", number.file_value},
                                 {"uncertainty", number.uncertainty},
                                 {"value", number.value},
                                 {"std_error", number.std_error},
                                 {"unit", number.unit},
                                 {"has_moved", number.has_moved()},
                                 {"deviation", number.deviation}});
  }
  const diagnose::Symptoms& symptoms = diagnosis.symptoms;
  Json candidates = Json::array();
  for (const auto& miss : diagnosis.near_misses) {
    candidates.push_back({{"effects", miss.effects},
                          {"probability", miss.probability},
                          {"explained_share", explained_share(miss.share)},
                          {"delta_bic", miss.information},
                          {"nrmse", miss.error}});
  }
  return {{"verdict", to_string(diagnosis.verdict)},
          {"symptoms", statements_json(symptoms)},
          {"causes", causes},
          {"posterior", posterior_json(diagnosis.posterior)},
          {"something_else", diagnosis.something_else},
          {"search", search_json(diagnosis)},
          {"prediction", prediction_json(diagnosis)},
          {"gain", gain},
          {"residual_test",
           {{"estimation", test_json(diagnosis.estimation_test)},
            {"validation",
             diagnosis.validation ? test_json(diagnosis.validation_test) : Json(nullptr)}}},
          {"fit", {{"converged", diagnosis.converged}, {"evaluations", diagnosis.evaluations}}},
          {"residual",
           {{"channels", channels},
            {"bands", bands_json(symptoms)},
            {"regimes", regimes_json(symptoms)},
            {"roots", root_shifts_json(symptoms)},
            {"hub_torque", hub_torque_json(symptoms)},
            {"distortion", distortion_json(symptoms)},
            {"run_consistency",
             symptoms.drift ? run_consistency_json(*symptoms.drift) : Json(nullptr)}}},
          {"candidates", candidates},
          {"uncertain_numbers", uncertain_numbers},
          {"empirical_law", empirical_law_json(diagnosis.empirical_law)},
          {"missing_force", missing_force_json(diagnosis.missing_force)},
          {"formulations", formulations_json(diagnosis.formulations)},
          {"extended_arm", extended_arm.empty() ? Json(nullptr) : Json(extended_arm)},
          {"next_experiments", additional_runs_json(diagnosis.next_experiments)},
          {"notices", diagnosis.notices},
          {"accepted_checks", accepted_json(diagnosis.accepted)}};
}

}  // namespace flexarm::report
