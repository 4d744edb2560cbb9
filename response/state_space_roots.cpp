#include "response/state_space_roots.hpp"

#include "arm/input_error.hpp"

#include <Eigen/Dense>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace flexarm::response {

namespace {

using Complex = std::complex<double>;

/// A Markov parameter C v is 0 if |C v| <= kZeroMarkov |C| |v|: those that are not are sums of some
/// ten modes of like size, those that are hold but rounding.
constexpr double kZeroMarkov = 1e-12;

/// Powers of 2 that make the off-diagonal parts of the rows and columns of A of like size, as
/// LAPACK's dgebal does; displacements and velocities differ by the highest frequency.
Eigen::VectorXd balance(Eigen::MatrixXd a) {
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(a.rows());
  constexpr int kMostSweeps = 20;
  bool changes = true;
  for (int sweep = 0; changes && sweep < kMostSweeps; ++sweep) {
    changes = false;
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      const double own = a(i, i) * a(i, i);
      const double row = std::sqrt(std::max(0.0, a.row(i).squaredNorm() - own));
      const double column = std::sqrt(std::max(0.0, a.col(i).squaredNorm() - own));
      if (row == 0.0 || column == 0.0) continue;
      const double factor = std::exp2(std::round(0.5 * std::log2(row / column)));
      if (factor == 1.0) continue;
      a.col(i) *= factor;
      a.row(i) /= factor;
      scale[i] *= factor;
      changes = true;
    }
  }
  return scale;
}

std::vector<Complex> sorted_eigenvalues(const Eigen::MatrixXd& a) {
  if (a.rows() == 0) return {};
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(a, false);
  std::vector<Complex> roots(solver.eigenvalues().begin(), solver.eigenvalues().end());
  std::ranges::sort(roots, {},
                    [](const Complex& s) { return std::tuple(std::abs(s), -s.real(), -s.imag()); });
  // The two of a pair may differ in |s| by rounding.
  for (std::size_t i = 0; i + 1 < roots.size(); ++i) {
    if (roots[i].imag() < 0.0 && roots[i] == std::conj(roots[i + 1])) {
      std::swap(roots[i], roots[i + 1]);
    }
  }
  return roots;
}

}  // namespace

std::vector<Complex> poles(const StateSpace& system) {
  const Eigen::VectorXd scale = balance(system.a);
  const Eigen::MatrixXd a = scale.cwiseInverse().asDiagonal() * system.a * scale.asDiagonal();
  return sorted_eigenvalues(a);
}

std::vector<Complex> zeros(const StateSpace& system, const arm::Sensor& sensor) {
  const auto place = std::ranges::find(system.sensors, sensor);
  if (place == system.sensors.end()) {
    throw arm::InputError(
        fmt::format("{}: not among the sensors of the state space", arm::to_string(sensor)));
  }
  const Eigen::Index row = place - system.sensors.begin();
  const Eigen::VectorXd scale = balance(system.a);
  const Eigen::MatrixXd a = scale.cwiseInverse().asDiagonal() * system.a * scale.asDiagonal();
  const Eigen::VectorXd b = scale.cwiseInverse().asDiagonal() * system.b;
  const Eigen::RowVectorXd c = system.c.row(row) * scale.asDiagonal();
  const double d = system.d(row, 0);
  if (d != 0.0) {
    const Eigen::MatrixXd inverse = a - b * (c / d);
    return sorted_eigenvalues(inverse);
  }
  const Eigen::Index states = a.rows();
  Eigen::MatrixXd held(states, 0);  // columns C', (C A)', ..., each of length 1
  Eigen::RowVectorXd derivative = c;
  while (held.cols() < states && derivative.norm() > 0.0) {
    derivative.normalize();
    held.conservativeResize(Eigen::NoChange, held.cols() + 1);
    held.rightCols(1) = derivative.transpose();
    const double markov = derivative.dot(b);
    const Eigen::RowVectorXd next = derivative * a;
    if (std::abs(markov) > kZeroMarkov * b.norm()) {
      const Eigen::MatrixXd inverse = a - b * (next / markov);
      const Eigen::HouseholderQR<Eigen::MatrixXd> factors(held);
      const Eigen::MatrixXd q = factors.householderQ();
      const Eigen::MatrixXd free = q.rightCols(states - held.cols());
      const Eigen::MatrixXd restricted = free.transpose() * inverse * free;
      return sorted_eigenvalues(restricted);
    }
    derivative = next;
  }
  return {};
}

}  // namespace flexarm::response
