#pragma once

#include "tests/trials/element_model.hpp"

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace flexarm::trials {

/// Undamped modes, ascending, of modal mass I (ElementModel::total_inertia_kg_m2) and turned so
/// that the hub turns forwards.
struct ElementModes {
  double modal_mass_kg_m2 = 0.0;
  /// omega^2; 0 for the rigid-body mode of an arm that turns freely, below 0 for one that falls.
  Eigen::VectorXd omega_squared_rad2_per_s2;
  Eigen::MatrixXd shapes;  ///< a column a mode
};

/// The lowest mode and `flexible` more.
ElementModes undamped_modes(const ElementModel& model, Eigen::Index flexible);

/// abs(s) of the lowest `count` hub-angle zeros: the arm's frequencies with its hub held [rad/s].
std::vector<double> held_omegas_rad_per_s(const ElementModel& model, int count);

/// The lowest `count` flexible poles with damping, Im >= 0, of the whole model: those of its lowest
/// modes, made exact by Newton's method. A pair that is damped beyond 1 is not among them; -omega
/// of the undamped mode stands in its place.
std::vector<std::complex<double>> damped_poles_rad_per_s(const ElementModel& model, int count);

/// Motion per torque on the hub at s: (s^2 M + s C + K) u = e_hub.
Eigen::VectorXcd motion_per_torque(const ElementModel& model, std::complex<double> s_rad_per_s);

}  // namespace flexarm::trials
