#pragma once

#include <Eigen/Core>

namespace flexarm::measured {

/// A coefficient of a linear regression.
struct Coefficient {
  double value = 0.0;
  double error = 0.0;  ///< standard error, from the residual
};

/// The coefficient of a column where `target` is the sum of all columns, each with its own, by
/// least squares. Columns have their own units, and one may be zero: its coefficient is 0.
Coefficient coefficient_of(Eigen::Index column, Eigen::MatrixXd columns,
                           const Eigen::VectorXd& target);

}  // namespace flexarm::measured
