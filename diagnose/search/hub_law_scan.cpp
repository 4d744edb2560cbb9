#include "diagnose/search/hub_law_scan.hpp"

#include "arm/input_error.hpp"
#include "diagnose/search/least_squares.hpp"
#include "diagnose/symptoms/hub_regression.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <variant>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;

/// The hub is taken to rest below this velocity, in standard deviations of its noise.
constexpr double kNoiseOfRest = 2.0;

/// Of the refinement: the share to four digits.
constexpr int kSteps = 8;
constexpr double kTolerance = 1e-4;

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

/// Places of the last effect's parameters among those of a candidate.
Eigen::VectorXd last_places(const Candidate& candidate) {
  return candidate.coordinates()(last_coordinates(candidate));
}

void put_last(Candidate& candidate, const Eigen::VectorXd& places) {
  Eigen::VectorXd all = candidate.coordinates();
  all(last_coordinates(candidate)) = places;
  candidate.put(all);
}

/// The candidate, and where parameters of its last effect have a neutral value, also with these
/// beside it.
std::vector<Candidate> refined_from(const Candidate& scanned) {
  constexpr double kBeside = 1e-3;
  const std::vector<SearchedParameter>& parameters = scanned.effects.back().parameters;
  Eigen::VectorXd places = last_places(scanned);
  bool has_neutral = false;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto neutral = parameters[i].neutral_coordinate();
    if (!neutral) continue;
    places(static_cast<Index>(i)) = *neutral + std::copysign(kBeside, 0.5 - *neutral);
    has_neutral = true;
  }
  if (!has_neutral) return {scanned};
  Candidate beside = scanned;
  put_last(beside, places);
  return {scanned, beside};
}

/// What a candidate leaves of the hub's signals; empty for one whose last law is of another kind.
using LeftBy = std::function<std::optional<Eigen::VectorXd>(const Candidate&)>;

/// `from` with the law that leaves least, and its sum of squares.
std::pair<Candidate, double> refined(const LeftBy& left_by, const Candidate& from, Index count,
                                     const ReportedWork* work) {
  const auto left_at = [&](const Eigen::VectorXd& places) -> Eigen::VectorXd {
    if (work != nullptr) work->go_on();
    Candidate tried = from;
    put_last(tried, places);
    const auto left = left_by(tried);
    return left ? *left : Eigen::VectorXd::Constant(count, kImpossibleResidual);
  };
  const LeastSquares best =
      least_squares(left_at, last_places(from), {.most_steps = kSteps, .tolerance = kTolerance});
  Candidate found = from;
  put_last(found, best.places);
  return {found, best.residuals.squaredNorm()};
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
  const LeftBy left_by = [&](const Candidate& candidate) -> std::optional<Eigen::VectorXd> {
    const auto tried = last_law(candidate, arm);
    if (!tried) return std::nullopt;
    try {
      return hub.residuals() - hub.readings(torques_of(*tried, motions));
    } catch (const arm::InputError&) {  // of a formula that is not finite there
      return std::nullopt;
    }
  };
  const auto squares_left_by = [&](const Candidate& candidate) {
    const auto left = left_by(candidate);
    return left ? left->squaredNorm() : std::numeric_limits<double>::infinity();
  };
  HubLawScan made{scan(squares_left_by, start, last_coordinates(start), options)};
  double least = squares_left_by(made.starts.front());
  for (const Candidate& from : refined_from(made.starts.front())) {
    if (!left_by(from)) continue;
    const auto [found, left] = refined(left_by, from, hub.residuals().size(), options.work);
    if (!(left < least)) continue;
    least = left;
    made.starts.front() = found;
  }
  made.share = std::clamp((hub.residuals().squaredNorm() - least) / hub.beyond_noise(), 0.0, 1.0);
  return made;
}

}  // namespace flexarm::diagnose
