#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace flexarm::benchmarks {

/// The values as they lie in memory, for numpy.fromfile. Throws std::runtime_error.
template <class T>
void write_raw(const std::filesystem::path& path, const std::vector<T>& values) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(values.data()),
             static_cast<std::streamsize>(values.size() * sizeof(T)));
  if (!file) throw std::runtime_error("cannot write " + path.string());
}

/// Throws std::runtime_error.
inline void write_json(const std::filesystem::path& path, const nlohmann::json& document) {
  std::ofstream file(path);
  file << document << '\n';
  if (!file) throw std::runtime_error("cannot write " + path.string());
}

/// A matrix as its rows.
inline nlohmann::json rows(const Eigen::MatrixXd& matrix) {
  auto made = nlohmann::json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    made.push_back(std::vector<double>(static_cast<std::size_t>(matrix.cols())));
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
      made.back()[static_cast<std::size_t>(j)] = matrix(i, j);
    }
  }
  return made;
}

}  // namespace flexarm::benchmarks
