#include "fem/static_flexibility.hpp"

namespace flexarm::fem {

StaticFlexibility::StaticFlexibility(const Discretisation& discretisation)
    : kinematics_(discretisation.kinematics(), PivotOrder::block_triangular),
      natural_stiffness_(discretisation.natural_stiffness()) {}

Eigen::VectorXd StaticFlexibility::deformations(Eigen::VectorXd f) const {
  kinematics_.solve_transposed(f);
  return f.cwiseQuotient(natural_stiffness_);
}

Eigen::VectorXd StaticFlexibility::displacements(Eigen::VectorXd d) const {
  kinematics_.solve(d);
  return d;
}

double StaticFlexibility::twice_strain_energy(const Eigen::VectorXd& d) const {
  return d.cwiseAbs2().dot(natural_stiffness_);
}

}  // namespace flexarm::fem
