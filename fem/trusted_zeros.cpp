#include "fem/trusted_zeros.hpp"

#include "fem/sensor_row.hpp"
#include "fem/transmission_zeros.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::fem {

namespace {

using Complex = std::complex<double>;

/// The one of +-sqrt(w), +-conj(sqrt(w)) with Re >= 0 and Im >= 0.
Complex first_quadrant_root(Complex w) {
  const Complex s = std::sqrt(w);
  return {std::abs(s.real()), std::abs(s.imag())};
}

/// A root on its way through the finer models.
struct Candidate {
  Complex s;
  std::optional<Complex> counterpart;                               ///< s' on the fine model
  double change = std::numeric_limits<double>::infinity();          ///< |s - s'|/|s'|
  double further_change = std::numeric_limits<double>::infinity();  ///< |s' - s''|/|s''|
};

Candidate follow(Complex w, const CheckingModels& checking, const Eigen::VectorXd& fine_row,
                 const Eigen::VectorXd& finer_row) {
  Candidate candidate;
  candidate.s = first_quadrant_root(w);
  const FollowedRoot fine = follow_root(checking.fine, fine_row, w);
  if (!fine.converged) return candidate;
  candidate.counterpart = first_quadrant_root(fine.w);
  candidate.change =
      std::abs(candidate.s - *candidate.counterpart) / std::abs(*candidate.counterpart);
  const FollowedRoot finer = follow_root(checking.finer, finer_row, fine.w);
  if (!finer.converged) return candidate;
  const Complex last = first_quadrant_root(finer.w);
  candidate.further_change = std::abs(*candidate.counterpart - last) / std::abs(last);
  return candidate;
}

bool same(Complex a, Complex b) {
  constexpr double kSameRoot = 1e-8;
  return std::abs(a - b) <= kSameRoot * std::abs(b);
}

/// Why `candidate` is not trusted; empty when it is.
std::string reason_against(const Candidate& candidate, const std::vector<Candidate>& all,
                           double agreement) {
  constexpr double kConvergence = 0.1;
  constexpr double kRounding = 1e-8;
  if (!candidate.counterpart) return "has no counterpart on a finer model";
  if (!(candidate.change <= agreement)) {
    return fmt::format("moves by more than {} on a finer model", agreement);
  }
  const auto has_nearer_claim = [&](const Candidate& other) {
    return other.counterpart && same(*other.counterpart, *candidate.counterpart) &&
           other.change < candidate.change;
  };
  if (std::ranges::any_of(all, has_nearer_claim)) {
    return "a nearer root has the same counterpart on a finer model";
  }
  if (!(candidate.further_change <= std::max(kConvergence * candidate.change, kRounding))) {
    return "does not converge on finer models";
  }
  return {};
}

/// Fills `count` of `zeros` for the roots w(0) ... w(looked_at - 1) by the argument principle.
arm::RootCount count_roots(const Discretisation& model, const Eigen::VectorXd& c,
                           const std::vector<Complex>& w, std::size_t looked_at, double tolerance) {
  // A count takes some fifty factorisations; for larger models that is dearer than the search.
  constexpr int kLargestCounted = 250;
  arm::RootCount count;
  count.found = static_cast<int>(looked_at);
  if (looked_at == w.size() || model.size() > kLargestCounted) return count;
  const double radius = std::sqrt(std::abs(w[looked_at - 1]) * std::abs(w[looked_at]));
  const int inside = roots_inside(model, c, radius, tolerance);
  count.method = "argument principle";
  const auto pairs = std::count_if(w.begin(), w.begin() + static_cast<std::ptrdiff_t>(looked_at),
                                   [](Complex root) { return root.imag() != 0.0; });
  if (inside >= 0) count.expected = inside - static_cast<int>(pairs);
  return count;
}

}  // namespace

arm::ZeroSet trusted_zeros(const Discretisation& model, const CheckingModels& checking,
                           const arm::Arm& arm, const arm::Sensor& sensor, int count,
                           const TrustOptions& options) {
  // Some spurious roots may lie between the zeros, and the last root counted needs one beyond it.
  constexpr int kSpare = 4;
  arm::ZeroSet zeros;
  const SensorRow row = sensor_row(model, arm, sensor);
  if (row.c.isZero(0.0)) return zeros;
  const Eigen::VectorXd fine_row = sensor_row(checking.fine, arm, sensor).c;
  const Eigen::VectorXd finer_row = sensor_row(checking.finer, arm, sensor).c;

  const int finite = model.size() + 1 - row.infinite_roots;
  const PencilRoots roots =
      pencil_roots(model, row.c, std::min(count + kSpare, finite), options.eigen_tolerance);
  std::vector<Candidate> candidates;
  for (const Complex w : roots.w) {
    candidates.push_back(follow(w, checking, fine_row, finer_row));
  }
  std::size_t looked_at = 0;
  for (const Candidate& candidate : candidates) {
    if (static_cast<int>(zeros.s_rad_per_s.size()) == count) break;
    ++looked_at;
    std::string reason = reason_against(candidate, candidates, options.agreement);
    if (reason.empty()) {
      zeros.s_rad_per_s.push_back(candidate.s);
    } else {
      zeros.rejected.push_back({candidate.s, candidate.change, std::move(reason)});
    }
  }
  if (looked_at > 0) {
    zeros.count = count_roots(model, row.c, roots.w, looked_at, options.eigen_tolerance);
  }
  zeros.infinite = row.infinite_roots;
  zeros.summary = {"Rosenbrock pencil by eigenvalues at s = 0, Newton's method", roots.newton_steps,
                   roots.largest_step, roots.converged};
  return zeros;
}

}  // namespace flexarm::fem
