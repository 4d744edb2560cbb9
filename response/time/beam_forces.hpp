#pragma once

#include "arm/formulation.hpp"
#include "response/arm_parts.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace flexarm::response {

/// A rule for integrals along the beam: int f dx = sum weights_m f(stations_m).
struct BeamStations {
  std::vector<double> stations_m;
  std::vector<double> weights_m;
};

inline constexpr int kBeamStations = 60;

/// Gauss' rule of 10 points on each of 6 equal parts of the beam. It is exact for the quadratic
/// drag of the rigid rotation, and resolves shapes of some 25 half waves. Where v changes its sign
/// within a part, |v| v has a jump in its second derivative, which costs about (l/60)^3 of the
/// integral.
BeamStations beam_stations(double length_m);

/// The generalised forces of laws force(v) along the beam (arm::BeamForce).
class BeamForces {
 public:
  /// `model` has displacements at `beam_stations(length_m)`; throws InputError where it has not.
  BeamForces(const arm::ModalModel& model, double length_m,
             std::vector<OfEffect<arm::BeamForce>> laws);

  /// Writes the modal forces int force(v) phi_i dx/I_T [1/s^2] to `made`, for the modal velocities
  /// [1/s]: n entries each.
  void modal_force(std::span<const double> modal_velocity, Eigen::VectorXd& made) const;
  /// Dissipated power -int force(v) v dx.
  double power_W(const Eigen::Ref<const Eigen::VectorXd>& modal_velocity) const;

  /// The first effect that acts along the beam.
  const std::string& effect() const { return laws_.front().effect; }

 private:
  using AtStations = Eigen::Matrix<double, kBeamStations, 1>;
  AtStations forces_N_per_m(const AtStations& velocity_m_per_s) const;

  std::vector<OfEffect<arm::BeamForce>> laws_;
  Eigen::Matrix<double, kBeamStations, Eigen::Dynamic> shapes_;
  AtStations weights_m_;
  AtStations weights_per_modal_mass_;  // [1/(kg m)]
};

}  // namespace flexarm::response
