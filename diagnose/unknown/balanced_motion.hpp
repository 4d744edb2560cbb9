#pragma once

#include "diagnose/search/problem.hpp"
#include "diagnose/symptoms/symptom.hpp"

#include <vector>

namespace flexarm::diagnose {

/// The torque balance of runs, run after run: means over a few samples each.
struct BalancedMotion {
  std::vector<double> missing_N_m;         ///< the residual hub torque
  std::vector<double> velocity_rad_per_s;  ///< of the hub, as smoothed
  std::vector<double> angle_rad;           ///< likewise

  double mean_square_missing() const;  ///< [N^2 m^2]
};

/// Returns it of these runs of a problem that judges the torque (balanced_at_hub). Throws
/// InputError for an arm that has no balance.
BalancedMotion balanced_motion(const Problem& balance, const arm::Arm& arm,
                               const std::vector<bool>& runs);

/// Part of the mean square of the missing torque that its means over intervals of `values` with as
/// many samples make, 0 to 1, with the constant part; and the probability that chance makes as
/// much, by an F test with the effective sample size.
struct Dependence {
  double share = 0.0;
  double probability = 1.0;
};
Dependence dependence_on(const std::vector<double>& values, const std::vector<double>& missing_N_m);
inline constexpr int kIntervals = 20;

/// How large the residual hub torque of the arm file is, and what it depends on.
Symptom balance_symptom(const Problem& balance);

}  // namespace flexarm::diagnose
