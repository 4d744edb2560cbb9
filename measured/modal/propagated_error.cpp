#include "measured/modal/propagated_error.hpp"

#include <cmath>
#include <limits>

namespace flexarm::measured {

double propagated_error(const Eigen::RowVectorXd& gradient, const Eigen::MatrixXd& covariance) {
  const double variance = gradient.dot(gradient * covariance);
  const Eigen::RowVectorXd sizes = gradient.cwiseAbs();
  const double rounding = static_cast<double>(gradient.size()) *
                          std::numeric_limits<double>::epsilon() *
                          sizes.dot(sizes * covariance.cwiseAbs());
  if (rounding == 0.0) return 0.0;
  return variance > rounding ? std::sqrt(variance) : std::numeric_limits<double>::infinity();
}

}  // namespace flexarm::measured
