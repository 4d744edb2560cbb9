#pragma once

#include "compare/finding.hpp"
#include "response/any_formulation.hpp"

#include <string>
#include <vector>

namespace flexarm::compare {

/// Modes of one formulation against the reference's, order by order.
struct ShapeAgreement {
  std::string formulation;
  int order = 1;
  double one_minus_mac = 0.0;    ///< modal assurance criterion [AllemangBrown1982], from 1
  double largest_error = 0.0;    ///< max |phi - phi_ref|/max |phi_ref| over the stations
  double hub_slope = 0.0;        ///< phi'(0) of the formulation, modal mass I_T
  double hub_slope_error = 0.0;  ///< relative
};

/// Evenly spaced stations, ends included, at which shapes are compared.
inline constexpr int kShapeStations = 201;

/// The stations x [m] of an arm of that length.
std::vector<double> shape_stations_m(double length_m);

/// One row for each mode that both have; `reference` and `model` are modes with displacements at
/// the same stations.
std::vector<ShapeAgreement> compare_shapes(const std::string& formulation,
                                           const std::vector<arm::Mode>& reference,
                                           const std::vector<arm::Mode>& model);

}  // namespace flexarm::compare
