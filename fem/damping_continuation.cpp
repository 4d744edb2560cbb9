#include "fem/damping_continuation.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <utility>

namespace flexarm::fem {

namespace {

using Complex = std::complex<double>;

/// A complex root, Im > 0, or a real one, with the number of its pair.
template <class Number>
struct Labelled {
  Number s;
  Number foreseen;  ///< where it points to at the next t
  std::size_t pair;
};

/// All roots at one t.
struct Roots {
  std::vector<Labelled<Complex>> complex;
  std::vector<Labelled<double>> real;  ///< ascending
};

/// First-order form of the vibration: velocities v = q_t and scaled displacements z = S q, but for
/// a coordinate with omega = 0, whose displacement nothing feels:
///
///     z_t = S v,   v_t = -Omega^2 S^-1 z - t C v.
class FirstOrder {
 public:
  explicit FirstOrder(const ModalVibration& vibration)
      : damping_(vibration.damping),
        free_(vibration.omega_squared[0] == 0.0 ? 1 : 0),
        size_(vibration.omega_squared.size()) {
    const Eigen::VectorXd held = vibration.omega_squared.tail(size_ - free_);
    scale_ = held.cwiseAbs().cwiseSqrt();
    // The lowest may be next to 0; any scale will do for it.
    if (free_ == 0 && size_ > 1) scale_[0] = std::max(scale_[0], 1e-3 * scale_[1]);
    if (free_ == 0 && scale_[0] == 0.0) scale_[0] = 1.0;
    restoring_ = held.cwiseQuotient(scale_);
  }

  bool has_zero_root() const { return free_ == 1; }

  Eigen::MatrixXd matrix(double t) const {
    const Eigen::Index held = size_ - free_;
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(held + size_, held + size_);
    a.topRightCorner(held, held).diagonal() = scale_;
    a.block(held + free_, 0, held, held).diagonal() = -restoring_;
    a.bottomRightCorner(size_, size_) = -t * damping_;
    return a;
  }

 private:
  const Eigen::MatrixXd& damping_;
  Eigen::Index free_;
  Eigen::Index size_;
  Eigen::VectorXd scale_;
  Eigen::VectorXd restoring_;
};

struct Found {
  std::vector<Complex> complex;
  std::vector<double> real;
};

bool is_real(Complex s) {
  // Rounding parts a double real root by the square root of epsilon.
  constexpr double kDouble = 1e-7;
  return std::abs(s.imag()) <= kDouble * std::abs(s);
}

Found roots_at(const FirstOrder& system, double t) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(system.matrix(t), false);
  Found found;
  for (const Complex s : solver.eigenvalues()) {
    if (is_real(s)) {
      found.real.push_back(s.real());
    } else if (s.imag() > 0.0) {
      found.complex.push_back(s);
    }
  }
  std::ranges::sort(found.real);
  return found;
}

/// Nearest matches of foreseen and found roots, shortest distance first; `clear` when each found
/// root is much nearer to its own foreseen one than to any other found root.
struct Matching {
  std::vector<std::optional<std::size_t>> found_of;  ///< per foreseen root
  bool clear = true;
};

Matching match(std::span<const Labelled<Complex>> before, std::span<const Complex> found) {
  constexpr double kClear = 0.25;
  struct Candidate {
    double distance;
    std::size_t from, to;
  };
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < before.size(); ++i) {
    for (std::size_t j = 0; j < found.size(); ++j) {
      candidates.push_back({std::abs(before[i].foreseen - found[j]), i, j});
    }
  }
  std::ranges::sort(candidates, {}, &Candidate::distance);
  Matching matching{std::vector<std::optional<std::size_t>>(before.size())};
  std::vector<bool> taken(found.size(), false);
  for (const auto& [distance, from, to] : candidates) {
    if (matching.found_of[from] || taken[to]) continue;
    matching.found_of[from] = to;
    taken[to] = true;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < found.size(); ++j) {
      if (j != to) nearest = std::min(nearest, std::abs(found[j] - found[to]));
    }
    matching.clear = matching.clear && distance <= kClear * nearest;
  }
  return matching;
}

/// Where in `longer` two neighbours have to be left out for the rest to be nearest to `shorter`,
/// both ascending, and the two to be nearest to `place`.
std::size_t best_gap(std::span<const double> longer, std::span<const double> shorter,
                     double place) {
  std::size_t best = 0;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t gap = 0; gap + 1 < longer.size(); ++gap) {
    double sum = std::abs(longer[gap] - place) + std::abs(longer[gap + 1] - place);
    for (std::size_t i = 0; i < shorter.size(); ++i) {
      sum += std::abs(longer[i < gap ? i : i + 2] - shorter[i]);
    }
    if (sum < smallest) {
      smallest = sum;
      best = gap;
    }
  }
  return best;
}

std::vector<double> foreseen_of(const std::vector<Labelled<double>>& real) {
  std::vector<double> places;
  for (const auto& root : real) places.push_back(root.foreseen);
  return places;
}

/// Gives the found roots the pairs of those before; empty where more than one pair reached or left
/// the real axis, or (unless `force`) complex roots cannot be told apart.
std::optional<Roots> follow(const Roots& before, const Found& found, bool force) {
  Roots after;
  const Matching matching = match(before.complex, found.complex);
  if (!matching.clear && !force) return std::nullopt;
  std::optional<std::size_t> landed;
  std::vector<bool> known(found.complex.size(), false);
  for (std::size_t i = 0; i < before.complex.size(); ++i) {
    if (const auto to = matching.found_of[i]) {
      known[*to] = true;
      after.complex.push_back({found.complex[*to], {}, before.complex[i].pair});
    } else {
      if (landed) return std::nullopt;
      landed = i;
    }
  }
  std::vector<std::size_t> pairs;
  for (const auto& root : before.real) pairs.push_back(root.pair);
  const std::vector<double> places = foreseen_of(before.real);
  if (landed) {
    if (found.real.size() != before.real.size() + 2) return std::nullopt;
    const auto& root = before.complex[*landed];
    const auto gap =
        static_cast<std::ptrdiff_t>(best_gap(found.real, places, root.foreseen.real()));
    pairs.insert(pairs.begin() + gap, 2, root.pair);
  } else if (const auto left = std::ranges::find(known, false); left != known.end()) {
    const auto number = static_cast<std::size_t>(left - known.begin());
    if (found.real.size() + 2 != before.real.size() || std::ranges::count(known, false) != 1) {
      return std::nullopt;
    }
    const std::size_t gap = best_gap(places, found.real, found.complex[number].real());
    const std::size_t earlier = std::min(pairs[gap], pairs[gap + 1]);
    const std::size_t later = std::max(pairs[gap], pairs[gap + 1]);
    const auto first = pairs.begin() + static_cast<std::ptrdiff_t>(gap);
    pairs.erase(first, first + 2);
    std::ranges::replace(pairs, later, earlier);
    after.complex.push_back({found.complex[number], {}, later});
  } else if (found.real.size() != before.real.size()) {
    return std::nullopt;
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    after.real.push_back({found.real[i], {}, pairs[i]});
  }
  return after;
}

/// Lets every root point along the straight line from its place before through its place now.
void foresee(const Roots& before, Roots& now, double ratio) {
  for (auto& root : now.complex) {
    const auto same = std::ranges::find(before.complex, root.pair, &Labelled<Complex>::pair);
    root.foreseen = same == before.complex.end() ? root.s : root.s + ratio * (root.s - same->s);
  }
  const bool same_order = std::ranges::equal(before.real, now.real, {}, &Labelled<double>::pair,
                                             &Labelled<double>::pair);
  for (std::size_t i = 0; i < now.real.size(); ++i) {
    const double moved = same_order ? now.real[i].s - before.real[i].s : 0.0;
    now.real[i].foreseen = now.real[i].s + ratio * moved;
  }
}

Roots undamped(const ModalVibration& vibration) {
  Roots roots;
  for (Eigen::Index j = 0; j < vibration.omega_squared.size(); ++j) {
    const auto pair = static_cast<std::size_t>(j);
    const double omega_squared = vibration.omega_squared[j];
    if (omega_squared > 0.0) {
      roots.complex.push_back({Complex(0.0, std::sqrt(omega_squared)), {}, pair});
    } else if (omega_squared == 0.0) {
      roots.real.push_back({0.0, 0.0, pair});
    } else {
      const double rate = std::sqrt(-omega_squared);
      roots.real.push_back({-rate, -rate, pair});
      roots.real.push_back({rate, rate, pair});
    }
  }
  return roots;
}

/// Perturbation of the first order in the damping: ds = -C_jj/2.
void foresee_from_rest(const ModalVibration& vibration, Roots& roots, double t) {
  for (auto& root : roots.complex) {
    const auto j = static_cast<Eigen::Index>(root.pair);
    root.foreseen = root.s - t * vibration.damping(j, j) / 2.0;
  }
}

/// Both roots of every pair, and the modes of the eigenvectors nearest to them.
std::vector<DampedPair> with_shapes(const Roots& roots, const FirstOrder& system,
                                    Eigen::Index size) {
  std::vector<DampedPair> pairs(static_cast<std::size_t>(size));
  std::vector<std::vector<Complex>> of_pair(pairs.size());
  for (const auto& root : roots.complex) of_pair[root.pair] = {root.s, std::conj(root.s)};
  for (const auto& root : roots.real) of_pair[root.pair].emplace_back(root.s);
  if (system.has_zero_root()) of_pair[0].emplace_back(0.0);
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(system.matrix(1.0), true);
  const auto shape_at = [&](Complex s) -> Eigen::VectorXcd {
    Eigen::Index nearest = 0;
    (solver.eigenvalues().array() - s).abs().minCoeff(&nearest);
    return solver.eigenvectors().col(nearest).tail(size).normalized();
  };
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    auto& both = of_pair[i];
    std::ranges::sort(both, {}, [](Complex s) { return std::pair(std::abs(s), -s.imag()); });
    if (both.front().imag() < 0.0) std::swap(both.front(), both.back());
    pairs[i] = {both.front(), both.back(), shape_at(both.front()), shape_at(both.back())};
    if (system.has_zero_root() && i == 0) {
      pairs[i].first_shape = Eigen::VectorXcd::Unit(size, 0);
    }
  }
  return pairs;
}

}  // namespace

ContinuedPairs continue_damping(const ModalVibration& vibration) {
  constexpr double kShortestStep = 1e-6;  // of t
  const FirstOrder system(vibration);
  ContinuedPairs result;
  Roots before;
  Roots now = undamped(vibration);
  double t = 0.0;
  double step = 1.0;
  double last_step = 0.0;
  while (t < 1.0) {
    step = std::min(step, 1.0 - t);
    const double next = t + step >= 1.0 ? 1.0 : t + step;
    if (last_step == 0.0) {
      foresee_from_rest(vibration, now, next);
    } else {
      foresee(before, now, step / last_step);
    }
    const Found found = roots_at(system, next);
    ++result.steps;
    std::optional<Roots> after = follow(now, found, false);
    if (!after && step > kShortestStep * std::max(t, kShortestStep)) {
      step /= 2.0;
      continue;
    }
    if (!after) {
      result.certain = false;
      after = follow(now, found, true);
      if (!after) break;
    }
    before = std::move(now);
    now = *std::move(after);
    last_step = step;
    t = next;
    step *= 2.0;
  }
  result.pairs = with_shapes(now, system, vibration.omega_squared.size());
  return result;
}

}  // namespace flexarm::fem
