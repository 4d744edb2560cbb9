#include "fem/damped_poles.hpp"

#include "fem/damping_continuation.hpp"
#include "fem/hub_driven_response.hpp"
#include "fem/vibration_modes.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace flexarm::fem {

namespace {

using Complex = std::complex<double>;

/// Shapes and their natural deformations, by columns.
struct Basis {
  Eigen::MatrixXd u;
  Eigen::MatrixXd d;
};

/// The lowest mode and `count` flexible ones with the hub free, then what `count` modes with the
/// hub held add to them, M-orthonormal.
Basis modes_of_both_supports(const Discretisation& model, const VibrationModes& free,
                             const VibrationModes& held) {
  const Eigen::Index flexible = free.omega_squared.size();
  const Eigen::Index most = 1 + flexible + held.omega_squared.size();
  Basis basis{Eigen::MatrixXd(model.size(), most), Eigen::MatrixXd(model.clamped_size(), most)};
  basis.u.leftCols(1 + flexible) << free.lowest.u, free.shapes;
  basis.d.leftCols(1 + flexible) << free.lowest.d, free.deformations;
  Eigen::Index used = 1 + flexible;
  for (Eigen::Index j = 0; j < held.omega_squared.size(); ++j) {
    constexpr int kPasses = 2;  // the second takes out the rounding of the first
    constexpr double kNothingNew = 1e-4;
    Eigen::VectorXd u = held.shapes.col(j);
    Eigen::VectorXd d = held.deformations.col(j);
    bool adds = true;
    for (int pass = 0; pass < kPasses && adds; ++pass) {
      const Eigen::VectorXd known = basis.u.leftCols(used).transpose() * (model.mass() * u);
      u -= basis.u.leftCols(used) * known;
      d -= basis.d.leftCols(used) * known;
      const double norm = std::sqrt(u.dot(model.mass() * u));
      adds = norm > kNothingNew;
      u /= norm;
      d /= norm;
    }
    if (!adds) continue;
    basis.u.col(used) = u;
    basis.d.col(used) = d;
    ++used;
  }
  return {basis.u.leftCols(used), basis.d.leftCols(used)};
}

/// The arm in the modes of its own projection on `basis`, to which the basis is turned.
ModalVibration project(const Discretisation& model, Basis& basis) {
  const Eigen::MatrixXd stiffness = model.stiffness_products<double>(basis.u, basis.d);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(stiffness);
  ModalVibration vibration;
  vibration.omega_squared = modes.eigenvalues();
  // Of a free hub it is 0 by construction; the solver leaves rounding.
  if (model.turns_freely()) vibration.omega_squared[0] = 0.0;
  basis.u = (basis.u * modes.eigenvectors()).eval();
  basis.d = (basis.d * modes.eigenvectors()).eval();
  vibration.damping = model.damping_products<double>(basis.u, basis.d);
  return vibration;
}

/// The root of a s^2 + b s + c nearest to `near`.
Complex nearest_root(Complex a, Complex b, Complex c, Complex near) {
  const Complex root = std::sqrt(b * b - 4.0 * a * c);
  // The sum without cancellation first.
  const Complex sum = std::real(std::conj(b) * root) >= 0.0 ? -(b + root) / 2.0 : -(b - root) / 2.0;
  if (sum == 0.0) return 0.0;
  const Complex one = sum / a;
  const Complex other = c / sum;
  return std::abs(one - near) <= std::abs(other - near) ? one : other;
}

struct Refined {
  Complex s;
  int iterations = 0;
  double last_change = std::numeric_limits<double>::infinity();
};

/// Inverse iteration with the shift at the root of the quotient.
Refined refine(const Discretisation& model, Complex s, Eigen::VectorXcd x) {
  constexpr int kMost = 12;
  constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
  constexpr double kSettled = 1e-9;
  Refined refined{s};
  while (refined.iterations < kMost) {
    ++refined.iterations;
    const ShapeOf<Complex> y = free_response(model, refined.s, model.mass() * x);
    const double size = y.u.cwiseAbs().maxCoeff();
    if (!std::isfinite(size) || size == 0.0) break;
    const Eigen::VectorXcd u = y.u / size;
    const Eigen::VectorXcd d = y.d / size;
    const Complex a = u.cwiseProduct(model.mass() * u).sum();
    const Complex next = nearest_root(a, model.damping_products<Complex>(u, d)(0, 0),
                                      model.stiffness_products<Complex>(u, d)(0, 0), refined.s);
    const double change = std::abs(next - refined.s) / std::abs(next);
    x = u;
    if (change < kSettled && change >= refined.last_change) break;
    refined.s = next;
    refined.last_change = change;
    if (change <= kRounding) break;
  }
  return refined;
}

/// Refines the roots of a pair, which stay conjugates or real, near the places where the projection
/// has them; else it is too coarse.
RootPair refine_pair(const Discretisation& model, const DampedPair& pair,
                     const Eigen::MatrixXd& basis, DampedRoots& roots, int& unsettled) {
  constexpr double kSettled = 1e-9;
  constexpr double kNear = 0.1;
  const bool is_real = pair.first.imag() == 0.0;
  const auto refined_root = [&](Complex s, const Eigen::VectorXcd& shape) -> Complex {
    if (s == 0.0) return s;  // nothing holds the hub
    const Refined refined = refine(model, s, basis * shape);
    roots.iterations += refined.iterations;
    roots.largest_change = std::max(roots.largest_change, refined.last_change);
    const double size = std::abs(refined.s);
    const bool is_settled = refined.last_change <= kSettled &&
                            std::abs(refined.s - s) <= kNear * size &&
                            (!is_real || std::abs(refined.s.imag()) <= kSettled * size);
    if (!is_settled) ++unsettled;
    return is_real ? Complex(refined.s.real(), 0.0) : refined.s;
  };
  const Complex first = refined_root(pair.first, pair.first_shape);
  if (!is_real) return {first, std::conj(first)};
  const Complex second = refined_root(pair.second, pair.second_shape);
  return std::abs(first) <= std::abs(second) ? RootPair{first, second} : RootPair{second, first};
}

/// Whether two of the roots are one, but for a double root of one pair.
bool has_duplicates(const std::vector<RootPair>& pairs) {
  constexpr double kSame = 1e-8;
  std::vector<std::pair<Complex, std::size_t>> roots;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    roots.emplace_back(pairs[i].first, i);
    roots.emplace_back(pairs[i].second, i);
  }
  for (std::size_t i = 0; i < roots.size(); ++i) {
    for (std::size_t j = i + 1; j < roots.size(); ++j) {
      const Complex s = roots[i].first;
      if (roots[i].second != roots[j].second &&
          std::abs(s - roots[j].first) <= kSame * std::abs(s)) {
        return true;
      }
    }
  }
  return false;
}

/// C = kv K: every mode keeps its shape, s^2 + kv omega^2 s + omega^2 = 0.
DampedRoots proportional_roots(const VibrationModes& modes, double kelvin_voigt) {
  DampedRoots roots;
  const auto add = [&](double omega_squared) {
    const double half = kelvin_voigt * omega_squared / 2.0;
    const double discriminant = half * half - omega_squared;
    if (discriminant < 0.0) {
      const Complex first(-half, std::sqrt(-discriminant));
      roots.pairs.push_back({first, std::conj(first)});
    } else {
      const double far = -half - std::copysign(std::sqrt(discriminant), half);
      const double near = far == 0.0 ? 0.0 : omega_squared / far;
      roots.pairs.push_back({near, far});
    }
  };
  add(modes.lowest_omega_squared);
  for (const double omega_squared : modes.omega_squared) add(omega_squared);
  roots.largest_change = modes.largest_change;
  roots.converged = modes.converged;
  return roots;
}

}  // namespace

DampedRoots damped_roots(const Discretisation& discretisation, int count, double tolerance) {
  if (discretisation.is_damped_in_proportion()) {
    return proportional_roots(vibration_modes(discretisation, HubSupport::free, count, tolerance),
                              discretisation.kelvin_voigt());
  }
  // Modes above those asked for, by which damping couples them.
  constexpr int kSpare = 10;
  constexpr int kTries = 3;
  DampedRoots roots;
  int spare = kSpare;
  for (int attempt = 0; attempt < kTries; ++attempt, spare *= 4) {
    const int used = std::min(count + spare, discretisation.clamped_size());
    Basis basis = modes_of_both_supports(
        discretisation, vibration_modes(discretisation, HubSupport::free, used, tolerance),
        vibration_modes(discretisation, HubSupport::clamped, used, tolerance));
    const ModalVibration vibration = project(discretisation, basis);
    const ContinuedPairs continued = continue_damping(vibration);
    roots = {};
    int unsettled = 0;
    const std::size_t wanted =
        std::min(static_cast<std::size_t>(count) + 1, continued.pairs.size());
    for (std::size_t i = 0; i < wanted; ++i) {
      roots.pairs.push_back(
          refine_pair(discretisation, continued.pairs[i], basis.u, roots, unsettled));
    }
    const bool twice = has_duplicates(roots.pairs);
    roots.converged = unsettled == 0 && continued.certain && !twice;
    if (roots.converged || used == discretisation.clamped_size()) break;
  }
  return roots;
}

}  // namespace flexarm::fem
