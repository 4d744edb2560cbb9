#include "report/json/comparison_json.hpp"

#include "compare/measured_verdict.hpp"
#include "report/json/arm_json.hpp"
#include "report/json/json_document.hpp"
#include "report/tables/zero_kind.hpp"

#include <algorithm>

namespace flexarm::report {

namespace {

using Json = nlohmann::ordered_json;

template <class T>
Json optional_json(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json sensor_json(const std::optional<arm::Sensor>& sensor) {
  return sensor ? Json(arm::to_string(*sensor)) : Json(nullptr);
}

Json family_json(const compare::FeatureFamily& family) {
  return {{"feature", family.zeros_of ? "zero" : "pole"}, {"sensor", sensor_json(family.zeros_of)}};
}

Json models_json(const compare::Comparison& comparison) {
  Json models = Json::array();
  for (std::size_t k = 0; k < comparison.subjects.size(); ++k) {
    models.push_back({{"model", comparison.subjects[k]},
                      {"settings", comparison.settings[k]},
                      {"degrees_of_freedom", comparison.degrees_of_freedom[k]}});
  }
  return models;
}

Json roots_json(const compare::Comparison& comparison) {
  Json roots = Json::array();
  for (const auto& row : comparison.roots) {
    Json entry = family_json(row.family);
    entry["order"] = row.order;
    for (std::size_t k = 0; k < comparison.subjects.size(); ++k) {
      entry["values"].push_back({{"model", comparison.subjects[k]},
                                 {"s_rad_per_s", complex_json(row.s_rad_per_s[k])},
                                 {"relative_distance", row.distance[k]}});
      if (row.family.zeros_of) {
        entry["values"].back()["non_minimum_phase"] =
            row.s_rad_per_s[k] ? Json(is_non_minimum_phase(*row.s_rad_per_s[k])) : Json(nullptr);
      }
    }
    roots.push_back(std::move(entry));
  }
  return roots;
}

Json counts_json(const compare::Comparison& comparison) {
  Json counts = Json::array();
  for (const auto& note : comparison.notes) {
    Json entry = family_json(note.family);
    entry["model"] = note.subject;
    entry["found"] = note.found;
    entry["counted"] = note.count.expected >= 0 ? Json(note.count.expected) : Json(nullptr);
    entry["count_method"] = note.count.method;
    entry["infinite"] = note.infinite;
    entry["rejected"] = Json::array();
    for (const auto& zero : note.rejected) {
      entry["rejected"].push_back({{"s_rad_per_s", complex_json(zero.s_rad_per_s)},
                                   {"relative_change", zero.relative_change},
                                   {"reason", zero.reason}});
    }
    counts.push_back(std::move(entry));
  }
  return counts;
}

Json point_json(const std::optional<compare::RefinementPoint>& point) {
  if (!point) return nullptr;
  return {{"setting", point->setting},
          {"degrees_of_freedom", point->degrees_of_freedom},
          {"relative_error", point->relative_error}};
}

Json refinements_json(const compare::Comparison& comparison) {
  Json refinements = Json::array();
  for (const auto& curve : comparison.refinements) {
    Json entry = family_json(curve.family);
    entry["order"] = curve.order;
    entry["refined"] = curve.refinement;
    entry["model"] = curve.formulation;
    entry["setting"] = curve.setting_name;
    entry["decay"] = curve.decay == compare::Decay::algebraic ? "algebraic" : "exponential";
    entry["observed_order"] = optional_json(curve.convergence.rate);
    entry["points_fitted"] = curve.convergence.points_fitted;
    entry["smallest_error"] = curve.convergence.smallest_error;
    entry["rounding_from"] = point_json(curve.convergence.rounding_onset);
    entry["accurate_from"] = point_json(curve.convergence.cheapest);
    for (const auto& point : curve.points) entry["points"].push_back(point_json(point));
    refinements.push_back(std::move(entry));
  }
  return refinements;
}

Json shapes_json(const compare::Comparison& comparison) {
  Json shapes = Json::array();
  for (const auto& row : comparison.shapes) {
    shapes.push_back({{"model", row.formulation},
                      {"order", row.order},
                      {"one_minus_mac", row.one_minus_mac},
                      {"largest_error", row.largest_error},
                      {"hub_slope", row.hub_slope},
                      {"hub_slope_error", row.hub_slope_error}});
  }
  return shapes;
}

Json responses_json(const compare::Comparison& comparison) {
  Json responses = Json::array();
  for (const auto& response : comparison.responses) {
    Json entry = {{"sensor", arm::to_string(response.sensor)},
                  {"unit", arm::unit(response.sensor)},
                  {"frequency_Hz", response.frequency_Hz},
                  {"one_minus_coherence", response.one_minus_coherence}};
    for (std::size_t k = 0; k < comparison.subjects.size(); ++k) {
      std::vector<double> re;
      std::vector<double> im;
      for (const auto value : response.values[k]) {
        re.push_back(value.real());
        im.push_back(value.imag());
      }
      entry["models"].push_back(
          {{"model", comparison.subjects[k]},
           {"re", re},
           {"im", im},
           {"relative_error", response.relative_error[k]},
           {"largest_error", response.largest_error[k]},
           {"largest_error_frequency_Hz", response.largest_error_frequency_Hz[k]}});
    }
    responses.push_back(std::move(entry));
  }
  return responses;
}

Json finding_json(const compare::Finding& finding) {
  if (finding.quantity.empty()) return nullptr;
  return {{"quantity", finding.quantity},
          {"first", finding.first},
          {"second", finding.second},
          {"distance", finding.distance},
          {"tolerance", finding.tolerance}};
}

Json measured_json(const std::vector<compare::MeasuredRow>& rows,
                   const std::vector<std::string>& models) {
  Json measured = Json::array();
  for (const auto& row : rows) {
    measured.push_back({{"feature", measured::to_string(row.measured.feature)},
                        {"sensor", sensor_json(row.measured.sensor)},
                        {"order", row.order ? Json(*row.order) : Json(nullptr)},
                        {"measured_Hz", optional_json(row.measured.frequency_Hz)},
                        {"model_Hz", optional_json(row.model_frequency_Hz)},
                        {"model_undamped_Hz", optional_json(row.undamped_Hz)},
                        {"error_percent", row.error_percent},
                        {"measured_std_Hz", optional_json(row.measured.frequency_std_Hz)},
                        {"model_std_Hz", optional_json(row.model_std_Hz)},
                        {"deviation_std", row.combined_deviation},
                        {"models", Json::array()},
                        {"damping_ratio", optional_json(row.measured.damping_ratio)},
                        {"damping_ratio_std", optional_json(row.measured.damping_ratio_std)},
                        {"model_damping_ratio", optional_json(row.model_damping_ratio)},
                        {"damping_deviation_std", row.damping_deviation}});
    for (std::size_t k = 0; k < row.frequencies_Hz.size() && k < models.size(); ++k) {
      measured.back()["models"].push_back({{"model", models[k]},
                                           {"frequency_Hz", optional_json(row.frequencies_Hz[k])},
                                           {"deviation_std", row.deviations[k]}});
    }
  }
  return measured;
}

void add_parts(const std::vector<std::complex<double>>& values, Json& entry) {
  std::vector<double> re;
  std::vector<double> im;
  for (const auto value : values) {
    re.push_back(value.real());
    im.push_back(value.imag());
  }
  entry["re"] = re;
  entry["im"] = im;
}

Json measured_responses_json(const std::vector<compare::MeasuredResponse>& responses) {
  Json all = Json::array();
  for (const auto& response : responses) {
    Json entry = {{"run", response.run.empty() ? Json(nullptr) : Json(response.run)},
                  {"sensor", arm::to_string(response.measured.sensor)},
                  {"unit", arm::unit(response.measured.sensor)},
                  {"frequency_Hz", response.measured.frequency_Hz}};
    add_parts(response.measured.response, entry);
    entry["coherence"] = response.measured.coherence;
    entry["models"] = Json::array();
    for (std::size_t k = 0; k < response.models.size(); ++k) {
      Json model = {{"model", response.models[k]}};
      add_parts(response.values[k], model);
      model["relative_error_percent"] = response.relative_error_percent[k];
      model["median_error_percent"] = response.median_error_percent[k];
      entry["models"].push_back(std::move(model));
    }
    all.push_back(std::move(entry));
  }
  return all;
}

Json mac_json(const std::vector<compare::ShapeCorrelation>& shapes) {
  Json all = Json::array();
  for (const auto& one : shapes) {
    Json entry = {{"computed_Hz", one.model_frequencies_Hz},
                  {"largest_auto_mac", one.largest_auto_mac},
                  {"measured", Json::array()},
                  {"models", Json::array()}};
    for (const auto& shape : one.measured) {
      Json sensors = Json::array();
      for (const auto& sensor : shape.sensors) sensors.push_back(arm::to_string(sensor));
      entry["measured"].push_back({{"order", shape.order},
                                   {"frequency_Hz", optional_json(shape.frequency_Hz)},
                                   {"sensors", sensors}});
    }
    for (std::size_t k = 0; k < one.models.size(); ++k) {
      Json rows = Json::array();
      for (std::size_t i = 0; i < one.measured.size(); ++i) {
        rows.push_back({{"order", one.measured[i].order}, {"mac", one.mac[k][i]}});
      }
      entry["models"].push_back({{"model", one.models[k]}, {"rows", rows}});
    }
    all.push_back(std::move(entry));
  }
  return all;
}

Json measured_runs_json(const std::vector<compare::MeasuredTimeRun>& runs) {
  Json all = Json::array();
  for (const auto& run : runs) {
    Json entry = {{"run", run.run},
                  {"payload_mass_kg", run.payload.mass_kg},
                  {"closed_loop", run.closed_loop},
                  {"free_start", run.free_start},
                  {"time_s", run.time_s},
                  {"channels", Json::array()}};
    for (const auto& signal : run.signals) {
      entry["channels"].push_back({{"channel", signal.sensor},
                                   {"unit", signal.unit},
                                   {"fit_percent", signal.fit_percent()},
                                   {"nrmse_percent", signal.nrmse_percent},
                                   {"measured", signal.measured},
                                   {"simulated", signal.simulated}});
    }
    all.push_back(std::move(entry));
  }
  return all;
}

const char* word_of(compare::MeasuredAgreement agreement) {
  return agreement == compare::MeasuredAgreement::agrees ? "agrees" : "differs";
}

Json measured_verdict_json(const compare::MeasuredVerdict& verdict) {
  if (verdict.agreement == compare::MeasuredAgreement::none) return nullptr;
  const auto by_std = [&](double value) {
    return verdict.judged_by_std > 0 ? Json(value) : Json(nullptr);
  };
  const auto name = [](const compare::LargestDifference& largest) {
    return largest.of.empty() ? Json(nullptr) : Json(largest.of);
  };
  const bool is_by_percent = verdict.judged_by_percent > 0;
  return {
      {"verdict", word_of(verdict.agreement)},
      {"chi_square", by_std(verdict.chi_square)},
      {"degrees_of_freedom", verdict.judged_by_std},
      {"p_value", by_std(verdict.p_value)},
      {"largest_deviation_std", by_std(verdict.in_std.size)},
      {"largest_deviation_of", name(verdict.in_std)},
      {"largest_difference_percent", is_by_percent ? Json(verdict.in_percent.size) : Json(nullptr)},
      {"largest_difference_of", name(verdict.in_percent)},
      {"tolerance_percent", verdict.tolerance_percent}};
}

Json compared_json(const ComparedArm& compared) {
  const auto& comparison = compared.comparison;
  Json findings = Json::array();
  for (const auto& finding : comparison.findings) findings.push_back(finding_json(finding));
  const std::string& alone = comparison.verdict.alone;
  return {
      {"verdict", comparison.verdict.agree ? "agree" : "disagree"},
      {"measured_verdict", measured_verdict_json(compare::judge(compared.measured))},
      {"worst", finding_json(comparison.verdict.worst)},
      {"alone", alone.empty() ? Json() : Json(alone)},
      {"arm", arm_json(comparison.arm)},
      {"models", models_json(comparison)},
      {"roots", roots_json(comparison)},
      {"counts", counts_json(comparison)},
      {"refinements", refinements_json(comparison)},
      {"refinements_complete", comparison.are_refinements_complete},
      {"basis_notes", comparison.basis_notes},
      {"shapes", shapes_json(comparison)},
      {"responses", responses_json(comparison)},
      {"measured", measured_json(compared.measured.rows, comparison.subjects)},
      {"measured_responses", measured_responses_json(compared.measured.responses)},
      {"measured_runs", measured_runs_json(compared.measured.runs)},
      {"runs_left_out", compared.measured.runs_left_out},
      {"runs_out_of_time", compared.measured.runs_out_of_time},
      {"mac", mac_json(compared.measured.shapes)},
      {"findings", findings},
  };
}

}  // namespace

std::string comparison_json(const std::vector<ComparedArm>& arms) {
  using enum compare::MeasuredAgreement;
  Json comparisons = Json::array();
  bool agree = true;
  compare::MeasuredAgreement measured = none;
  for (const auto& compared : arms) {
    comparisons.push_back(compared_json(compared));
    agree = agree && compared.comparison.verdict.agree;
    measured = std::max(measured, compare::judge(compared.measured).agreement);
  }
  return json_document(
      "flexarm.compare/1",
      {{"verdict", agree ? "agree" : "disagree"},
       {"measured_verdict", measured == none ? Json(nullptr) : Json(word_of(measured))},
       {"comparisons", comparisons}});
}

}  // namespace flexarm::report
