#pragma once

#include "arm/linear_arm.hpp"
#include "fem/beam_element.hpp"
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
///     M u_tt + C u_t + K u = e0 tau,   K = B^T D B + ks e0 e0^T + G,
///     C = B^T D_c B + c e0 e0^T + ca A.
///
/// u(0) is the rotation on which the torque acts, that of the rotor; where the drive is compliant
/// the hub rotation theta follows, and where the root is that of the beam's root. Where the drive
/// is rigid theta is u(0). Then for each element from root to tip its bubbles, its shear strains
/// where the beam has any, and deflection and rotation at its outer end. After the element that
/// ends at a suspended mass or at the crack follow the mass's displacement z and the rotation
/// beyond the crack. The root is carried by the hub, y(0) = a theta. Payload, hub and masses on the
/// beam stand in M. Suffix `c` (clamped) means the n - 1 coordinates without u(0).
///
/// B takes the coordinates to n - 1 natural deformations: those of the elements (see BeamElement),
/// the rotations of the springs at drive, root and crack, and the extensions z - y of suspensions.
/// Deformation i stands for coordinate i + 1: bubbles and shear strains are their own, d1 stands
/// for the outer deflection, d0 for the outer rotation, a spring for the rotation beyond it, an
/// extension for z. The arm is statically determinate, so B of the clamped coordinates is square
/// and block lower triangular. D and D_c are diagonal: bending is damped by kv D, drive, root and
/// suspensions by what they have. Solvers use B and D, never their product: assembled, it gives a
/// rigid rotation, rounded, strain energy of the order h^-4 times epsilon.
///
/// G is the potential of the weight, A the beam's translational mass. Where mass and crack are at
/// one place, the mass is beyond the crack.
class Discretisation {
 public:
  /// Throws arm::InputError for options out of their range.
  Discretisation(const arm::LinearArm& arm, const MeshOptions& mesh, int degree);

  const arm::LinearArm& arm() const { return arm_; }
  int size() const { return static_cast<int>(mass_.rows()); }
  int clamped_size() const { return size() - 1; }
  /// The coordinate that is theta: 1 where the drive is compliant, else 0.
  int hub_index() const { return arm_.drive ? 1 : 0; }
  int elements() const { return static_cast<int>(lengths_.size()); }
  const BeamElement& element() const { return element_; }
  const std::vector<double>& lengths() const { return lengths_; }
  int tip_deflection_index() const { return place(elements() - 1, 2).index; }
  int tip_rotation_index() const { return place(elements() - 1, 3).index; }
  /// Bubbles, shear strains, deflection and rotation of one element.
  int coordinates_per_element() const { return element_.shape_functions() - 2; }
  /// The first of them.
  int first_coordinate(int e) const { return first_[static_cast<std::size_t>(e)]; }

  /// n x n, symmetric positive definite.
  const Eigen::SparseMatrix<double>& mass() const { return mass_; }
  /// A, n x n; empty (all zero) without air damping.
  const Eigen::SparseMatrix<double>& air_mass() const { return air_mass_; }
  /// G, n x n; empty (all zero) without gravity.
  const Eigen::SparseMatrix<double>& weight() const { return weight_; }
  /// K and C, n x n, symmetric, assembled.
  Eigen::SparseMatrix<double> stiffness() const;
  Eigen::SparseMatrix<double> damping() const;
  /// B, (n - 1) x n.
  const Eigen::SparseMatrix<double>& kinematics() const { return kinematics_; }
  /// The diagonals of D and D_c, n - 1.
  const Eigen::VectorXd& natural_stiffness() const { return natural_stiffness_; }
  const Eigen::VectorXd& natural_damping() const { return natural_damping_; }
  /// Deformation i is a coordinate of its own.
  bool is_coordinate(int i) const { return is_coordinate_[static_cast<std::size_t>(i)]; }

  /// The rotations of the springs at drive, root and crack among the natural deformations.
  const std::vector<int>& spring_rotations() const { return spring_rotations_; }
  /// A mass on the beam.
  struct Carried {
    double position;
    double mass;
    double stiffness;  ///< of its suspension; 0 where it is fixed
    double damping;
    int node;               ///< elements between it and the root
    int displacement = -1;  ///< the coordinate z; -1 where it is fixed
  };
  const std::vector<Carried>& carried() const { return carried_; }

  /// r: unit rotation of the rigid arm, y = a + x.
  const Eigen::VectorXd& rigid_rotation() const { return rigid_rotation_; }
  /// M r.
  const Eigen::VectorXd& rigid_momentum() const { return rigid_momentum_; }
  /// r^T M r.
  double total_inertia() const { return total_inertia_; }

  /// K r = 0.
  bool turns_freely() const { return !has_weight() && hub_spring_ == 0.0; }
  bool has_weight() const { return gravity_ != 0.0; }
  /// C = kv K, kv = 0 included.
  bool is_damped_in_proportion() const;
  /// In units of m l, m l^2, m l^3.
  double payload_mass() const { return payload_mass_; }
  double payload_first_moment() const { return payload_first_moment_; }
  double payload_inertia() const { return payload_inertia_; }
  double hub_radius() const { return hub_radius_; }
  /// kv, c, ca, ks.
  double kelvin_voigt() const { return kelvin_voigt_; }
  /// tr.
  double root_retardation() const { return root_retardation_; }
  double hub_friction() const { return hub_friction_; }
  double air_damping() const { return air_damping_; }
  double hub_spring() const { return hub_spring_; }

  /// u^T K u and u^T C u (without conjugation) for shapes and their natural deformations by
  /// columns, summed in deformations.
  template <class Scalar>
  Columns<Scalar> stiffness_products(const Columns<Scalar>& u, const Columns<Scalar>& d) const;
  template <class Scalar>
  Columns<Scalar> damping_products(const Columns<Scalar>& u, const Columns<Scalar>& d) const;

  /// What the loads of a motion do on an influence shape k, by coordinates of the motion: M k, A k
  /// and G k; the last two empty where those matrices are.
  struct VirtualWork {
    Eigen::VectorXd inertia;
    Eigen::VectorXd air;
    Eigen::VectorXd weight;
  };
  /// k(x) = max(x - position, 0) with psi = 1 beyond `position` in [0, 1], bending nowhere else.
  VirtualWork work_on_ramp(double position) const;
  /// k = the clamped arm under a unit force at the tip: what its bending does, its root's spring,
  /// and the rest, shear and crack.
  VirtualWork work_on_tip_bending() const;
  VirtualWork work_on_tip_root() const;
  VirtualWork work_on_tip_shear_and_crack() const;

  /// Deflection y(x) of the shape `u`, x in [0, 1].
  double deflection(const Eigen::VectorXd& u, double x) const;

 private:
  /// Where a local shape function enters: `factor` times coordinate `index`.
  struct Place {
    int index;  ///< -1: nowhere
    double factor;
  };
  Place place(int e, int local) const;
  /// Deflection and rotation of the cross-section that a mass is fixed to.
  Place deflection_place(const Carried& mass) const;
  Place rotation_place(const Carried& mass) const;
  void place_nodes(const MeshOptions& options);
  void place_coordinates();
  void place_masses();
  void place_weight();
  void place_rigid_rotation();
  void place_natural_deformations();
  void place_kinematics();
  /// The n x n sum of the elements' matrices, each `element_matrix(e)`.
  template <class ElementMatrix>
  Eigen::SparseMatrix<double> assemble(const ElementMatrix& element_matrix) const;
  /// Tension in element e: P in its middle, and its rise over half of it.
  double tension(int e) const;
  VirtualWork work_on(const Eigen::VectorXd& shape) const;
  /// Suspended masses go with the beam: no force is on them.
  void place_suspended(Eigen::VectorXd& shape) const;

  arm::LinearArm arm_;
  BeamElement element_;
  std::vector<double> lengths_;
  std::vector<double> nodes_;
  int before_crack_ = -1;  ///< elements between root and crack; -1 without a crack
  std::vector<Carried> carried_;
  std::vector<int> first_;  ///< the first coordinate of each element
  std::vector<int> spring_rotations_;
  double payload_mass_;
  double payload_first_moment_;
  double payload_inertia_;
  double hub_radius_;
  double kelvin_voigt_;
  double root_retardation_;
  double hub_friction_;
  double air_damping_;
  double hub_spring_;
  double gravity_;
  double shear_rigidity_;
  double rotary_inertia_;
  Eigen::VectorXd natural_stiffness_;
  Eigen::VectorXd natural_damping_;
  std::vector<bool> is_coordinate_;
  Eigen::SparseMatrix<double> kinematics_;
  Eigen::SparseMatrix<double> mass_;
  Eigen::SparseMatrix<double> air_mass_;
  Eigen::SparseMatrix<double> weight_;
  Eigen::VectorXd rigid_rotation_;
  Eigen::VectorXd rigid_momentum_;
  double total_inertia_ = 0.0;
};

/// "200 elements of degree 3, payload mass 1.5 m l, payload inertia 0 m l^3", for errors.
std::string describe(const Discretisation& discretisation);

}  // namespace flexarm::fem
