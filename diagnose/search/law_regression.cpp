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
  if (std::holds_alternative<arm::SmoothHubTorque>(law)) return true;
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
    // Not finite, or states that move too fast.
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
  if (periodic == parameters.end()) return;
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
    const bool is_solved = !amplitudes_.empty() && (i == amplitudes_.front() || i == phase_);
    if (!is_solved) others.push_back(all[i]);
  }
  return others;
}

std::optional<Candidate> LinearParameters::quarter_of(const Candidate& candidate) const {
  return phase_ ? std::optional(turned(candidate, 0.25)) : std::nullopt;
}

std::pair<Candidate, double> LinearParameters::solved(const Candidate& candidate,
                                                      const LawProducts& products) const {
  constexpr double kLeast = 1e-2;
  const auto& [rr, ra, rb, aa, ab, bb] = products;
  // With `a` times the readings and `b` times those a quarter on.
  const auto left = [&](double a, double b) {
    return rr - 2.0 * (a * ra + b * rb) + a * a * aa + 2.0 * a * b * ab + b * b * bb;
  };
  if (amplitudes_.empty()) return {candidate, left(1.0, 0.0)};
  const double largest = largest_size(candidate);
  if (!phase_) {
    const double size = std::clamp(aa > 0.0 ? ra / aa : 0.0, kLeast, largest);
    return {times(candidate, size), left(size, 0.0)};
  }
  Eigen::Matrix2d normal;
  normal << aa, ab, ab, bb;
  // Of readings that are nearly the same the shortest solution.
  const Eigen::Vector2d solution =
      normal.completeOrthogonalDecomposition().solve(Eigen::Vector2d(ra, rb));
  const double size = std::clamp(solution.norm(), kLeast, largest);
  const double angle = std::atan2(solution(1), solution(0));
  return {times(turned(candidate, angle / (2.0 * std::numbers::pi)), size),
          left(size * std::cos(angle), size * std::sin(angle))};
}

Candidate LinearParameters::times(const Candidate& candidate, double size) const {
  Candidate made = candidate;
  for (const std::size_t i : amplitudes_) made.values[first_ + i] *= size;
  return made;
}

Candidate LinearParameters::turned(const Candidate& candidate, double turns) const {
  Candidate made = candidate;
  double& value = made.values[first_ + *phase_];
  const double lowest = candidate.effects.back().parameters[*phase_].lowest;
  const double place = (value - lowest) / turn_ + turns;
  value = lowest + turn_ * (place - std::floor(place));
  return made;
}

double LinearParameters::largest_size(const Candidate& candidate) const {
  double largest = std::numeric_limits<double>::max();
  for (const std::size_t i : amplitudes_) {
    const double highest = candidate.effects.back().parameters[i].highest;
    largest = std::min(largest, highest / candidate.values[first_ + i]);
  }
  return std::max(largest, 1.0);
}

}  // namespace flexarm::diagnose
