#pragma once

#include "arm/formulation.hpp"
#include "arm/linear_arm.hpp"
#include "fem/mesh.hpp"

#include <Eigen/SparseCore>

#include <complex>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace flexarm::fem {

class Discretisation;

/// An arm by beam finite elements with all its linear effects (arm/linear_arm.hpp).
///
/// Elements are Euler-Bernoulli's with a continuous slope, or Timoshenko's with rotation and shear
/// strain of their own where the arm has effects.shear_and_rotary_inertia (see BeamElement; they do
/// not lock). A crack is a node at which the rotation jumps: the mesh is compressed on either side
/// of it, so that no element grows and there is at most one more; masses on the beam have nodes of
/// their own in the same way. A compliant drive or root, suspensions and a hub spring are further
/// natural deformations, hub radius and payload offset change kinematics and mass, gravity adds the
/// tension's stiffness.
///
/// The error of a frequency or a zero falls as h^(2p-2) with any effect, or exponentially with the
/// degree p, down to some epsilon. It does not rise again on fine meshes: the stiffness is kept
/// factored in the natural deformations of the elements (see discretisation.hpp). Only the weight's
/// stiffness is assembled; with gravity some epsilon times the number of elements remains.
///
/// An arm that stands up is accepted while its lowest mode alone falls. Where it would buckle with
/// the hub held, its first hub zero is real.
///
///     const fem::FemArm model(arm::paper_arm(), {.mesh = {.elements = 4}, .degree = 15});
///     const arm::PoleSet poles = model.poles(10);
class FemArm {
 public:
  static constexpr std::string_view kName = "fem";
  static constexpr int kHighestDegree = 25;
  static constexpr int kMostCheckingDegrees = 4;

  struct Options {
    MeshOptions mesh = {};
    /// Of the shape functions, 3 to 25. Four elements of degree 15 have 57 coordinates and give
    /// ten poles, ten hub zeros and six tip zeros to some 1e-14.
    int degree = 15;
    /// Iterative eigensolvers stop at |residual| <= eigen_tolerance |eigenvalue|.
    double eigen_tolerance = 1e-12;
    /// A zero s of a non-collocated sensor is trusted when the same mesh with `checking_degrees`
    /// more degrees has a zero s' with |s - s'| <= zero_agreement |s'|, and with twice as many
    /// more a zero s'' with |s' - s''| <= max(|s - s'|/10, zero_agreement |s''|/1000).
    double zero_agreement = 1e-2;
    int checking_degrees = 2;  ///< 1 to 4
  };

  /// Throws arm::InputError for an invalid arm, for an effect that is not linear, for an arm that
  /// stands up and of which a flexible mode buckles (effects.gravity.acceleration), and for options
  /// out of range.
  explicit FemArm(arm::Arm arm);
  FemArm(arm::Arm arm, Options options);

  const arm::Arm& arm() const { return arm_; }
  const Options& options() const { return options_; }
  /// n = 1 + elements (degree - 1): the hub rotation and, for each element, its degree - 3
  /// bubbles, and deflection and rotation at its outer end. Shear adds degree - 1 to each element,
  /// a compliant drive 1, a compliant root 1, a crack 1 and the element that it divides, a mass on
  /// the beam that element and 1 where it is suspended.
  int degrees_of_freedom() const;

  /// `count.expected` is by Sylvester inertia where rounding of the assembled stiffness permits.
  arm::PoleSet poles(int count) const;
  /// Roots of the whole quadratic pencil (see damped_poles.hpp), not of its projection.
  arm::DampedPoleSet damped_poles(int count) const;
  /// Collocated: frequencies of the arm with its hub clamped. Others: finite roots of the
  /// Rosenbrock pencil, of which those are rejected that the checking mesh does not confirm; fewer
  /// than `count` are returned when no more can be trusted. With `count` = degrees_of_freedom() all
  /// roots of a small model are sorted into trusted and rejected. With a payload inertia the tip
  /// has an imaginary pair of zeros beside its real ones. `count` of a non-collocated sensor: roots
  /// of the pencil looked at, rejected ones included, beside their number by the argument
  /// principle, -1 where rounding hides it. Should one be missing in spite of further searches,
  /// `summary.converged` is false and the roots beyond the gap are rejected.
  arm::ZeroSet zeros(const arm::Sensor& sensor, int count) const;
  /// Stations in metres along the beam, each from 0 to its length.
  std::vector<arm::Mode> modes(int count, std::span<const arm::Sensor> sensors,
                               std::span<const double> stations_m) const;
  arm::ModalModel modal_model(int count, std::span<const arm::Sensor> sensors,
                              std::span<const double> stations_m) const;
  /// Sparse complex LU along the arm, linear in the number of elements. Rounding grows with the
  /// number of elements, not with the condition of the stiffness: some 1e-15 for the default, 1e-11
  /// at 100,000 elements, times the condition of the response at s. Throws std::domain_error also
  /// for an s whose square is not finite.
  std::complex<double> transfer_function(const arm::Sensor& sensor,
                                         std::complex<double> s_rad_per_s) const;

  /// Consistent mass [kg m^2], stiffness [N m] and damping [N m s] for the coordinates theta_m, the
  /// rotor's rotation [rad]; theta where the drive is compliant; the rotation of the beam's root
  /// where it is; for each element l psi' amplitudes of
  /// the bubbles, amplitudes of the shear strains where the beam has any, y/l and psi at the outer
  /// end; after the element that ends there, displacements over l of suspended masses and the
  /// rotation beyond a crack. n x n, symmetric. For use outside; eigenvalues of the assembled
  /// stiffness carry errors of order epsilon h^-4.
  Eigen::SparseMatrix<double> mass_kg_m2() const;
  Eigen::SparseMatrix<double> stiffness_N_m() const;
  Eigen::SparseMatrix<double> damping_N_m_s() const;

 private:
  arm::ZeroSet clamped_zeros(int count) const;
  arm::ZeroSet transmission_zeros(const arm::Sensor& sensor, int count) const;

  arm::Arm arm_;
  Options options_;
  arm::LinearArm linear_;
  double omega_scale_rad_per_s_;
  std::shared_ptr<const Discretisation> model_;
};

static_assert(arm::Formulation<FemArm>);

}  // namespace flexarm::fem
