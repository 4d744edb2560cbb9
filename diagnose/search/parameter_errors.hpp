#pragma once

#include "diagnose/search/explanation.hpp"
#include "diagnose/search/problem.hpp"

#include <vector>

namespace flexarm::diagnose {

/// Standard errors of what a candidate was fitted by: nuisances, then the values of its effects
/// (Candidate::coordinates), each in its own unit. With H = J^T J the variance is the larger of
///
///     H^-1 s^2                        of independent residuals, as many as their correlation
///     leaves, H^-1 (sum_b g_b g_b^T) H^-1     of residuals that go together over stretches b of a
///     run,
///
/// g_b = J_b^T r_b (White 1982; clusters: Liang & Zeger 1986), and beside it the square of what
/// `finer`, the same problem with a finer simulation, would shift: H^-1 J^T (r_finer - r).
std::vector<double> standard_errors(const Problem& problem, const Explanation& explanation,
                                    const Problem& finer);
/// Stretches of a run or channel that stand for independent ones.
inline constexpr int kStretches = 10;

}  // namespace flexarm::diagnose
