#pragma once

#include "arm/formulation.hpp"
#include "arm/linear_arm.hpp"
#include "assumed_modes/admissible_functions.hpp"
#include "assumed_modes/basis.hpp"
#include "assumed_modes/ritz.hpp"
#include "assumed_modes/scaled_arm.hpp"
#include "assumed_modes/symmetric_pencil.hpp"
#include "assumed_modes/undamped_modes.hpp"

#include <Eigen/Core>

#include <complex>
#include <span>
#include <string_view>
#include <vector>

namespace flexarm::assumed_modes {

struct AssumedModesOptions {
  Basis basis = Basis::legendre;

  /// Generalised coordinates n of a beam that is whole and bends only, the rigid rotation included;
  /// 2 <= n <= kMaximumFunctions. Effects add their own with `legendre`: a soft drive or root, a
  /// crack and a suspended mass one, crack and masses up to 15 for each further piece of the beam,
  /// and shear as many as bending has (StrainFunctions). With Legendre functions 36 give ten poles
  /// and ten hub zeros to rounding, and ten tip zeros to 1e-12, for payloads of up to 10 m l and
  /// 0.1 m l^3 and hubs of up to 100 m l^3. Models of 28 or more are given further ones for high
  /// zeros of a sensor away from the hub (assumed_modes/output_zeros.hpp).
  int functions = 36;

  /// A zero s of a sensor away from the hub is trusted when the nearest zeros s' with 2 and
  /// with 4 more functions in every family both have |s - s'| <= zero_change |s|. At 1e-3 no false
  /// zero of the tip passes for any basis and n up to 60; at 1e-2 an eighth of those that pass is
  /// false with Legendre functions, and more with the others.
  double zero_change = 1e-3;
};

/// Cost grows as n^3: at this n the construction takes 0.3 s and the zeros of a sensor 1 s.
inline constexpr int kMaximumFunctions = 200;

/// The arm by Lagrange's equations on admissible functions (assumed modes, Rayleigh-Ritz):
///
///     y(x, t) = q_0 (a + x) + l sum q_i y_i(x/l),   psi(x, t) = q_0 + sum q_i psi_i(x/l),
///
/// with q in radians and psi_i = y_i' on a beam without shear. From the energies of
/// arm/linear_arm.hpp, torque tau on the hub gives
///
///     m l^3 M q'' + C q' + (EI/l) K q = h tau,   theta_m = h . q.
///
/// Every linear effect is honoured. `legendre` turns in a soft drive, bends at a crack and at a
/// soft root and shears, by functions made for each (StrainFunctions), which may also break at
/// masses on the beam: Ritz values of poles and hub zeros converge from above and faster than any
/// power of n whatever the effects. The other bases refuse springs in the beam, masses on it and
/// shear_and_rotary_inertia by the effect's name. All bases are orthonormal in strain energy,
/// springs and shear included: K is diag(0, 1, ..., 1), to which a hub spring adds rank one and
/// gravity a full matrix. All integrals are closed forms but gravity's on beam shapes, which is
/// quadrature to rounding.
///
/// An arm that stands up (gravity below 0) has a lowest mode that falls, omega^2 < 0; it is refused
/// when another does, which means that its flexible modes buckle. Its hub zeros may be real.
///
/// Real zeros of the tip are exponentially ill-conditioned in coordinates that span the link, since
/// the motion at a zero dies out from one end of it to the other. They are computed in functions
/// that decay likewise (assumed_modes/output_zeros.hpp).
///
/// [Meirovitch1967], ch. 6.
class AssumedModesArm {
 public:
  using Options = AssumedModesOptions;
  static constexpr std::string_view kName = "assumed_modes";

  /// Throws InputError for an invalid arm, an effect that is not linear or that the basis cannot
  /// represent, an arm that buckles, or options out of their range.
  explicit AssumedModesArm(arm::Arm arm, Options options = {});

  const arm::Arm& arm() const { return arm_; }
  const Options& options() const { return options_; }
  int degrees_of_freedom() const { return static_cast<int>(modes_.mass.size()); }

  /// All but the lowest at most, of which the upper third is off by more than a percent.
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

  /// m l^3 M, symmetric positive definite; the rigid rotation comes first.
  Eigen::MatrixXd mass_matrix_kg_m2() const;
  /// (EI/l) K, symmetric.
  Eigen::MatrixXd stiffness_matrix_N_m() const;
  /// C, symmetric positive semidefinite.
  Eigen::MatrixXd damping_matrix_N_m_s() const;
  /// Condition number of the mass matrix scaled to a unit diagonal.
  double mass_condition_number() const { return scaled_condition_number(pencil_.mass()); }

 private:
  arm::ZeroSet hub_zeros(int count) const;
  arm::SolveSummary summary_of(const RitzPairs& pairs) const;
  Real torsion_N_m() const;

  arm::Arm arm_;
  arm::LinearArm linear_;
  Options options_;
  ScaledArm scaled_;
  AdmissibleFunctions functions_;
  SymmetricPencil pencil_;
  RitzPairs modes_;
  ModalDamping damping_;
};

}  // namespace flexarm::assumed_modes
