#include "diagnose/search/law_regression.hpp"

#include "arm/input_error.hpp"
#include "diagnose/search/law_torques.hpp"
#include "diagnose/search/scan.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <variant>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;

bool is_scanned(const arm::HubLaw& law) {
  if (const auto* smooth = std::get_if<arm::SmoothHubTorque>(&law)) {
    return smooth->states == 0 || smooth->after_turn;
  }
  const auto* friction = std::get_if<arm::DryFriction>(&law);
  return friction != nullptr && friction->changes_over_rad_per_s.has_value();
}

}  // namespace

std::optional<arm::HubLaw> last_law(const Candidate& candidate, const arm::Arm& arm) {
  try {
    const arm::Arm extended = candidate.extend(arm);
    const arm::Effect& effect = extended.effects.at(candidate.effects.back().effect);
    if (effect.definition->ports() != std::vector{arm::Port::hub_torque}) return std::nullopt;
    const arm::HubLaw law = effect.definition->hub_torque(effect);
    return is_scanned(law) ? std::optional(law) : std::nullopt;
  } catch (const arm::InputError&) {
    return std::nullopt;
  }
}

std::optional<HubTorques> LawRegression::torques(const Candidate& candidate) const {
  const auto law = last_law(candidate, arm_);
  if (!law) return std::nullopt;
  try {
    return torques_of(*law, hub_.motions());
  } catch (const std::runtime_error&) {
    // Not finite.
    return std::nullopt;
  }
}

std::optional<Eigen::VectorXd> LawRegression::readings(const Candidate& candidate) const {
  const auto made = torques(candidate);
  if (!made) return std::nullopt;
  Eigen::VectorXd readings = hub_.readings(*made);
  if (!readings.allFinite()) return std::nullopt;  // too large
  return readings;
}

namespace {

/// Of amplitudes that are solved for, in those of the grid.
constexpr double kLeastAmplitude = 1e-2;

std::vector<double> parts_of_last(const Candidate& candidate) {
  const std::size_t last = candidate.effects.size() - 1;
  return effects::parts_of(candidate.effects[last].parameters, candidate.values_of(last));
}

/// The readings of the candidate are these, but for rounding.
bool are_readings(const LawRegression& laws, const Candidate& candidate,
                  const Eigen::VectorXd& expected) {
  constexpr double kRounding = 1e-9;
  const auto made = laws.readings(candidate);
  return made && (*made - expected).norm() <= kRounding * expected.norm();
}

}  // namespace

LinearParameters::LinearParameters(const LawRegression& laws, const Candidate& start) {
  const std::vector<SearchedParameter>& parameters = start.effects.back().parameters;
  first_ = start.values.size() - parameters.size();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].spacing == effects::Spacing::from_zero) amplitudes_.push_back(i);
  }
  const auto once = laws.readings(start);
  if (amplitudes_.empty() || !once || !are_readings(laws, times(start, 2.0), 2.0 * *once)) {
    amplitudes_.clear();
    return;
  }
  const auto periodic = std::ranges::find_if(parameters, &SearchedParameter::periodic);
  if (periodic == parameters.end()) {
    if (amplitudes_.size() != 2) return;
    second_ = amplitudes_.back();
    const auto twice = laws.readings(times_each(start, 1.0, 2.0));
    const auto is_linear = [&] {
      return are_readings(laws, times_each(start, 1.0, 1.5), 0.5 * (*once + *twice));
    };
    if (!twice || !is_linear()) second_.reset();
    return;
  }
  phase_ = static_cast<std::size_t>(periodic - parameters.begin());
  turn_ = periodic->highest - periodic->lowest;
  const auto quarter = laws.readings(turned(start, 0.25));
  const auto is_sine = [&] {
    return are_readings(laws, turned(start, 0.125), (*once + *quarter) / std::numbers::sqrt2);
  };
  if (!quarter || !is_sine()) phase_.reset();
}

std::vector<Index> LinearParameters::other_coordinates(const Candidate& candidate) const {
  std::vector<Index> others;
  const std::vector<Index> all = last_coordinates(candidate);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool is_solved =
        !amplitudes_.empty() && (i == amplitudes_.front() || i == phase_ || i == second_);
    if (!is_solved) others.push_back(all[i]);
  }
  return others;
}

std::optional<Candidate> LinearParameters::companion_of(const Candidate& candidate) const {
  if (phase_) return turned(candidate, 0.25);
  return second_ ? std::optional(times_each(candidate, 1.0, 2.0)) : std::nullopt;
}

std::pair<Candidate, double> LinearParameters::solved(const Candidate& candidate,
                                                      const LawProducts& products) const {
  if (second_) return solved_for_both(candidate, products);
  const auto& [rr, ra, rb, aa, ab, bb] = products;
  // With `a` times the readings and `b` times those a quarter on.
  const auto left = [&](double a, double b) {
    return rr - 2.0 * (a * ra + b * rb) + a * a * aa + 2.0 * a * b * ab + b * b * bb;
  };
  if (amplitudes_.empty()) return {candidate, left(1.0, 0.0)};
  const double largest = largest_size(candidate);
  if (!phase_) {
    const double size = std::clamp(aa > 0.0 ? ra / aa : 0.0, kLeastAmplitude, largest);
    return {times(candidate, size), left(size, 0.0)};
  }
  Eigen::Matrix2d normal;
  normal << aa, ab, ab, bb;
  // Of readings that are nearly the same the shortest solution.
  const Eigen::Vector2d solution =
      normal.completeOrthogonalDecomposition().solve(Eigen::Vector2d(ra, rb));
  const double size = std::clamp(solution.norm(), kLeastAmplitude, largest);
  const double angle = std::atan2(solution(1), solution(0));
  return {times(turned(candidate, angle / (2.0 * std::numbers::pi)), size),
          left(size * std::cos(angle), size * std::sin(angle))};
}

std::pair<Candidate, double> LinearParameters::solved_for_both(const Candidate& candidate,
                                                               const LawProducts& products) const {
  const auto& [rr, ra, rb, aa, ab, bb] = products;
  // Of the readings U and W that the amplitudes make, a = U + W and b = U + 2 W.
  Eigen::Matrix2d normal;
  normal << 4.0 * aa - 4.0 * ab + bb, 3.0 * ab - 2.0 * aa - bb, 3.0 * ab - 2.0 * aa - bb,
      aa - 2.0 * ab + bb;
  const Eigen::Vector2d along(2.0 * ra - rb, rb - ra);
  const auto left = [&](const Eigen::Vector2d& sizes) {
    return rr - 2.0 * sizes.dot(along) + sizes.dot(normal * sizes);
  };
  const Eigen::Vector2d least(kLeastAmplitude, kLeastAmplitude);
  const Eigen::Vector2d largest(largest_size(candidate, amplitudes_.front()),
                                largest_size(candidate, *second_));
  Eigen::Vector2d best = normal.completeOrthogonalDecomposition().solve(along);
  if ((best.array() < least.array() || best.array() > largest.array()).any()) {
    // The least is on an edge of the box.
    best = least;
    for (const Eigen::Index fixed : {0, 1}) {
      const Eigen::Index free = 1 - fixed;
      for (const double at : {least(fixed), largest(fixed)}) {
        Eigen::Vector2d sizes;
        sizes(fixed) = at;
        const double size = normal(free, free) > 0.0
                                ? (along(free) - normal(free, fixed) * at) / normal(free, free)
                                : 0.0;
        sizes(free) = std::clamp(size, least(free), largest(free));
        if (left(sizes) < left(best)) best = sizes;
      }
    }
  }
  return {times_each(candidate, best(0), best(1)), left(best)};
}

Candidate LinearParameters::times(const Candidate& candidate, double size) const {
  Candidate made = candidate;
  for (const std::size_t i : amplitudes_) made.values[first_ + i] *= size;
  return made;
}

Candidate LinearParameters::times_each(const Candidate& candidate, double first,
                                       double second) const {
  const Hypothesis& effect = candidate.effects.back();
  std::vector<double> parts = parts_of_last(candidate);
  parts[amplitudes_.front()] *= first;
  parts[amplitudes_.back()] *= second;
  return candidate.without(candidate.effects.size() - 1)
      .with(effect, effects::values_of(effect.parameters, std::move(parts)));
}

Candidate LinearParameters::turned(const Candidate& candidate, double turns) const {
  Candidate made = candidate;
  double& value = made.values[first_ + *phase_];
  const double lowest = candidate.effects.back().parameters[*phase_].lowest;
  const double place = (value - lowest) / turn_ + turns;
  value = lowest + turn_ * (place - std::floor(place));
  return made;
}

double LinearParameters::largest_size(const Candidate& candidate, std::size_t amplitude) const {
  const SearchedParameter& parameter = candidate.effects.back().parameters[amplitude];
  return std::max(parameter.highest / parts_of_last(candidate)[amplitude], 1.0);
}

double LinearParameters::largest_size(const Candidate& candidate) const {
  double largest = std::numeric_limits<double>::max();
  for (const std::size_t i : amplitudes_) largest = std::min(largest, largest_size(candidate, i));
  return largest;
}

}  // namespace flexarm::diagnose
