#pragma once

#include "response/time/added_forces.hpp"
#include "response/time/energy_ledger.hpp"
#include "response/time/modal_dynamics.hpp"
#include "response/time/simulation.hpp"
#include "response/time/step_table.hpp"
#include "response/time/torque_path.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace flexarm::response {

/// Steps of one length with their tables.
struct Steps {
  int count = 0;  ///< in the piece of torque that they make up
  double length_s = 0.0;
  StepTable turning = {};
  StepTable held = {};
  /// Where energy is booked and forces are constant; that of a held hub where there is friction.
  std::optional<StepEnergy> turning_energy = {};
  std::optional<StepEnergy> held_energy = {};
  /// Two steps of half the length, for a step in which the hub may come to rest or turn loose, or
  /// whose forces do not converge; null where the step is short enough for a power series.
  std::shared_ptr<const Steps> shorter = {};
};

/// Steps of a piece of torque that changes at a constant rate.
struct PieceSteps {
  double unsettled_part = 1.0;  ///< of its length: before the lagged torque Z has settled
  Steps unsettled = {};
  std::optional<Steps> settled = {};  ///< the rest, with_settled_torque
};

/// How an arm is stepped through the samples of a torque: what does not depend on the torque, and
/// is computed once for any number of runs.
///
/// A step of constant forces is exact however long it is, its energy too. It is as long as the
/// piece of torque, and the hub's speed (or the torque that holds it) is watched within it; the few
/// steps in which the hub may come to rest or turn loose are halved until that is seen. Behind a
/// lag that is short in a piece the torque settles first; then the lag no longer limits a step.
class StepPlan {
 public:
  /// `arm`, `forces` and `ledger`, which may be null, must outlive the object. `cuts` as
  /// TorquePath.
  StepPlan(const ModalDynamics& arm, const AddedForces& forces, const Actuator& actuator,
           const SimulationOptions& options, const EnergyLedger* ledger,
           std::span<const double> cuts = {});

  /// For pieces that are the whole of this part of a sample interval (TorquePath::edges).
  const PieceSteps& regular(std::size_t part) const { return regular_[part]; }
  Steps steps(double length_s) const { return steps(*arm_, length_s); }
  /// Inner steps of that length of `arm`, which is arm() or settled(). Throws InputError by the
  /// name of an effect that would need more than kMostSubsteps.
  int substeps(const ModalDynamics& arm, double length_s) const;
  /// The part of a piece of this length before Z has settled; 1 where that takes most of it.
  double unsettled_part(double length_s) const;

  const ModalDynamics& arm() const { return *arm_; }
  /// with_settled_torque of arm(); null where that has no lagged torque, or is linear.
  const ModalDynamics* settled() const { return settled_ ? &*settled_ : nullptr; }
  const AddedForces& forces() const { return *forces_; }
  const SimulationOptions& options() const { return options_; }
  /// theta' = velocity_row() X.
  const Eigen::RowVectorXd& velocity_row() const { return velocity_row_; }
  /// No friction, and forces that do not vary.
  bool is_linear() const { return is_linear_; }

 private:
  /// What shows that the hub stops or turns loose; null without friction.
  struct WatchedReadings {
    std::shared_ptr<const ReadingModes> speed = {};
    std::shared_ptr<const ReadingModes> reaction = {};
  };

  Steps steps(const ModalDynamics& arm, double length_s) const;
  PieceSteps piece_steps(double length_s) const;
  WatchedReadings watched_readings(const ModalDynamics& arm) const;

  const ModalDynamics* arm_;
  std::optional<ModalDynamics> settled_;
  const AddedForces* forces_;
  SimulationOptions options_;
  const EnergyLedger* ledger_;
  bool is_linear_;
  Eigen::RowVectorXd velocity_row_;
  WatchedReadings watched_;
  WatchedReadings settled_watched_;
  Eigen::MatrixXd argument_rows_;  ///< of AddedForces
  double settling_s_;
  std::vector<PieceSteps> regular_;  ///< one a part of a sample interval
};

/// |A| dt of a step that is solved by power series: with 1 the series has some 20 terms and loses
/// no digit.
inline constexpr double kLargestPhase_rad = 1.0;

/// |A| dt of a step in which every mode is resolved.
inline double phase_rad(const ModalDynamics& arm, double length_s) {
  return arm.fastest_rate_rad_per_s * length_s;
}

}  // namespace flexarm::response
