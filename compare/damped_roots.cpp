#include "compare/damped_roots.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <variant>

namespace flexarm::compare {

namespace {

using Root = std::complex<double>;

constexpr int kMostSteps = 60;
constexpr double kFirstStep = 1e-4;  // relative to the root
constexpr double kSettled = 1e-10;   // |step| <= kSettled |s|
constexpr double kFarthest = 0.5;    // |s - start| <= kFarthest |start|

std::optional<Root> followed(const response::AnyFormulation& formulation, const arm::Sensor& sensor,
                             Root start) {
  const auto value = [&](Root s) { return response::transfer_function(formulation, sensor, s); };
  Root last = start;
  Root s = start - kFirstStep * std::abs(start);  // damping moves roots to the left
  Root value_last = value(last);
  for (int k = 0; k < kMostSteps; ++k) {
    const Root value_here = value(s);
    if (value_here == value_last) return value_here == 0.0 ? std::optional(s) : std::nullopt;
    const Root step = -value_here * (s - last) / (value_here - value_last);
    last = s;
    value_last = value_here;
    s += step;
    if (!(std::abs(s - start) <= kFarthest * std::abs(start))) return std::nullopt;
    if (std::abs(step) <= kSettled * std::abs(s)) return s;
  }
  return std::nullopt;
}

/// The undamped zero and its mirror image, which damping moves away from each other's image.
arm::PolePair undamped_pair(Root zero) {
  return {zero, zero.imag() == 0.0 || zero.real() != 0.0 ? -zero : std::conj(zero)};
}

}  // namespace

NaturalFrequency natural_frequency(const arm::PolePair& pair) {
  const double omega = std::sqrt(std::abs(pair.first_rad_per_s * pair.second_rad_per_s));
  const double sum = (pair.first_rad_per_s + pair.second_rad_per_s).real();
  return {omega / (2.0 * std::numbers::pi), -sum / (2.0 * omega)};
}

std::vector<std::optional<arm::PolePair>> zeros_with_damping(
    const response::AnyFormulation& formulation, const arm::Sensor& sensor,
    std::span<const Root> undamped_rad_per_s) {
  const auto* own = std::get_if<exact_tf::ExactArm>(&formulation);
  auto pairs = own != nullptr ? own->damped_zeros(sensor, undamped_rad_per_s).pairs
                              : exact_tf::ExactArm(response::arm_of(formulation))
                                    .damped_zeros(sensor, undamped_rad_per_s)
                                    .pairs;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (own != nullptr && pairs[i]) continue;
    const arm::PolePair start = pairs[i].value_or(undamped_pair(undamped_rad_per_s[i]));
    const auto first = followed(formulation, sensor, start.first_rad_per_s);
    const bool is_conjugate = start.second_rad_per_s == std::conj(start.first_rad_per_s);
    const auto second =
        !first || is_conjugate ? first : followed(formulation, sensor, start.second_rad_per_s);
    pairs[i].reset();
    if (!first || !second) continue;
    pairs[i] = arm::PolePair{*first, is_conjugate ? std::conj(*first) : *second};
  }
  return pairs;
}

std::vector<Root> with_conjugates(const arm::PolePair& pair) {
  std::vector<Root> roots;
  for (const Root& s : {pair.first_rad_per_s, pair.second_rad_per_s}) {
    for (const Root& root : {s, std::conj(s)}) {
      if (std::ranges::find(roots, root) == roots.end()) roots.push_back(root);
    }
  }
  return roots;
}

}  // namespace flexarm::compare
