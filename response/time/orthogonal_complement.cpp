#include "response/time/orthogonal_complement.hpp"

#include <Eigen/Householder>

namespace flexarm::response {

// By the reflection itself: the product of reflections that HouseholderQR makes takes the compiler
// seconds.
Eigen::MatrixXd orthogonal_complement(const Eigen::VectorXd& direction) {
  const Eigen::Index n = direction.size();
  Eigen::VectorXd essential(n - 1);
  double tau = 0.0;
  double length = 0.0;
  direction.makeHouseholder(essential, tau, length);
  Eigen::VectorXd workspace(n);
  Eigen::MatrixXd reflection = Eigen::MatrixXd::Identity(n, n);
  reflection.applyHouseholderOnTheLeft(essential, tau, workspace.data());
  return reflection.rightCols(n - 1);
}

}  // namespace flexarm::response
