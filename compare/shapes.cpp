#include "compare/shapes.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace flexarm::compare {

namespace {

Eigen::Map<const Eigen::VectorXd> as_vector(const std::vector<double>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

}  // namespace

std::vector<double> shape_stations_m(double length_m) {
  std::vector<double> stations;
  for (int i = 0; i < kShapeStations; ++i) {
    // The quotient first: it is 1 at the tip, where no station may lie beyond the beam.
    stations.push_back(length_m * (static_cast<double>(i) / (kShapeStations - 1)));
  }
  return stations;
}

std::vector<ShapeAgreement> compare_shapes(const std::string& formulation,
                                           const std::vector<arm::Mode>& reference,
                                           const std::vector<arm::Mode>& model) {
  std::vector<ShapeAgreement> rows;
  const std::size_t count = std::min(reference.size(), model.size());
  for (std::size_t i = 0; i < count; ++i) {
    const auto exact = as_vector(reference[i].displacement_m);
    const auto shape = as_vector(model[i].displacement_m);
    ShapeAgreement row;
    row.formulation = formulation;
    row.order = static_cast<int>(i) + 1;
    // 1 - MAC = sin^2 of the angle between the two, free of the cancellation in 1 - cos^2.
    const Eigen::VectorXd across = shape - exact * (exact.dot(shape) / exact.squaredNorm());
    row.one_minus_mac = across.squaredNorm() / shape.squaredNorm();
    row.largest_error = (shape - exact).lpNorm<Eigen::Infinity>() / exact.lpNorm<Eigen::Infinity>();
    row.hub_slope = model[i].hub_slope;
    row.hub_slope_error =
        std::abs(model[i].hub_slope - reference[i].hub_slope) / std::abs(reference[i].hub_slope);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace flexarm::compare
