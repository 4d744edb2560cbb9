#pragma once

#include "arm/linear_arm.hpp"
#include "fem/hermite_element.hpp"
#include "fem/mesh.hpp"

#include <Eigen/SparseCore>

#include <string>
#include <vector>

namespace flexarm::fem {

template <class Scalar>
using Columns = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

/// The arm divided into finite elements, dimensionless: lengths in l, times in sqrt(m l^4/EI),
/// forces in EI/l^2. With n generalised coordinates u,
///
///     M u_tt + K u = e0 tau,   K = B^T D B,
///
/// where u(0) is the hub rotation theta; then for each element from root to tip its bubbles, and
/// deflection and slope at its outer end. The root does not move (y(0) = 0). Payload and hub
/// stand in M. Suffix `c` (clamped) means the n - 1 coordinates without theta.
///
/// B takes the clamped coordinates to the natural deformations of the elements (see
/// HermiteElement), in the order bubbles, d1, d0. The arm is statically determinate, so B is
/// square and block lower triangular. D is diagonal. Solvers use B and D, never K: an assembled
/// K gives a rigid rotation, rounded, strain energy of the order h^-4 times epsilon.
class Discretisation {
 public:
  /// Throws arm::InputError for options out of their range.
  Discretisation(const arm::LinearArm& arm, const MeshOptions& mesh, int degree);

  int size() const { return static_cast<int>(mass_.rows()); }
  int clamped_size() const { return size() - 1; }
  int elements() const { return static_cast<int>(lengths_.size()); }
  int coordinates_per_element() const { return element_.degree() - 1; }
  const HermiteElement& element() const { return element_; }
  const std::vector<double>& lengths() const { return lengths_; }
  int tip_deflection_index() const { return size() - 2; }

  /// n x n, symmetric positive definite.
  const Eigen::SparseMatrix<double>& mass() const { return mass_; }
  /// n x n, symmetric, of rank n - 1.
  Eigen::SparseMatrix<double> stiffness() const;
  /// B, (n - 1) x (n - 1).
  Eigen::SparseMatrix<double> kinematics() const;
  /// The diagonal of D, n - 1.
  Eigen::VectorXd natural_stiffness() const;

  /// r: unit rotation of the rigid arm, y = x.
  const Eigen::VectorXd& rigid_rotation() const { return rigid_rotation_; }
  /// M r.
  const Eigen::VectorXd& rigid_momentum() const { return rigid_momentum_; }
  /// r^T M r: 1/3 + hub inertia + payload.
  double total_inertia() const { return total_inertia_; }

  /// In units of m l and m l^3.
  double payload_mass() const { return payload_mass_; }
  double payload_inertia() const { return payload_inertia_; }

  /// K r = 0.
  bool turns_freely() const { return true; }
  /// C = kv K, kv = 0 included.
  bool is_damped_in_proportion() const { return hub_friction_ == 0.0; }
  /// Kelvin-Voigt time, and friction of the hub as (2 R)/theta_t^2.
  double kelvin_voigt() const { return kelvin_voigt_; }
  double hub_friction() const { return hub_friction_; }
  /// u^T K u and u^T C u (without conjugation) for shapes and their natural deformations by
  /// columns, summed in deformations.
  template <class Scalar>
  Columns<Scalar> stiffness_products(const Columns<Scalar>& u, const Columns<Scalar>& d) const;
  template <class Scalar>
  Columns<Scalar> damping_products(const Columns<Scalar>& u, const Columns<Scalar>& d) const;

  /// M k for the influence shape k(x) = max(x - position, 0), position in [0, 1].
  Eigen::VectorXd ramp_momentum(double position) const;
  /// k(x) = x^2 (3 - x)/6, the clamped arm under a unit force at the tip.
  Eigen::VectorXd tip_force_shape() const;

  /// Deflection y(x) of the shape `u`, x in [0, 1].
  double deflection(const Eigen::VectorXd& u, double x) const;

 private:
  /// The coordinate of a local shape function of element `e`; -1 for the root's deflection.
  int index(int e, int local) const;
  /// Adds the n x n sum of the elements' matrices, each `element_matrix(h)`.
  template <class ElementMatrix>
  Eigen::SparseMatrix<double> assemble(const ElementMatrix& element_matrix) const;

  HermiteElement element_;
  std::vector<double> lengths_;
  std::vector<double> nodes_;
  double payload_mass_;
  double payload_inertia_;
  double kelvin_voigt_;
  double hub_friction_;
  Eigen::SparseMatrix<double> mass_;
  Eigen::VectorXd rigid_rotation_;
  Eigen::VectorXd rigid_momentum_;
  double total_inertia_;
};

/// "200 elements of degree 3, payload mass 1.5 m l, payload inertia 0 m l^3", for errors.
std::string describe(const Discretisation& discretisation);

}  // namespace flexarm::fem
