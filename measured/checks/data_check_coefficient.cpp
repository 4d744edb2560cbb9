#include "measured/checks/data_check_coefficient.hpp"

#include <Eigen/Cholesky>

#include <cmath>

namespace flexarm::measured {

Coefficient coefficient_of(Eigen::Index column, Eigen::MatrixXd columns,
                           const Eigen::VectorXd& target) {
  // Keeps the normal equations of columns of unit length solvable; far below any noise.
  constexpr double kRidge = 1e-12;
  Eigen::VectorXd scale = columns.colwise().norm().transpose();
  scale = scale.array().max(1e-300);
  columns = columns * scale.cwiseInverse().asDiagonal();
  Eigen::MatrixXd normal = columns.transpose() * columns;
  normal.diagonal().array() += kRidge;
  const Eigen::LDLT<Eigen::MatrixXd> factors(normal);
  const Eigen::VectorXd solution = factors.solve(columns.transpose() * target);
  const double variance = (target - columns * solution).squaredNorm() /
                          static_cast<double>(target.size() - columns.cols());
  const double inverse = factors.solve(Eigen::VectorXd::Unit(columns.cols(), column))[column];
  return {solution[column] / scale[column], std::sqrt(variance * inverse) / scale[column]};
}

}  // namespace flexarm::measured
