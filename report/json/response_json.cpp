#include "report/json/response_json.hpp"

#include "report/json/arm_json.hpp"
#include "report/tables/truncation_text.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace flexarm::report {

namespace {

using Json = nlohmann::ordered_json;

Json pair_json(const arm::PolePair& pair) {
  return Json::array({complex_json(pair.first_rad_per_s), complex_json(pair.second_rad_per_s)});
}

Json chain_json(const response::LinearChain& chain) {
  Json json = {{"gain", chain.gain},
               {"delay_s", chain.delay_s},
               {"actuator_lag_s", chain.lag_s},
               {"lagging_sensor", nullptr},
               {"sensor_lag_s", 0.0}};
  const auto lagging = std::ranges::find_if(chain.sensor_chains,
                                            [](const auto& stages) { return stages.lag_s > 0.0; });
  if (lagging != chain.sensor_chains.end()) {
    json["lagging_sensor"] = arm::to_string(lagging->sensor);
    json["sensor_lag_s"] = lagging->lag_s;
  }
  json["sensors"] = Json::array();
  for (const auto& stages : chain.sensor_chains) {
    json["sensors"].push_back({{"sensor", arm::to_string(stages.sensor)},
                               {"gain", stages.gain},
                               {"delay_s", stages.delay_s},
                               {"lag_s", stages.lag_s}});
  }
  return json;
}

Json poles_json(const response::ResponseStudy& study) {
  Json poles = Json::array();
  poles.push_back({{"order", 0},
                   {"omega_squared_rad2_per_s2", study.poles.lowest_omega_squared_rad2_per_s2},
                   {"damped_rad_per_s", pair_json(study.damped_poles.lowest)}});
  for (std::size_t i = 0; i < study.poles.omega_rad_per_s.size(); ++i) {
    const double omega = study.poles.omega_rad_per_s[i];
    poles.push_back({{"order", i + 1},
                     {"omega_squared_rad2_per_s2", omega * omega},
                     {"damped_rad_per_s", pair_json(study.damped_poles.flexible.at(i))}});
  }
  return poles;
}

Json product_json(const response::ProductFactors& product) {
  Json zeros = Json::array();
  for (const auto& zero : product.zeros_rad_per_s) zeros.push_back(complex_json(zero));
  return {{"gain", product.gain}, {"power_of_s", product.power}, {"zeros_rad_per_s", zeros}};
}

Json fractions_json(const std::vector<response::PartialFraction>& fractions) {
  Json terms = Json::array();
  for (std::size_t i = 0; i < fractions.size(); ++i) {
    terms.push_back({{"order", i},
                     {"omega_squared_rad2_per_s2", fractions[i].omega_squared_rad2_per_s2},
                     {"damping_rad_per_s", fractions[i].damping_rad_per_s},
                     {"residue", fractions[i].residue}});
  }
  return terms;
}

Json values_json(const response::FrequencyResponse& response, std::size_t k) {
  const auto& values = response.values[k];
  Json json = {{"re", Json::array()}, {"im", Json::array()}};
  for (const auto& value : values) {
    json["re"].push_back(value.real());
    json["im"].push_back(value.imag());
  }
  json["phase_deg"] = response.phase_deg[k];
  return json;
}

}  // namespace

Json response_json(const response::ResponseStudy& study) {
  Json sensors = Json::array();
  const auto errors = response::state_space_errors(study);
  for (std::size_t k = 0; k < study.response.sensors.size(); ++k) {
    const auto& sensor = study.response.sensors[k];
    sensors.push_back({{"sensor", arm::to_string(sensor)},
                       {"unit", std::string(arm::unit(sensor))},
                       {"product", product_json(study.products[k])},
                       {"partial_fractions", fractions_json(study.fractions[k])},
                       {"response", values_json(study.response, k)},
                       {"state_space", nullptr}});
    if (errors.empty()) continue;
    sensors.back()["state_space"] = {
        {"feedthrough", study.state_space->d(static_cast<Eigen::Index>(k), 0)},
        {"largest_error", errors[k].largest},
        {"largest_error_frequency_Hz", errors[k].largest_at_Hz},
        {"median_error", errors[k].median},
        {"response", values_json(*study.state_space_response, k)}};
  }
  return {
      {"left_out", study.left_out},
      {"chain", chain_json(study.chain)},
      {"poles", poles_json(study)},
      {"states", study.state_space ? Json(study.state_space->states) : Json::array()},
      {"static_correction", study.residual_mode},
      {"truncation", study.truncation ? truncation_json(*study.truncation, study.response.sensors)
                                      : Json(nullptr)},
      {"frequency_Hz", study.response.frequency_Hz},
      {"sensors", std::move(sensors)}};
}

}  // namespace flexarm::report
