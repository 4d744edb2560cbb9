#include "fem/discretisation.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <fmt/format.h>

#include <algorithm>
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

std::vector<double> positions(const std::vector<double>& lengths) {
  std::vector<double> nodes(lengths.size() + 1, 0.0);
  std::partial_sum(lengths.begin(), lengths.end(), nodes.begin() + 1);
  nodes.back() = 1.0;
  return nodes;
}

}  // namespace

Discretisation::Discretisation(const arm::LinearArm& arm, const MeshOptions& mesh, int degree)
    : element_(degree),
      lengths_(element_lengths(mesh, arm.length_m)),
      nodes_(positions(lengths_)),
      payload_mass_(arm.payload_mass_kg / beam_mass_kg(arm)),
      payload_inertia_(arm.payload_tip_inertia_kg_m2 / beam_inertia_kg_m2(arm)),
      kelvin_voigt_(arm.kelvin_voigt_s * arm::omega_scale_rad_per_s(arm)),
      hub_friction_(arm.hub_viscous_friction_N_m_s_per_rad * arm::omega_scale_rad_per_s(arm) *
                    arm.length_m / arm.flexural_rigidity_N_m2) {
  mass_ = assemble([this](double h) { return element_.mass(h); });
  const int n = size();
  mass_.coeffRef(0, 0) += arm.hub_inertia_kg_m2 / beam_inertia_kg_m2(arm);
  mass_.coeffRef(n - 2, n - 2) += payload_mass_;
  mass_.coeffRef(n - 1, n - 1) += payload_inertia_;

  rigid_rotation_ = Eigen::VectorXd::Zero(n);
  rigid_rotation_[0] = 1.0;
  for (int e = 0; e < elements(); ++e) {
    rigid_rotation_[index(e, 2)] = nodes_[static_cast<std::size_t>(e) + 1];
    rigid_rotation_[index(e, 3)] = 1.0;
  }
  rigid_momentum_ = mass_ * rigid_rotation_;
  total_inertia_ = rigid_rotation_.dot(rigid_momentum_);
}

int Discretisation::index(int e, int local) const {
  const int per_element = coordinates_per_element();
  if (local >= 4) return 1 + e * per_element + (local - 4);
  if (local >= 2) return 1 + e * per_element + element_.bubbles() + (local - 2);
  if (e == 0) return local == 1 ? 0 : -1;
  return index(e - 1, local + 2);
}

template <class ElementMatrix>
Eigen::SparseMatrix<double> Discretisation::assemble(const ElementMatrix& element_matrix) const {
  const int locals = element_.degree() + 1;
  Triplets triplets;
  triplets.reserve(lengths_.size() * static_cast<std::size_t>(locals * locals));
  for (int e = 0; e < elements(); ++e) {
    const Eigen::MatrixXd matrix = element_matrix(lengths_[static_cast<std::size_t>(e)]);
    for (int i = 0; i < locals; ++i) {
      for (int j = 0; j < locals; ++j) {
        if (index(e, i) >= 0 && index(e, j) >= 0) {
          triplets.emplace_back(index(e, i), index(e, j), matrix(i, j));
        }
      }
    }
  }
  const int n = 1 + elements() * coordinates_per_element();
  Eigen::SparseMatrix<double> assembled(n, n);
  assembled.setFromTriplets(triplets.begin(), triplets.end());
  return assembled;
}

Eigen::SparseMatrix<double> Discretisation::stiffness() const {
  return assemble([this](double h) { return element_.stiffness(h); });
}

Eigen::SparseMatrix<double> Discretisation::kinematics() const {
  Triplets triplets;
  triplets.reserve(static_cast<std::size_t>(clamped_size() + 6 * elements()));
  for (int e = 0; e < elements(); ++e) {
    const double h = lengths_[static_cast<std::size_t>(e)];
    for (int bubble = 4; bubble <= element_.degree(); ++bubble) {
      triplets.emplace_back(index(e, bubble) - 1, index(e, bubble) - 1, 1.0);
    }
    const int d1 = index(e, 2) - 1;
    const int d0 = index(e, 3) - 1;
    triplets.emplace_back(d1, index(e, 2) - 1, -1.0);
    triplets.emplace_back(d1, index(e, 3) - 1, h / 2.0);
    triplets.emplace_back(d0, index(e, 3) - 1, 1.0);
    if (e > 0) {
      triplets.emplace_back(d1, index(e, 0) - 1, 1.0);
      triplets.emplace_back(d1, index(e, 1) - 1, h / 2.0);
      triplets.emplace_back(d0, index(e, 1) - 1, -1.0);
    }
  }
  Eigen::SparseMatrix<double> b(clamped_size(), clamped_size());
  b.setFromTriplets(triplets.begin(), triplets.end());
  return b;
}

Eigen::VectorXd Discretisation::natural_stiffness() const {
  Eigen::VectorXd d(clamped_size());
  for (int e = 0; e < elements(); ++e) {
    const double h = lengths_[static_cast<std::size_t>(e)];
    for (int bubble = 4; bubble <= element_.degree(); ++bubble) {
      d[index(e, bubble) - 1] = h / (2.0 * (bubble - 2) + 1.0);
    }
    d[index(e, 2) - 1] = 12.0 / (h * h * h);
    d[index(e, 3) - 1] = 1.0 / h;
  }
  return d;
}

Eigen::VectorXd Discretisation::ramp_momentum(double position) const {
  Eigen::VectorXd momentum = Eigen::VectorXd::Zero(size());
  const int degree = element_.degree();
  for (int e = 0; e < elements(); ++e) {
    const double left = nodes_[static_cast<std::size_t>(e)];
    const double right = nodes_[static_cast<std::size_t>(e) + 1];
    if (right <= position) continue;
    const double h = lengths_[static_cast<std::size_t>(e)];
    // int k P_k dx over the element, k = 0 ... p.
    Eigen::VectorXd moments = Eigen::VectorXd::Zero(degree + 1);
    if (position <= left) {
      moments[0] = h * ((left - position) + h / 2.0);
      moments[1] = h * h / 6.0;
    } else {
      // 20 Gauss points are exact to degree 39; the integrand's is p + 1 <= 34.
      using Gauss = boost::math::quadrature::gauss<double, 20>;
      for (int k = 0; k <= degree; ++k) {
        moments[k] = Gauss::integrate(
            [&](double x) {
              return (x - position) * legendre_values(k, 2.0 * (x - left) / h - 1.0)[k];
            },
            position, right);
      }
    }
    const Eigen::VectorXd local = element_.legendre_coefficients(h) * moments;
    for (int i = 0; i <= degree; ++i) {
      if (index(e, i) >= 0) momentum[index(e, i)] += local[i];
    }
  }
  momentum[size() - 2] += payload_mass_ * (1.0 - position);
  momentum[size() - 1] += payload_inertia_;
  return momentum;
}

Eigen::VectorXd Discretisation::tip_force_shape() const {
  Eigen::VectorXd shape = Eigen::VectorXd::Zero(size());
  for (int e = 0; e < elements(); ++e) {
    const double x = nodes_[static_cast<std::size_t>(e) + 1];
    shape[index(e, 2)] = x * x * (3.0 - x) / 6.0;
    shape[index(e, 3)] = x * (2.0 - x) / 2.0;
  }
  return shape;
}

double Discretisation::deflection(const Eigen::VectorXd& u, double x) const {
  const auto after = std::upper_bound(nodes_.begin(), nodes_.end(), x);
  const auto found = std::max<std::ptrdiff_t>(after - nodes_.begin() - 1, 0);
  const int e = static_cast<int>(std::min<std::ptrdiff_t>(found, elements() - 1));
  const double h = lengths_[static_cast<std::size_t>(e)];
  const double xi = 2.0 * (x - nodes_[static_cast<std::size_t>(e)]) / h - 1.0;
  const Eigen::VectorXd shapes =
      element_.legendre_coefficients(h) * legendre_values(element_.degree(), xi);
  double y = 0.0;
  for (int i = 0; i <= element_.degree(); ++i) {
    if (index(e, i) >= 0) y += u[index(e, i)] * shapes[i];
  }
  return y;
}

template <class Scalar>
Columns<Scalar> Discretisation::stiffness_products(const Columns<Scalar>&,
                                                   const Columns<Scalar>& d) const {
  return d.transpose() * (natural_stiffness().template cast<Scalar>().asDiagonal() * d);
}

template <class Scalar>
Columns<Scalar> Discretisation::damping_products(const Columns<Scalar>& u,
                                                 const Columns<Scalar>& d) const {
  return kelvin_voigt_ * stiffness_products(u, d) +
         hub_friction_ * (u.row(0).transpose() * u.row(0));
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
