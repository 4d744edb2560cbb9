#include "fem/discretisation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numeric>
#include <span>

namespace flexarm::fem {

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

double beam_mass_kg(const arm::LinearArm& arm) {
  return arm.linear_density_kg_per_m * arm.length_m;
}

/// m l^3, the unit of inertia.
double beam_inertia_kg_m2(const arm::LinearArm& arm) {
  return beam_mass_kg(arm) * arm.length_m * arm.length_m;
}

/// EI/l, the unit of torque and of rotational stiffness.
double torsion_N_m(const arm::LinearArm& arm) {
  return arm.flexural_rigidity_N_m2 / arm.length_m;
}

std::vector<double> positions(const std::vector<double>& lengths) {
  std::vector<double> nodes(lengths.size() + 1, 0.0);
  std::partial_sum(lengths.begin(), lengths.end(), nodes.begin() + 1);
  nodes.back() = 1.0;
  return nodes;
}

}  // namespace

Discretisation::Discretisation(const arm::LinearArm& arm, const MeshOptions& mesh, int degree)
    : arm_(arm),
      element_(degree, arm.shear.has_value()),
      payload_mass_(arm.payload_mass_kg / beam_mass_kg(arm)),
      payload_first_moment_(arm.payload_first_moment_kg_m / (beam_mass_kg(arm) * arm.length_m)),
      payload_inertia_(arm.payload_tip_inertia_kg_m2 / beam_inertia_kg_m2(arm)),
      hub_radius_(arm.hub_radius_m / arm.length_m),
      kelvin_voigt_(arm.kelvin_voigt_s * arm::omega_scale_rad_per_s(arm)),
      root_retardation_(arm.root_retardation_s * arm::omega_scale_rad_per_s(arm)),
      hub_friction_(arm.hub_viscous_friction_N_m_s_per_rad * arm::omega_scale_rad_per_s(arm) /
                    torsion_N_m(arm)),
      air_damping_(arm.air_damping_N_s_per_m2 /
                   (arm.linear_density_kg_per_m * arm::omega_scale_rad_per_s(arm))),
      hub_spring_(arm.hub_spring_N_m_per_rad / torsion_N_m(arm)),
      gravity_(arm.gravity_m_per_s2 * beam_mass_kg(arm) * arm.length_m / torsion_N_m(arm)),
      shear_rigidity_(arm.shear ? arm.shear->shear_rigidity_N * arm.length_m / torsion_N_m(arm)
                                : 0.0),
      rotary_inertia_(arm.shear
                          ? arm.shear->rotary_inertia_kg_m * arm.length_m / beam_inertia_kg_m2(arm)
                          : 0.0) {
  for (const arm::MassOnBeam& mass : arm.masses) {
    const arm::Suspension suspension = mass.suspension.value_or(arm::Suspension{});
    const double length_m = arm.length_m;
    const double stiffness = suspension.stiffness_N_per_m * length_m * length_m / torsion_N_m(arm);
    const double damping = suspension.damping_N_s_per_m * arm::omega_scale_rad_per_s(arm) *
                           length_m * length_m / torsion_N_m(arm);
    carried_.push_back(
        {mass.position_m / length_m, mass.mass_kg / beam_mass_kg(arm), stiffness, damping, 0});
  }
  place_nodes(mesh);
  place_coordinates();
  place_natural_deformations();
  place_kinematics();
  place_masses();
  place_weight();
  place_rigid_rotation();
}

void Discretisation::place_nodes(const MeshOptions& options) {
  constexpr double kSamePlace = kShortestElement;
  // Root, nodes asked for, tip, with the elements before each.
  std::vector<double> places = {0.0, 1.0};
  const auto nearest = [&](double position) {
    return std::ranges::min_element(
        places, {}, [position](double place) { return std::abs(place - position); });
  };
  if (arm_.crack) places.insert(places.begin() + 1, arm_.crack->position_m / arm_.length_m);
  for (const Carried& mass : carried_) {
    if (std::abs(*nearest(mass.position) - mass.position) <= kSamePlace) continue;
    places.insert(std::ranges::upper_bound(places, mass.position), mass.position);
  }
  SplitMesh split = split_mesh(element_lengths(options, arm_.length_m),
                               std::span(places).subspan(1, places.size() - 2));
  lengths_ = std::move(split.lengths);
  nodes_ = positions(lengths_);
  std::vector<int> before = std::move(split.before);
  before.insert(before.begin(), 0);
  before.push_back(elements());
  const auto node_at = [&](double position) {
    return before[static_cast<std::size_t>(nearest(position) - places.begin())];
  };
  if (arm_.crack) before_crack_ = node_at(arm_.crack->position_m / arm_.length_m);
  for (Carried& mass : carried_) mass.node = node_at(mass.position);
}

void Discretisation::place_coordinates() {
  int next = 1;
  const auto add_suspended = [&](int node) {
    for (Carried& mass : carried_) {
      if (mass.node == node && mass.stiffness > 0.0) mass.displacement = next++;
    }
  };
  if (arm_.drive) spring_rotations_.push_back(next++ - 1);
  if (arm_.root_stiffness_N_m_per_rad) spring_rotations_.push_back(next++ - 1);
  for (int e = 0; e < elements(); ++e) {
    add_suspended(e);
    if (e == before_crack_) spring_rotations_.push_back(next++ - 1);
    first_.push_back(next);
    next += coordinates_per_element();
  }
  add_suspended(elements());
  natural_stiffness_.setZero(next - 1);
  natural_damping_.setZero(next - 1);
  is_coordinate_.assign(static_cast<std::size_t>(next) - 1, false);
}

Discretisation::Place Discretisation::place(int e, int local) const {
  const int first = first_coordinate(e);
  switch (local) {
    case 0:
      if (e > 0) return place(e - 1, 2);
      return {hub_radius_ > 0.0 ? hub_index() : -1, hub_radius_};
    case 1:
      if (e == before_crack_) return {first - 1, 1.0};
      if (e > 0) return place(e - 1, 3);
      return {hub_index() + (arm_.root_stiffness_N_m_per_rad ? 1 : 0), 1.0};
    case 2:
    case 3:
      return {first + coordinates_per_element() - 4 + local, 1.0};
    default:
      return {first + local - 4, 1.0};
  }
}

Discretisation::Place Discretisation::deflection_place(const Carried& mass) const {
  return mass.node < elements() ? place(mass.node, 0) : place(mass.node - 1, 2);
}

Discretisation::Place Discretisation::rotation_place(const Carried& mass) const {
  return mass.node < elements() ? place(mass.node, 1) : place(mass.node - 1, 3);
}

void Discretisation::place_natural_deformations() {
  if (const auto& drive = arm_.drive) {
    natural_stiffness_[0] = drive->stiffness_N_m_per_rad / torsion_N_m(arm_);
    natural_damping_[0] =
        drive->retardation_s * arm::omega_scale_rad_per_s(arm_) * natural_stiffness_[0];
  }
  if (const auto& root = arm_.root_stiffness_N_m_per_rad) {
    natural_stiffness_[hub_index()] = *root / torsion_N_m(arm_);
    natural_damping_[hub_index()] = root_retardation_ * natural_stiffness_[hub_index()];
  }
  if (arm_.crack) {
    natural_stiffness_[spring_rotations_.back()] =
        arm_.crack->stiffness_N_m_per_rad / torsion_N_m(arm_);
  }
  for (const Carried& mass : carried_) {
    if (mass.displacement < 0) continue;
    natural_stiffness_[mass.displacement - 1] = mass.stiffness;
    natural_damping_[mass.displacement - 1] = mass.damping;
  }
  for (int e = 0; e < elements(); ++e) {
    const double h = lengths_[static_cast<std::size_t>(e)];
    int row = first_coordinate(e) - 1;
    const auto add = [&](double stiffness, bool bends, bool is_coordinate) {
      natural_stiffness_[row] = stiffness;
      if (bends) natural_damping_[row] = kelvin_voigt_ * stiffness;
      is_coordinate_[static_cast<std::size_t>(row)] = is_coordinate;
      ++row;
    };
    for (int k = 2; k < 2 + element_.bubbles(); ++k) add(h / (2.0 * k + 1.0), true, true);
    for (int k = 0; k < element_.shear_strains(); ++k) {
      add(shear_rigidity_ * h / (2.0 * k + 1.0), false, true);
    }
    add(12.0 / (h * h * h), true, false);
    add(1.0 / h, true, false);
  }
}

template <class ElementMatrix>
Eigen::SparseMatrix<double> Discretisation::assemble(const ElementMatrix& element_matrix) const {
  const int locals = element_.shape_functions();
  Triplets triplets;
  triplets.reserve(lengths_.size() * static_cast<std::size_t>(locals * locals));
  for (int e = 0; e < elements(); ++e) {
    const Eigen::MatrixXd matrix = element_matrix(e);
    for (int i = 0; i < locals; ++i) {
      const Place row = place(e, i);
      if (row.index < 0) continue;
      for (int j = 0; j < locals; ++j) {
        const Place column = place(e, j);
        if (column.index < 0) continue;
        triplets.emplace_back(row.index, column.index, row.factor * column.factor * matrix(i, j));
      }
    }
  }
  const auto n = natural_stiffness_.size() + 1;
  Eigen::SparseMatrix<double> assembled(n, n);
  assembled.setFromTriplets(triplets.begin(), triplets.end());
  return assembled;
}

double Discretisation::tension(int e) const {
  const auto i = static_cast<std::size_t>(e);
  double beyond = payload_mass_ + 1.0 - (nodes_[i] + nodes_[i + 1]) / 2.0;
  for (const Carried& mass : carried_) beyond += mass.node > e ? mass.mass : 0.0;
  return gravity_ * beyond;
}

void Discretisation::place_masses() {
  const auto length_of = [this](int e) { return lengths_[static_cast<std::size_t>(e)]; };
  const auto beam_mass = [&](int e) { return element_.mass(length_of(e)); };
  if (arm_.shear) {
    mass_ = assemble([&](int e) -> Eigen::MatrixXd {
      return beam_mass(e) + rotary_inertia_ * element_.rotary_mass(length_of(e));
    });
  } else {
    mass_ = assemble(beam_mass);
  }
  const int tip = tip_deflection_index();
  const double rotor_kg_m2 = arm_.drive ? arm_.drive->rotor_inertia_kg_m2 : 0.0;
  mass_.coeffRef(0, 0) += rotor_kg_m2 / beam_inertia_kg_m2(arm_);
  mass_.coeffRef(hub_index(), hub_index()) +=
      (arm_.hub_inertia_kg_m2 - rotor_kg_m2) / beam_inertia_kg_m2(arm_);
  mass_.coeffRef(tip, tip) += payload_mass_;
  mass_.coeffRef(tip, tip + 1) += payload_first_moment_;
  mass_.coeffRef(tip + 1, tip) += payload_first_moment_;
  mass_.coeffRef(tip + 1, tip + 1) += payload_inertia_;
  for (const Carried& mass : carried_) {
    const Place at = mass.displacement < 0 ? deflection_place(mass) : Place{mass.displacement, 1.0};
    if (at.index >= 0) mass_.coeffRef(at.index, at.index) += at.factor * at.factor * mass.mass;
  }
  air_mass_.resize(size(), size());
  if (air_damping_ > 0.0) air_mass_ = assemble(beam_mass);
}

void Discretisation::place_weight() {
  weight_.resize(size(), size());
  if (!has_weight()) return;
  weight_ = assemble([&](int e) {
    const double h = lengths_[static_cast<std::size_t>(e)];
    return element_.tension(h, tension(e), -gravity_ * h / 2.0);
  });
  double all = payload_mass_ + 1.0;
  for (const Carried& mass : carried_) all += mass.mass;
  weight_.coeffRef(hub_index(), hub_index()) += gravity_ * all * hub_radius_;
  const int tip_rotation = tip_rotation_index();
  weight_.coeffRef(tip_rotation, tip_rotation) += gravity_ * payload_first_moment_;
  for (const Carried& mass : carried_) {
    if (mass.displacement < 0) continue;
    const auto add = [&](Place a, Place b, double value) {
      if (a.index < 0) return;
      weight_.coeffRef(a.index, b.index) += a.factor * value;
      weight_.coeffRef(b.index, a.index) += a.factor * value;
    };
    const double pull = gravity_ * mass.mass;
    add({mass.displacement, 1.0}, rotation_place(mass), pull);
    add(deflection_place(mass), rotation_place(mass), -pull);
  }
}

void Discretisation::place_rigid_rotation() {
  rigid_rotation_ = Eigen::VectorXd::Zero(size());
  rigid_rotation_[0] = 1.0;
  rigid_rotation_[hub_index()] = 1.0;
  for (int e = 0; e < elements(); ++e) {
    rigid_rotation_[place(e, 1).index] = 1.0;
    rigid_rotation_[place(e, 2).index] = hub_radius_ + nodes_[static_cast<std::size_t>(e) + 1];
    rigid_rotation_[place(e, 3).index] = 1.0;
  }
  for (const Carried& mass : carried_) {
    if (mass.displacement < 0) continue;
    rigid_rotation_[mass.displacement] = hub_radius_ + nodes_[static_cast<std::size_t>(mass.node)];
  }
  rigid_momentum_ = mass_ * rigid_rotation_;
  total_inertia_ = rigid_rotation_.dot(rigid_momentum_);
}

void Discretisation::place_kinematics() {
  Triplets triplets;
  const Eigen::Index n = natural_stiffness_.size() + 1;
  triplets.reserve(static_cast<std::size_t>(n + 8 * elements()));
  const auto add = [&](int row, Place at, double value) {
    if (at.index >= 0) triplets.emplace_back(row, at.index, at.factor * value);
  };
  const auto add_turn = [&](int from) {
    triplets.emplace_back(from, from + 1, 1.0);
    triplets.emplace_back(from, from, -1.0);
  };
  if (arm_.drive) add_turn(0);
  if (arm_.root_stiffness_N_m_per_rad) add_turn(hub_index());
  if (arm_.crack) {
    const int row = spring_rotations_.back();
    add(row, place(before_crack_, 1), 1.0);
    add(row, place(before_crack_ - 1, 3), -1.0);
  }
  for (const Carried& mass : carried_) {
    if (mass.displacement < 0) continue;
    add(mass.displacement - 1, {mass.displacement, 1.0}, 1.0);
    add(mass.displacement - 1, deflection_place(mass), -1.0);
  }
  for (int e = 0; e < elements(); ++e) {
    const double h = lengths_[static_cast<std::size_t>(e)];
    for (int local = 4; local < element_.shape_functions(); ++local) {
      add(place(e, local).index - 1, place(e, local), 1.0);
    }
    const int d1 = place(e, 2).index - 1;
    add(d1, place(e, 0), 1.0);
    add(d1, place(e, 1), h / 2.0);
    add(d1, place(e, 2), -1.0);
    add(d1, place(e, 3), h / 2.0);
    if (element_.shear_strains() > 0) add(d1, place(e, 4 + element_.bubbles()), h);
    const int d0 = place(e, 3).index - 1;
    add(d0, place(e, 1), -1.0);
    add(d0, place(e, 3), 1.0);
  }
  kinematics_.resize(n - 1, n);
  kinematics_.setFromTriplets(triplets.begin(), triplets.end());
}

namespace {

/// B^T D B, symmetric to the last bit.
Eigen::SparseMatrix<double> assembled(const Eigen::SparseMatrix<double>& b,
                                      const Eigen::VectorXd& d) {
  const Eigen::SparseMatrix<double, Eigen::RowMajor> rows = b;
  using Entry = Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator;
  Triplets triplets;
  for (int row = 0; row < rows.outerSize(); ++row) {
    if (d[row] == 0.0) continue;
    for (Entry i(rows, row); i; ++i) {
      for (Entry j(rows, row); j; ++j) {
        triplets.emplace_back(i.col(), j.col(), d[row] * (i.value() * j.value()));
      }
    }
  }
  Eigen::SparseMatrix<double> product(b.cols(), b.cols());
  product.setFromTriplets(triplets.begin(), triplets.end());
  return product;
}

}  // namespace

Eigen::SparseMatrix<double> Discretisation::stiffness() const {
  Eigen::SparseMatrix<double> k = assembled(kinematics_, natural_stiffness_);
  if (has_weight()) k += weight_;
  if (hub_spring_ > 0.0) k.coeffRef(0, 0) += hub_spring_;
  return k;
}

Eigen::SparseMatrix<double> Discretisation::damping() const {
  Eigen::SparseMatrix<double> c = assembled(kinematics_, natural_damping_);
  if (air_damping_ > 0.0) c += air_damping_ * air_mass_;
  c.coeffRef(0, 0) += hub_friction_;
  return c;
}

bool Discretisation::is_damped_in_proportion() const {
  if (hub_friction_ > 0.0 || air_damping_ > 0.0) return false;
  if (natural_damping_.isZero(0.0)) return true;
  return turns_freely() && natural_damping_ == kelvin_voigt_ * natural_stiffness_;
}

template <class Scalar>
Columns<Scalar> Discretisation::stiffness_products(const Columns<Scalar>& u,
                                                   const Columns<Scalar>& d) const {
  Columns<Scalar> products =
      d.transpose() * (natural_stiffness_.template cast<Scalar>().asDiagonal() * d);
  if (hub_spring_ > 0.0) products += hub_spring_ * (u.row(0).transpose() * u.row(0));
  if (has_weight()) products += u.transpose() * (weight_ * u);
  return products;
}

template <class Scalar>
Columns<Scalar> Discretisation::damping_products(const Columns<Scalar>& u,
                                                 const Columns<Scalar>& d) const {
  Columns<Scalar> products = hub_friction_ * (u.row(0).transpose() * u.row(0));
  products += d.transpose() * (natural_damping_.template cast<Scalar>().asDiagonal() * d);
  if (air_damping_ > 0.0) products += air_damping_ * (u.transpose() * (air_mass_ * u));
  return products;
}

using Complex = std::complex<double>;
template Columns<double> Discretisation::stiffness_products(const Columns<double>&,
                                                            const Columns<double>&) const;
template Columns<Complex> Discretisation::stiffness_products(const Columns<Complex>&,
                                                             const Columns<Complex>&) const;
template Columns<double> Discretisation::damping_products(const Columns<double>&,
                                                          const Columns<double>&) const;
template Columns<Complex> Discretisation::damping_products(const Columns<Complex>&,
                                                           const Columns<Complex>&) const;

std::string describe(const Discretisation& discretisation) {
  return fmt::format(
      "{} elements of degree {}, payload mass {:.4g} m l, payload inertia {:.4g} m l^3",
      discretisation.elements(), discretisation.element().degree(), discretisation.payload_mass(),
      discretisation.payload_inertia());
}

}  // namespace flexarm::fem
