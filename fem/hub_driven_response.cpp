#include "fem/hub_driven_response.hpp"

#include <limits>
#include <utility>

namespace flexarm::fem {

namespace {

using Complex = std::complex<double>;

/// Along the arm: the two kinematic equations of an element before its coordinates, that of a
/// spring or suspension before the coordinate beyond it.
MixedOrder order_of(const Discretisation& model) {
  const auto n = static_cast<std::size_t>(model.clamped_size());
  MixedOrder slots{std::vector<int>(n), std::vector<int>(n, -1), 0};
  const auto place = [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      if (!model.is_coordinate(i)) slots.kinematic[static_cast<std::size_t>(i)] = slots.size++;
    }
    for (int i = first; i < last; ++i) {
      slots.coordinate[static_cast<std::size_t>(i)] = slots.size++;
    }
  };
  int next = 0;
  for (int e = 0; e < model.elements(); ++e) {
    const int first = model.first_coordinate(e) - 1;
    place(next, first);
    next = first + model.coordinates_per_element();
    place(first, next);
  }
  place(next, model.clamped_size());
  return slots;
}

template <class Scalar>
Eigen::SparseMatrix<Scalar> mixed_matrix(const Discretisation& model,
                                         const Dynamics<Scalar>& dynamics,
                                         const MixedOrder& order) {
  const auto& [coordinate, kinematic, size] = order;
  const Eigen::SparseMatrix<double>& mass = model.mass();
  const Eigen::SparseMatrix<double>& b = model.kinematics();
  const Eigen::VectorXd& stiffness = model.natural_stiffness();
  const Eigen::VectorXd& damping = model.natural_damping();
  std::vector<Eigen::Triplet<Scalar>> triplets;
  triplets.reserve(static_cast<std::size_t>(mass.nonZeros() + 2 * b.nonZeros() + stiffness.size() +
                                            model.air_mass().nonZeros() +
                                            model.weight().nonZeros()));
  for (int i = 0; i < model.clamped_size(); ++i) {
    const Scalar d = stiffness[i] + dynamics.s * damping[i];
    const int row = kinematic[static_cast<std::size_t>(i)];
    const int own = coordinate[static_cast<std::size_t>(i)];
    if (row < 0) {
      triplets.emplace_back(own, own, d);
    } else {
      triplets.emplace_back(row, row, -1.0 / d);
    }
  }
  using Entry = Eigen::SparseMatrix<double>::InnerIterator;
  for (int column = 1; column < b.outerSize(); ++column) {
    const int at = coordinate[static_cast<std::size_t>(column) - 1];
    for (Entry entry(b, column); entry; ++entry) {
      const int row = kinematic[static_cast<std::size_t>(entry.row())];
      if (row < 0) continue;
      triplets.emplace_back(row, at, entry.value());
      triplets.emplace_back(at, row, entry.value());
    }
  }
  const auto add = [&](const Eigen::SparseMatrix<double>& matrix, Scalar factor) {
    for (int column = 1; column < matrix.outerSize(); ++column) {
      for (Entry entry(matrix, column); entry; ++entry) {
        if (entry.row() == 0) continue;
        triplets.emplace_back(coordinate[static_cast<std::size_t>(entry.row()) - 1],
                              coordinate[static_cast<std::size_t>(column) - 1],
                              factor * entry.value());
      }
    }
  };
  add(mass, dynamics.w);
  if (model.air_damping() > 0.0) add(model.air_mass(), dynamics.air);
  if (model.has_weight()) add(model.weight(), 1.0);
  Eigen::SparseMatrix<Scalar> matrix(size, size);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return matrix;
}

}  // namespace

Dynamics<Complex> damped_dynamics(const Discretisation& discretisation, Complex s) {
  return {s * s, s, discretisation.air_damping() * s,
          discretisation.hub_friction() * s + discretisation.hub_spring()};
}

template <class Scalar>
HubDrivenResponse<Scalar>::HubDrivenResponse(const Discretisation& discretisation,
                                             const Dynamics<Scalar>& dynamics)
    : model_(discretisation),
      dynamics_(dynamics),
      order_(order_of(discretisation)),
      factor_(mixed_matrix(discretisation, dynamics, order_), PivotOrder::natural_partial) {}

template <class Scalar>
typename HubDrivenResponse<Scalar>::Shape HubDrivenResponse<Scalar>::solve(Vector mixed,
                                                                           Scalar rotation) const {
  factor_.solve(mixed);
  const Eigen::VectorXd& stiffness = model_.natural_stiffness();
  const Eigen::VectorXd& damping = model_.natural_damping();
  Shape shape{Vector(model_.size()), Vector(model_.clamped_size())};
  shape.u[0] = rotation;
  for (int i = 0; i < model_.clamped_size(); ++i) {
    shape.u[i + 1] = mixed[order_.coordinate[static_cast<std::size_t>(i)]];
    const int kinematic = order_.kinematic[static_cast<std::size_t>(i)];
    if (kinematic < 0) {
      shape.d[i] = shape.u[i + 1];
    } else {
      shape.d[i] = mixed[kinematic] / (stiffness[i] + dynamics_.s * damping[i]);
    }
  }
  return shape;
}

template <class Scalar>
typename HubDrivenResponse<Scalar>::Shape HubDrivenResponse<Scalar>::to_unit_rotation() const {
  Vector mixed = Vector::Zero(order_.size);
  using Entry = Eigen::SparseMatrix<double>::InnerIterator;
  const auto add = [&](const Eigen::SparseMatrix<double>& matrix, Scalar factor) {
    for (Entry entry(matrix, 0); entry; ++entry) {
      if (entry.row() == 0) continue;
      mixed[order_.coordinate[static_cast<std::size_t>(entry.row()) - 1]] -= factor * entry.value();
    }
  };
  for (Entry entry(model_.kinematics(), 0); entry; ++entry) {
    mixed[order_.kinematic[static_cast<std::size_t>(entry.row())]] -= entry.value();
  }
  add(model_.mass(), dynamics_.w);
  if (model_.air_damping() > 0.0) add(model_.air_mass(), dynamics_.air);
  if (model_.has_weight()) add(model_.weight(), 1.0);
  return solve(std::move(mixed), 1.0);
}

template <class Scalar>
typename HubDrivenResponse<Scalar>::Shape HubDrivenResponse<Scalar>::to_loads(
    const Vector& f) const {
  Vector mixed = Vector::Zero(order_.size);
  for (int i = 0; i < model_.clamped_size(); ++i) {
    mixed[order_.coordinate[static_cast<std::size_t>(i)]] = f[i + 1];
  }
  return solve(std::move(mixed), 0.0);
}

template <class Scalar>
Scalar HubDrivenResponse<Scalar>::hub_torque(const Vector& u) const {
  const auto work = [&](const auto& load) -> Scalar {
    return load.template cast<Scalar>().cwiseProduct(u).sum();
  };
  Scalar torque = dynamics_.w * work(model_.rigid_momentum()) + dynamics_.hub * u[0];
  const Eigen::VectorXd& r = model_.rigid_rotation();
  if (model_.air_damping() > 0.0) {
    torque += dynamics_.air * work(Eigen::VectorXd(model_.air_mass() * r));
  }
  if (model_.has_weight()) torque += work(Eigen::VectorXd(model_.weight() * r));
  return torque;
}

template <class Scalar>
typename HubDrivenResponse<Scalar>::Shape HubDrivenResponse<Scalar>::to_loads_of_free_arm(
    const Vector& f, const Shape& turned) const {
  Shape loaded = to_loads(f);
  // Reciprocity: what of the loads the hub feels.
  const Scalar felt = turned.u.cwiseProduct(f).sum();
  const Scalar rotation = felt / hub_torque(turned.u);
  loaded.u += rotation * turned.u;
  loaded.d += rotation * turned.d;
  return loaded;
}

template class HubDrivenResponse<double>;
template class HubDrivenResponse<Complex>;

ShapeOf<Complex> free_response(const Discretisation& discretisation, Complex s,
                               const Eigen::VectorXcd& f) {
  const HubDrivenResponse<Complex> response(discretisation, damped_dynamics(discretisation, s));
  if (response.singular()) {
    constexpr double kBeside = 1.0 + 4.0 * std::numeric_limits<double>::epsilon();
    return free_response(discretisation, s * kBeside, f);
  }
  return response.to_loads_of_free_arm(f, response.to_unit_rotation());
}

}  // namespace flexarm::fem
