#pragma once

#include "measured/spectra/spectra.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace flexarm::measured {

/// Mean spectra of segments between all signals: at each line the Hermitian matrix
/// S_ab = mean of conj(A) B, one-sided [units/Hz]. Signals, period and plan as `cross_spectra` has
/// them.
///
/// Throws InputError as `cross_spectra` does.
std::vector<Eigen::MatrixXcd> joint_spectra(std::span<const Signal> signals, double period_s,
                                            const SegmentPlan& plan);

/// Correlation of the errors e_i = y_i - g_i x of several responses at one line,
/// E[conj(e_i) e_j]/sqrt(E|e_i|^2 E|e_j|^2); 0 beside an error that is 0. `joint`: of x (index 0)
/// and the outputs y_i (1 + i), their spectra or the covariance of their noise. `g`: one an output.
Eigen::MatrixXcd error_correlation(const Eigen::MatrixXcd& joint, const Eigen::VectorXcd& g);

}  // namespace flexarm::measured
