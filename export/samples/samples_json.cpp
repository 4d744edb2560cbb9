#include "export/samples/sample_files.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace flexarm::samples {

namespace {

using Json = nlohmann::ordered_json;

Json rows_of(const Eigen::MatrixXd& matrix) {
  Json rows = Json::array();
  for (const auto& row : matrix.rowwise()) {
    rows.push_back(std::vector<double>(row.begin(), row.end()));
  }
  return rows;
}

}  // namespace

Json samples_json(const SampleExport& exported) {
  const auto& [posterior, samples, state_space, seed, left_out_effects] = exported;
  Json json = {{"input", "torque [N m]"},
               {"states", state_space.states},
               {"outputs", Json::array()},
               {"numbers", Json::array()},
               {"sets", Json::array()},
               {"left_out_effects", left_out_effects},
               {"seed", seed},
               {"rejected_draws", samples.rejected},
               {"samples", Json::array()}};
  for (const arm::Sensor& sensor : state_space.systems.front().sensors) {
    json["outputs"].push_back(
        {{"sensor", arm::to_string(sensor)}, {"unit", std::string(arm::unit(sensor))}});
  }
  for (const SampledNumber& number : samples.numbers) {
    json["numbers"].push_back({{"key", number.key}, {"unit", number.unit}});
  }
  for (const ArmDistribution& set : posterior.sets) {
    json["sets"].push_back({{"effects", set.effects}, {"probability", set.probability}});
  }
  for (std::size_t k = 0; k < samples.samples.size(); ++k) {
    const ArmSample& sample = samples.samples[k];
    const response::StateSpace& system = state_space.systems[k];
    Json values = Json::array();
    for (const double value : sample.values) {
      values.push_back(std::isnan(value) ? Json(nullptr) : Json(value));
    }
    const auto& delays = system.output_delay_s;
    json["samples"].push_back(
        {{"set", sample.set},
         {"values", std::move(values)},
         {"A", rows_of(system.a)},
         {"B", rows_of(system.b)},
         {"C", rows_of(system.c)},
         {"D", rows_of(system.d)},
         {"delay_s", system.delay_s},
         {"output_delay_s", std::vector<double>(delays.begin(), delays.end())}});
  }
  return json;
}

}  // namespace flexarm::samples
