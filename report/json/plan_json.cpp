#include "report/json/plan_json.hpp"

#include "report/json/json_document.hpp"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace flexarm::report {

namespace {

using Json = nlohmann::ordered_json;

/// Parameters of one effect, a list, as their names differ from effect to effect.
Json values_json(const std::optional<diagnose::Candidate>& candidate) {
  Json values = Json::array();
  if (!candidate) return values;
  const diagnose::Hypothesis& hypothesis = candidate->effects.front();
  for (std::size_t i = 0; i < candidate->values.size(); ++i) {
    const auto& parameter = hypothesis.parameters[i];
    values.push_back({{"parameter", parameter.name},
                      {"value", candidate->values[i]},
                      {"unit", hypothesis.unit_of(parameter)}});
  }
  return values;
}

}  // namespace

Json additional_runs_json(const std::vector<diagnose::NextExperiment>& runs) {
  Json all = Json::array();
  for (const auto& [further, leads, told, score] : runs) {
    const diagnose::PlannedRun& run = further.run;
    Json sensors = Json::array();
    for (const auto& sensor : run.sensors) sensors.push_back(arm::to_string(sensor.sensor));
    const bool in_time = run.kind == measured::RunKind::time;
    all.push_back({{"run", run.id},
                   {"based_on", further.like},
                   {"change", further.change},
                   {"kind", to_string(run.kind)},
                   {"input", diagnose::input_of(run)},
                   {"peak_torque_N_m",
                    in_time ? Json(response::peak_N_m(diagnose::torque_of(run))) : Json(nullptr)},
                   {"payload_mass_kg", run.payload ? Json(run.payload->mass_kg) : Json(nullptr)},
                   {"sensors", sensors},
                   {"resolved", told},
                   {"delta_bic", leads},
                   {"score", score}});
  }
  return all;
}

Json plan_json(const diagnose::Plan& plan) {
  const auto label = [&](std::size_t effect) { return plan.effects[effect].hypothesis.label(); };
  Json effects = Json::array();
  for (const auto& detection : plan.effects) {
    effects.push_back({{"effect", detection.hypothesis.label()},
                       {"detectable", detection.shows},
                       {"minimum_detectable_value", values_json(detection.smallest)},
                       {"comparison_value", values_json(detection.compared)},
                       {"comparison_change", detection.compared_change},
                       {"largest_change", detection.largest_change}});
  }
  Json separations = Json::array();
  for (std::size_t a = 0; a < plan.effects.size(); ++a) {
    for (std::size_t b = 0; b < plan.effects.size(); ++b) {
      const auto& separation = plan.separations[a][b];
      if (!separation) continue;
      separations.push_back({{"effect_present", label(a)},
                             {"alternative", label(b)},
                             {"cosine", separation->cosine},
                             {"delta_bic", separation->lead},
                             {"fitted", separation->is_fitted},
                             {"distinguishable", separation->lead >= diagnose::kToldLead}});
    }
  }
  Json ties = Json::array();
  for (const auto& tie : plan.ties) {
    ties.push_back({{"effect_present", label(tie.truth)},
                    {"alternative", label(tie.rival)},
                    {"delta_bic", tie.lead},
                    {"delta_bic_improved_plan",
                     tie.lead_with_more ? Json(*tie.lead_with_more) : Json(nullptr)}});
  }
  Json classes = Json::array();
  for (const auto& members : plan.classes) {
    Json names = Json::array();
    for (const std::size_t effect : members) names.push_back(label(effect));
    classes.push_back({{"effects", names}});
  }
  return {{"effects", effects},
          {"separations", separations},
          {"indistinguishable_pairs", ties},
          {"equivalence_classes", classes},
          {"additional_runs", additional_runs_json(plan.further)},
          {"improved_plan_runs", additional_runs_json(plan.added)},
          {"notices", plan.notices}};
}

std::string plan_document(const diagnose::Plan& plan) {
  return json_document("flexarm.plan/2", plan_json(plan));
}

}  // namespace flexarm::report
