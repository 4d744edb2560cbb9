#include "compare/features.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace flexarm::compare {

std::string label(const FeatureFamily& family) {
  return family.zeros_of ? arm::to_string(*family.zeros_of) + " zero" : "pole";
}

FeatureRoots roots(const response::AnyFormulation& formulation, const FeatureFamily& family) {
  FeatureRoots found;
  if (family.zeros_of) {
    arm::ZeroSet zeros = response::zeros(formulation, *family.zeros_of, family.count);
    found.s_rad_per_s = std::move(zeros.s_rad_per_s);
    found.relative_change = std::move(zeros.relative_change);
    found.rejected = std::move(zeros.rejected);
    found.infinite = zeros.infinite;
    found.count = std::move(zeros.count);
  } else {
    arm::PoleSet poles = response::poles(formulation, family.count);
    for (const double omega : poles.omega_rad_per_s) found.s_rad_per_s.emplace_back(0.0, omega);
    found.count = std::move(poles.count);
  }
  return found;
}

double stated_error(const FeatureRoots& found, const FeatureFamily& family,
                    const std::optional<std::complex<double>>& root) {
  constexpr double kOfChange = 10.0;
  if (!root) {
    const int count = static_cast<int>(found.s_rad_per_s.size());
    const bool is_short = count < family.count ||
                          (found.count.expected >= 0 && found.count.found != found.count.expected);
    const bool has_gap =
        count > 0 && std::ranges::any_of(found.rejected, [&](const arm::RejectedZero& rejected) {
          return std::abs(rejected.s_rad_per_s) < std::abs(found.s_rad_per_s.back());
        });
    return is_short || has_gap ? std::numeric_limits<double>::infinity() : 0.0;
  }
  const auto place = std::ranges::find(found.s_rad_per_s, *root) - found.s_rad_per_s.begin();
  if (place >= std::ssize(found.relative_change)) return 0.0;
  return kOfChange * found.relative_change[static_cast<std::size_t>(place)];
}

double relative_distance(std::complex<double> s, std::complex<double> reference) {
  return std::abs(s - reference) / std::abs(reference);
}

std::vector<std::optional<std::complex<double>>> match(
    const FeatureFamily& family, std::span<const std::complex<double>> reference,
    std::span<const std::complex<double>> found) {
  const bool ordered = !family.zeros_of || arm::is_collocated(*family.zeros_of);
  if (ordered) {
    std::vector<std::optional<std::complex<double>>> matched(reference.size());
    for (std::size_t i = 0; i < reference.size() && i < found.size(); ++i) matched[i] = found[i];
    return matched;
  }
  return match_nearest(reference, found);
}

std::vector<std::optional<std::complex<double>>> match_nearest(
    std::span<const std::complex<double>> reference, std::span<const std::complex<double>> found) {
  std::vector<std::optional<std::complex<double>>> matched(reference.size());
  pair_nearest(reference, found, [&](std::size_t i, std::size_t j) {
    matched[i] = found[j];
    return true;
  });
  return matched;
}

void pair_nearest(std::span<const std::complex<double>> reference,
                  std::span<const std::complex<double>> found,
                  const std::function<bool(std::size_t, std::size_t)>& take) {
  struct Pair {
    double distance;
    std::size_t reference;
    std::size_t found;
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    for (std::size_t j = 0; j < found.size(); ++j) {
      const double distance = relative_distance(found[j], reference[i]);
      if (distance <= kNearest) pairs.push_back({distance, i, j});
    }
  }
  std::ranges::stable_sort(pairs, {}, &Pair::distance);
  std::vector<bool> matched(reference.size(), false);
  std::vector<bool> taken(found.size(), false);
  for (const Pair& pair : pairs) {
    if (matched[pair.reference] || taken[pair.found]) continue;
    matched[pair.reference] = taken[pair.found] = take(pair.reference, pair.found);
  }
}

}  // namespace flexarm::compare
