#pragma once

#include "arm/formulation.hpp"
#include "arm/linear_arm.hpp"
#include "exact_tf/arithmetic.hpp"
#include "exact_tf/damped_zeros.hpp"
#include "exact_tf/numerator.hpp"

#include <complex>
#include <span>
#include <string_view>
#include <vector>

namespace flexarm::exact_tf {

/// Throws InputError by the name of an effect that leaves an arm which `who` cannot solve, one that
/// is not plain (LinearArm::is_plain).
void require_plain(const arm::Arm& arm, std::string_view who);

/// A plain arm (LinearArm::is_plain) by the closed forms of exact_tf/numerator.hpp. Kelvin-Voigt
/// damping and hub friction are in the transfer function and the damped poles without
/// approximation. Questions, counts and errors are those of ExactArm.
class PlainArm {
 public:
  explicit PlainArm(const arm::LinearArm& arm, Arithmetic arithmetic = Arithmetic::extended);

  const InertiaRatios& ratios() const { return ratios_; }

  std::vector<double> pole_lambdas(int count) const;
  std::vector<double> hub_zero_lambdas(int count) const;

  arm::PoleSet poles(int count) const;
  /// s^2 + kv omega_i^2 s + omega_i^2 = 0 without hub friction, else by continuation.
  arm::DampedPoleSet damped_poles(int count) const;
  arm::ZeroSet hub_zeros(int count) const;
  arm::ZeroSet zeros(const arm::Sensor& sensor, int count) const;
  /// s^2/(1 + kv s) = s_0^2 beside each undamped zero s_0, whatever the sensor: a numerator depends
  /// on lambda alone.
  DampedZeroSet damped_zeros(std::span<const std::complex<double>> undamped_rad_per_s) const;
  std::vector<arm::Mode> modes(int count, std::span<const arm::Sensor> sensors,
                               std::span<const double> stations_m) const;
  /// D_ij = kv omega_i^2 delta_ij + c theta_i theta_j/I_T.
  arm::ModalModel modal_model(int count, std::span<const arm::Sensor> sensors,
                              std::span<const double> stations_m) const;
  std::vector<std::complex<double>> transfer_functions(std::span<const arm::Sensor> sensors,
                                                       std::complex<double> s_rad_per_s) const;

 private:
  arm::LinearArm arm_;
  InertiaRatios ratios_;
  InertiaRatiosIn<double> working_ratios_;
  Arithmetic arithmetic_;
};

}  // namespace flexarm::exact_tf
