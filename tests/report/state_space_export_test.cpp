#include "report/tables/state_space_export.hpp"

#include "measured/files/csv.hpp"
#include "report/tables/csv.hpp"
#include "tests/report/response_sample.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>

namespace flexarm::report {
namespace {

using Complex = std::complex<double>;

/// Largest relative distance of a state space's response from what was exported beside it.
double distance(const response::StateSpace& system, const response::FrequencyResponse& expected) {
  double largest = 0.0;
  for (std::size_t i = 0; i < expected.frequency_Hz.size(); ++i) {
    const auto values =
        response::frequency_response(system, response::on_imaginary_axis(expected.frequency_Hz[i]));
    for (std::size_t k = 0; k < values.size(); ++k) {
      largest = std::max(
          largest, std::abs(values[k] - expected.values[k][i]) / std::abs(expected.values[k][i]));
    }
  }
  return largest;
}

TEST(StateSpaceExport, JsonReadsBackToTheSameResponse) {
  const auto study = sample_study();
  const auto json = nlohmann::json::parse(
      state_space_json({*study.state_space, *study.state_space_response}).dump());
  response::StateSpace read;
  read.sensors = study.state_space->sensors;
  read.delay_s = json["delay_s"];
  const auto matrix = [&](const char* name) {
    const auto& rows = json[name];
    Eigen::MatrixXd values(rows.size(), rows[0].size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (std::size_t j = 0; j < rows[i].size(); ++j) {
        values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = rows[i][j];
      }
    }
    return values;
  };
  read.a = matrix("A");
  read.b = matrix("B");
  read.c = matrix("C");
  read.d = matrix("D");
  read.output_delay_s.resize(read.d.rows());
  for (Eigen::Index k = 0; k < read.d.rows(); ++k) {
    read.output_delay_s(k) = json["outputs"][static_cast<std::size_t>(k)]["delay_s"];
  }
  EXPECT_EQ(read.a, study.state_space->a);
  EXPECT_EQ(distance(read, *study.state_space_response), 0.0);
  EXPECT_EQ(json["outputs"][1]["sensor"], "tip_acceleration");
  EXPECT_EQ(json["outputs"][1]["unit"], "m/s^2");
  EXPECT_EQ(json["outputs"][1]["re"][3], study.state_space_response->values[1][3].real());
}

TEST(StateSpaceExport, CsvReadsBackToTheSameResponse) {
  const auto study = sample_study();
  const std::string csv = to_csv(state_space_listing(*study.state_space));
  response::StateSpace read = *study.state_space;
  for (auto* matrix : {&read.a, &read.b, &read.c, &read.d}) matrix->setConstant(NAN);
  read.delay_s = NAN;
  Eigen::MatrixXd output_delay_s = Eigen::MatrixXd::Constant(2, 1, NAN);
  const std::map<std::string, Eigen::MatrixXd*> matrices = {{"A", &read.a},
                                                            {"B", &read.b},
                                                            {"C", &read.c},
                                                            {"D", &read.d},
                                                            {"output_delay_s", &output_delay_s}};
  const auto rows = measured::parse_csv(csv, "state-space.csv");
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto& cells = rows[i].cells;
    const double value = std::strtod(cells.back().c_str(), nullptr);
    if (cells[0] == "delay_s") {
      read.delay_s = value;
    } else {
      (*matrices.at(cells[0]))(std::stol(cells[1]) - 1, std::stol(cells[2]) - 1) = value;
    }
  }
  read.output_delay_s = output_delay_s.col(0);
  EXPECT_EQ(read.a, study.state_space->a);
  EXPECT_EQ(read.delay_s, study.state_space->delay_s);
  EXPECT_EQ(distance(read, *study.state_space_response), 0.0);
}

TEST(StateSpaceExport, MatReadsBackToTheSameResponse) {
  const auto study = sample_study();
  const auto path = std::filesystem::path(testing::TempDir()) / "flexarm-state-space-export.mat";
  measured::write_mat_file(state_space_mat({*study.state_space, *study.state_space_response}),
                           path);
  std::map<std::string, measured::MatVariable> read;
  for (auto& variable : measured::read_mat_file(path)) read[variable.name] = std::move(variable);
  std::filesystem::remove(path);
  const auto matrix = [&](const char* name) -> Eigen::MatrixXd {
    const auto& m = std::get<measured::MatMatrix>(read.at(name).value);
    return Eigen::Map<const Eigen::MatrixXd>(m.values.data(), static_cast<Eigen::Index>(m.rows),
                                             static_cast<Eigen::Index>(m.columns));
  };
  response::StateSpace system = *study.state_space;
  system.a = matrix("A");
  system.b = matrix("B");
  system.c = matrix("C");
  system.d = matrix("D");
  system.delay_s = matrix("delay_s")(0, 0);
  system.output_delay_s = matrix("output_delay_s").col(0);
  EXPECT_EQ(system.output_delay_s(1), 4e-3);
  EXPECT_EQ(distance(system, *study.state_space_response), 0.0);
  EXPECT_EQ(std::get<measured::MatStrings>(read.at("sensors").value),
            (measured::MatStrings{"hub_angle", "tip_acceleration"}));
  EXPECT_EQ(std::get<measured::MatStrings>(read.at("states").value), study.state_space->states);
  const auto& response = std::get<measured::MatComplexMatrix>(read.at("response").value);
  EXPECT_EQ(response(1, 7), study.state_space_response->values[1][7]);
}

TEST(StateSpaceExport, AFlippedSignOfDampingIsSeenInTheExportedResponse) {
  const auto study = sample_study();
  response::StateSpace flipped = *study.state_space;
  for (Eigen::Index i = 0; i < 8; i += 2) {
    for (Eigen::Index j = 0; j < 8; j += 2) flipped.a(i + 1, j + 1) *= -1.0;
  }
  EXPECT_GT(distance(flipped, *study.state_space_response), 1.0);
}

}  // namespace
}  // namespace flexarm::report
