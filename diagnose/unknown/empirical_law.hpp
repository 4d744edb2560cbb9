#pragma once

#include "arm/hub_torque_table.hpp"
#include "diagnose/search/problem.hpp"
#include "diagnose/unknown/torque_means.hpp"

#include <optional>
#include <vector>

namespace flexarm::diagnose {

/// A law of hub torque that no effect of the library explains, as the data determine it.
struct EmpiricalLaw {
  arm::HubTorqueTable table;                ///< over the velocity of the hub, its angle, or both
  double std_error_N_m = 0.0;               ///< of the torques of the table, the median
  std::vector<double> std_errors_N_m = {};  ///< of each of them
  /// Part of the mean square of the missing torque that it removes, on validation runs
  /// (estimation runs where there are none).
  double share = 0.0;
  /// NRMSE of simulations of the same runs, mean of the channels.
  double error_before = 0.0;
  double error_after = 0.0;
  /// Of the residual hub torque that the table describes, on the same runs.
  std::vector<std::vector<TorqueMean>> means = {};
};

/// The arm with the law.
arm::Arm with_law(const arm::Arm& arm, const EmpiricalLaw& law);

/// Fits tables to the residual hub torque that a `candidate` leaves: over velocity, with dry
/// friction where it jumps at 0, over angle, and over both. The torques are those that make the
/// missing torque of `balance` least (BalancedMotion), so that they pass its filter as the recorded
/// torque does. Of these tables that one is taken that leaves least on validation runs, one over
/// both only where it leaves less than `kMuchLess` of what the others leave.
///
/// Empty where it removes less than `kLeastShare` of the mean square of the missing torque, or
/// brings `simulated` runs no nearer to the data.
std::optional<EmpiricalLaw> empirical_law(const Problem& balance, const Problem& simulated,
                                          const Candidate& candidate);
inline constexpr double kLeastShare = 0.5;
inline constexpr double kMuchLess = 0.7;

}  // namespace flexarm::diagnose
