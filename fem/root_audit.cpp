#include "fem/root_audit.hpp"

#include <algorithm>
#include <cmath>

namespace flexarm::fem {

namespace {

/// Roots within the circle beyond w[k - 1], conjugate pairs once; -1 when it cannot be told.
int counted(std::span<const std::complex<double>> w, std::size_t k,
            const PoleFreeNumerator& numerator) {
  const int inside = numerator.roots_inside(radius_before(w, k));
  const auto pairs =
      std::ranges::count_if(w.first(k), [](auto root) { return root.imag() != 0.0; });
  return inside < 0 ? -1 : inside - static_cast<int>(pairs);
}

}  // namespace

double radius_before(std::span<const std::complex<double>> w, std::size_t k) {
  constexpr double kOutside = 1.01;
  constexpr double kInside = 0.1;
  if (k == 0) return kInside * std::abs(w.front());
  if (k == w.size()) return kOutside * std::abs(w.back());
  return std::sqrt(std::abs(w[k - 1]) * std::abs(w[k]));
}

RootAudit audit(std::span<const std::complex<double>> w, std::size_t looked_at,
                const PoleFreeNumerator& numerator) {
  RootAudit result{counted(w, looked_at, numerator), looked_at};
  if (result.expected < 0 || result.expected == static_cast<int>(looked_at)) return result;
  // A root that is missing within a circle is missing within every larger one.
  std::size_t complete = 0;
  std::size_t gapped = looked_at;
  while (gapped - complete > 1) {
    const std::size_t middle = (complete + gapped) / 2;
    const bool whole = counted(w, middle, numerator) == static_cast<int>(middle);
    (whole ? complete : gapped) = middle;
  }
  result.complete = complete;
  return result;
}

}  // namespace flexarm::fem
