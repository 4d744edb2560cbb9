#pragma once

#include "arm/formulation.hpp"
#include "arm/linear_arm.hpp"
#include "assumed_modes/admissible_functions.hpp"
#include "assumed_modes/basis.hpp"
#include "assumed_modes/mass_matrix.hpp"
#include "assumed_modes/ritz.hpp"

#include <Eigen/Core>

#include <complex>
#include <span>
#include <string_view>
#include <vector>

namespace flexarm::assumed_modes {

struct AssumedModesOptions {
  Basis basis = Basis::legendre;

  /// Generalised coordinates n, the rigid rotation included; 2 <= n <= kMaximumFunctions. With
  /// Legendre functions 36 give ten poles and ten hub zeros to rounding and six tip zeros to 1e-9
  /// for payloads of up to 10 m l and 0.1 m l^3 and hubs of up to 100 m l^3; 28 give 1e-10 on the
  /// paper's arm.
  int functions = 36;

  /// A zero s of a sensor away from the hub is trusted when the nearest zeros s' with n + 2 and
  /// with n + 4 functions both have |s - s'| <= zero_change |s|. At 1e-3 no false zero of the tip
  /// passes for any basis and n up to 60; at 1e-2 an eighth of those that pass is false with
  /// Legendre functions, and more with the others.
  double zero_change = 1e-3;
};

/// Cost grows as n^3: at this n the construction takes 0.3 s and the zeros of a sensor 1 s.
inline constexpr int kMaximumFunctions = 200;

/// The arm by Lagrange's equations on admissible functions (assumed modes, Rayleigh-Ritz):
///
///     y(x, t) = q_0 x + l sum q_i psi_i(x/l),   psi_i(0) = 0,
///
/// with q in radians. Torque tau on the hub gives
///
///     m l^3 M q'' + (EI/l) K (q + kv q') + c a a^T q' = a tau,   a = (1, psi_i'(0)).
///
/// All bases are orthonormal in strain energy, K = diag(0, 1, ..., 1), and all integrals are closed
/// forms: nothing is left to quadrature. Ritz values of poles and hub zeros converge from above.
///
/// Real zeros of the tip are exponentially ill-conditioned in coordinates that span the link, since
/// the motion at a zero dies out from one end of it to the other: each keeps some 1.5 digits fewer
/// than the one before, about 1e-13 the fourth, 1e-10 the sixth, 1e-4 the tenth. The summary's
/// residual shows it.
///
/// Meirovitch, Analytical Methods in Vibrations (1967), ch. 6.
class AssumedModesArm {
 public:
  using Options = AssumedModesOptions;
  static constexpr std::string_view kName = "assumed_modes";

  /// Throws InputError for an invalid arm, any effect, or options out of their range.
  explicit AssumedModesArm(arm::Arm arm, Options options = {});

  const arm::Arm& arm() const { return arm_; }
  const Options& options() const { return options_; }
  int degrees_of_freedom() const { return options_.functions; }

  /// n - 1 at most, of which the upper third is off by more than a percent.
  arm::PoleSet poles(int count) const;
  /// Hub angle and velocity: Ritz values, all kept. Others: those that `zero_change` trusts.
  arm::ZeroSet zeros(const arm::Sensor& sensor, int count) const;
  std::vector<arm::Mode> modes(int count, std::span<const arm::Sensor> sensors,
                               std::span<const double> stations_m) const;
  /// Of the whole quadratic eigenproblem; conventions in assumed_modes/damped_poles.hpp.
  arm::DampedPoleSet damped_poles(int count) const;
  arm::ModalModel modal_model(int count, std::span<const arm::Sensor> sensors,
                              std::span<const double> stations_m) const;
  std::complex<double> transfer_function(const arm::Sensor& sensor,
                                         std::complex<double> s_rad_per_s) const;

  /// m l^3 M, symmetric positive definite, n by n; the rigid rotation comes first.
  Eigen::MatrixXd mass_matrix_kg_m2() const;
  /// (EI/l) K, n by n.
  Eigen::MatrixXd stiffness_matrix_N_m() const;
  /// Condition number of the mass matrix scaled to a unit diagonal.
  double mass_condition_number() const { return scaled_condition_number(mass_); }

 private:
  arm::ZeroSet hub_zeros(int count) const;
  arm::ZeroSet output_zeros(const arm::Sensor& sensor, int count) const;

  arm::Arm arm_;
  arm::LinearArm linear_;
  Options options_;
  InertiaRatios ratios_;
  AdmissibleFunctions functions_;
  Integrals integrals_;
  MassMatrix mass_;
  RitzPairs modes_;    ///< of the functions freed of rigid-body motion
  Vector hub_slopes_;  ///< psi'(0) of those modes
};

}  // namespace flexarm::assumed_modes
