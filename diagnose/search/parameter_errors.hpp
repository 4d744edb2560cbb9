#pragma once

#include "diagnose/search/explanation.hpp"
#include "diagnose/search/problem.hpp"

#include <Eigen/Core>

#include <vector>

namespace flexarm::diagnose {

/// Returns the standard errors of nuisances and parameters, each in its parameter's own unit; none
/// of a fit that failed. With H = J^T J and g = J^T r of a part of the residuals the variance is
/// the larger of
///
///     H^-1 s^2                         residuals independent, as many as their correlation leaves,
///     H^-1 (sum_b g_b g_b^T) H^-1      residuals that go together over stretches b of a run
///
/// [White1982, LiangZeger1986]. Where the estimates are inconsistent between runs, that is where
/// the same sum over whole runs exceeds it by more than chance does in 5 %, the variance is that
/// sum, widened by Student's t for as few runs: a misfit of one kind of run shifts that run's
/// estimate. Beside it stands the square of what a simulation with `further_modes` modes more, if
/// that is above 0, would shift: H^-1 J^T (r_finer - r). Throws Cancelled after the problem's
/// deadline where that is simulated.
std::vector<double> standard_errors(const Problem& problem, const Explanation& explanation,
                                    int further_modes);
/// Correlation of the estimates of nuisances and parameters, by H^-1 alone; of their logarithms
/// where the values are above 0. Empty for a fit that failed or has nothing to estimate.
Eigen::MatrixXd correlation_of_estimates(const Explanation& explanation);
/// Stretches of a run or channel that stand for independent ones.
inline constexpr int kStretches = 10;

}  // namespace flexarm::diagnose
