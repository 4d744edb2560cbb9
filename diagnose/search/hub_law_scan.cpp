#include "diagnose/search/hub_law_scan.hpp"

#include "arm/input_error.hpp"
#include "diagnose/symptoms/hub_regression.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

namespace flexarm::diagnose {

namespace {

/// The hub is taken to rest below this velocity, in standard deviations of its noise.
constexpr double kNoiseOfRest = 2.0;

bool is_scanned(const arm::HubLaw& law) {
  if (const auto* smooth = std::get_if<arm::SmoothHubTorque>(&law)) return smooth->states == 0;
  const auto* friction = std::get_if<arm::DryFriction>(&law);
  return friction != nullptr && friction->changes_over_rad_per_s.has_value();
}

/// The law of the candidate's last effect. Empty for a law that is not scanned, which it may be at
/// some values of its parameters alone; for an effect that is more than a law; and for values that
/// it cannot have.
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

double torque_N_m(const arm::HubLaw& law, const HubMotion& motion, std::size_t k) {
  const double velocity = at_sample(motion, motion.velocity_rad_per_s, k);
  if (const auto* friction = std::get_if<arm::DryFriction>(&law)) {
    return -sign_at_sample(motion, k) * friction->size(std::abs(velocity)).torque_N_m;
  }
  const arm::HubState hub{.angle_rad = at_sample(motion, motion.angle_rad, k),
                          .velocity_rad_per_s = velocity,
                          .torque_N_m = motion.torque_N_m[k],
                          .time_s = at_sample(motion, motion.time_s, k) - motion.time_s.front()};
  return std::get<arm::SmoothHubTorque>(law).law(hub, {}, {}).torque_N_m;
}

HubTorques torques_of(const arm::HubLaw& law, const std::vector<HubMotion>& motions) {
  HubTorques made;
  for (const HubMotion& motion : motions) {
    auto& own = made.emplace_back(motion.time_s.size());
    for (std::size_t k = 0; k < own.size(); ++k) own[k] = torque_N_m(law, motion, k);
  }
  return made;
}

}  // namespace

std::optional<HubLawScan> scan_hub_law(const Problem& problem, const Candidate& start,
                                       const ScanOptions& options) {
  if (!problem.is_driven_by_torque()) return std::nullopt;
  const arm::Arm& arm = problem.experiment().arm;
  const std::optional<arm::HubLaw> law = last_law(start, arm);
  if (!law) return std::nullopt;
  const Candidate base = start.without(start.effects.size() - 1);
  const std::vector<bool>& runs = problem.estimation_runs();
  const auto residuals = problem.residuals(base, runs);
  if (!residuals) return std::nullopt;
  std::vector<HubMotion> motions = hub_motions({problem, *residuals, *residuals, base});
  std::erase_if(motions, [&](const HubMotion& motion) { return !runs[motion.run]; });
  if (std::ssize(motions) != std::ranges::count(runs, true)) return std::nullopt;
  const bool is_friction = std::holds_alternative<arm::DryFriction>(*law);
  if (is_friction && part_at_rest(motions) > kMostRest) return std::nullopt;
  const HubRegression hub(motions);
  const auto left_by = [&](const Candidate& candidate) {
    const auto tried = last_law(candidate, arm);
    if (!tried) return std::numeric_limits<double>::infinity();
    try {
      return (hub.residuals() - hub.readings(torques_of(*tried, motions))).squaredNorm();
    } catch (const arm::InputError&) {  // of a formula that is not finite there
      return std::numeric_limits<double>::infinity();
    }
  };
  HubLawScan made{scan(left_by, start, last_coordinates(start), options)};
  const double taken = hub.residuals().squaredNorm() - left_by(made.starts.front());
  made.share = std::clamp(taken / hub.beyond_noise(), 0.0, 1.0);
  return made;
}

}  // namespace flexarm::diagnose
