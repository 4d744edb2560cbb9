#pragma once

#include "arm/formulation.hpp"
#include "arm/sensor.hpp"
#include "response/arm_parts.hpp"

#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

namespace flexarm::response {

/// A reading y = state X + actuator u + force f of the linear system below.
struct Reading {
  Eigen::RowVectorXd state;  ///< N
  double actuator = 0.0;
  Eigen::RowVectorXd force;  ///< m
};

/// The arm, the lag of its actuator, those of its sensors and the states of laws of hub torque as
/// one linear system with the hub either turning or held,
///
///     X' = A X + actuator u + actuator_rate u' + force f,
///
/// X = (sigma_i q_i; q_i'; Z; W; d; z), N entries: sigma_i = omega_i, or that of the first flexible
/// mode where omega_i is less, makes A nearly antisymmetric; Z is the lagged torque and W the
/// lagged readings, each scaled so that its couplings are no larger than A's other entries; d is a
/// disturbance of the hub torque, scaled as Z, which decays unless a filter moves it. u is the
/// torque behind delay, gain and clipping; f the torques and forces that are added at the arm, a
/// torque on the hub [N m] or n modal forces [1/s^2], and behind them the rates z' of the laws' own
/// states: m entries.
struct LinearSystem {
  Eigen::MatrixXd a;                   ///< N x N [1/s]
  Eigen::VectorXd actuator;            ///< N
  Eigen::VectorXd actuator_rate = {};  ///< N; empty but in with_settled_torque
  Eigen::MatrixXd force;               ///< N x m
  Reading hub_acceleration;            ///< theta''
  std::vector<Reading> sensors;
  std::vector<Eigen::Index> lagged_readings;  ///< rows of W; nothing else depends on W
};

/// A bound on what X but W does: the largest of those row sums of |A|. Lags of sensors, which may
/// be as short as they like, are left out.
double fastest_rate_rad_per_s(const LinearSystem& system);

/// What the two systems of an arm have in common, and how f is formed.
struct ModalDynamics {
  LinearSystem turning;
  /// theta' = 0: M = 1 - b b^T/(b^T b) on the modal accelerations, b the hub slopes, takes out what
  /// the hub's reaction balances.
  LinearSystem held;
  Reading reaction;                  ///< torque of friction that holds the hub, against it [N m]
  Reading hub_torque;                ///< T that reaches the hub, without what is in f
  Eigen::VectorXd hub_force;         ///< f of a unit torque on the hub, m
  Eigen::Index modes = 0;            ///< n
  Eigen::Index first_law_state = 0;  ///< where z begins in X
  Eigen::Index law_state_count = 0;
  std::optional<Eigen::Index> lagged_torque = {};  ///< row of Z
  std::optional<Eigen::Index> disturbance = {};    ///< row of d
  double disturbance_N_m = 0.0;                    ///< torque of a unit of d
  double modal_mass_kg_m2 = 0.0;
  Eigen::VectorXd hub_slope;            ///< n
  Eigen::VectorXd scale_rad_per_s;      ///< sigma, n
  Eigen::VectorXd stiffness;            ///< omega_i^2, n; the first may be below 0
  Eigen::MatrixXd damping;              ///< D, n x n
  double fastest_rate_rad_per_s = 0.0;  ///< of `turning`

  Eigen::Index size() const { return turning.a.rows(); }
  double hub_angle(const Eigen::VectorXd& x) const;
  double hub_velocity(const Eigen::VectorXd& x) const {
    return hub_slope.dot(x.segment(modes, modes));
  }
  auto velocity(const Eigen::VectorXd& x) const { return x.segment(modes, modes); }
  /// z, in the order of HubLaws::smooth.
  auto law_states(const Eigen::VectorXd& x) const {
    return x.segment(first_law_state, law_state_count);
  }
  /// Modal velocities that leave the hub at rest, and nearest to those of `x`.
  void stop_hub(Eigen::VectorXd& x) const;
  /// Modal coordinates with that hub angle, and nearest to those of `x`.
  void set_hub_angle(Eigen::VectorXd& x, double angle_rad) const;
};

/// The arm long after u began to change at a constant rate: what Z was before has decayed, and
/// Z' = u' in Z's units, whatever the lag. Of an arm whose Z is driven by u alone.
ModalDynamics with_settled_torque(const ModalDynamics& arm);

/// Of a hub that is driven (ArmParts::hub_is_driven) u is theta'' [rad/s^2]: the modal
/// accelerations are those of the held hub and b u/(b^T b) beside them, so that theta'' = u to the
/// last bit.
///
/// Throws InputError for a model whose parts do not fit together.
ModalDynamics modal_dynamics(const arm::ModalModel& model, const ArmParts& parts,
                             std::span<const arm::Sensor> sensors);

}  // namespace flexarm::response
