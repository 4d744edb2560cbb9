#include "response/frequency/modal_response.hpp"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <fmt/format.h>

#include <limits>
#include <stdexcept>

namespace flexarm::response {

namespace {

using Complex = std::complex<double>;
using Damping =
    Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

Damping damping_of(const arm::ModalModel& model) {
  const auto n = static_cast<Eigen::Index>(model.modes.size());
  return {model.damping_rad_per_s.data(), n, n};
}

/// q of the sum above.
Eigen::VectorXcd amplitudes(const arm::ModalModel& model, Complex s) {
  const auto n = static_cast<Eigen::Index>(model.modes.size());
  const Damping damping = damping_of(model);
  Eigen::VectorXcd force(n);
  Eigen::VectorXcd dynamic(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto mode = static_cast<std::size_t>(i);
    force(i) = model.modes[mode].hub_slope / model.modal_mass_kg_m2;
    dynamic(i) = s * s + omega_squared(model, mode);
  }
  const bool coupled = !damping.isDiagonal(0.0);
  if (!coupled) return force.cwiseQuotient(dynamic + s * damping.diagonal().cast<Complex>());
  Eigen::MatrixXcd matrix = s * damping.cast<Complex>();
  matrix.diagonal() += dynamic;
  return matrix.partialPivLu().solve(force);
}

}  // namespace

double omega_squared(const arm::ModalModel& model, std::size_t i) {
  if (i == 0) return model.lowest_omega_squared_rad2_per_s2;
  return model.modes[i].omega_rad_per_s * model.modes[i].omega_rad_per_s;
}

std::vector<Complex> modal_response(const arm::ModalModel& model,
                                    std::span<const arm::Sensor> sensors, Complex s_rad_per_s) {
  const Eigen::VectorXcd q = amplitudes(model, s_rad_per_s);
  std::vector<Complex> response;
  for (std::size_t k = 0; k < sensors.size(); ++k) {
    Complex sum = 0.0;
    // From the smallest term to the largest.
    for (std::size_t i = model.modes.size(); i-- > 0;) {
      sum += model.modes[i].sensor_values.at(k) * q(static_cast<Eigen::Index>(i));
    }
    for (int i = 0; i < arm::derivative_order(sensors[k]); ++i) sum *= s_rad_per_s;
    response.push_back(sum);
  }
  return response;
}

void require_consistent(const arm::ModalModel& model, std::span<const arm::Sensor> sensors) {
  const std::size_t n = model.modes.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (model.modes[i].sensor_values.size() != sensors.size()) {
      throw std::invalid_argument(fmt::format("mode {} has values at {} sensors, not {}", i,
                                              model.modes[i].sensor_values.size(), sensors.size()));
    }
  }
  if (n == 0 || model.damping_rad_per_s.size() != n * n) {
    throw std::invalid_argument(fmt::format("damping matrix of {} entries for {} modes",
                                            model.damping_rad_per_s.size(), n));
  }
  const Damping damping = damping_of(model);
  const double size = damping.cwiseAbs().maxCoeff();
  // Eigenvalues of a symmetric matrix are within n epsilon of its size.
  const double rounding =
      16.0 * static_cast<double>(n) * size * std::numeric_limits<double>::epsilon();
  const bool finite = damping.allFinite();
  const bool symmetric =
      finite && (damping - damping.transpose()).cwiseAbs().maxCoeff() <= rounding;
  if (!symmetric) throw std::invalid_argument("damping matrix: not finite or not symmetric");
  const double lowest =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(damping, Eigen::EigenvaluesOnly)
          .eigenvalues()(0);
  if (lowest < -rounding) {
    throw std::invalid_argument(
        fmt::format("damping matrix: eigenvalue {} rad/s; must be 0 or more", lowest));
  }
}

}  // namespace flexarm::response
