#include "exact_tf/pole_continuation.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

namespace flexarm::exact_tf {

namespace {

/// F and its derivatives with respect to u.
struct Local {
  Complex newton_step;  ///< -F/F'
  Complex slope;        ///< F' over exp(log_scale)
  Real radius = 0.0L;   ///< |F'/F''|
  Real log_scale = 0.0L;
};

struct Root {
  Complex u;
  Complex s;
  Real radius = 0.0L;
  Real residual = 0.0L;  ///< last step of Newton's method over |u|
};

/// Where a root starts, with du/dd there and half the distance to the nearest other.
struct Start {
  Complex u;
  Complex slope;
  Real radius = 0.0L;
  int branch = 1;  ///< of s = -kv d u^2/2 + branch i u q
};

bool finite(const Complex& z) {
  return std::isfinite(z.real()) && std::isfinite(z.imag());
}

class Path {
 public:
  Path(const DampedCharacteristic& characteristic, Real kelvin_voigt_s,
       const ContinuationOptions& options, Real detour, Real caution)
      : characteristic_(characteristic),
        kelvin_voigt_s_(kelvin_voigt_s),
        options_(options),
        detour_(detour),
        caution_(caution) {}

  std::optional<Root> follow(const Start& start);
  int function_values() const { return values_; }

 private:
  Complex damping_at(Real t) const { return {t, detour_ * t * (1.0L - t)}; }
  /// q = sqrt(1 - (kv d u/2)^2), continued from the last place accepted.
  Complex root_of_pair(const Complex& u, Real t) const;
  Complex s_of(const Complex& u, Real t) const;
  Scaled<Complex> value(const Complex& u, Real t) {
    ++values_;
    return characteristic_(s_of(u, t), damping_at(t));
  }
  Local local(const Complex& u, Real t, Real radius);
  Complex velocity(const Root& root, Real t, Real step);
  std::optional<Root> newton(const Complex& from, Real t, Real radius);

  const DampedCharacteristic& characteristic_;
  Real kelvin_voigt_s_;
  const ContinuationOptions& options_;
  Real detour_;
  Real caution_;  ///< divides the lengths of steps
  int branch_ = 1;
  Complex last_q_ = 1.0L;
  int values_ = 0;
};

Complex Path::root_of_pair(const Complex& u, Real t) const {
  const Complex ratio = 0.5L * kelvin_voigt_s_ * damping_at(t) * u;
  const Complex q = std::sqrt((1.0L - ratio) * (1.0L + ratio));
  const Real along = (q * std::conj(last_q_)).real();
  // A step across 1 - (kv d u/2)^2 = 0 at real d and u: to either root of the pair by its branch.
  const bool turned = std::abs(along) < 0.5L * std::abs(q) * std::abs(last_q_);
  return (turned ? q.imag() > 0.0L : along < 0.0L) ? -q : q;
}

Complex Path::s_of(const Complex& u, Real t) const {
  const Complex half = 0.5L * kelvin_voigt_s_ * damping_at(t) * u * u;
  const Complex offset = static_cast<Real>(branch_) * Complex(0.0L, 1.0L) * u * root_of_pair(u, t);
  // The smaller of the two from their product u^2.
  return std::abs(offset - half) >= std::abs(offset + half) ? offset - half
                                                            : -u * u / (offset + half);
}

/// By central differences. Their errors of relative order kStep^2 = 1e-10 slow Newton's method down
/// by no more than that.
constexpr Real kStep = 1e-5L;

Local Path::local(const Complex& u, Real t, Real radius) {
  const Real h = kStep * radius;
  const auto centre = value(u, t);
  const auto after = value(u + h, t);
  const auto before = value(u - h, t);
  const Complex f = centre.value;
  const Complex f_after = after.value * std::exp(after.log_scale - centre.log_scale);
  const Complex f_before = before.value * std::exp(before.log_scale - centre.log_scale);
  const Complex first = (f_after - f_before) / (2.0L * h);
  const Complex second = (f_after - 2.0L * f + f_before) / (h * h);
  return {-f / first, first, std::abs(first) / std::abs(second), centre.log_scale};
}

/// du/dt = -F_t/F_u along the path.
Complex Path::velocity(const Root& root, Real t, Real step) {
  const Local here = local(root.u, t, root.radius);
  const Real h = kStep * step;
  const auto after = value(root.u, t + h);
  const auto before = value(root.u, t - h);
  const Complex change = after.value * std::exp(after.log_scale - here.log_scale) -
                         before.value * std::exp(before.log_scale - here.log_scale);
  return -change / (2.0L * h * here.slope);
}

std::optional<Root> Path::newton(const Complex& from, Real t, Real radius) {
  constexpr int kMostSteps = 20;
  // On the way the root need not be better than the tangent.
  constexpr Real kOnTheWay = 1e-6L;
  Root root{from, {}, radius, 0.0L};
  Real last = radius;
  for (int i = 0; i < kMostSteps; ++i) {
    const Local here = local(root.u, t, root.radius);
    if (!finite(here.newton_step)) return std::nullopt;
    const Real size = std::abs(here.newton_step);
    // Within the rounding of F a step no longer falls, and is not taken.
    const bool stalled = size >= 0.5L * last && size <= 1e-12L * std::abs(root.u);
    if (!stalled && (size > last || std::abs(root.u - from) > radius)) return std::nullopt;
    root.radius =
        std::min(std::isfinite(here.radius) ? here.radius : 2.0L * root.radius, 2.0L * root.radius);
    if (!stalled) root.u += here.newton_step;
    root.residual = size / std::abs(root.u);
    const bool near = t < 1.0L && size <= kOnTheWay * root.radius;
    if (stalled || near || size <= options_.newton_tolerance * std::abs(root.u)) {
      root.s = s_of(root.u, t);
      return root;
    }
    last = size;
  }
  return std::nullopt;
}

std::optional<Root> Path::follow(const Start& start) {
  constexpr Real kSmallestStep = 1e-5L;
  constexpr Real kSmallestStepOfDetour = 1e-9L;
  const Real smallest = detour_ > 0.0L ? kSmallestStepOfDetour : kSmallestStep;
  branch_ = start.branch;
  last_q_ = 1.0L;
  Root at{start.u, {}, start.radius, 0.0L};
  Complex velocity_now = start.slope * Complex(1.0L, detour_);
  Real t = 0.0L;
  Real step = 1.0L / caution_;
  Real move = options_.largest_move / caution_;
  while (t < 1.0L) {
    const Real speed = std::abs(velocity_now);
    const Real reach = move * at.radius;
    if (speed * step > reach) step = reach / speed;
    if (step < smallest || values_ > options_.most_function_values) return std::nullopt;
    const Real next = t + step >= 1.0L - 1e-3L * step ? 1.0L : t + step;
    const Complex predicted = at.u + velocity_now * (next - t);
    const auto root = newton(predicted, next, at.radius);
    const Real allowed =
        root ? options_.largest_correction / caution_ * std::min(at.radius, root->radius) : 0.0L;
    const Real correction = root ? std::abs(root->u - predicted) : 1.0L;
    if (correction > allowed) {
      step *= 0.5L;
      continue;
    }
    // The correction is of second order in the step. A straight path may be followed further: far
    // from all other roots F is an exponential, and rho much less than their distance.
    constexpr Real kAim = 0.3L;
    constexpr Real kMostRadii = 200.0L;
    const Real growth = std::min(4.0L, std::sqrt(kAim * allowed / correction));
    move = std::clamp(growth * move, options_.largest_move / caution_, kMostRadii / caution_);
    step *= growth;
    at = *root;
    t = next;
    last_q_ = root_of_pair(at.u, t);
    if (t < 1.0L) {
      velocity_now = velocity(at, t, step);
      if (!finite(velocity_now)) return std::nullopt;
    }
  }
  return at;
}

/// The two roots of a mode while they are followed.
struct Pair {
  std::vector<Start> starts;  ///< fewer than two where roots stay at 0
  bool on_detour = false;
  std::vector<Root> roots;

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
      Root partner = pair.roots.front();
      partner.s = std::conj(partner.s);
      pair.roots.push_back(partner);
      continue;
    }
    Path path(characteristic_, kelvin_voigt_s_, options_, detour, caution_);
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
    summary_.converged = false;
    pair.roots.resize(pair.starts.size());
  }
}

/// Pairs that share a root with another.
std::vector<std::size_t> Continuation::doubled() const {
  // Nearer than this part of the distance in which other roots are felt, two are one.
  constexpr Real kSame = 0.1L;
  const auto same = [](const Root& a, const Root& b) {
    return std::abs(a.s - b.s) < kSame * std::abs(a.s) &&
           std::abs(a.s - b.s) * std::abs(a.u) < kSame * a.radius * std::abs(a.s) &&
           (a.s.imag() < 0.0L) == (b.s.imag() < 0.0L);
  };
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const bool shared = std::ranges::any_of(pairs_[i].roots, [&](const Root& root) {
      return std::ranges::any_of(pairs_, [&](const Pair& other) {
        return std::ranges::any_of(
            other.roots, [&](const Root& twin) { return &twin != &root && same(root, twin); });
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
  summary_.converged = summary_.converged && again.empty();
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
