#include "fem/trusted_zeros.hpp"

#include "fem/numerator.hpp"
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

Candidate follow(Complex w, const Numerator& fine, const Numerator& finer) {
  constexpr int kStepsAllowed = 30;
  Candidate candidate;
  candidate.s = first_quadrant_root(w);
  const NewtonResult first = fine.root_near(w, {}, kStepsAllowed);
  if (!first.converged) return candidate;
  candidate.counterpart = first_quadrant_root(first.w);
  candidate.change =
      std::abs(candidate.s - *candidate.counterpart) / std::abs(*candidate.counterpart);
  const NewtonResult second = finer.root_near(first.w, {}, kStepsAllowed);
  if (!second.converged) return candidate;
  const Complex last = first_quadrant_root(second.w);
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
  constexpr double kNegligible = 1e-3;
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
  if (!(candidate.further_change <=
        std::max(kConvergence * candidate.change, kNegligible * agreement))) {
    return "does not converge on finer models";
  }
  return {};
}

/// The roots w(0) ... w(looked_at - 1) beside what the argument principle counts.
arm::RootCount count_of(const std::vector<Complex>& w, std::size_t looked_at,
                        const Numerator& numerator) {
  arm::RootCount count;
  count.found = static_cast<int>(looked_at);
  if (looked_at == 0 || looked_at == w.size()) return count;
  const double radius = std::sqrt(std::abs(w[looked_at - 1]) * std::abs(w[looked_at]));
  const int inside = numerator.roots_inside(radius);
  const auto pairs = std::count_if(w.begin(), w.begin() + static_cast<std::ptrdiff_t>(looked_at),
                                   [](Complex root) { return root.imag() != 0.0; });
  if (inside >= 0) count.expected = inside - static_cast<int>(pairs);
  count.method = "argument principle";
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
  const int finite = model.size() + 1 - row.infinite_roots;
  const int wanted = std::min(count + kSpare, finite);
  // There are up to sqrt(2) poles for a root.
  const int poles = 2 * wanted;
  const auto numerator_of = [&](const Discretisation& discretisation) {
    return Numerator(discretisation, sensor_row(discretisation, arm, sensor).c, poles,
                     options.eigen_tolerance);
  };
  const Numerator numerator = numerator_of(model);
  const Numerator fine = numerator_of(checking.fine);
  const Numerator finer = numerator_of(checking.finer);
  const PencilRoots roots = pencil_roots(model, numerator, wanted, options.eigen_tolerance);
  std::vector<Candidate> candidates;
  for (const Complex w : roots.w) candidates.push_back(follow(w, fine, finer));
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
  // The count takes some hundred factorisations; for a large model that is dearer than the search.
  constexpr int kLargestCounted = 500;
  if (model.size() <= kLargestCounted) {
    zeros.count = count_of(roots.w, looked_at, numerator);
  } else {
    zeros.count.found = static_cast<int>(looked_at);
  }
  zeros.infinite = row.infinite_roots;
  zeros.summary = {
      "Rosenbrock pencil by eigenvalues at s = 0, Newton's method (residual: last step in s^2)",
      roots.newton_steps, roots.largest_step, roots.converged};
  return zeros;
}

}  // namespace flexarm::fem
