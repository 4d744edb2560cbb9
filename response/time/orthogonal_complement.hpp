#pragma once

#include <Eigen/Core>

namespace flexarm::response {

/// n - 1 orthonormal columns orthogonal to `direction`, which has n entries.
Eigen::MatrixXd orthogonal_complement(const Eigen::VectorXd& direction);

}  // namespace flexarm::response
