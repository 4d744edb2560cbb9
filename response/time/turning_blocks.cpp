#include "response/time/turning_blocks.hpp"

#include <algorithm>
#include <cmath>

namespace flexarm::response {

using Eigen::Index;

bool TurningBlocks::are_possible(const StepPlan& plan, const TorquePath& path) {
  if (plan.is_linear() || plan.forces().vary()) return false;
  if (path.torques_of_part() > 1 || path.edges().size() > 2) return false;
  const PieceSteps& steps = plan.regular(0);
  return steps.unsettled_part == 1.0 && steps.unsettled.count == 1;
}

TurningBlocks::TurningBlocks(const StepPlan& plan, const IntervalMap& interval,
                             const ReadingTimes& times)
    : times_(times),
      block_(lifted_block(interval, kSamples)),
      plan_(&plan),
      forces_(constant_forces(plan.forces())) {}

bool TurningBlocks::Run::surely_turns(double direction, const Eigen::VectorXd& x) {
  const StepPlan& plan = *blocks_.plan_;
  const ReadingBound& speed = plan.regular(0).unsettled.turning.watched;
  const auto [in_first, per_torque, growth] =
      speed.departure(x, inputs_(0), blocks_.forces_ * Eigen::Vector2d(1.0, direction), workspace_);
  const auto speeds = readings_.tail(kSamples);
  double departure = in_first;
  double larger = 1.0;
  for (Index i = 0; i < kSamples; ++i) {
    const double next = i + 1 < kSamples ? speeds(i + 1) : plan.velocity_row().dot(end_);
    // Not so for a bound that is not a number.
    if (!(std::min(direction * speeds(i), direction * next) > larger * departure)) return false;
    if (i + 1 < kSamples) departure += per_torque * std::abs(inputs_(i + 1) - inputs_(i));
    larger *= growth;
  }
  return true;
}

bool TurningBlocks::Run::go(const Eigen::MatrixXd& torques, std::ptrdiff_t first, std::ptrdiff_t k,
                            double direction, Eigen::VectorXd& x, Eigen::MatrixXd& made) {
  const LiftedBlock& block = blocks_.block_;
  const Eigen::Vector2d constants(1.0, direction);
  inputs_ = torques.row(0).segment(k - first, kSamples).transpose();
  end_.noalias() = block.end_by_constants * constants;
  end_.noalias() += block.end_by_state * x;
  end_.noalias() += block.end_by_inputs * inputs_;
  readings_.noalias() = block.readings_by_constants * constants;
  readings_.noalias() += block.readings_by_state * x;
  readings_.noalias() += block.readings_by_inputs * inputs_;
  if (!surely_turns(direction, x) || !readings_.allFinite()) return false;
  for (Index j = 0; j < made.cols(); ++j) {
    put_readings(readings_.segment(j * kSamples, kSamples), k,
                 blocks_.times_.sensors[static_cast<std::size_t>(j)].samples_later, made.col(j));
  }
  x = end_;
  return true;
}

}  // namespace flexarm::response
