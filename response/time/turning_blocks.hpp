#pragma once

#include "response/time/lifted_block.hpp"
#include "response/time/reading_bound.hpp"

#include <Eigen/Core>

#include <cstddef>

namespace flexarm::response {

/// Blocks of samples of an arm with constant dry friction, over which the hub surely turns one way:
/// its velocity at the samples, and a bound of what it departs from the chords between them, say
/// so. In a block nothing happens that a TimeStepper would have to locate.
class TurningBlocks {
 public:
  /// A block can be taken: forces are constant for each motion, the torque is constant between
  /// samples, and a sample interval is one step.
  static bool are_possible(const StepPlan& plan, const TorquePath& path);

  /// Of such an arm, whose sensors are read at `times`. `plan` must outlive the object.
  TurningBlocks(const StepPlan& plan, const IntervalMap& interval, const ReadingTimes& times);

  /// One run. `blocks` must outlive the object.
  class Run {
   public:
    explicit Run(const TurningBlocks& blocks) : blocks_(blocks) {}

    /// Goes from sample `k` over one block, the hub turning in `direction`, if it surely does: X
    /// becomes that at the end of the block, and its readings are written to `made`, a row a sample
    /// and a column a sensor. Else nothing changes. `torques` (TorquePath::whole_parts) begin with
    /// that of sample `first`; the block must end before the last of them.
    bool go(const Eigen::MatrixXd& torques, std::ptrdiff_t first, std::ptrdiff_t k,
            double direction, Eigen::VectorXd& x, Eigen::MatrixXd& made);

   private:
    bool surely_turns(double direction, const Eigen::VectorXd& x);

    const TurningBlocks& blocks_;
    Eigen::VectorXd inputs_;
    Eigen::VectorXd end_;
    Eigen::VectorXd readings_;
    ReadingBound::Workspace workspace_;
  };

  /// Under a random torque up to 80 Hz a hub reverses every ten samples of 2 ms: longer blocks are
  /// taken less often, shorter ones form the state more often.
  static constexpr Eigen::Index kSamples = 4;

 private:
  ReadingTimes times_;
  LiftedBlock block_;
  const StepPlan* plan_;
  Eigen::MatrixXd forces_;  ///< f by (1; direction)
};

}  // namespace flexarm::response
