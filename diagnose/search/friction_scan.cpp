#include "diagnose/search/friction_scan.hpp"

#include "arm/input_error.hpp"
#include "diagnose/symptoms/hub_regression.hpp"
#include "response/arm_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace flexarm::diagnose {

namespace {

constexpr double kNoiseOfRest = 2.0;  // deviations

/// Of the effect alone, where its friction changes with speed and it is nothing else.
std::optional<arm::DryFriction> falling_friction(const arm::Arm& arm, const std::string& effect) {
  const response::HubLaws laws = response::take_apart(arm).hub;
  const auto is_own = [&](const auto& law) { return law.effect == effect; };
  const auto own = std::ranges::find_if(laws.friction, is_own);
  if (own == laws.friction.end() || !own->part.changes_over_rad_per_s ||
      std::ranges::any_of(laws.smooth, is_own)) {
    return std::nullopt;
  }
  return own->part;
}

/// Part of the samples at which the velocity is zero within its noise.
double part_at_rest(const std::vector<HubMotion>& motions) {
  double at_rest = 0.0;
  double samples = 0.0;
  for (const HubMotion& motion : motions) {
    for (std::size_t k = 0; k < motion.time_s.size(); ++k) {
      const double speed = std::abs(at_sample(motion, motion.velocity_rad_per_s, k));
      if (speed < kNoiseOfRest * motion.velocity_noise_rad_per_s) at_rest += 1.0;
    }
    samples += static_cast<double>(motion.time_s.size());
  }
  return at_rest / samples;
}

bool shows_hub_alone_in_time(const Problem& problem, const std::vector<HubMotion>& motions) {
  return problem.is_driven_by_torque() && motions.size() == problem.experiment().runs.size();
}

HubTorques torques_of(const arm::DryFriction& friction, const std::vector<HubMotion>& motions) {
  HubTorques made;
  for (const HubMotion& motion : motions) {
    auto& own = made.emplace_back(motion.time_s.size());
    for (std::size_t k = 0; k < own.size(); ++k) {
      const double speed = std::abs(at_sample(motion, motion.velocity_rad_per_s, k));
      own[k] = -sign_at_sample(motion, k) * friction.size(speed).torque_N_m;
    }
  }
  return made;
}

}  // namespace

std::optional<FrictionScan> scan_friction(const Problem& problem, const Candidate& start,
                                          const ScanOptions& options) {
  const arm::Arm& arm = problem.experiment().arm;
  const std::string& effect = start.effects.back().effect;
  if (!falling_friction(start.extend(arm), effect)) return std::nullopt;
  const Candidate base = start.without(start.effects.size() - 1);
  const auto residuals = problem.residuals(base, problem.estimation_runs());
  if (!residuals) return std::nullopt;
  const std::vector<HubMotion> motions = hub_motions({problem, *residuals, *residuals, base});
  if (!shows_hub_alone_in_time(problem, motions)) return std::nullopt;
  if (part_at_rest(motions) > kMostRest) return std::nullopt;
  const HubRegression hub(motions);
  const auto left_by = [&](const Candidate& candidate) {
    try {
      const auto friction = falling_friction(candidate.extend(arm), effect);
      if (!friction) return std::numeric_limits<double>::infinity();
      return (hub.residuals() - hub.readings(torques_of(*friction, motions))).squaredNorm();
    } catch (const arm::InputError&) {
      return std::numeric_limits<double>::infinity();
    }
  };
  FrictionScan made{scan(left_by, start, last_coordinates(start), options)};
  const double taken = hub.residuals().squaredNorm() - left_by(made.starts.front());
  made.share = std::clamp(taken / hub.beyond_noise(), 0.0, 1.0);
  return made;
}

}  // namespace flexarm::diagnose
