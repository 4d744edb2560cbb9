#include "report/json/symptom_json.hpp"

#include "report/tables/table.hpp"

#include <nlohmann/json.hpp>

namespace flexarm::report {

namespace {

using Json = nlohmann::ordered_json;

Json hub_term_json(const diagnose::HubTorqueTerm& term, bool accepted) {
  Json json = {{"depends_on", to_string(term.kind)},
               {"accepted", accepted},
               {"coefficient", term.coefficient},
               {"std_error", term.std_error},
               {"unit", term.unit}};
  if (term.kind == diagnose::HubTorqueKind::ripple) json["cycles_per_rev"] = term.at;
  if (term.kind == diagnose::HubTorqueKind::saturation) json["threshold_N_m"] = term.at;
  json["explained_share"] = explained_share(term.share);
  json["p_value"] = term.probability;
  return json;
}

Json root_number_json(const diagnose::RootNumber& number) {
  return {{"measured", number.measured},
          {"std_error", number.std_error},
          {"before", number.before},
          {"after", number.after}};
}

}  // namespace

Json statements_json(const diagnose::Symptoms& symptoms) {
  Json all = Json::array();
  for (const auto& one : symptoms.statements) {
    Json json = {{"kind", to_string(one.kind)},
                 {"text", one.text},
                 {"significant", one.is_significant},
                 {"p_value", one.probability},
                 {"deviate", one.deviate}};
    if (!one.run.empty()) json["run"] = one.run;
    if (!one.sensor.empty()) json["sensor"] = one.sensor;
    all.push_back(json);
  }
  return all;
}

Json bands_json(const diagnose::Symptoms& symptoms) {
  Json all = Json::array();
  for (const auto& error : symptoms.bands) {
    Json json = {{"run", error.run_id},       {"sensor", error.sensor},
                 {"band", error.band.name},   {"from_Hz", error.band.from_Hz},
                 {"to_Hz", error.band.to_Hz}, {"payload_kg", error.payload_kg}};
    if (error.torque_rms_N_m) json["torque_rms_N_m"] = *error.torque_rms_N_m;
    json["before"] = error.before;
    json["after"] = error.after;
    json["noise_floor"] = error.noise;
    json["p_value"] = error.probability;
    all.push_back(json);
  }
  return all;
}

Json regimes_json(const diagnose::Symptoms& symptoms) {
  Json all = Json::array();
  for (const auto& regime : symptoms.regimes) {
    all.push_back({{"quantity", to_string(regime.quantity)},
                   {"from", regime.from},
                   {"to", regime.to},
                   {"unit", unit_of(regime.quantity)},
                   {"share", regime.share},
                   {"before", regime.before},
                   {"after", regime.after},
                   {"noise_floor", regime.noise_floor},
                   {"ratio", regime.ratio},
                   {"innovation_ratio",
                    regime.innovation_ratio ? Json(*regime.innovation_ratio) : Json(nullptr)},
                   {"p_value", regime.p_value},
                   {"significant", regime.is_significant()}});
  }
  return all;
}

Json root_shifts_json(const diagnose::Symptoms& symptoms) {
  Json all = Json::array();
  for (const auto& shift : symptoms.roots) {
    Json json = {{"run", shift.run}, {"feature", shift.zero_of ? "zero" : "pole"}};
    if (shift.zero_of) json["sensor"] = arm::to_string(*shift.zero_of);
    json["order"] = shift.order;
    json["payload_kg"] = shift.payload_kg;
    if (shift.frequency_Hz) json["frequency_Hz"] = root_number_json(*shift.frequency_Hz);
    if (shift.damping_ratio) json["damping_ratio"] = root_number_json(*shift.damping_ratio);
    all.push_back(json);
  }
  return all;
}

Json hub_torque_json(const diagnose::Symptoms& symptoms) {
  Json all = Json::array();
  for (const auto& term : symptoms.hub_torque.terms) all.push_back(hub_term_json(term, true));
  for (const auto& term : symptoms.hub_torque.left_over) all.push_back(hub_term_json(term, false));
  return all;
}

Json distortion_json(const diagnose::Symptoms& symptoms) {
  Json all = Json::array();
  for (const auto& run : symptoms.distortion) {
    for (std::size_t c = 0; c < run.sensors.size(); ++c) {
      const auto& channel = run.distortion.channels[c];
      const auto test_json = [](const measured::DistortionTest& test) {
        return Json{{"lines", test.lines},
                    {"level_dB", test.level_dB},
                    {"noise_dB", test.noise_dB},
                    {"p_value", test.probability}};
      };
      all.push_back({{"run", run.run},
                     {"sensor", arm::to_string(run.sensors[c])},
                     {"odd", test_json(channel.odd)},
                     {"even", test_json(channel.even)}});
    }
  }
  return all;
}

Json run_consistency_json(const diagnose::RunDrift& drift) {
  Json values = Json::array();
  for (const auto& value : drift.values) {
    values.push_back({{"run", value.run}, {"value", value.value}, {"std_error", value.std_error}});
  }
  return {{"effect", drift.effect},      {"parameter", drift.parameter},
          {"unit", drift.unit},          {"values", values},
          {"mean", drift.mean},          {"chi_squared", drift.chi_squared},
          {"p_value", drift.probability}};
}

}  // namespace flexarm::report
