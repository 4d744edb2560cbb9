#include "fem/discretisation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <complex>
#include <cstddef>
#include <numeric>

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

SplitMesh mesh_of(const arm::LinearArm& arm, const MeshOptions& options) {
  std::vector<double> lengths = element_lengths(options, arm.length_m);
  if (!arm.crack) return {std::move(lengths), 0};
  return split_mesh(lengths, arm.crack->position_m / arm.length_m);
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
  SplitMesh split = mesh_of(arm, mesh);
  lengths_ = std::move(split.lengths);
  before_crack_ = split.before;
  nodes_ = positions(lengths_);
  place_natural_deformations();
  place_kinematics();

  const auto length_of = [this](int e) { return lengths_[static_cast<std::size_t>(e)]; };
  const auto beam_mass = [&](int e) { return element_.mass(length_of(e)); };
  if (arm.shear) {
    mass_ = assemble([&](int e) -> Eigen::MatrixXd {
      return beam_mass(e) + rotary_inertia_ * element_.rotary_mass(length_of(e));
    });
  } else {
    mass_ = assemble(beam_mass);
  }
  const int n = size();
  mass_.coeffRef(0, 0) += arm.hub_inertia_kg_m2 / beam_inertia_kg_m2(arm);
  mass_.coeffRef(n - 2, n - 2) += payload_mass_;
  mass_.coeffRef(n - 2, n - 1) += payload_first_moment_;
  mass_.coeffRef(n - 1, n - 2) += payload_first_moment_;
  mass_.coeffRef(n - 1, n - 1) += payload_inertia_;
  air_mass_.resize(n, n);
  if (air_damping_ > 0.0) air_mass_ = assemble(beam_mass);
  weight_.resize(n, n);
  if (has_weight()) {
    weight_ = assemble([&](int e) {
      return element_.tension(length_of(e), tension(e), -gravity_ * length_of(e) / 2.0);
    });
    weight_.coeffRef(0, 0) += gravity_ * (payload_mass_ + 1.0) * hub_radius_;
    weight_.coeffRef(n - 1, n - 1) += gravity_ * payload_first_moment_;
  }

  rigid_rotation_ = Eigen::VectorXd::Zero(n);
  rigid_rotation_[0] = 1.0;
  for (int e = 0; e < elements(); ++e) {
    rigid_rotation_[place(e, 1).index] = 1.0;
    rigid_rotation_[place(e, 2).index] = hub_radius_ + nodes_[static_cast<std::size_t>(e) + 1];
    rigid_rotation_[place(e, 3).index] = 1.0;
  }
  rigid_momentum_ = mass_ * rigid_rotation_;
  total_inertia_ = rigid_rotation_.dot(rigid_momentum_);
}

int Discretisation::first_coordinate(int e) const {
  const int root = arm_.root_stiffness_N_m_per_rad ? 1 : 0;
  const int crack = arm_.crack && e >= before_crack_ ? 1 : 0;
  return 1 + root + crack + e * coordinates_per_element();
}

Discretisation::Place Discretisation::place(int e, int local) const {
  const int first = first_coordinate(e);
  switch (local) {
    case 0:
      if (e > 0) return place(e - 1, 2);
      return {hub_radius_ > 0.0 ? 0 : -1, hub_radius_};
    case 1:
      // The hub's, the root's, the element's before, or that beyond the crack.
      return {first - 1, 1.0};
    case 2:
    case 3:
      return {first + coordinates_per_element() - 4 + local, 1.0};
    default:
      return {first + local - 4, 1.0};
  }
}

void Discretisation::place_natural_deformations() {
  const int last = elements() - 1;
  const auto count =
      static_cast<std::size_t>(first_coordinate(last) + coordinates_per_element() - 1);
  natural_stiffness_.resize(static_cast<Eigen::Index>(count));
  bending_stiffness_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(count));
  is_coordinate_.assign(count, false);
  if (const auto& root = arm_.root_stiffness_N_m_per_rad) {
    natural_stiffness_[0] = *root / torsion_N_m(arm_);
  }
  if (arm_.crack) {
    natural_stiffness_[first_coordinate(before_crack_) - 2] =
        arm_.crack->stiffness_N_m_per_rad / torsion_N_m(arm_);
  }
  for (int e = 0; e <= last; ++e) {
    const double h = lengths_[static_cast<std::size_t>(e)];
    int row = first_coordinate(e) - 1;
    const auto add = [&](double stiffness, bool bends, bool is_coordinate) {
      natural_stiffness_[row] = stiffness;
      if (bends) bending_stiffness_[row] = stiffness;
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
  return gravity_ * (payload_mass_ + 1.0 - (nodes_[i] + nodes_[i + 1]) / 2.0);
}

void Discretisation::place_kinematics() {
  Triplets triplets;
  const Eigen::Index n = natural_stiffness_.size() + 1;
  triplets.reserve(static_cast<std::size_t>(n + 8 * elements()));
  const auto add = [&](int row, Place at, double value) {
    if (at.index >= 0) triplets.emplace_back(row, at.index, at.factor * value);
  };
  if (arm_.root_stiffness_N_m_per_rad) {
    triplets.emplace_back(0, 1, 1.0);
    triplets.emplace_back(0, 0, -1.0);
  }
  if (arm_.crack) {
    const int beyond = first_coordinate(before_crack_) - 1;
    triplets.emplace_back(beyond - 1, beyond, 1.0);
    triplets.emplace_back(beyond - 1, beyond - 1, -1.0);
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
  Eigen::SparseMatrix<double> c = assembled(kinematics_, kelvin_voigt_ * bending_stiffness_);
  if (air_damping_ > 0.0) c += air_damping_ * air_mass_;
  c.coeffRef(0, 0) += hub_friction_;
  return c;
}

bool Discretisation::is_damped_in_proportion() const {
  if (hub_friction_ > 0.0 || air_damping_ > 0.0) return false;
  return kelvin_voigt_ == 0.0 || (turns_freely() && natural_stiffness_ == bending_stiffness_);
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
  if (kelvin_voigt_ > 0.0) {
    products += kelvin_voigt_ *
                (d.transpose() * (bending_stiffness_.template cast<Scalar>().asDiagonal() * d));
  }
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
