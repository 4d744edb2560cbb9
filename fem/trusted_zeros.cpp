#include "fem/trusted_zeros.hpp"

#include "fem/root_audit.hpp"
#include "fem/sensor_row.hpp"

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

Candidate follow(Complex w, const PoleFreeNumerator& fine, const PoleFreeNumerator& finer) {
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
  if (!candidate.counterpart) return "no corresponding zero of the refined model";
  if (!(candidate.change <= agreement)) {
    return fmt::format("relative change above {} in the refined model", agreement);
  }
  const auto has_nearer_claim = [&](const Candidate& other) {
    return other.counterpart && same(*other.counterpart, *candidate.counterpart) &&
           other.change < candidate.change;
  };
  if (std::ranges::any_of(all, has_nearer_claim)) {
    return "a closer root corresponds to the same zero of the refined model";
  }
  if (!(candidate.further_change <=
        std::max(kConvergence * candidate.change, kNegligible * agreement))) {
    return "no convergence under refinement";
  }
  return {};
}

/// Sorts the roots into trusted and rejected, in ascending order, until `count` are trusted;
/// returns how many it looked at. Those from number `complete` on are rejected.
std::size_t sort_out(const std::vector<Candidate>& candidates, std::size_t complete, int count,
                     double agreement, arm::ZeroSet& zeros) {
  zeros.s_rad_per_s.clear();
  zeros.relative_change.clear();
  zeros.rejected.clear();
  std::size_t looked_at = 0;
  for (const Candidate& candidate : candidates) {
    if (static_cast<int>(zeros.s_rad_per_s.size()) == count) break;
    std::string reason = looked_at < complete ? reason_against(candidate, candidates, agreement)
                                              : "beyond a zero that the search missed";
    ++looked_at;
    if (reason.empty()) {
      zeros.s_rad_per_s.push_back(candidate.s);
      zeros.relative_change.push_back(candidate.change);
    } else {
      zeros.rejected.push_back({candidate.s, candidate.change, std::move(reason)});
    }
  }
  return looked_at;
}

}  // namespace

CheckedNumerators::CheckedNumerators(const Discretisation& discretisation,
                                     const CheckingModels& checking, const arm::Sensor& sensor,
                                     int poles, double tolerance)
    : model(discretisation, SensorRow(discretisation, sensor), poles, tolerance),
      fine(checking.fine, SensorRow(checking.fine, sensor), poles, tolerance),
      finer(checking.finer, SensorRow(checking.finer, sensor), poles, tolerance) {}

JudgedZeros judge(const PencilRoots& roots, const CheckedNumerators& numerators, int count,
                  double agreement) {
  JudgedZeros judged;
  arm::ZeroSet& zeros = judged.zeros;
  std::vector<Candidate> candidates;
  for (const Complex w : roots.w) {
    candidates.push_back(follow(w, numerators.fine, numerators.finer));
  }
  const std::size_t looked_at = sort_out(candidates, candidates.size(), count, agreement, zeros);
  judged.complete = looked_at;
  zeros.count = {static_cast<int>(looked_at), -1, "argument principle"};
  if (looked_at > 0) {
    const RootAudit counted = audit(roots.w, looked_at, numerators.model);
    zeros.count.expected = counted.expected;
    judged.complete = counted.complete;
  }
  judged.gap = judged.complete < looked_at;
  if (judged.gap) sort_out(candidates, judged.complete, count, agreement, zeros);
  zeros.summary = {
      "Rosenbrock pencil by eigenvalues at s = 0, Newton's method (residual: last step in s^2)",
      roots.newton_steps, roots.largest_step, roots.converged && !judged.gap};
  return judged;
}

arm::ZeroSet trusted_zeros(const Discretisation& model, const CheckingModels& checking,
                           const arm::Sensor& sensor, int count, const TrustOptions& options) {
  // Some spurious roots may lie between the zeros, and the last root counted needs one beyond it.
  constexpr int kSpare = 4;
  const SensorRow row(model, sensor);
  if (row.constant().isZero(0.0)) return {};
  const int finite = model.size() + 1 - row.infinite_roots();
  const int wanted = std::min(count + kSpare, finite);
  // There are up to sqrt(2) poles for a root, and more of a sheared beam, whose real zeros follow
  // the decay along the beam and whose poles follow its slower waves.
  const int poles = (model.arm().shear ? 4 : 2) * wanted;
  const CheckedNumerators numerators(model, checking, sensor, poles, options.eigen_tolerance);
  PencilRoots roots = pencil_roots(model, numerators.model, wanted, options.eigen_tolerance);
  JudgedZeros judged = judge(roots, numerators, count, options.agreement);
  const auto missing = [&] { return judged.zeros.count.expected > judged.zeros.count.found; };
  for (int search = 0; search < wanted && missing(); ++search) {
    if (!search_beside(judged.complete, numerators.model, roots)) break;
    judged = judge(roots, numerators, count, options.agreement);
  }
  judged.zeros.infinite = row.infinite_roots();
  return std::move(judged.zeros);
}

}  // namespace flexarm::fem
