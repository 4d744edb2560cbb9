#include "exact_tf/pole_continuation.hpp"

#include "exact_tf/pole_path.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace flexarm::exact_tf {

namespace {

/// The two roots of a mode while they are followed.
struct Pair {
  std::vector<PathStart> starts;  ///< fewer than two where roots stay at 0
  bool on_detour = false;
  std::vector<FollowedRoot> roots;

  Complex end(std::size_t i) const { return i < roots.size() ? roots[i].s : 0.0L; }
};

class Continuation {
 public:
  Continuation(const DampedCharacteristic& characteristic, Real kelvin_voigt_s,
               const ContinuationOptions& options)
      : characteristic_(characteristic), kelvin_voigt_s_(kelvin_voigt_s), options_(options) {}

  arm::DampedPoleSet run(const std::vector<UndampedMode>& modes);

 private:
  void place(const std::vector<UndampedMode>& modes);
  void follow(Pair& pair);
  bool follow(Pair& pair, Real detour);
  std::vector<std::size_t> doubled() const;
  std::vector<std::pair<Complex, Complex>> paired() const;

  const DampedCharacteristic& characteristic_;
  Real kelvin_voigt_s_;
  const ContinuationOptions& options_;
  std::vector<Pair> pairs_;
  Real caution_ = 1.0L;
  arm::SolveSummary summary_;
  int lost_ = 0;  // pairs that could not be followed
};

void Continuation::place(const std::vector<UndampedMode>& modes) {
  std::vector<Complex> all;
  for (const auto& mode : modes) {
    const Complex u = std::sqrt(Complex(mode.omega_squared_rad2_per_s2));
    all.push_back(u);
    if (u != 0.0L) all.push_back(-u);
  }
  for (const auto& mode : modes) {
    const Complex u = std::sqrt(Complex(mode.omega_squared_rad2_per_s2));
    Pair pair;
    // Without restoring force one root stays at 0, and the other moves at twice the speed.
    const Real decay = u == 0.0L ? mode.damping_rad_per_s : 0.5L * mode.damping_rad_per_s;
    Real nearest = std::abs(u) + std::abs(decay);
    for (const Complex& other : all) {
      if (other != u) nearest = std::min(nearest, std::abs(other - u));
    }
    for (const int branch : {1, -1}) {
      if (u == 0.0L && (branch < 0 || decay == 0.0L)) continue;
      // ds/dd = branch i du/dd at d = 0, the Kelvin-Voigt part apart.
      const Complex slope(0.0L, static_cast<Real>(branch) * decay);
      pair.starts.push_back({u, slope, 0.5L * nearest, branch});
    }
    pairs_.push_back(std::move(pair));
  }
}

/// Imaginary parts below this part of |s| are rounding.
constexpr Real kRealWithin = 1e-12L;

bool is_real(const Complex& s) {
  return std::abs(s.imag()) <= kRealWithin * std::abs(s);
}

/// False where a path ends on the way.
bool Continuation::follow(Pair& pair, Real detour) {
  pair.roots.clear();
  for (const auto& start : pair.starts) {
    // On real d the partner of a complex root is its conjugate.
    if (detour == 0.0L && !pair.roots.empty() && !is_real(pair.roots.front().s)) {
      FollowedRoot partner = pair.roots.front();
      partner.s = std::conj(partner.s);
      pair.roots.push_back(partner);
      continue;
    }
    PolePath path(characteristic_, kelvin_voigt_s_, options_, detour, caution_);
    const auto root = path.follow(start);
    summary_.iterations += path.function_values();
    if (!root) return false;
    pair.roots.push_back(*root);
  }
  return true;
}

void Continuation::follow(Pair& pair) {
  if (!pair.on_detour && follow(pair, 0.0L)) return;
  pair.on_detour = true;
  if (!follow(pair, options_.detour)) {
    ++lost_;
    pair.roots.resize(pair.starts.size());
  }
}

/// Pairs that share a root with another.
std::vector<std::size_t> Continuation::doubled() const {
  // Nearer than this part of the distance in which other roots are felt, two are one.
  constexpr Real kSame = 0.1L;
  const auto same = [](const FollowedRoot& a, const FollowedRoot& b) {
    return std::abs(a.s - b.s) < kSame * std::abs(a.s) &&
           std::abs(a.s - b.s) * std::abs(a.u) < kSame * a.radius * std::abs(a.s) &&
           (a.s.imag() < 0.0L) == (b.s.imag() < 0.0L);
  };
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const bool shared = std::ranges::any_of(pairs_[i].roots, [&](const FollowedRoot& root) {
      return std::ranges::any_of(pairs_, [&](const Pair& other) {
        return std::ranges::any_of(other.roots, [&](const FollowedRoot& twin) {
          return &twin != &root && same(root, twin);
        });
      });
    });
    if (shared) found.push_back(i);
  }
  return found;
}

bool are_conjugate(const Complex& a, const Complex& b) {
  return !is_real(a) && std::abs(a - std::conj(b)) <= 1e-9L * std::abs(a);
}

/// Conjugates together, real roots together: pairs that are neither give their roots to a pool, in
/// which conjugates find each other, and the real ones are paired in order.
std::vector<std::pair<Complex, Complex>> Continuation::paired() const {
  std::vector<std::pair<Complex, Complex>> result;
  std::vector<std::size_t> mixed;
  std::vector<Complex> pool;
  for (const auto& pair : pairs_) {
    const Complex a = pair.end(0);
    const Complex b = pair.end(1);
    result.emplace_back(a, b);
    if (are_conjugate(a, b) || (is_real(a) && is_real(b))) continue;
    mixed.push_back(result.size() - 1);
    pool.push_back(a);
    pool.push_back(b);
  }
  std::vector<std::pair<Complex, Complex>> regrouped;
  std::vector<Complex> real;
  for (const Complex& s : pool) {
    if (is_real(s)) {
      real.push_back(s);
    } else if (s.imag() > 0.0L) {
      regrouped.emplace_back(s, std::conj(s));
    }
  }
  std::ranges::sort(real, {}, [](const Complex& s) { return std::abs(s); });
  std::ranges::sort(regrouped, {}, [](const auto& pair) { return std::abs(pair.first); });
  // An arm that turns freely keeps its root 0, and with it the lowest place.
  for (std::size_t i = real.size() / 2; i-- > 0;) {
    regrouped.insert(regrouped.begin(), std::pair(real[2 * i], real[2 * i + 1]));
  }
  for (std::size_t i = 0; i < mixed.size() && i < regrouped.size(); ++i) {
    result[mixed[i]] = regrouped[i];
  }
  return result;
}

arm::PolePair rounded(std::pair<Complex, Complex> pair) {
  for (Complex* s : {&pair.first, &pair.second}) {
    if (is_real(*s)) *s = s->real();
  }
  const bool real = pair.first.imag() == 0.0L && pair.second.imag() == 0.0L;
  const bool in_order =
      real ? std::abs(pair.first) <= std::abs(pair.second) : pair.first.imag() > 0.0L;
  if (!in_order) std::swap(pair.first, pair.second);
  if (!real) pair.second = std::conj(pair.first);
  const auto to_double = [](const Complex& s) {
    return std::complex<double>(static_cast<double>(s.real()), static_cast<double>(s.imag()));
  };
  return {to_double(pair.first), to_double(pair.second)};
}

arm::DampedPoleSet Continuation::run(const std::vector<UndampedMode>& modes) {
  place(modes);
  for (auto& pair : pairs_) follow(pair);
  constexpr int kMostRounds = 3;
  auto again = doubled();
  for (int round = 0; round < kMostRounds && !again.empty(); ++round) {
    caution_ *= 3.0L;
    for (const std::size_t i : again) {
      pairs_[i].on_detour = true;
      follow(pairs_[i]);
    }
    again = doubled();
  }
  summary_.converged = lost_ == 0 && again.empty();
  for (const auto& pair : pairs_) {
    for (const auto& root : pair.roots) {
      summary_.largest_residual =
          std::max(summary_.largest_residual, static_cast<double>(root.residual));
    }
  }
  summary_.method = "continuation in damping, Newton; residual: last step over |u|";
  arm::DampedPoleSet set;
  const auto pairs = paired();
  set.lowest = rounded(pairs.front());
  for (std::size_t i = 1; i < pairs.size(); ++i) set.flexible.push_back(rounded(pairs[i]));
  set.summary = std::move(summary_);
  return set;
}

}  // namespace

arm::DampedPoleSet follow_damping(const DampedCharacteristic& characteristic, Real kelvin_voigt_s,
                                  const std::vector<UndampedMode>& modes,
                                  const ContinuationOptions& options) {
  if (modes.empty()) throw std::invalid_argument("no modes to follow");
  return Continuation(characteristic, kelvin_voigt_s, options).run(modes);
}

}  // namespace flexarm::exact_tf
