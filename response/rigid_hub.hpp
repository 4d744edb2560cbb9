#pragma once

#include "arm/formulation.hpp"
#include "arm/linear_arm.hpp"

#include <complex>
#include <span>
#include <string_view>
#include <vector>

namespace flexarm::response {

/// An arm without a beam (arm/rigid_hub.hpp), in closed form:
///
///     Ih theta'' + c theta' + ks theta = tau.
///
/// It fulfils arm::Formulation with one mode, the lowest; there are no flexible poles and no zeros,
/// whatever number of them is asked for. Sensors are those of the hub.
class RigidHub {
 public:
  static constexpr std::string_view kName = "rigid_hub";

  /// Throws InputError for an arm that is not valid or has a beam, and for an effect through a port
  /// that is not among `arm::kLinearArmPorts`.
  explicit RigidHub(arm::Arm arm);

  const arm::Arm& arm() const { return arm_; }
  int degrees_of_freedom() const { return 1; }
  arm::PoleSet poles(int count) const;
  arm::ZeroSet zeros(const arm::Sensor& sensor, int count) const;
  arm::DampedPoleSet damped_poles(int count) const;
  std::vector<arm::Mode> modes(int count, std::span<const arm::Sensor> sensors,
                               std::span<const double> stations_m) const;
  arm::ModalModel modal_model(int count, std::span<const arm::Sensor> sensors,
                              std::span<const double> stations_m) const;
  std::complex<double> transfer_function(const arm::Sensor& sensor,
                                         std::complex<double> s_rad_per_s) const;

 private:
  /// ks/Ih [1/s^2] and c/Ih [1/s].
  double stiffness_per_inertia() const;
  double friction_per_inertia() const;

  arm::Arm arm_;
  arm::LinearArm linear_;
};

}  // namespace flexarm::response
