#pragma once

#include "arm/formulation.hpp"
#include "arm/linear_arm.hpp"
#include "exact_tf/plain_arm.hpp"
#include "exact_tf/transfer_matrix_arm.hpp"

#include <complex>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

namespace flexarm::exact_tf {

/// The arm as its boundary value problem states it: the transcendental transfer function from hub
/// torque to every sensor, with no discretisation. See exact_tf/numerator.hpp for the equations.
///
///     const ExactArm exact(arm::paper_arm());
///     const double first_Hz = exact.poles(1).omega_rad_per_s[0] / (2 * std::numbers::pi);
///
/// Every effect through the ports arm::kLinearArmPorts is honoured, damping without approximation
/// in the transfer function and in the damped poles; others are refused by name. A plain arm
/// (LinearArm::is_plain) is answered by closed forms, any other by transfer matrices of segments:
/// exact_tf/plain_arm.hpp, exact_tf/transfer_matrix_arm.hpp.
class ExactArm {
 public:
  static constexpr std::string_view kName = "exact_tf";

  /// Throws arm::InputError for an invalid arm, for an effect that is not honoured, and for an arm
  /// that stands up and whose flexible modes buckle.
  explicit ExactArm(arm::Arm arm, Arithmetic arithmetic = Arithmetic::extended);

  const arm::Arm& arm() const { return arm_; }
  /// What the equations are made of: the arm with its effects.
  const arm::LinearArm& linear() const { return linear_; }
  /// Of a plain arm; for others std::bad_variant_access.
  const InertiaRatios& ratios() const { return std::get<PlainArm>(engine_).ratios(); }
  int degrees_of_freedom() const { return 0; }

  /// The `count` lowest lambda of the flexible poles, ascending, within an ulp or so. The poles are
  /// s = +-i lambda^2 omega_scale. Throws arm::InputError unless
  /// 1 <= count <= kMostRoots (TransferMatrixArm::kMostRoots where the arm is not plain), as do all
  /// below, and for an arm that is not plain, as does hub_zero_lambdas.
  std::vector<double> pole_lambdas(int count) const;
  /// The same for the hub-angle zeros.
  std::vector<double> hub_zero_lambdas(int count) const;

  arm::PoleSet poles(int count) const;
  arm::DampedPoleSet damped_poles(int count) const;
  arm::ZeroSet zeros(const arm::Sensor& sensor, int count) const;
  /// What undamped zeros of `zeros` become with damping, each followed by itself.
  DampedZeroSet damped_zeros(const arm::Sensor& sensor,
                             std::span<const std::complex<double>> undamped_rad_per_s) const;
  std::vector<arm::Mode> modes(int count, std::span<const arm::Sensor> sensors,
                               std::span<const double> stations_m) const;
  arm::ModalModel modal_model(int count, std::span<const arm::Sensor> sensors,
                              std::span<const double> stations_m) const;
  std::complex<double> transfer_function(const arm::Sensor& sensor,
                                         std::complex<double> s_rad_per_s) const;
  /// Of several sensors, which share most of the work.
  std::vector<std::complex<double>> transfer_functions(std::span<const arm::Sensor> sensors,
                                                       std::complex<double> s_rad_per_s) const;

 private:
  arm::Arm arm_;
  arm::LinearArm linear_;
  std::variant<PlainArm, TransferMatrixArm> engine_;
};

static_assert(arm::Formulation<ExactArm>);

}  // namespace flexarm::exact_tf
