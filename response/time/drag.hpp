#pragma once

#include "arm/formulation.hpp"

#include <Eigen/Core>

#include <vector>

namespace flexarm::response {

/// A rule for integrals along the beam: int f dx = sum weights_m f(stations_m).
struct DragStations {
  std::vector<double> stations_m;
  std::vector<double> weights_m;
};

/// Gauss' rule of 10 points on each of 6 equal parts of the beam. It is exact for the drag of the
/// rigid rotation, and resolves shapes of some 25 half waves. Where v changes its sign within a
/// part, |v| v has a jump in its second derivative, which costs about (l/60)^3 of the integral.
DragStations drag_stations(double length_m);

/// The generalised forces of drag, force per length -coefficient |v| v.
class QuadraticDrag {
 public:
  /// `model` has displacements at `drag_stations(length_m)`; throws InputError where it has not.
  QuadraticDrag(const arm::ModalModel& model, double length_m, double coefficient_N_s2_per_m3);

  /// -coefficient int |v| v phi_i dx/I_T for the modal velocities, n [1/s^2].
  Eigen::VectorXd modal_force(const Eigen::Ref<const Eigen::VectorXd>& modal_velocity) const;
  /// coefficient int |v|^3 dx [W].
  double power_W(const Eigen::Ref<const Eigen::VectorXd>& modal_velocity) const;

 private:
  Eigen::MatrixXd shapes_;           // stations x n
  Eigen::MatrixXd weighted_shapes_;  // n x stations, times -coefficient weight/I_T
  Eigen::VectorXd weights_;          // coefficient weight
};

}  // namespace flexarm::response
