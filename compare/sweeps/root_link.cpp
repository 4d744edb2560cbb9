#include "compare/sweeps/root_link.hpp"

#include "compare/assignment.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexarm::compare {

namespace {

using Complex = std::complex<double>;

constexpr double kFarthest = 2.0;   // of `distance`: z and -z, both large
constexpr double kUnpaired = 0.4;   // cost of leaving a root or a prediction without a partner
constexpr double kForbidden = 1e3;  // of a pair that continuity excludes
constexpr double kLongStep = 0.7;   // |ln(z/z')| from which a step foretells nothing

bool is_real(Complex z) {
  return z.imag() == 0.0;
}

/// |z - p| over their mean modulus, 1 being the scale below which differences count as they are.
double distance(Complex z, Complex p) {
  return std::abs(z - p) / ((std::abs(z) + std::abs(p)) / 2.0 + 1.0);
}

/// Conjugates stay apart as long as they are complex: one meets the other on the real axis only.
bool crosses_the_axis(Complex from, Complex to) {
  return from.imag() * to.imag() < 0.0;
}

double largest(std::span<const Complex> roots) {
  double modulus = 0.0;
  for (const Complex z : roots) modulus = std::max(modulus, std::abs(z));
  return modulus;
}

}  // namespace

Complex predict(Complex before, Complex now, double ratio) {
  if (std::abs(before) > 1.0 && std::abs(now) > 1.0) {
    const Complex step = std::log(now / before);
    if (std::abs(step) > kLongStep || is_real(before) != is_real(now)) return now;
    const Complex next = now * std::exp(step * ratio);
    return is_real(now) ? Complex(next.real(), 0.0) : next;
  }
  return std::abs(now - before) > 1.0 ? now : now + (now - before) * ratio;
}

RootLink link_step(std::span<const Complex> from, std::span<const Complex> predicted,
                   std::span<const Complex> roots, const TrackOptions& options) {
  const std::size_t m = predicted.size();
  const std::size_t n = roots.size();
  const std::size_t size = m + n;
  // Beside every prediction and every root a place where it stays without a partner.
  std::vector<double> cost(size * size, 0.0);
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j < size; ++j) {
      double& entry = cost[i * size + j];
      if (i < m && j < n) {
        entry = crosses_the_axis(from[i], roots[j]) ? kForbidden : distance(predicted[i], roots[j]);
      } else if (i < m || j < n) {
        entry = kUnpaired;
      }
    }
  }
  const auto column_of = cheapest_assignment(cost, size);

  RootLink link{std::vector<std::optional<std::size_t>>(m), true};
  std::vector<std::optional<std::size_t>> row_of(n);
  for (std::size_t i = 0; i < m; ++i) {
    if (column_of[i] >= n) continue;
    link.to[i] = column_of[i];
    row_of[column_of[i]] = i;
  }

  /// Whether i and other leave the real axis for a pair, or the reverse: either may be either.
  const auto meets = [&](std::size_t i, std::size_t other) {
    if (!link.to[i] || !link.to[other]) return false;
    const Complex z = roots[*link.to[i]];
    return is_real(from[i]) != is_real(z) &&
           (roots[*link.to[other]] == std::conj(z) || from[other] == std::conj(from[i]));
  };
  for (std::size_t i = 0; i < m; ++i) {
    if (!link.to[i]) {
      const double modulus = std::max(std::abs(from[i]), std::abs(predicted[i]));
      if (modulus < options.edge * largest(roots)) link.clear = false;
      continue;
    }
    const bool is_upper = from[i].imag() > 0.0;
    if (is_upper && roots[*link.to[i]].imag() > 0.0 && link.to[i + 1] != *link.to[i] + 1) {
      link.clear = false;  // a conjugate pair stays one
    }
    const double own = cost[i * size + *link.to[i]];
    double nearest_other = kFarthest * options.clearance;
    for (std::size_t j = 0; j < n; ++j) {
      if (j == *link.to[i] || (row_of[j] && meets(i, *row_of[j]))) continue;
      nearest_other = std::min(nearest_other, cost[i * size + j]);
    }
    for (std::size_t k = 0; k < m; ++k) {
      if (k == i || meets(i, k)) continue;
      nearest_other = std::min(nearest_other, cost[k * size + *link.to[i]]);
    }
    if (own > options.largest_step || own * options.clearance > nearest_other) link.clear = false;
  }
  for (std::size_t j = 0; j < n; ++j) {
    if (!row_of[j] && std::abs(roots[j]) < options.edge * largest(from)) link.clear = false;
  }
  return link;
}

}  // namespace flexarm::compare
