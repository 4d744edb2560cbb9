#pragma once

#include "arm/sensor.hpp"
#include "response/any_formulation.hpp"

#include <complex>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace flexarm::compare {

/// The poles, or the zeros of one sensor.
struct FeatureFamily {
  std::optional<arm::Sensor> zeros_of;  ///< empty: the poles
  int count = 10;

  bool operator==(const FeatureFamily&) const = default;
};

/// "pole", "hub_angle zero".
std::string label(const FeatureFamily& family);

/// The roots s [rad/s] that a formulation gives for the family: poles as i omega; zeros as in
/// arm::ZeroSet.
struct FeatureRoots {
  std::vector<std::complex<double>> s_rad_per_s;
  std::vector<double> relative_change;  ///< as in arm::ZeroSet
  std::vector<arm::RejectedZero> rejected;
  int infinite = 0;
  arm::RootCount count;
};
FeatureRoots roots(const response::AnyFormulation& formulation, const FeatureFamily& family);

/// What the formulation itself says of the error of a root of `found`, relative: ten times what a
/// finer model changes; 0 where it says nothing. For a root that it lacks infinity where it says
/// that one may be missing: fewer roots than asked for, another number than it counted, or a
/// rejected root among those found.
double stated_error(const FeatureRoots& found, const FeatureFamily& family,
                    const std::optional<std::complex<double>>& root);

/// For each reference root the root of `found` that stands for it, or empty: by order where roots
/// are ordered by the theory (poles, zeros of a collocated sensor: Rayleigh-Ritz bounds), else
/// nearest pairs first, each root once, at most `kNearest` of the reference's modulus apart.
std::vector<std::optional<std::complex<double>>> match(
    const FeatureFamily& family, std::span<const std::complex<double>> reference,
    std::span<const std::complex<double>> found);

/// The second of these ways.
std::vector<std::optional<std::complex<double>>> match_nearest(
    std::span<const std::complex<double>> reference, std::span<const std::complex<double>> found);

/// Pairs roots as `match_nearest` does, where `take(i, j)` decides whether reference root i and root
/// j of `found` are a pair: it is asked of the nearest first, while neither has another.
void pair_nearest(std::span<const std::complex<double>> reference,
                  std::span<const std::complex<double>> found,
                  const std::function<bool(std::size_t, std::size_t)>& take);

/// A root further than this from a reference root, relative to its modulus, is not taken for it.
inline constexpr double kNearest = 0.3;

/// |s - reference|/|reference|.
double relative_distance(std::complex<double> s, std::complex<double> reference);

}  // namespace flexarm::compare
