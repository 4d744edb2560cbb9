#pragma once

#include "arm/formulation.hpp"
#include "arm/linear_arm.hpp"
#include "exact_tf/arithmetic.hpp"
#include "exact_tf/beam_units.hpp"
#include "exact_tf/damped_zeros.hpp"

#include <complex>
#include <span>
#include <variant>
#include <vector>

namespace flexarm::exact_tf {

/// A linear arm with every effect, by transfer matrices of segments: exact_tf/beam_units.hpp has
/// the equations, exact_tf/transfer_chain.hpp how they are solved. Questions and errors are those
/// of ExactArm, the counts bounded by `kMostRoots`.
class TransferMatrixArm {
 public:
  /// Values take time in proportion to the number of waves, searches to its square: 2,000 poles
  /// some seconds.
  static constexpr int kMostRoots = 2000;

  /// Throws arm::InputError for an arm that stands up and whose flexible modes buckle.
  explicit TransferMatrixArm(const arm::LinearArm& arm,
                             Arithmetic arithmetic = Arithmetic::extended);

  arm::PoleSet poles(int count) const;
  arm::DampedPoleSet damped_poles(int count) const;
  arm::ZeroSet zeros(const arm::Sensor& sensor, int count) const;
  /// By continuation in damping (exact_tf/pole_continuation.hpp) of the sensor's numerator, whose
  /// zeros those of the hub are the poles of the arm with its rotor held. Zeros off both axes are
  /// not followed.
  DampedZeroSet damped_zeros(const arm::Sensor& sensor,
                             std::span<const std::complex<double>> undamped_rad_per_s) const;
  std::vector<arm::Mode> modes(int count, std::span<const arm::Sensor> sensors,
                               std::span<const double> stations_m) const;
  arm::ModalModel modal_model(int count, std::span<const arm::Sensor> sensors,
                              std::span<const double> stations_m) const;
  /// s = 0 where something holds the arm.
  std::vector<std::complex<double>> transfer_functions(std::span<const arm::Sensor> sensors,
                                                       std::complex<double> s_rad_per_s) const;

 private:
  arm::LinearArm arm_;
  std::variant<ArmInBeamUnits<Real>, ArmInBeamUnits<double>> units_;
};

}  // namespace flexarm::exact_tf
