#pragma once

#include "response/arm_parts.hpp"
#include "response/time/added_forces.hpp"
#include "response/time/reading_times.hpp"
#include "response/time/step_plan.hpp"
#include "response/time/torque_path.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <span>

namespace flexarm::response {

/// Rows that are linear in X at the beginning of a sample interval, in the inputs of the interval
/// and in c = (1; direction(motion)).
struct AffineRows {
  Eigen::MatrixXd state;
  Eigen::MatrixXd inputs;
  Eigen::MatrixXd constants;  ///< 2 columns
};

/// What a sample interval does.
struct IntervalMap {
  AffineRows end;       ///< X at its end
  AffineRows readings;  ///< what is read in it
};

/// Of an arm whose hub turns one way, or has no friction. The inputs are the torques of the
/// interval (TorquePath::whole_parts); behind the sensors the velocity of the hub is read where the
/// arm has friction. `plan` is of an arm whose forces are constant for each motion, with no ledger;
/// `path` and `times` are those of any run of it.
IntervalMap interval_map(const StepPlan& plan, const ArmParts& parts,
                         std::span<const arm::Sensor> sensors, const TorquePath& path,
                         const ReadingTimes& times);

/// A block of sample intervals at once: the lifted system [Bamieh1991]. With X at the beginning of
/// the block, the inputs of its intervals, one after the other, and c, X at its end and the
/// readings in it are sums of three products. The state is formed once a block, not at each sample.
struct LiftedBlock {
  Eigen::MatrixXd end_by_state;
  Eigen::MatrixXd end_by_inputs;
  Eigen::MatrixXd end_by_constants;
  /// Of all intervals for the first reading, then for the next one.
  Eigen::MatrixXd readings_by_state;
  Eigen::MatrixXd readings_by_inputs;
  Eigen::MatrixXd readings_by_constants;
};

/// `samples` is a power of 2.
LiftedBlock lifted_block(const IntervalMap& interval, Eigen::Index samples);

/// The readings of block after block with c = (1; 0), from the state `initial` on: a row an
/// interval and a column a reading, for `inputs` with a column an interval. `block` is of
/// `samples`.
Eigen::MatrixXd read_in_blocks(const LiftedBlock& block, Eigen::Index samples,
                               const Eigen::MatrixXd& inputs, const Eigen::VectorXd& initial);

/// LinearSystem's f of an arm whose forces are constant for each motion, by c: m rows, 2 columns.
Eigen::MatrixXd constant_forces(const AddedForces& forces);

/// Writes what a sensor reads in the sample intervals from `first` on, which may be before 0, to
/// its column of `made`, a row a sample: `samples_later` as ReadingTimes has it.
void put_readings(const Eigen::Ref<const Eigen::VectorXd>& of_intervals, std::ptrdiff_t first,
                  std::ptrdiff_t samples_later, Eigen::Ref<Eigen::VectorXd> made);

}  // namespace flexarm::response
