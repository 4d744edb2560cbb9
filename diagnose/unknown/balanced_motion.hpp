#pragma once

#include "diagnose/search/problem.hpp"
#include "diagnose/symptoms/symptom.hpp"

#include <vector>

namespace flexarm::diagnose {

/// What a torque balance makes of runs, sample by sample, run after run.
struct BalancedMotion {
  std::vector<double> disturbance_N_m;     ///< the residual hub torque
  std::vector<double> velocity_rad_per_s;  ///< of the hub, as the filter has it
  std::vector<double> angle_rad;           ///< as measured, not a number where that is missing;
                                           ///< empty where a run has no hub angle
};

/// Of those `time` runs of a problem with a noise model. Throws InputError for an arm that cannot
/// be filtered.
BalancedMotion balanced_motion(const Problem& balance, const arm::Arm& arm,
                               const std::vector<bool>& runs);

/// Part of the mean square of the disturbance that its means over intervals of `values` with as
/// many samples make, 0 to 1, with the constant part; and the probability that chance makes as
/// much, by an F test with the effective sample size.
struct Dependence {
  double share = 0.0;
  double probability = 1.0;
};
Dependence dependence_on(const std::vector<double>& values,
                         const std::vector<double>& disturbance_N_m);
inline constexpr int kIntervals = 20;

/// How large the residual hub torque of the arm file is, and what it depends on.
Symptom balance_symptom(const Problem& balance);

}  // namespace flexarm::diagnose
