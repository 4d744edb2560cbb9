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

/// An arm whose hub turns one way, or has no friction, over a block of samples at once: the lifted
/// system [Bamieh1991]. With X at the beginning of the block, the torques of its samples
/// (TorquePath::whole_parts, one sample after the other) and c = (1; direction(motion)), X at its
/// end and the readings in it are sums of three products. The state is formed once a block, not at
/// each sample.
struct LiftedBlock {
  Eigen::MatrixXd end_by_state;
  Eigen::MatrixXd end_by_torques;
  Eigen::MatrixXd end_by_constants;
  /// Of all samples of the first sensor, then of the next one; behind the sensors the velocity of
  /// the hub where the arm has friction. Of a sample is what is read in its interval.
  Eigen::MatrixXd readings_by_state;
  Eigen::MatrixXd readings_by_torques;
  Eigen::MatrixXd readings_by_constants;
};

/// LinearSystem's f of an arm whose forces are constant for each motion, by c: m rows, 2 columns.
Eigen::MatrixXd constant_forces(const AddedForces& forces);

/// `plan` is of an arm whose forces are constant for each motion, with no ledger; `path` and
/// `times` are those of any run of it; `samples` is a power of 2.
LiftedBlock lifted_block(const StepPlan& plan, const ArmParts& parts,
                         std::span<const arm::Sensor> sensors, const TorquePath& path,
                         const ReadingTimes& times, Eigen::Index samples);

/// Writes what a sensor reads in the sample intervals from `first` on, which may be before 0, to
/// its column of `made`, a row a sample: `samples_later` as ReadingTimes has it.
void put_readings(const Eigen::Ref<const Eigen::VectorXd>& of_intervals, std::ptrdiff_t first,
                  std::ptrdiff_t samples_later, Eigen::Ref<Eigen::VectorXd> made);

}  // namespace flexarm::response
