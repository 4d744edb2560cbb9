#include "exact_tf/analytic_zeros.hpp"

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

namespace flexarm::exact_tf {

namespace {

constexpr Real kEpsilon = std::numeric_limits<Real>::epsilon();

/// Where a contour is put between two bounds, in order of preference.
constexpr std::array<Real, 7> kCuts = {0.5L, 0.43L, 0.57L, 0.36L, 0.64L, 0.29L, 0.71L};

constexpr std::array<ZeroLocus, 2> kAxes = {ZeroLocus::positive_axis, ZeroLocus::negative_axis};

Real angle_of(ZeroLocus axis) {
  return axis == ZeroLocus::positive_axis ? 0.0L : kSectorAngle;
}

class ZeroSearch {
 public:
  ZeroSearch(const SectorFunction& function, const AnalyticZeroOptions& options)
      : function_(function), options_(options), principle_(function, options.contour) {}

  AnalyticZeros run(int count);

 private:
  Real on_axis(ZeroLocus axis, Real modulus) {
    ++values_;
    return function_(on_ray(modulus, angle_of(axis))).real();
  }
  /// N near the sector, continued across its rays by N(conj z) = conj N(z).
  Complex continued(const Complex& lambda);

  struct Bracket {
    Real low;
    Real high;
  };
  std::vector<Bracket> sign_changes(ZeroLocus axis, Real from, Real to, Real step);
  void solve(ZeroLocus axis, const Bracket& bracket);

  bool extend(Real wanted);
  void resolve(const PolarBox& box, int counted);
  bool cut(const PolarBox& box, PolarBox& first, PolarBox& second, int& in_first);
  bool take_apart(ZeroLocus axis, Real low, Real high);
  bool polish(const Complex& start, const PolarBox& box);

  int found_in(const PolarBox& box) const;
  bool out_of_budget() const { return function_values() > options_.most_function_values; }
  long function_values() const { return values_ + principle_.function_values(); }

  const SectorFunction& function_;
  const AnalyticZeroOptions& options_;
  ArgumentPrinciple principle_;
  std::vector<AnalyticZero> zeros_;
  long values_ = 0;
  Real radius_ = 0.0L;  // zeros are searched for and counted up to here
  int counted_ = 0;
  bool narrowed_ = true;  // every bracket, to options_.significand_bits
};

Complex ZeroSearch::continued(const Complex& lambda) {
  ++values_;
  const Complex above(lambda.real(), std::abs(lambda.imag()));
  const bool beyond = above.imag() > above.real();
  // i conj(lambda) has the z of conj(lambda).
  const Complex value = function_(beyond ? Complex(above.imag(), above.real()) : above);
  return beyond != (lambda.imag() < 0.0L) ? std::conj(value) : value;
}

void ZeroSearch::solve(ZeroLocus axis, const Bracket& bracket) {
  constexpr std::uintmax_t kMostValues = 200;
  std::uintmax_t values = kMostValues;
  const auto [below, above] = boost::math::tools::toms748_solve(
      [&](Real modulus) { return on_axis(axis, modulus); }, bracket.low, bracket.high,
      boost::math::tools::eps_tolerance<Real>(options_.significand_bits), values);
  narrowed_ = narrowed_ && values < kMostValues;
  zeros_.push_back({axis, on_ray(0.5L * (below + above), angle_of(axis))});
}

std::vector<ZeroSearch::Bracket> ZeroSearch::sign_changes(ZeroLocus axis, Real from, Real to,
                                                          Real step) {
  std::vector<Bracket> brackets;
  const auto pieces = std::max<long>(1, std::lround(std::ceil((to - from) / step)));
  const Real width = (to - from) / static_cast<Real>(pieces);
  Real low = from;
  Real value_low = on_axis(axis, low);
  for (long i = 1; i <= pieces; ++i) {
    const Real high = i == pieces ? to : from + static_cast<Real>(i) * width;
    const Real value_high = on_axis(axis, high);
    if (std::signbit(value_low) != std::signbit(value_high)) brackets.push_back({low, high});
    low = high;
    value_low = value_high;
  }
  return brackets;
}

int ZeroSearch::found_in(const PolarBox& box) const {
  int found = 0;
  for (const auto& zero : zeros_) {
    const bool on_angle =
        zero.locus == ZeroLocus::off_axis
            ? box.contains(zero.lambda)
            : angle_of(zero.locus) == box.from_angle || angle_of(zero.locus) == box.to_angle;
    const Real modulus = std::abs(zero.lambda);
    if (on_angle && box.inner <= modulus && modulus <= box.outer) found += zero.multiplicity();
  }
  return found;
}

/// A real zero of order two, or two zeros too close for any grid: at the extremum of N on the axis
/// between `low` and `high` N changes sign twice, or has a pair of conjugate zeros beside it.
bool ZeroSearch::take_apart(ZeroLocus axis, Real low, Real high) {
  const Real sign = on_axis(axis, low) < 0.0L ? -1.0L : 1.0L;
  const auto [extremum, least] = boost::math::tools::brent_find_minima(
      [&](Real modulus) { return sign * on_axis(axis, modulus); }, low, high,
      std::numeric_limits<Real>::digits / 2);
  if (least < 0.0L) {
    solve(axis, {low, extremum});
    solve(axis, {extremum, high});
    return true;
  }
  const Real reach = 0.125L * std::min(extremum - low, high - extremum);
  const Real curvature =
      sign * (on_axis(axis, extremum + reach) + on_axis(axis, extremum - reach)) - 2.0L * least;
  if (!(curvature > 0.0L)) return false;
  const Real across = reach * std::sqrt(2.0L * least / curvature);
  if (across <= 4.0L * std::sqrt(kEpsilon) * extremum) {
    const Complex lambda = on_ray(extremum, angle_of(axis));
    zeros_.push_back({axis, lambda});
    zeros_.push_back({axis, lambda});
    return true;
  }
  const Real offset = std::min(across / extremum, 0.5L * kSectorAngle);
  const Real angle = axis == ZeroLocus::positive_axis ? offset : kSectorAngle - offset;
  return polish(std::polar(extremum, angle), {low, high, 0.0L, kSectorAngle});
}

/// The secant method from `start`; true when it ends at a zero off the axes in `box`.
bool ZeroSearch::polish(const Complex& start, const PolarBox& box) {
  constexpr int kMostSteps = 60;
  Complex before = start * Complex(1.0L, 1e-4L);
  Complex value_before = continued(before);
  Complex at = start;
  for (int step = 0; step < kMostSteps; ++step) {
    const Complex value_at = continued(at);
    if (value_at == value_before) return false;
    const Complex move = -value_at * (at - before) / (value_at - value_before);
    before = at;
    value_before = value_at;
    at += move;
    if (!(std::abs(at) < 2.0L * box.outer) || at.real() <= 0.0L) return false;
    if (std::abs(move) > options_.secant_tolerance * std::abs(at)) continue;
    const Complex above(at.real(), std::abs(at.imag()));
    const Complex lambda =
        above.imag() > above.real() ? Complex(above.imag(), above.real()) : above;
    const Real from_axes = std::min(lambda.imag(), lambda.real() - lambda.imag());
    if (from_axes <= std::sqrt(kEpsilon) * std::abs(lambda) || !box.contains(lambda)) return false;
    zeros_.push_back({ZeroLocus::off_axis, lambda});
    return true;
  }
  return false;
}

/// Halves the longer side of the box, where a contour can be resolved.
bool ZeroSearch::cut(const PolarBox& box, PolarBox& first, PolarBox& second, int& in_first) {
  const bool radially = box.outer - box.inner >= box.outer * (box.to_angle - box.from_angle);
  for (const Real part : kCuts) {
    first = second = box;
    if (radially) {
      first.outer = second.inner = box.inner + part * (box.outer - box.inner);
    } else {
      first.to_angle = second.from_angle = box.from_angle + part * (box.to_angle - box.from_angle);
    }
    if (const auto counted = principle_.count(first)) {
      in_first = *counted;
      return true;
    }
  }
  return false;
}

/// Finds what is missing in a box whose zeros, mirror images included, are `counted`.
void ZeroSearch::resolve(const PolarBox& box, int counted) {
  // Boxes of this size in lambda, below half the usual distance of zeros, are worth a try.
  constexpr Real kTryBelow = 1.0L;
  const int missing = counted - found_in(box);
  if (missing <= 0 || out_of_budget()) return;
  const Real size = std::max(box.outer - box.inner, box.outer * (box.to_angle - box.from_angle));
  if (size <= kTryBelow) {
    for (const ZeroLocus axis : kAxes) {
      if (angle_of(axis) != box.from_angle && angle_of(axis) != box.to_angle) continue;
      constexpr Real kPieces = 8.0L;
      const Real step = (box.outer - box.inner) / kPieces;
      for (const auto& bracket : sign_changes(axis, box.inner, box.outer, step)) {
        if (found_in({bracket.low, bracket.high, angle_of(axis), angle_of(axis)}) == 0) {
          solve(axis, bracket);
        }
      }
      if (found_in(box) == 0 && counted == 2 && take_apart(axis, box.inner, box.outer)) return;
    }
    const Complex centre =
        std::polar(0.5L * (box.inner + box.outer), 0.5L * (box.from_angle + box.to_angle));
    if (found_in(box) == 0 && counted == 2 && polish(centre, box)) return;
    if (found_in(box) >= counted) return;
  }
  if (size <= options_.smallest_box * box.outer) return;
  PolarBox first;
  PolarBox second;
  int in_first = 0;
  if (!cut(box, first, second, in_first)) return;
  resolve(first, in_first);
  resolve(second, counted - in_first);
}

/// Searches from radius_ to near `wanted`; false where no contour could be resolved there.
bool ZeroSearch::extend(Real wanted) {
  const Real from = radius_;
  for (const ZeroLocus axis : kAxes) {
    for (const auto& bracket : sign_changes(axis, from, wanted, options_.axis_step)) {
      solve(axis, bracket);
    }
  }

  // The contour crosses the axes in the widest gap that its neighbourhood has.
  constexpr Real kNeighbourhood = 4.0L;
  std::vector<Real> bounds = {std::max(0.5L * (from + wanted), wanted - kNeighbourhood), wanted};
  for (const auto& zero : zeros_) {
    const Real modulus = std::abs(zero.lambda);
    if (modulus > bounds[0] && modulus < wanted) bounds.push_back(modulus);
  }
  std::sort(bounds.begin(), bounds.end());
  std::size_t widest = 0;
  for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
    if (bounds[i + 1] - bounds[i] > bounds[widest + 1] - bounds[widest]) widest = i;
  }
  for (const Real part : kCuts) {
    const Real radius = bounds[widest] + part * (bounds[widest + 1] - bounds[widest]);
    const auto counted = principle_.count({0.0L, radius});
    if (!counted) continue;
    std::erase_if(zeros_, [&](const auto& zero) { return std::abs(zero.lambda) >= radius; });
    if (options_.locate_missing) resolve({from, radius}, *counted - counted_);
    radius_ = radius;
    counted_ = *counted;
    return true;
  }
  return false;
}

AnalyticZeros ZeroSearch::run(int count) {
  // A disc without zeros to start from.
  constexpr Real kSmallestStart = 1e-12L;
  radius_ = 1.0L;
  while (principle_.count({0.0L, radius_}) != 0) {
    radius_ *= 0.5L;
    if (radius_ < kSmallestStart) throw std::domain_error("N(0) = 0: divide by z first");
  }

  bool resolved = true;
  while (resolved && counted_ == found_in({0.0L, radius_}) && std::ssize(zeros_) < count &&
         !out_of_budget()) {
    const auto left = static_cast<Real>(count - std::ssize(zeros_));
    const Real spacing =
        zeros_.empty() ? std::numbers::pi_v<Real> : radius_ / static_cast<Real>(zeros_.size());
    resolved = extend(radius_ + std::numbers::pi_v<Real> + left * spacing);
  }

  AnalyticZeros result;
  std::sort(zeros_.begin(), zeros_.end(),
            [](const auto& a, const auto& b) { return std::abs(a.lambda) < std::abs(b.lambda); });
  result.zeros = zeros_;
  result.radius = radius_;
  result.counted = counted_;
  for (const auto& zero : zeros_) result.found += zero.multiplicity();
  result.converged = resolved && narrowed_ && result.missing() == 0 && std::ssize(zeros_) >= count;
  result.function_values = function_values();
  return result;
}

}  // namespace

AnalyticZeroOptions zero_options(Arithmetic arithmetic) {
  AnalyticZeroOptions options;
  if (arithmetic == Arithmetic::working) {
    options.significand_bits = std::numeric_limits<double>::digits - 3;
    options.secant_tolerance = 1e-13L;
  }
  return options;
}

AnalyticZeros find_analytic_zeros(const SectorFunction& function, int count,
                                  const AnalyticZeroOptions& options) {
  if (count < 1) throw std::invalid_argument("count of zeros must be 1 or more");
  return ZeroSearch(function, options).run(count);
}

}  // namespace flexarm::exact_tf
