#pragma once

#include "arm/sensor.hpp"
#include "tests/trials/beam_element.hpp"
#include "tests/trials/true_arm.hpp"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <complex>
#include <span>
#include <utility>
#include <vector>

namespace flexarm::trials {

/// What a sensor reads of a motion u exp(s t), before time derivatives:
/// (stiffness + s damping + s^2 mass)^T u/(1 + kelvin_voigt s).
struct ReadingRow {
  Eigen::VectorXd stiffness;
  Eigen::VectorXd damping;
  Eigen::VectorXd mass;
  double kelvin_voigt_s = 0.0;

  std::complex<double> of(const Eigen::VectorXcd& u, std::complex<double> s) const;
  /// Of an undamped mode, s^2 = -lambda.
  double of_mode(const Eigen::VectorXd& u, double lambda) const;
};

/// The trials' own model of the linear arm: finite elements of the energies
///
///     2 T = Jr theta_m_t^2 + (Ih - Jr) theta_t^2 + int (m y_t^2 + rho I psi_t^2) dx
///           + Mp (y_t + d psi_t)^2 + Ip psi_t^2 + sum m_p y_t^2 + sum m_k z_t^2
///     2 V = ks theta_m^2 + kg (theta - theta_m)^2 + sum k [psi]^2
///           + int (EI psi'^2 + kGA (y' - psi)^2) dx + sum k_k (y - z)^2
///           + 2 g (heights that masses gain)
///     2 R = c theta_m_t^2 + rg (theta_t - theta_m_t)^2 + sum r [psi_t]^2
///           + int (kv EI psi'_t^2 + ca y_t^2) dx + sum c_k (y_t - z_t)^2
///
/// with y(0) = radius theta; theta_m of the rotor, which is theta without a gear; payload terms at
/// the tip, d its centre's distance beyond; [psi] the jump of rotation at a spring, at the root
/// from the hub's; m_p point masses fixed to the beam; z displacements of attached masses. A piece
/// of beam that turns by y' lifts all that hangs beyond by y'^2/2 per length, the hub's arm by
/// radius theta^2/2, the payload's by d psi^2/2. An attached mass is a distance z - y beside the
/// beam, perpendicular to it: lifted by (z - y) psi more.
class ElementModel {
 public:
  /// `elements` of equal length; a spring or a strain sensor within the beam divides one, so that
  /// no element grows.
  ElementModel(const TrueArm& arm, int elements, std::span<const arm::Sensor> sensors = {});

  Eigen::Index size() const { return mass_.rows(); }
  const Eigen::SparseMatrix<double>& mass() const { return mass_; }
  const Eigen::SparseMatrix<double>& stiffness() const { return stiffness_; }
  const Eigen::SparseMatrix<double>& damping() const { return damping_; }
  /// theta_m, on which the motor acts and which the hub's sensors read, is the first coordinate.
  static constexpr Eigen::Index kHub = 0;
  /// Neither spring nor weight holds the hub.
  bool turns_freely() const;
  /// Of the rigid arm about its axis.
  double total_inertia_kg_m2() const;
  /// 2 V of u by the squares of deformations. u^T K u of an arm that hardly bends drowns in
  /// rounding of the stiffness of its shortest waves, epsilon h^-4.
  double twice_potential(const Eigen::VectorXd& u) const;
  /// y(x) = row^T u.
  Eigen::VectorXd deflection_row(double position_m) const;
  /// psi(x) = row^T u, where it jumps that on the side of the tip.
  Eigen::VectorXd rotation_row(double position_m) const;
  /// Strain by the moment that equilibrium of the element beyond its place asks for: nodal moments
  /// are as exact as deflections, where the shapes' curvature is two orders less so.
  const ReadingRow& reading(std::size_t sensor) const { return readings_[sensor]; }

 private:
  using Terms = std::vector<Eigen::Triplet<double>>;
  /// Coordinates of an element's entries and their factors: y(0) = radius theta.
  using Places = std::vector<std::pair<Eigen::Index, double>>;

  struct Element {
    double from_m = 0.0;
    double length_m = 0.0;
    Places places;
  };
  struct Square {
    Eigen::MatrixXd mass;
    Eigen::MatrixXd stiffness;
    Eigen::MatrixXd damping;
  };

  void lay_out(int elements, std::span<const arm::Sensor> sensors);
  Square square_of(const Element& element) const;
  Eigen::VectorXd spread(const Element& element, const Eigen::VectorXd& local) const;
  ReadingRow make_reading(const arm::Sensor& sensor) const;
  ReadingRow strain_reading(double position_m) const;
  const Element& element_at(double position_m) const;
  ElementShapes shapes_at(const Element& element, double position_m) const;
  /// Just on the hub's side of the place.
  double tension_N(double position_m) const;
  double rigidity_N_m2(double thickness_ratio) const;
  double weight_N(const TrueArm::AttachedMass& mass) const;
  double shear_rigidity_N() const;
  /// Stiffness of hub and tip against turning, by their weight.
  double hub_stiffness_N_m() const;
  double tip_stiffness_N_m() const;

  TrueArm arm_;
  std::vector<Element> elements_;
  /// Differences of coordinates that springs stretch.
  struct Stretch {
    Eigen::Index beyond;
    Eigen::Index before;
    double stiffness_N_m_per_rad;
    double damping_N_m_s_per_rad;
  };
  std::vector<Stretch> stretches_;
  Eigen::Index size_ = 1;
  Eigen::Index load_ = kHub;  // theta
  Eigen::Index tip_deflection_ = 0;
  Eigen::Index tip_rotation_ = 0;
  Eigen::VectorXd rigid_;  // the arm turned by 1
  std::vector<ReadingRow> readings_;
  Eigen::SparseMatrix<double> mass_;
  Eigen::SparseMatrix<double> stiffness_;
  Eigen::SparseMatrix<double> damping_;
};

}  // namespace flexarm::trials
