#pragma once

#include <Eigen/Core>

namespace flexarm::measured {

/// sqrt(g C g^T), the standard error to first order of a quantity with gradient g (1 x n) to
/// parameters of covariance C (n x n). Infinite where rounding of the sum, up to
/// n epsilon |g| |C| |g|^T, is as large as the sum itself: parameters that are all but dependent
/// then say nothing of it.
double propagated_error(const Eigen::RowVectorXd& gradient, const Eigen::MatrixXd& covariance);

}  // namespace flexarm::measured
