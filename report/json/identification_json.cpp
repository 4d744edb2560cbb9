#include "report/json/identification_json.hpp"

#include "report/json/arm_json.hpp"
#include "report/json/json_document.hpp"
#include "report/tables/identification_tables.hpp"
#include "report/tables/method_differences.hpp"
#include "report/tables/zero_kind.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

namespace flexarm::report {

namespace {

using Json = nlohmann::ordered_json;
using measured::Estimate;

Json text(const std::string& value) {
  return value.empty() ? Json(nullptr) : Json(value);
}

Json payload_json(const std::optional<arm::Payload>& payload) {
  if (!payload) return nullptr;
  return {{"mass_kg", payload->mass_kg}, {"inertia_kg_m2", payload->inertia_kg_m2}};
}

Json complex_list(const std::vector<std::complex<double>>& values) {
  Json json = {{"re", Json::array()}, {"im", Json::array()}};
  for (const auto& value : values) {
    json["re"].push_back(value.real());
    json["im"].push_back(value.imag());
  }
  return json;
}

Json findings_json(const std::vector<measured::DataFinding>& findings) {
  Json json = Json::array();
  for (const auto& finding : findings) {
    json.push_back({{"fault", to_string(finding.fault)},
                    {"channel", finding.channel},
                    {"first_sample", finding.first_sample},
                    {"time_s", finding.time_s},
                    {"value", finding.value},
                    {"text", finding.text}});
  }
  return json;
}

Json spectra_json(const measured::FrequencyResponseEstimate& estimate) {
  Json settings = Json::array();
  for (const auto& report : estimate.settings.reports) {
    settings.push_back({{"name", report.name}, {"value", report.value}, {"reason", report.reason}});
  }
  Json channels = Json::array();
  for (const auto& channel : estimate.channels) {
    channels.push_back({{"sensor", arm::to_string(channel.sensor)},
                        {"unit", arm::unit(channel.sensor)},
                        {"autopower", channel.autopower},
                        {"autopower_relative_std", channel.autopower_relative_std},
                        {"h1", complex_list(channel.estimators.h1)},
                        {"h2", complex_list(channel.estimators.h2)},
                        {"hv", complex_list(channel.estimators.hv)},
                        {"response", complex_list(channel.response)},
                        {"response_std", channel.response_std},
                        {"coherence", channel.estimators.coherence}});
  }
  const auto& estimator = estimate.settings.estimator;
  return {
      {"settings", settings},
      {"input", to_string(estimator.input)},
      {"instrument", estimator.instrument ? Json(to_string(*estimator.instrument)) : Json(nullptr)},
      {"estimator_reason", estimator.reason},
      {"averages", estimate.averages},
      {"spacing_Hz", estimate.spacing_Hz},
      {"noise_bandwidth_Hz", estimate.noise_bandwidth_Hz},
      {"frequency_Hz", estimate.frequency_Hz},
      {"input_autopower", estimate.input_autopower},
      {"channels", channels}};
}

Json circles_json(const std::vector<measured::SensorCircles>& sensors) {
  Json json = Json::array();
  for (const auto& [sensor, set] : sensors) {
    Json circles = Json::array();
    for (const auto& circle : set.circles) {
      circles.push_back({{"natural_frequency_Hz", circle.natural_frequency_Hz},
                         {"natural_frequency_std_Hz", circle.natural_frequency_std_Hz},
                         {"damping_ratio", circle.damping_ratio},
                         {"damping_ratio_std", circle.damping_ratio_std},
                         {"modal_constant", complex_json(circle.modal_constant)},
                         {"points", circle.frequency_Hz.size()}});
    }
    Json refused = Json::array();
    for (const auto& refusal : set.refused) {
      refused.push_back({{"frequency_Hz", refusal.frequency_Hz}, {"reason", refusal.reason}});
    }
    json.push_back(
        {{"sensor", arm::to_string(sensor)}, {"circles", circles}, {"refused", refused}});
  }
  return json;
}

Json test_json(const measured::DistortionTest& test) {
  return {{"lines", test.lines},
          {"probability", test.probability},
          {"found", test.found},
          {"level_dB", test.level_dB},
          {"noise_dB", test.noise_dB}};
}

Json distortion_json(const measured::RunIdentification& run) {
  if (!run.distortion) return nullptr;
  Json channels = Json::array();
  for (std::size_t i = 0; i < run.distortion->channels.size(); ++i) {
    const auto& channel = run.distortion->channels[i];
    channels.push_back({{"sensor", arm::to_string(run.estimate->channels[i].sensor)},
                        {"odd", test_json(channel.odd)},
                        {"even", test_json(channel.even)}});
  }
  return {{"testable", run.distortion->testable},
          {"reason", run.distortion->reason},
          {"channels", channels}};
}

Json run_json(const measured::RunIdentification& run) {
  Json left_out = Json::array();
  for (const auto& sensor : run.left_out) left_out.push_back(arm::to_string(sensor));
  return {{"id", run.run.id},
          {"kind", to_string(run.run.kind)},
          {"payload", payload_json(run.run.payload)},
          {"refusal", text(run.refusal)},
          {"findings", findings_json(run.findings)},
          {"left_out", left_out},
          {"decay_begins_s", number_json(run.decay_begins_s)},
          {"spectra", run.estimate ? spectra_json(*run.estimate) : Json(nullptr)},
          {"circles", circles_json(run.circles)},
          {"distortion", distortion_json(run)}};
}

Json condition_json(const compare::IdentifiedCondition& condition) {
  Json poles = Json::array();
  for (const auto& pole : condition.analytical.poles) {
    poles.push_back({{"frequency_Hz", pole.frequency_Hz}, {"damping_ratio", pole.damping_ratio}});
  }
  Json zeros = Json::array();
  for (const auto& sensor : condition.analytical.zeros) {
    Json roots = Json::array();
    for (const auto& zero : sensor.s_rad_per_s) roots.push_back(complex_json(zero));
    zeros.push_back({{"sensor", arm::to_string(sensor.sensor)}, {"s_rad_per_s", roots}});
  }
  Json gains = Json::array();
  for (const auto& model : condition.analytical.gains) {
    gains.push_back({{"model", model.model},
                     {"total_inertia_kg_m2", model.total_inertia_kg_m2},
                     {"hub_slope", model.hub_slope},
                     {"tip_gain_m", model.tip_gain_m}});
  }
  return {{"payload", payload_json(condition.payload)},
          {"poles", poles},
          {"zeros", zeros},
          {"gains", gains}};
}

Json reading_json(const measured::ModalReading& reading,
                  const std::vector<compare::IdentifiedRoot>& identified, std::size_t condition) {
  Json roots = Json::array();
  for (const auto& root : identified) {
    roots.push_back(
        {{"feature", to_string(root.measured.feature)},
         {"order", root.order ? Json(*root.order) : Json(nullptr)},
         {"frequency_Hz", number_json(root.measured.frequency_Hz)},
         {"frequency_std_Hz", number_json(root.measured.frequency_std_Hz)},
         {"damping_ratio", number_json(root.measured.damping_ratio)},
         {"damping_ratio_std", number_json(root.measured.damping_ratio_std)},
         {"alias_of_Hz", number_json(root.alias_of_Hz)},
         {"alias_of_order", root.alias_of_order ? Json(*root.alias_of_order) : Json(nullptr)},
         {"analytical_Hz", number_json(root.analytical_Hz)},
         {"analytical_damping_ratio", number_json(root.analytical_damping_ratio)},
         {"error_percent", root.error_percent()}});
  }
  return {{"method", to_string(reading.method)},
          {"runs", reading.runs},
          {"sensor", reading.sensor ? Json(arm::to_string(*reading.sensor)) : Json(nullptr)},
          {"condition", condition},
          {"hub_held", reading.hub_held},
          {"roots", roots}};
}

Json estimate_json(const std::optional<Estimate>& estimate) {
  if (!estimate) return nullptr;
  return {{"value", estimate->value}, {"standard_error", estimate->standard_error}};
}

Json gains_json(const measured::RunsFit& fit) {
  if (!fit.gains) return nullptr;
  Json modes = Json::array();
  for (const auto& mode : fit.gains->modes) {
    modes.push_back({{"frequency_Hz", mode.frequency_Hz},
                     {"hub_slope", estimate_json(mode.hub_slope)},
                     {"hub_slope_of_product", estimate_json(mode.hub_slope_of_product)},
                     {"tip_gain_m", estimate_json(mode.tip_gain_m)},
                     {"tip_gain_of_ratio_m", estimate_json(mode.tip_gain_of_ratio_m)}});
  }
  return {{"total_inertia_kg_m2", estimate_json(fit.gains->total_inertia_kg_m2)}, {"modes", modes}};
}

Json sensor_json(const measured::FittedSensor& sensor) {
  Json numerators = Json::array();
  for (const auto& numerator : sensor.numerators) {
    numerators.push_back({{"b1", numerator.b1},
                          {"b1_std", numerator.b1_std},
                          {"b0", numerator.b0},
                          {"b0_std", numerator.b0_std}});
  }
  Json zeros = Json::array();
  for (const auto& zero : sensor.zeros) {
    zeros.push_back({{"s_rad_per_s", complex_json(zero.s_rad_per_s)},
                     {"frequency_std_Hz", zero.frequency_std_Hz},
                     {"damping_ratio_std", zero.damping_ratio_std},
                     {"in_band", zero.in_band},
                     {"is_told", zero.is_told},
                     {"non_minimum_phase", is_non_minimum_phase(zero)}});
  }
  const auto& residual = sensor.residual;
  return {{"sensor", arm::to_string(sensor.sensor)},
          {"numerators", numerators},
          {"remainder", sensor.remainder},
          {"remainder_std", sensor.remainder_std},
          {"zeros", zeros},
          {"residual",
           {{"standard_deviation", residual.standard_deviation},
            {"relative", residual.relative},
            {"whiteness_probability", residual.whiteness_probability},
            {"explained_probability", residual.explained_probability},
            {"explained_share", residual.explained_share}}}};
}

Json chart_json(const measured::StabilisationChart& chart) {
  Json poles = Json::array();
  for (const auto& pole : chart.poles) {
    poles.push_back({{"order", pole.order},
                     {"frequency_Hz", pole.frequency_Hz},
                     {"damping_ratio", pole.damping_ratio},
                     {"frequency_stable", pole.frequency_stable},
                     {"damping_stable", pole.damping_stable},
                     {"vector_stable", pole.vector_stable}});
  }
  return poles;
}

Json fit_json(const measured::RunsFit& fitted, const measured::Identification& identification,
              std::size_t condition) {
  const auto& fit = fitted.fit;
  Json blocks = Json::array();
  for (const auto& pole : fit.poles) {
    blocks.push_back({{"s_rad_per_s", Json::array({complex_json(pole.s_rad_per_s[0]),
                                                   complex_json(pole.s_rad_per_s[1])})},
                      {"frequency_std_Hz", pole.frequency_std_Hz},
                      {"damping_ratio_std", pole.damping_ratio_std},
                      {"residue_turn", pole.residue_turn},
                      {"is_mode", pole.is_mode}});
  }
  Json sensors = Json::array();
  for (const auto& sensor : fit.sensors) sensors.push_back(sensor_json(sensor));
  return {{"runs", ids_of(fitted, identification)},
          {"condition", condition},
          {"data", fitted.of_responses ? "responses" : "as given"},
          {"hub_held", fitted.hub_held},
          {"refusal", text(fitted.refusal)},
          {"converged", fit.converged},
          {"unphysical", text(fitted.unphysical)},
          {"free_decay", fit.free_decay},
          {"from_Hz", fit.band.from_Hz},
          {"to_Hz", fit.band.to_Hz},
          {"order_reason", fit.order_reason},
          {"robust_intervals", fit.robust_covariance},
          {"delay_s", fit.delay_s},
          {"rigid_body_damping_rad_per_s", fit.rigid_a1_rad_per_s},
          {"rigid_body_damping_std_rad_per_s", fit.rigid_a1_std_rad_per_s},
          {"blocks", blocks},
          {"sensors", sensors},
          {"gains", gains_json(fitted)},
          {"gains_refusal", text(fitted.gains_refusal)},
          {"stabilisation", chart_json(fit.chart)}};
}

/// The first of these that is so.
std::string_view state_of(const measured::Identification& identification) {
  const auto& fits = identification.fits;
  const auto has = [](const auto& is) {
    return [is](const measured::RunsFit& fit) { return fit.refusal.empty() && is(fit); };
  };
  if (std::ranges::any_of(fits, has([](const auto& fit) { return !fit.fit.converged; }))) {
    return "not converged";
  }
  if (std::ranges::any_of(fits, has([](const auto& fit) { return !fit.unphysical.empty(); }))) {
    return "unphysical";
  }
  const bool is_empty = std::ranges::all_of(
      identification.readings, [](const auto& reading) { return reading.table.empty(); });
  return is_empty ? "nothing identified" : "identified";
}

}  // namespace

Json identification_json(const measured::Identification& identification,
                         const std::vector<compare::IdentifiedCondition>& conditions) {
  Json runs = Json::array();
  for (const auto& run : identification.runs) runs.push_back(run_json(run));
  Json expected = Json::array();
  Json readings = Json::array();
  Json fits = Json::array();
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    const auto& condition = conditions[c];
    expected.push_back(condition_json(condition));
    for (std::size_t i = 0; i < condition.readings.size(); ++i) {
      readings.push_back(
          reading_json(identification.readings[condition.readings[i]], condition.roots[i], c));
    }
    for (const std::size_t f : condition.fits) {
      fits.push_back(fit_json(identification.fits[f], identification, c));
    }
  }
  return {{"state", state_of(identification)},
          {"doubts", doubts(identification)},
          {"differences", all_method_differences(identification, conditions)},
          {"checks_complete", identification.are_checks_complete},
          {"runs", runs},
          {"conditions", expected},
          {"readings", readings},
          {"fits", fits}};
}

std::string identification_document(const std::string& measurement,
                                    const std::optional<arm::Arm>& arm,
                                    const measured::Identification& identification,
                                    const std::vector<compare::IdentifiedCondition>& conditions) {
  Json document = {{"measurement", measurement}, {"arm", arm ? arm_json(*arm) : Json(nullptr)}};
  document.update(identification_json(identification, conditions));
  return json_document("flexarm.identify/1", document);
}

}  // namespace flexarm::report
