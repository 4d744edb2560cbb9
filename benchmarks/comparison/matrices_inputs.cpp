#include "assumed_modes/assumed_modes_arm.hpp"
#include "benchmarks/comparison/inputs.hpp"
#include "benchmarks/comparison/raw_files.hpp"
#include "fem/fem_arm.hpp"

#include <Eigen/SparseCore>

#include <string>
#include <vector>

namespace flexarm::benchmarks {
namespace {

/// Row indices, then column indices, then values, all as doubles.
std::vector<double> triplets(const Eigen::SparseMatrix<double>& matrix) {
  std::vector<double> rows_of;
  std::vector<double> columns;
  std::vector<double> values;
  for (Eigen::Index column = 0; column < matrix.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(matrix, column); entry; ++entry) {
      rows_of.push_back(static_cast<double>(entry.row()));
      columns.push_back(static_cast<double>(entry.col()));
      values.push_back(entry.value());
    }
  }
  rows_of.insert(rows_of.end(), columns.begin(), columns.end());
  rows_of.insert(rows_of.end(), values.begin(), values.end());
  return rows_of;
}

}  // namespace

void write_matrices(const std::filesystem::path& folder) {
  auto elements = nlohmann::json::array();
  for (const int count : {29, 100, 300, 1000, 10'000, 100'000}) {
    const fem::FemArm model(arm::paper_arm(), {.mesh = {.elements = count}, .degree = 3});
    const std::string name = "elements-" + std::to_string(count);
    write_raw(folder / (name + "-stiffness.f64"), triplets(model.stiffness_N_m()));
    write_raw(folder / (name + "-mass.f64"), triplets(model.mass_kg_m2()));
    elements.push_back({{"elements", count}, {"size", model.degrees_of_freedom()}});
  }
  const assumed_modes::AssumedModesArm assumed(arm::paper_arm());
  write_json(folder / "matrices.json",
             {{"elements", elements},
              {"functions", assumed.options().functions},
              {"functions_stiffness_N_m", rows(assumed.stiffness_matrix_N_m())},
              {"functions_mass_kg_m2", rows(assumed.mass_matrix_kg_m2())}});
}

}  // namespace flexarm::benchmarks
