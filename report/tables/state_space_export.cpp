#include "report/tables/state_space_export.hpp"

#include "report/json/arm_json.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>

namespace flexarm::report {

namespace {

using Json = nlohmann::ordered_json;

Json rows_of(const Eigen::MatrixXd& matrix) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(matrix(i, j));
    rows.push_back(std::move(row));
  }
  return rows;
}

measured::MatMatrix columns_of(const Eigen::MatrixXd& matrix) {
  return {static_cast<std::size_t>(matrix.rows()), static_cast<std::size_t>(matrix.cols()),
          std::vector<double>(matrix.data(), matrix.data() + matrix.size())};
}

std::vector<std::string> sensor_names(const response::StateSpace& system) {
  std::vector<std::string> names;
  for (const auto& sensor : system.sensors) names.push_back(arm::to_string(sensor));
  return names;
}

}  // namespace

Json state_space_json(const StateSpaceExport& state_space) {
  const auto& [system, response] = state_space;
  Json document = {{"input", "torque [N m]"},   {"states", system.states},
                   {"A", rows_of(system.a)},    {"B", rows_of(system.b)},
                   {"C", rows_of(system.c)},    {"D", rows_of(system.d)},
                   {"delay_s", system.delay_s}, {"frequency_Hz", response.frequency_Hz},
                   {"outputs", Json::array()}};
  for (std::size_t k = 0; k < system.sensors.size(); ++k) {
    Json output = {{"sensor", arm::to_string(system.sensors[k])},
                   {"unit", std::string(arm::unit(system.sensors[k]))},
                   {"delay_s", system.output_delay_s(static_cast<Eigen::Index>(k))},
                   {"re", Json::array()},
                   {"im", Json::array()}};
    for (const auto& value : response.values[k]) {
      output["re"].push_back(value.real());
      output["im"].push_back(value.imag());
    }
    document["outputs"].push_back(std::move(output));
  }
  return document;
}

Table state_space_listing(const response::StateSpace& system) {
  Table table{"State space",
              {{"matrix"}, {"row"}, {"column"}, {"row of"}, {"column of"}, {"value", "", 17}}};
  const auto add = [&](const char* name, const Eigen::MatrixXd& matrix,
                       const std::vector<std::string>& rows,
                       const std::vector<std::string>& columns) {
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
      for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
        table.add_row({std::string(name), std::int64_t{i} + 1, std::int64_t{j} + 1,
                       rows[static_cast<std::size_t>(i)], columns[static_cast<std::size_t>(j)],
                       matrix(i, j)});
      }
    }
  };
  const std::vector<std::string> input = {"torque"};
  const auto outputs = sensor_names(system);
  add("A", system.a, system.states, system.states);
  add("B", system.b, system.states, input);
  add("C", system.c, outputs, system.states);
  add("D", system.d, outputs, input);
  add("delay_s", Eigen::MatrixXd::Constant(1, 1, system.delay_s), input, input);
  add("output_delay_s", system.output_delay_s, outputs, input);
  return table;
}

std::vector<measured::MatVariable> state_space_mat(const StateSpaceExport& state_space) {
  const auto& [system, response] = state_space;
  measured::MatStrings units;
  for (const auto& sensor : system.sensors) units.emplace_back(arm::unit(sensor));
  measured::MatComplexMatrix values{system.sensors.size(), response.frequency_Hz.size(), {}};
  for (std::size_t i = 0; i < response.frequency_Hz.size(); ++i) {
    for (const auto& of_sensor : response.values) values.values.push_back(of_sensor[i]);
  }
  return {
      {"A", columns_of(system.a)},
      {"B", columns_of(system.b)},
      {"C", columns_of(system.c)},
      {"D", columns_of(system.d)},
      {"delay_s", measured::MatMatrix{1, 1, {system.delay_s}}},
      {"output_delay_s", columns_of(system.output_delay_s)},
      {"states", system.states},
      {"sensors", sensor_names(system)},
      {"units", units},
      {"frequency_Hz", measured::MatMatrix{1, response.frequency_Hz.size(), response.frequency_Hz}},
      {"response", values}};
}

}  // namespace flexarm::report
