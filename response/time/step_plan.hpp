#pragma once

#include "response/time/added_forces.hpp"
#include "response/time/energy_ledger.hpp"
#include "response/time/modal_dynamics.hpp"
#include "response/time/simulation.hpp"
#include "response/time/step_table.hpp"
#include "response/time/torque_path.hpp"

#include <Eigen/Core>

#include <array>
#include <memory>
#include <optional>

namespace flexarm::response {

/// Steps of one length with their tables.
struct Steps {
  int count = 0;  ///< in the piece of torque that they make up
  double length_s = 0.0;
  StepTable turning = {};
  StepTable held = {};
  std::optional<StepEnergy> energy = {};  ///< of a linear arm whose energy is booked
  /// Two steps of half the length, for a step in which the hub may come to rest or turn loose, or
  /// whose forces do not converge; null where the step is short enough for a power series.
  std::shared_ptr<const Steps> shorter = {};
};

/// How an arm is stepped through the samples of a torque: what does not depend on the torque, and
/// is computed once for any number of runs.
///
/// A step of constant forces is exact however long it is. Without a ledger it is as long as the
/// piece of torque, and the hub's speed (or the torque that holds it) is watched within it; the few
/// steps in which the hub may come to rest or turn loose are halved until that is seen.
class StepPlan {
 public:
  /// `arm`, `forces` and `ledger`, which may be null, must outlive the object.
  StepPlan(const ModalDynamics& arm, const AddedForces& forces, const Actuator& actuator,
           const SimulationOptions& options, const EnergyLedger* ledger);

  /// For pieces of a length that comes again (TorquePiece::Length, but `other`).
  const Steps& regular(TorquePiece::Length length) const {
    return regular_[static_cast<std::size_t>(length)];
  }
  Steps steps(double length_s) const;
  /// Inner steps of a piece of this length. Throws InputError by the name of an effect that would
  /// need more than kMostSubsteps.
  int substeps(double length_s) const;

  const ModalDynamics& arm() const { return *arm_; }
  const AddedForces& forces() const { return *forces_; }
  const SimulationOptions& options() const { return options_; }
  /// theta' = velocity_row() X.
  const Eigen::RowVectorXd& velocity_row() const { return velocity_row_; }
  /// No friction, and forces that do not vary.
  bool is_linear() const { return is_linear_; }
  /// |A| dt of steps in which every mode is resolved.
  double phase_rad(double length_s) const { return arm_->fastest_rate_rad_per_s * length_s; }

 private:
  /// Steps of that length, each watched in so many parts.
  Steps steps_in_parts(int count, double length_s, int parts) const;

  const ModalDynamics* arm_;
  const AddedForces* forces_;
  SimulationOptions options_;
  const EnergyLedger* ledger_;
  bool is_linear_;
  Eigen::RowVectorXd velocity_row_;
  std::array<Steps, 3> regular_;
};

/// |A| dt of a step that is solved by power series: with 1 the series has some 20 terms and loses
/// no digit, and no mode turns by more than 1 rad between two looks at the hub.
inline constexpr double kLargestPhase_rad = 1.0;

}  // namespace flexarm::response
