#include "tests/trials/element_modes.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseLU>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace flexarm::trials {

namespace {

using Complex = std::complex<double>;
using SparseFactor = Eigen::SparseLU<Eigen::SparseMatrix<Complex>>;

/// Modes from which Newton's method starts.
constexpr Eigen::Index kStartingModes = 24;
constexpr int kMostNewtonSteps = 8;
/// Of a pole, from one step to the next.
constexpr double kNewtonTolerance = 1e-12;

/// s^2 M + s C + K.
Eigen::SparseMatrix<Complex> dynamic_stiffness(const ElementModel& model, Complex s) {
  return s * s * model.mass().cast<Complex>() + s * model.damping().cast<Complex>() +
         model.stiffness().cast<Complex>();
}

/// Poles of the modes' projection with Im > 0, ascending in size, and where each mode's share of
/// the motion is.
struct ProjectedPole {
  Complex s_rad_per_s;
  Eigen::VectorXcd motion;  ///< in modes
};

std::vector<ProjectedPole> projected_poles(const ElementModel& model, const ElementModes& modes) {
  const Eigen::Index n = modes.shapes.cols();
  const Eigen::MatrixXd damping =
      modes.shapes.transpose() * model.damping() * modes.shapes / modes.modal_mass_kg_m2;
  Eigen::MatrixXd first_order = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  first_order.topRightCorner(n, n).setIdentity();
  first_order.bottomLeftCorner(n, n).diagonal() = -modes.omega_squared_rad2_per_s2;
  first_order.bottomRightCorner(n, n) = -damping;
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(first_order);
  std::vector<ProjectedPole> poles;
  for (Eigen::Index i = 0; i < 2 * n; ++i) {
    const Complex s = solver.eigenvalues()(i);
    if (s.imag() > 0.0) poles.push_back({s, solver.eigenvectors().col(i).head(n)});
  }
  std::ranges::sort(poles, {}, [](const ProjectedPole& one) { return std::abs(one.s_rad_per_s); });
  return poles;
}

/// Newton's method on s and u together (inverse iteration): (s^2 M + s C + K) w = (2 s M + C) u,
/// s - u^T u/u^T w, and w in place of u.
Complex refined(const ElementModel& model, Complex s, Eigen::VectorXcd u) {
  for (int step = 0; step < kMostNewtonSteps; ++step) {
    u /= u.norm();
    const Eigen::VectorXcd slope =
        2.0 * s * (model.mass().cast<Complex>() * u) + model.damping().cast<Complex>() * u;
    SparseFactor factor(dynamic_stiffness(model, s));
    const Eigen::VectorXcd w = factor.solve(slope);
    if (factor.info() != Eigen::Success || !w.allFinite()) break;
    const Complex change = u.dot(u) / u.dot(w);
    s -= change;
    u = w;
    if (std::abs(change) <= kNewtonTolerance * std::abs(s)) break;
  }
  return s;
}

}  // namespace

ElementModes undamped_modes(const ElementModel& model, Eigen::Index flexible) {
  const Eigen::MatrixXd stiffness = model.stiffness();
  const Eigen::MatrixXd mass = model.mass();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness, mass);
  if (solver.info() != Eigen::Success) throw std::runtime_error("no modes were found");
  const Eigen::Index n = std::min(flexible + 1, model.size());
  ElementModes modes;
  modes.modal_mass_kg_m2 = model.total_inertia_kg_m2();
  modes.shapes = std::sqrt(modes.modal_mass_kg_m2) * solver.eigenvectors().leftCols(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (modes.shapes(ElementModel::kHub, i) < 0.0) modes.shapes.col(i) *= -1.0;
  }
  // Rayleigh's quotient, in which an error of the shape counts by its square alone.
  modes.omega_squared_rad2_per_s2.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    modes.omega_squared_rad2_per_s2(i) =
        model.twice_potential(modes.shapes.col(i)) / modes.modal_mass_kg_m2;
  }
  if (model.turns_freely()) modes.omega_squared_rad2_per_s2(0) = 0.0;
  return modes;
}

std::vector<double> held_omegas_rad_per_s(const ElementModel& model, int count) {
  static_assert(ElementModel::kHub == 0);
  const Eigen::Index n = model.size() - 1;
  const Eigen::MatrixXd stiffness = Eigen::MatrixXd(model.stiffness()).bottomRightCorner(n, n);
  const Eigen::MatrixXd mass = Eigen::MatrixXd(model.mass()).bottomRightCorner(n, n);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness, mass,
                                                                         Eigen::EigenvaluesOnly);
  std::vector<double> omegas;
  for (Eigen::Index i = 0; i < count; ++i) {
    omegas.push_back(std::sqrt(std::abs(solver.eigenvalues()(i))));
  }
  return omegas;
}

std::vector<Complex> damped_poles_rad_per_s(const ElementModel& model, int count) {
  const ElementModes modes = undamped_modes(model, kStartingModes);
  std::vector<ProjectedPole> projected = projected_poles(model, modes);
  Eigen::Index largest = 1;
  if (!projected.empty()) projected.front().motion.cwiseAbs().maxCoeff(&largest);
  // The lowest mode swings where something holds the hub.
  if (!projected.empty() && largest == 0) projected.erase(projected.begin());
  std::vector<Complex> poles;
  for (int i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (at < projected.size()) {
      const ProjectedPole& start = projected[at];
      poles.push_back(
          refined(model, start.s_rad_per_s, modes.shapes.cast<Complex>() * start.motion));
    } else {
      poles.emplace_back(-std::sqrt(std::abs(modes.omega_squared_rad2_per_s2(i + 1))));
    }
  }
  return poles;
}

Eigen::VectorXcd motion_per_torque(const ElementModel& model, Complex s_rad_per_s) {
  SparseFactor factor(dynamic_stiffness(model, s_rad_per_s));
  if (factor.info() != Eigen::Success) throw std::runtime_error("a pole");
  const Eigen::VectorXcd torque = Eigen::VectorXcd::Unit(model.size(), ElementModel::kHub);
  return factor.solve(torque);
}

}  // namespace flexarm::trials
