#pragma once

#include "tests/trials/true_arm.hpp"

#include <span>
#include <vector>

namespace flexarm::trials {

/// The commanded torque on its way to the hub: delay, curves, lag, bias.
class TorqueChain {
 public:
  /// The command holds from sample to sample and is zero before the first. `torque_N_m` must
  /// outlive the object.
  TorqueChain(const TrueArm& arm, std::span<const double> torque_N_m, double sample_time_s);

  /// Goes on from `from_s`, where the last step ended, and returns the mean torque of the step. A
  /// step contains one change of the command at most.
  double advance(double from_s, double step_s);
  /// The torque just after `time_s`, to which `advance` has come.
  double now(double time_s) const;

 private:
  double clipped_command(double time_s) const;
  double mean_command(double from_s, double step_s) const;

  std::span<const double> torque_N_m_;
  double sample_time_s_;
  double delay_s_;
  std::vector<TrueArm::TorqueCurve> curves_;
  double lag_s_;
  double bias_N_m_;
  double lagged_N_m_ = 0.0;
};

}  // namespace flexarm::trials
