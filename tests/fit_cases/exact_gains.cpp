#include "tests/fit_cases/exact_gains.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <complex>

namespace flexarm::measured {

namespace {

/// Residues R_i of displacements, sum_i R_i/(s - p_i), one row a sensor.
struct ModelResidues {
  Eigen::VectorXcd poles;
  Eigen::MatrixXcd residues;

  /// b0 of the block (b1 s + b0)/((s - p)(s - conj p)) of sensor j.
  double b0(Eigen::Index j, Eigen::Index i) const {
    return -2.0 * (residues(j, i) * std::conj(poles(i))).real();
  }
  std::complex<double> displacement(Eigen::Index j, std::complex<double> s) const {
    return (residues.row(j).transpose().array() / (s - poles.array())).sum();
  }
};

ModelResidues model_residues(const arm::ModalModel& model, std::size_t sensors) {
  using Eigen::Index;
  const auto n = static_cast<Index>(model.modes.size());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(2 * n);
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(static_cast<Index>(sensors), 2 * n);
  a.topRightCorner(n, n).setIdentity();
  for (Index i = 0; i < n; ++i) {
    const arm::Mode& mode = model.modes[static_cast<std::size_t>(i)];
    a(n + i, i) = -mode.omega_rad_per_s * mode.omega_rad_per_s;
    b(n + i) = mode.hub_slope / model.modal_mass_kg_m2;
    for (Index k = 0; k < n; ++k) {
      a(n + i, n + k) = -model.damping_rad_per_s[static_cast<std::size_t>(i * n + k)];
    }
    for (Index j = 0; j < c.rows(); ++j) {
      c(j, i) = mode.sensor_values[static_cast<std::size_t>(j)];
    }
  }
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(a);
  const Eigen::MatrixXcd vectors = solver.eigenvectors();
  const Eigen::VectorXcd drive = vectors.partialPivLu().solve(b.cast<std::complex<double>>());
  return {solver.eigenvalues(), c.cast<std::complex<double>>() * vectors * drive.asDiagonal()};
}

}  // namespace

ExactGains exact_gains(const arm::ModalModel& model, std::size_t hub_sensor,
                       std::size_t tip_sensor) {
  const auto hub = static_cast<Eigen::Index>(hub_sensor);
  const auto tip = static_cast<Eigen::Index>(tip_sensor);
  const ModelResidues all = model_residues(model, model.modes.front().sensor_values.size());
  std::vector<Eigen::Index> order;
  for (Eigen::Index i = 0; i < all.poles.size(); ++i) {
    if (all.poles(i).imag() >= 0.0) order.push_back(i);
  }
  std::ranges::sort(order, {}, [&](Eigen::Index i) { return std::abs(all.poles(i)); });
  const double a1 = -all.poles(order[1]).real();
  ExactGains gains;
  gains.total_inertia_kg_m2 = 1.0 / (a1 * all.residues(hub, order[0]).real());
  for (std::size_t m = 2; m < order.size(); ++m) {
    const Eigen::Index i = order[m];
    const double slope = std::sqrt(gains.total_inertia_kg_m2 * all.b0(hub, i));
    const std::complex<double> s(0.0, std::abs(all.poles(i)));
    gains.hub_slopes.push_back(slope);
    gains.tip_gains_m.push_back(gains.total_inertia_kg_m2 * all.b0(tip, i) / slope);
    // The acceleration's s^2 = -omega^2 and the minus sign cancel.
    gains.tip_gains_of_ratio_m.push_back(
        (all.displacement(tip, s) / all.displacement(hub, s)).real() * slope);
  }
  return gains;
}

}  // namespace flexarm::measured
