#include "fem/transmission_zeros.hpp"

#include "fem/hub_driven_response.hpp"
#include "fem/static_flexibility.hpp"
#include "fem/vibration_modes.hpp"

#include <Eigen/Eigenvalues>
#include <Spectra/GenEigsSolver.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
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

/// Inverse of the pencil at w = 0: u = response to the loads M v, turned so that c^T u = 0. Its
/// eigenvalues are -1/w; that of the rigid direction is 0, an infinite root.
class InversePencil {
 public:
  using Scalar = double;

  InversePencil(const Discretisation& model, const Eigen::VectorXd& c)
      : model_(model),
        flexibility_(model),
        c_(c),
        // Coordinates scaled by the root of their mass make the problem independent of units.
        scale_(model.mass().diagonal().cwiseSqrt()) {}

  Eigen::Index rows() const { return model_.size(); }
  Eigen::Index cols() const { return model_.size(); }
  void perform_op(const double* x_in, double* y_out) const {
    const Eigen::VectorXd v = Eigen::VectorXd::ConstMapType(x_in, rows()).cwiseQuotient(scale_);
    const Eigen::VectorXd f = model_.mass() * v;
    Eigen::VectorXd u(rows());
    u[0] = 0.0;
    u.tail(model_.clamped_size()) =
        flexibility_.displacements(flexibility_.deformations(f.tail(model_.clamped_size())));
    u -= c_.dot(u) / c_.dot(model_.rigid_rotation()) * model_.rigid_rotation();
    Eigen::VectorXd::MapType(y_out, rows()) = u.cwiseProduct(scale_);
  }

 private:
  const Discretisation& model_;
  StaticFlexibility flexibility_;
  const Eigen::VectorXd& c_;
  Eigen::VectorXd scale_;
};

Eigen::VectorXcd inverse_eigenvalues(const InversePencil& inverse, int count, double tolerance) {
  const Eigen::Index n = inverse.rows();
  if (n <= kDenseSize || 4 * count > n) {
    Eigen::MatrixXd matrix(n, n);
    const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(n, n);
    for (Eigen::Index j = 0; j < n; ++j) {
      inverse.perform_op(unit.col(j).data(), matrix.col(j).data());
    }
    return Eigen::EigenSolver<Eigen::MatrixXd>(matrix, false).eigenvalues();
  }
  constexpr Eigen::Index kMaximumRestarts = 300;
  const Eigen::Index krylov = std::min<Eigen::Index>(n, std::max(2 * count + 1, 20));
  Spectra::GenEigsSolver<const InversePencil> solver(inverse, count, krylov);
  solver.init();
  solver.compute(Spectra::SortRule::LargestMagn, kMaximumRestarts, tolerance);
  return solver.eigenvalues();
}

/// F(w) and F'(w)/F(w).
struct HubTransmission {
  Complex value;
  Complex log_derivative;
  bool singular = false;
};

HubTransmission hub_transmission(const Discretisation& model, const Eigen::VectorXd& c, Complex w) {
  const HubDrivenResponse response(model, 1.0, w);
  if (response.singular()) return {0.0, 0.0, true};
  const Eigen::VectorXcd u = response.to_unit_rotation();
  const Eigen::VectorXcd inertia = model.mass() * u;
  const Eigen::VectorXcd derivative = response.to_loads(-inertia);
  const Complex value = c.cast<Complex>().cwiseProduct(u).sum();
  const Complex slope = c.cast<Complex>().cwiseProduct(derivative).sum();
  return {value, slope / value, false};
}

/// Newton's method on F prod(1 + w/poles)/prod(w - found).
FollowedRoot newton(const Discretisation& model, const Eigen::VectorXd& c, Complex w,
                    int steps_allowed, const Eigen::VectorXd& poles,
                    const std::vector<Complex>& found) {
  FollowedRoot root;
  root.w = w;
  root.last_step = std::numeric_limits<double>::infinity();
  for (; root.newton_steps < steps_allowed; ++root.newton_steps) {
    const HubTransmission f = hub_transmission(model, c, root.w);
    if (f.value == 0.0 && !f.singular) {
      root.converged = true;
      return root;
    }
    Complex log_derivative = f.log_derivative;
    for (const double pole : poles) log_derivative += 1.0 / (root.w + pole);
    for (const Complex other : found) log_derivative -= 1.0 / (root.w - other);
    const Complex step = 1.0 / log_derivative;
    if (!std::isfinite(std::abs(step))) return root;
    const double size = std::abs(step) / std::abs(root.w);
    // Quadratic convergence: a step of kLast leaves an error of about its square. It has ended
    // early, by rounding, when a small step is no longer shrinking.
    constexpr double kLast = 1e-9;
    constexpr double kSmall = 1e-7;
    if (size < kSmall && size >= root.last_step) {
      root.converged = true;
      return root;
    }
    root.w -= step;
    root.last_step = size;
    if (size <= kLast) {
      root.converged = true;
      return root;
    }
  }
  return root;
}

}  // namespace

FollowedRoot follow_root(const Discretisation& discretisation, const Eigen::VectorXd& c,
                         std::complex<double> w) {
  constexpr int kStepsAllowed = 30;
  return newton(discretisation, c, w, kStepsAllowed, Eigen::VectorXd(), {});
}

PencilRoots pencil_roots(const Discretisation& discretisation, const Eigen::VectorXd& c, int count,
                         double tolerance) {
  constexpr int kStepsAllowed = 100;
  PencilRoots roots;
  const InversePencil inverse(discretisation, c);
  const Eigen::VectorXcd mu = inverse_eigenvalues(inverse, count, tolerance);
  std::vector<Complex> guesses;
  for (const Complex value : mu) {
    if (value != 0.0) guesses.push_back(-1.0 / value);
  }
  // A conjugate pair is of one modulus; the member with Im > 0 comes first.
  std::ranges::sort(guesses, {}, [](Complex w) { return std::pair(std::abs(w), -w.imag()); });
  const VibrationModes clamped =
      vibration_modes(discretisation, HubSupport::clamped, count + 4, tolerance);

  std::vector<Complex> divided_out;
  bool conjugate_found = false;
  for (const Complex guess : guesses) {
    if (static_cast<int>(divided_out.size()) >= count) break;
    if (conjugate_found && guess.imag() < 0.0) continue;
    FollowedRoot root =
        newton(discretisation, c, guess, kStepsAllowed, clamped.omega_squared, divided_out);
    roots.newton_steps += root.newton_steps;
    // Rounding makes pairs of guesses for real roots that lie close; each then leads to its own.
    conjugate_found = root.converged && guess.imag() > 0.0 && !is_real(root.w);
    if (!root.converged) {
      roots.converged = false;
      continue;
    }
    roots.largest_step = std::max(roots.largest_step, root.last_step);
    if (is_real(root.w)) {
      root.w = root.w.real();
    } else {
      root.w.imag(std::abs(root.w.imag()));
      divided_out.push_back(std::conj(root.w));
    }
    divided_out.push_back(root.w);
    roots.w.push_back(root.w);
  }
  std::ranges::sort(roots.w, {}, [](Complex w) { return std::abs(w); });
  return roots;
}

int roots_inside(const Discretisation& discretisation, const Eigen::VectorXd& c, double radius,
                 double tolerance) {
  constexpr double kPi = std::numbers::pi;
  constexpr double kLargestTurn = kPi / 4.0;  // of N from one point to the next
  constexpr double kShortestArc = kPi / 4096.0;
  VibrationModes clamped;
  // Poles up to twice the radius are taken out of F; those farther out turn it but little.
  for (int count = 16;; count *= 2) {
    clamped = vibration_modes(discretisation, HubSupport::clamped, count, tolerance);
    const Eigen::Index found = clamped.omega_squared.size();
    if (found < count || clamped.omega_squared[found - 1] > 2.0 * radius) break;
  }
  const auto numerator = [&](double angle) {
    const Complex w = std::polar(radius, angle);
    Complex value = hub_transmission(discretisation, c, w).value;
    for (const double pole : clamped.omega_squared) value *= 1.0 + w / pole;
    return value / std::abs(value);
  };
  // N(conj w) = conj N(w): half the circle turns half as often.
  double angle = 0.0;
  double arc = kPi / 8.0;
  double turned = 0.0;
  Complex here = numerator(angle);
  while (angle < kPi) {
    const double next_angle = std::min(angle + arc, kPi);
    const Complex next = numerator(next_angle);
    const double turn = std::arg(next / here);
    if (!(std::abs(turn) <= kLargestTurn)) {
      arc = (next_angle - angle) / 2.0;
      if (arc < kShortestArc) return -1;
      continue;
    }
    turned += turn;
    angle = next_angle;
    here = next;
    if (std::abs(turn) < kLargestTurn / 2.0) arc *= 2.0;
  }
  return static_cast<int>(std::lround(turned / kPi));
}

}  // namespace flexarm::fem
