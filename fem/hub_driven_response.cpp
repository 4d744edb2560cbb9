#include "fem/hub_driven_response.hpp"

#include <limits>
#include <vector>

namespace flexarm::fem {

namespace {

using Complex = HubDrivenResponse::Complex;

/// Row and column of clamped coordinate `i` in the mixed system: each element adds its d1 and d0
/// equations (and its shear force and bending moment) before its coordinates.
int mixed_index(const Discretisation& model, int i) {
  return i + 2 * (i / model.coordinates_per_element() + 1);
}

int mixed_size(const Discretisation& model) {
  return model.clamped_size() + 2 * model.elements();
}

/// The kinematic equation of natural deformation `row`, d1 or d0, which follow the bubbles; -1 for
/// a bubble, whose deformation is its own coordinate.
int kinematic_index(const Discretisation& model, int row) {
  const int per_element = model.coordinates_per_element();
  const int local = row % per_element - model.element().bubbles();
  if (local < 0) return -1;
  return row / per_element * (per_element + 2) + local;
}

Eigen::SparseMatrix<Complex> mixed_matrix(const Discretisation& model, Complex stiffness_factor,
                                          Complex s_squared) {
  const Eigen::SparseMatrix<double>& mass = model.mass();
  const Eigen::SparseMatrix<double> b = model.kinematics();
  const Eigen::VectorXd d = model.natural_stiffness();
  std::vector<Eigen::Triplet<Complex>> triplets;
  triplets.reserve(static_cast<std::size_t>(mass.nonZeros() + 2 * b.nonZeros() + d.size()));
  for (int i = 0; i < model.clamped_size(); ++i) {
    const int kinematic = kinematic_index(model, i);
    const int own = mixed_index(model, i);
    if (kinematic < 0) {
      triplets.emplace_back(own, own, stiffness_factor * d[i]);
    } else {
      triplets.emplace_back(kinematic, kinematic, -1.0 / (stiffness_factor * d[i]));
    }
  }
  using Entry = Eigen::SparseMatrix<double>::InnerIterator;
  for (int column = 0; column < b.outerSize(); ++column) {
    for (Entry entry(b, column); entry; ++entry) {
      const int kinematic = kinematic_index(model, static_cast<int>(entry.row()));
      if (kinematic < 0) continue;
      triplets.emplace_back(kinematic, mixed_index(model, column), entry.value());
      triplets.emplace_back(mixed_index(model, column), kinematic, entry.value());
    }
  }
  for (int column = 1; column < mass.outerSize(); ++column) {
    for (Entry entry(mass, column); entry; ++entry) {
      if (entry.row() == 0) continue;
      triplets.emplace_back(mixed_index(model, static_cast<int>(entry.row()) - 1),
                            mixed_index(model, column - 1), s_squared * entry.value());
    }
  }
  Eigen::SparseMatrix<Complex> matrix(mixed_size(model), mixed_size(model));
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return matrix;
}

}  // namespace

HubDrivenResponse::HubDrivenResponse(const Discretisation& discretisation, Complex stiffness_factor,
                                     Complex s_squared)
    : model_(discretisation),
      stiffness_factor_(stiffness_factor),
      s_squared_(s_squared),
      factor_(mixed_matrix(discretisation, stiffness_factor, s_squared),
              PivotOrder::natural_partial) {}

DynamicShape HubDrivenResponse::solve(Eigen::VectorXcd mixed, Complex theta) const {
  factor_.solve(mixed);
  const Eigen::VectorXd stiffness = model_.natural_stiffness();
  DynamicShape shape{Eigen::VectorXcd(model_.size()), Eigen::VectorXcd(model_.clamped_size())};
  shape.u[0] = theta;
  for (int i = 0; i < model_.clamped_size(); ++i) {
    shape.u[i + 1] = mixed[mixed_index(model_, i)];
    const int kinematic = kinematic_index(model_, i);
    shape.d[i] =
        kinematic < 0 ? shape.u[i + 1] : mixed[kinematic] / (stiffness_factor_ * stiffness[i]);
  }
  return shape;
}

DynamicShape HubDrivenResponse::to_unit_rotation() const {
  Eigen::VectorXcd mixed = Eigen::VectorXcd::Zero(mixed_size(model_));
  // theta's column of B stands in the first element: d1 has h/2 of it, d0 has -1.
  mixed[0] = -model_.lengths().front() / 2.0;
  mixed[1] = 1.0;
  using Entry = Eigen::SparseMatrix<double>::InnerIterator;
  for (Entry entry(model_.mass(), 0); entry; ++entry) {
    if (entry.row() == 0) continue;
    mixed[mixed_index(model_, static_cast<int>(entry.row()) - 1)] = -s_squared_ * entry.value();
  }
  return solve(std::move(mixed), 1.0);
}

DynamicShape HubDrivenResponse::to_loads(const Eigen::VectorXcd& f) const {
  Eigen::VectorXcd mixed = Eigen::VectorXcd::Zero(mixed_size(model_));
  for (int i = 0; i < model_.clamped_size(); ++i) mixed[mixed_index(model_, i)] = f[i + 1];
  return solve(std::move(mixed), 0.0);
}

DynamicShape free_response(const Discretisation& discretisation, Complex s,
                           const Eigen::VectorXcd& f) {
  const HubDrivenResponse response(discretisation, 1.0 + discretisation.kelvin_voigt() * s, s * s);
  if (response.singular()) {
    constexpr double kBeside = 1.0 + 4.0 * std::numeric_limits<double>::epsilon();
    return free_response(discretisation, s * kBeside, f);
  }
  const DynamicShape turned = response.to_unit_rotation();
  DynamicShape loaded = response.to_loads(f);
  // Reciprocity: what of the loads the hub feels.
  const Complex felt = turned.u.cwiseProduct(f).sum();
  const Complex torque =
      s * s * discretisation.rigid_momentum().cast<Complex>().cwiseProduct(turned.u).sum() +
      discretisation.hub_friction() * s;
  loaded.u += felt / torque * turned.u;
  loaded.d += felt / torque * turned.d;
  return loaded;
}

}  // namespace flexarm::fem
