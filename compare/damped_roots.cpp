#include "compare/damped_roots.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace flexarm::compare {

namespace {

using Root = std::complex<double>;

constexpr int kMostSteps = 60;
constexpr double kFirstStep = 1e-4;  // relative to the root
constexpr double kSettled = 1e-10;   // |step| <= kSettled |s|
constexpr double kFarthest = 0.5;    // |s - start| <= kFarthest |start|
constexpr double kOneRoot = 1e-8;    // relative distance of what is one root

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

}  // namespace

std::vector<Root> poles_with_damping(const response::AnyFormulation& formulation, int count) {
  std::vector<Root> poles;
  for (const auto& pair : response::damped_poles(formulation, count).flexible) {
    poles.push_back(pair.first_rad_per_s);
    poles.push_back(pair.second_rad_per_s);
  }
  return poles;
}

std::vector<Root> zeros_with_damping(const response::AnyFormulation& formulation,
                                     const arm::Sensor& sensor,
                                     const std::vector<Root>& undamped_rad_per_s) {
  std::vector<Root> zeros;
  const auto add = [&](Root zero) {
    const bool is_new = std::ranges::none_of(
        zeros, [&](Root other) { return std::abs(other - zero) <= kOneRoot * std::abs(zero); });
    if (is_new) zeros.push_back(zero);
  };
  for (const Root& undamped : undamped_rad_per_s) {
    // Mirror images at the imaginary axis are different roots with damping; conjugates remain.
    for (const Root& start : {undamped, -std::conj(undamped)}) {
      if (const auto zero = followed(formulation, sensor, start)) {
        add(*zero);
        add(std::conj(*zero));
      }
    }
  }
  return zeros;
}

}  // namespace flexarm::compare
