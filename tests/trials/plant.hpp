#pragma once

#include "arm/sensor.hpp"
#include "tests/trials/true_arm.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace flexarm::trials {

/// The linear arm in the lowest modes of a finite-element model,
///
///     q'' + D q' + W q = (hub T + f)/I,   theta = hub^T q,
///
/// with a tuned mass, where there is one, as one coordinate more.
struct Plant {
  double modal_mass_kg_m2 = 0.0;      ///< I
  Eigen::MatrixXd damping;            ///< D [1/s], n x n
  Eigen::MatrixXd stiffness;          ///< W [1/s^2], n x n
  Eigen::VectorXd hub;                ///< n
  Eigen::MatrixXd readings;           ///< sensors x n, before time derivatives
  Eigen::MatrixXd stations;           ///< displacement y at evenly spaced stations, n columns
  Eigen::VectorXd station_weights_m;  ///< of Simpson's rule along the beam
};

struct PlantOptions {
  int elements = 40;
  int flexible_modes = 14;  ///< beside those of attached masses
};

/// What is not linear does not enter.
Plant make_plant(const TrueArm& arm, std::span<const arm::Sensor> sensors,
                 const PlantOptions& options = {});

}  // namespace flexarm::trials
