#include "fem/transmission_zeros.hpp"

#include "fem/flexible_solve.hpp"
#include "fem/root_audit.hpp"

#include <Eigen/Eigenvalues>
#include <Spectra/GenEigsSolver.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace flexarm::fem {

namespace {

using Complex = std::complex<double>;

/// Up to this many coordinates the dense eigenproblem costs no more than some ten milliseconds.
constexpr int kDenseSize = 160;

bool is_real(Complex w) {
  // Newton's last step leaves rounding of some epsilon; true pairs of complex roots lie far apart.
  constexpr double kRealPart = 1e-9;
  return std::abs(w.imag()) <= kRealPart * std::abs(w);
}

/// Inverse of the pencil at w = shift: u = response to the loads M v, turned so that
/// c^T u = (dc/dw)^T v. Its eigenvalues are 1/(shift - w); that of the rigid direction is 0, an
/// infinite root.
class InversePencil {
 public:
  using Scalar = double;

  InversePencil(const Discretisation& model, const SensorRow& row)
      : model_(model),
        clamped_(model, HubSupport::clamped),
        c_(row.constant()),
        dc_dw_(row.times_w()),
        turned_(model.has_weight() ? turned(model, shift()) : model.rigid_rotation()),
        // Coordinates scaled by the root of their mass make the problem independent of units.
        scale_(model.mass().diagonal().cwiseSqrt()) {
    if (dc_dw_.size() > 0) c_ += shift() * dc_dw_;
  }

  double shift() const { return clamped_.shift(); }
  Eigen::Index rows() const { return model_.size(); }
  Eigen::Index cols() const { return model_.size(); }
  void perform_op(const double* x_in, double* y_out) const {
    const Eigen::VectorXd v = Eigen::VectorXd::ConstMapType(x_in, rows()).cwiseQuotient(scale_);
    Eigen::VectorXd u = clamped_(model_.mass() * v).u;
    const double wanted = dc_dw_.size() > 0 ? dc_dw_.dot(v) : 0.0;
    u += (wanted - c_.dot(u)) / c_.dot(turned_) * turned_;
    Eigen::VectorXd::MapType(y_out, rows()) = u.cwiseProduct(scale_);
  }

 private:
  static Eigen::VectorXd turned(const Discretisation& model, double w) {
    return HubDrivenResponse<double>(model, undamped_dynamics(model, w)).to_unit_rotation().u;
  }

  const Discretisation& model_;
  FlexibleSolve clamped_;
  Eigen::VectorXd c_;
  Eigen::VectorXd dc_dw_;
  Eigen::VectorXd turned_;
  Eigen::VectorXd scale_;
};

std::runtime_error eigensolver_failure(const char* method, const Discretisation& model, int count) {
  return std::runtime_error(
      fmt::format("fem: {} iteration failed for first guesses at the {} smallest zeros of {}",
                  method, count, describe(model)));
}

Eigen::VectorXcd inverse_eigenvalues(const Discretisation& model, const InversePencil& inverse,
                                     int count, double tolerance) {
  const Eigen::Index n = inverse.rows();
  if (n <= kDenseSize || 4 * count > n) {
    Eigen::MatrixXd matrix(n, n);
    const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(n, n);
    for (Eigen::Index j = 0; j < n; ++j) {
      inverse.perform_op(unit.col(j).data(), matrix.col(j).data());
    }
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(matrix, false);
    if (solver.info() != Eigen::Success) throw eigensolver_failure("QR", model, count);
    return solver.eigenvalues();
  }
  constexpr Eigen::Index kMaximumRestarts = 300;
  const Eigen::Index krylov = std::min<Eigen::Index>(n, std::max(2 * count + 1, 20));
  Spectra::GenEigsSolver<const InversePencil> solver(inverse, count, krylov);
  try {
    solver.init();
    solver.compute(Spectra::SortRule::LargestMagn, kMaximumRestarts, tolerance);
  } catch (const std::runtime_error&) {
    throw eigensolver_failure("Arnoldi", model, count);
  }
  return solver.eigenvalues();
}

constexpr int kStepsAllowed = 100;

double modulus(Complex w) {
  return std::abs(w);
}

/// Adds what Newton's method found to the roots; `divided_out` takes both of a conjugate pair.
void add(const NewtonResult& result, PencilRoots& roots, std::vector<Complex>& divided_out) {
  const Complex w = is_real(result.w) ? Complex(result.w.real(), 0.0)
                                      : Complex(result.w.real(), std::abs(result.w.imag()));
  roots.w.push_back(w);
  roots.largest_step = std::max(roots.largest_step, result.last_step);
  divided_out.push_back(w);
  if (w.imag() != 0.0) divided_out.push_back(std::conj(w));
}

}  // namespace

PencilRoots pencil_roots(const Discretisation& discretisation, const PoleFreeNumerator& numerator,
                         int count, double tolerance) {
  PencilRoots roots;
  const InversePencil inverse(discretisation, numerator.row());
  const Eigen::VectorXcd mu = inverse_eigenvalues(discretisation, inverse, count, tolerance);
  std::vector<Complex> guesses;
  for (const Complex value : mu) {
    if (value != 0.0) guesses.push_back(inverse.shift() - 1.0 / value);
  }
  // A conjugate pair is of one modulus; the member with Im > 0 comes first.
  std::ranges::sort(guesses, {}, [](Complex w) { return std::pair(std::abs(w), -w.imag()); });
  std::vector<Complex> divided_out;
  bool conjugate_found = false;
  for (const Complex guess : guesses) {
    if (static_cast<int>(divided_out.size()) >= count) break;
    if (conjugate_found && guess.imag() < 0.0) continue;
    const NewtonResult result = numerator.root_near(guess, divided_out, kStepsAllowed);
    roots.newton_steps += result.steps;
    // Rounding makes pairs of guesses for real roots that lie close; each then leads to its own.
    conjugate_found = result.converged && guess.imag() > 0.0 && !is_real(result.w);
    if (result.converged) add(result, roots, divided_out);
  }
  // Three searches that end beyond the largest root found, or nowhere, have nothing left to find
  // inside. They start near zero and towards either end of the real axis, but off it, so that they
  // can reach complex roots.
  constexpr double kOffAxis = std::numbers::pi / 20.0;
  const int all = discretisation.size() + 1 - numerator.row().infinite_roots();
  for (int beyond = 0; beyond < 3 && static_cast<int>(divided_out.size()) < all;) {
    const double smallest = roots.w.empty() ? 1.0 : modulus(std::ranges::min(roots.w, {}, modulus));
    const double largest = roots.w.empty() ? 1.0 : modulus(std::ranges::max(roots.w, {}, modulus));
    const std::array<Complex, 3> starts = {std::polar(1e-3 * smallest, std::numbers::pi / 4.0),
                                           std::polar(largest / 2.0, kOffAxis),
                                           std::polar(largest / 2.0, std::numbers::pi - kOffAxis)};
    const NewtonResult result =
        numerator.root_near(starts[static_cast<std::size_t>(beyond)], divided_out, kStepsAllowed);
    roots.newton_steps += result.steps;
    if (result.converged) add(result, roots, divided_out);
    const bool enough = static_cast<int>(divided_out.size()) >= count;
    if (!result.converged || (enough && modulus(result.w) >= largest)) ++beyond;
  }
  roots.converged = static_cast<int>(divided_out.size()) >= count;
  std::ranges::sort(roots.w, {}, modulus);
  return roots;
}

bool search_beside(std::size_t k, const PoleFreeNumerator& numerator, PencilRoots& roots) {
  constexpr int kDirections = 8;  // of the upper half plane, both ends of the real axis included
  std::vector<Complex> divided_out;
  for (const Complex w : roots.w) {
    divided_out.push_back(w);
    if (w.imag() != 0.0) divided_out.push_back(std::conj(w));
  }
  const double inner = radius_before(roots.w, k);
  const double outer = radius_before(roots.w, k + 1);
  bool found = false;
  for (const double radius : {outer, std::sqrt(inner * outer), inner}) {
    for (int i = 0; i <= kDirections && !found; ++i) {
      const Complex start = std::polar(radius, std::numbers::pi * i / kDirections);
      const NewtonResult result = numerator.root_near(start, divided_out, kStepsAllowed);
      roots.newton_steps += result.steps;
      if (!result.converged) continue;
      add(result, roots, divided_out);
      found = std::abs(result.w) >= inner && std::abs(result.w) <= outer;
    }
  }
  std::ranges::sort(roots.w, {}, modulus);
  return found;
}

}  // namespace flexarm::fem
