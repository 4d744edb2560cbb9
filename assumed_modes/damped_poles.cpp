#include "assumed_modes/damped_poles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <vector>

namespace flexarm::assumed_modes {

namespace {

using Root = std::complex<double>;

/// The roots of one mode: conjugates, or two real ones, `first` the nearer to 0.
struct Pair {
  Root first;
  Root second;
};

Pair pair_of(Root a, Root b) {
  if (a.imag() != 0.0) return {{a.real(), std::abs(a.imag())}, {a.real(), -std::abs(a.imag())}};
  return std::abs(a) <= std::abs(b) ? Pair{a, b} : Pair{b, a};
}

/// Roots below this, in units of the shift, are rounding: a friction too small to be seen.
constexpr double kRoundingOfRoots = 1e-8;

double relative_distance(Root a, Root b, double tau) {
  return std::abs(a - b) / (std::abs(a) + std::abs(b) + kRoundingOfRoots * tau);
}

double distance(const Pair& a, const Pair& b, double tau) {
  const auto between = [tau](Root x, Root y) { return relative_distance(x, y, tau); };
  return std::min(std::max(between(a.first, b.first), between(a.second, b.second)),
                  std::max(between(a.first, b.second), between(a.second, b.first)));
}

/// Roots of mass s^2 + damping s + stiffness, for stiffness of either sign.
Pair roots_of_mode(double mass, double damping, double stiffness) {
  const double half = damping / (2.0 * mass);
  const double square = half * half - stiffness / mass;
  if (square < 0.0) return pair_of({-half, std::sqrt(-square)}, {-half, -std::sqrt(-square)});
  const double larger = -(half + std::sqrt(square));
  return pair_of(larger == 0.0 ? 0.0 : stiffness / mass / larger, larger);
}

/// Follows the roots of the first modes; the pencil is scaled for its shift.
class Continuation {
 public:
  Continuation(const QuadraticPencil& pencil, Real tau, std::size_t modes)
      : pencil_(pencil), tau_(tau), modes_(modes) {}

  std::vector<Pair> followed();
  int steps() const { return steps_; }

 private:
  /// A set of roots that modes take pairs from.
  struct Candidate {
    Pair pair;
    std::size_t first;  ///< index of the root; conjugates count as one
    std::size_t second;
  };
  struct Match {
    std::vector<Pair> pairs;
    bool clear = true;
  };

  std::vector<Pair> uncoupled(double damping_factor) const;
  std::vector<Candidate> candidates(const std::vector<Root>& roots) const;
  Match match(const std::vector<Pair>& former, const std::vector<Root>& roots) const;

  const QuadraticPencil& pencil_;
  Real tau_;
  std::size_t modes_;
  int steps_ = 0;
};

std::vector<Pair> Continuation::uncoupled(double damping_factor) const {
  std::vector<Pair> pairs;
  for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(modes_); ++k) {
    pairs.push_back(roots_of_mode(static_cast<double>(pencil_.mass(k)),
                                  damping_factor * static_cast<double>(pencil_.damping(k, k)),
                                  static_cast<double>(pencil_.stiffness(k))));
  }
  return pairs;
}

std::vector<Continuation::Candidate> Continuation::candidates(
    const std::vector<Root>& roots) const {
  std::vector<Candidate> all;
  for (std::size_t i = 0; i < roots.size(); ++i) {
    if (roots[i].imag() > 0.0) all.push_back({pair_of(roots[i], std::conj(roots[i])), i, i});
    if (roots[i].imag() != 0.0) continue;
    for (std::size_t j = i + 1; j < roots.size(); ++j) {
      if (roots[j].imag() == 0.0) all.push_back({pair_of(roots[i], roots[j]), i, j});
    }
  }
  return all;
}

/// From the highest mode to the lowest, so that a collision leaves the lower mode what is left.
Continuation::Match Continuation::match(const std::vector<Pair>& former,
                                        const std::vector<Root>& roots) const {
  constexpr double kClear = 1.0 / 3.0;
  constexpr double kSame = 1e-6;
  std::vector<Root> available = roots;
  if (pencil_.turns_freely()) available.emplace_back(0.0);
  const std::size_t origin = pencil_.turns_freely() ? available.size() - 1 : available.size();
  const auto all = candidates(available);
  std::vector<bool> taken(available.size(), false);
  Match result{std::vector<Pair>(former.size()), true};
  for (std::size_t mode = former.size(); mode-- > 0;) {
    double nearest = std::numeric_limits<double>::infinity();
    double next = nearest;
    const Candidate* chosen = nullptr;
    for (const Candidate& candidate : all) {
      // The root at the origin belongs to the lowest mode.
      const bool has_origin = candidate.first == origin || candidate.second == origin;
      if (has_origin != (mode == 0 && origin < available.size())) continue;
      const double size = distance(former[mode], candidate.pair, static_cast<double>(tau_));
      const bool is_taken = taken[candidate.first] || taken[candidate.second];
      if (!is_taken && size < nearest) {
        next = std::min(next, nearest);
        nearest = size;
        chosen = &candidate;
      } else {
        next = std::min(next, size);
      }
    }
    if (chosen == nullptr) return {former, false};
    taken[chosen->first] = true;
    taken[chosen->second] = true;
    result.pairs[mode] = chosen->pair;
    result.clear = result.clear && (nearest <= kClear * next || nearest <= kSame);
  }
  return result;
}

std::vector<Pair> Continuation::followed() {
  constexpr double kSmallestStep = 1.0 / 64;
  double factor = 0.0;
  double step = 1.0;
  std::vector<Pair> current;
  while (factor < 1.0) {
    const double next = std::min(1.0, factor + step);
    const auto roots = all_roots(pencil_, tau_, next);
    const Match found = match(factor == 0.0 ? uncoupled(next) : current, roots);
    ++steps_;
    if (!found.clear && step > kSmallestStep) {
      step /= 2.0;
      continue;
    }
    current = found.pairs;
    factor = next;
    step *= 2.0;
  }
  return current;
}

}  // namespace

arm::DampedPoleSet damped_poles(const QuadraticPencil& pencil, int flexible,
                                double omega_scale_rad_per_s) {
  const Real tau = shift_of(pencil);
  const QuadraticPencil scaled = pencil.scaled(tau);
  Continuation continuation(scaled, tau, static_cast<std::size_t>(flexible) + 1);

  arm::DampedPoleSet result;
  const auto to_rad_per_s = [&](const Root& start) -> Root {
    if (start == 0.0) return 0.0;
    const PolishedRoot root = polished(scaled, std::complex<Real>(start));
    result.summary.largest_residual =
        std::max(result.summary.largest_residual, static_cast<double>(root.last_step));
    const auto s_rad_per_s = root.s * static_cast<Real>(omega_scale_rad_per_s);
    return start.imag() == 0.0 ? Root(static_cast<double>(s_rad_per_s.real())) : Root(s_rad_per_s);
  };
  std::vector<Pair> pairs = continuation.followed();
  if (pencil.turns_freely() &&
      std::abs(pairs[0].second) <= kRoundingOfRoots * static_cast<double>(tau)) {
    pairs[0] = {0.0, static_cast<double>(-scaled.damping(0, 0) / scaled.mass(0))};
  }
  for (const Pair& pair : pairs) {
    arm::PolePair poles;
    poles.first_rad_per_s = to_rad_per_s(pair.first);
    poles.second_rad_per_s =
        pair.first.imag() != 0.0 ? std::conj(poles.first_rad_per_s) : to_rad_per_s(pair.second);
    result.flexible.push_back(poles);
  }
  result.lowest = result.flexible.front();
  result.flexible.erase(result.flexible.begin());
  result.summary.iterations = continuation.steps();
  result.summary.method = fmt::format(
      "companion matrix of the shifted quadratic pencil in {} modes, continuation from zero "
      "damping; residual: last relative step of Newton's method",
      pencil.mass.size());
  constexpr double kConverged = 1e-12;
  result.summary.converged = result.summary.largest_residual <= kConverged;
  return result;
}

}  // namespace flexarm::assumed_modes
