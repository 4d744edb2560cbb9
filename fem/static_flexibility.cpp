#include "fem/static_flexibility.hpp"

namespace flexarm::fem {

StaticFlexibility::StaticFlexibility(const Discretisation& discretisation)
    : kinematics_(discretisation.kinematics().rightCols(discretisation.clamped_size()),
                  PivotOrder::block_triangular),
      natural_stiffness_(discretisation.natural_stiffness()) {}

Eigen::VectorXd StaticFlexibility::deformations(Eigen::VectorXd f) const {
  kinematics_.solve_transposed(f);
  return f.cwiseQuotient(natural_stiffness_);
}

Eigen::VectorXd StaticFlexibility::displacements(Eigen::VectorXd d) const {
  kinematics_.solve(d);
  return d;
}

}  // namespace flexarm::fem
