#include "diagnose/search/hub_law_scan.hpp"

#include "arm/input_error.hpp"
#include "diagnose/search/least_squares.hpp"
#include "diagnose/symptoms/hub_regression.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
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

/// What laws of hub torque, the last effects of candidates, leave of the hub's signals.
class LawRegression {
 public:
  /// The references must outlive the object.
  LawRegression(const arm::Arm& arm, const std::vector<HubMotion>& motions)
      : arm_(arm), motions_(motions), hub_(motions) {}

  const HubRegression& hub() const { return hub_; }

  /// Empty for a candidate whose last law is of another kind, or not finite at some motion.
  std::optional<Eigen::VectorXd> readings(const Candidate& candidate) const {
    const auto law = last_law(candidate, arm_);
    if (!law) return std::nullopt;
    try {
      return hub_.readings(torques_of(*law, motions_));
    } catch (const arm::InputError&) {
      return std::nullopt;
    }
  }
  std::optional<Eigen::VectorXd> left_by(const Candidate& candidate) const {
    const auto made = readings(candidate);
    return made ? std::optional<Eigen::VectorXd>(hub_.residuals() - *made) : std::nullopt;
  }

 private:
  const arm::Arm& arm_;
  const std::vector<HubMotion>& motions_;
  HubRegression hub_;
};

/// The parameters of the last effect that a law's torque is linear in: amplitudes, all of which
/// together it is in proportion to, and beside them the phase of a sine.
class LinearParameters {
 public:
  /// Of `start`, each where readings at a few values confirm it.
  LinearParameters(const LawRegression& laws, const Candidate& start) : laws_(laws) {
    const std::vector<SearchedParameter>& parameters = start.effects.back().parameters;
    first_ = start.values.size() - parameters.size();
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      if (parameters[i].spacing == effects::Spacing::from_zero) amplitudes_.push_back(i);
    }
    const auto once = laws.readings(start);
    if (amplitudes_.empty() || !once || !is_combination({2.0 * *once}, times(start, 2.0))) {
      amplitudes_.clear();
      return;
    }
    const auto periodic = std::ranges::find_if(parameters, &SearchedParameter::periodic);
    if (periodic == parameters.end()) return;
    phase_ = static_cast<std::size_t>(periodic - parameters.begin());
    turn_ = periodic->highest - periodic->lowest;
    const auto quarter = laws.readings(turned(start, 0.25));
    if (!quarter ||
        !is_combination((*once + *quarter) / std::numbers::sqrt2, turned(start, 0.125))) {
      phase_.reset();
    }
  }

  /// The coordinates of the last effect that `best` does not solve for: all but the first amplitude
  /// and the phase.
  std::vector<Index> other_coordinates(const Candidate& candidate) const {
    std::vector<Index> others;
    const std::vector<Index> all = last_coordinates(candidate);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const bool is_solved = !amplitudes_.empty() && (i == amplitudes_.front() || i == phase_);
      if (!is_solved) others.push_back(all[i]);
    }
    return others;
  }

  /// `candidate` with those amplitudes within their ranges, in their ratio, and that phase which
  /// leave least; and the sum of squares that it leaves. Infinite where it leaves nothing to
  /// compare.
  std::pair<Candidate, double> best(const Candidate& candidate) const {
    const auto readings = laws_.readings(candidate);
    if (!readings) return {candidate, std::numeric_limits<double>::infinity()};
    const auto left = [&](const Eigen::VectorXd& made) {
      return (laws_.hub().residuals() - made).squaredNorm();
    };
    if (amplitudes_.empty()) return {candidate, left(*readings)};
    const auto quarter = phase_ ? laws_.readings(turned(candidate, 0.25)) : std::nullopt;
    Eigen::MatrixXd terms(readings->size(), quarter ? 2 : 1);
    terms.col(0) = *readings;
    if (quarter) terms.col(1) = *quarter;
    const Eigen::VectorXd solved = terms.colPivHouseholderQr().solve(laws_.hub().residuals());
    constexpr double kLeast = 1e-2;
    const double size =
        std::clamp(quarter ? solved.norm() : solved(0), kLeast, largest_size(candidate));
    if (!quarter) return {times(candidate, size), left(size * *readings)};
    const double angle = std::atan2(solved(1), solved(0));
    return {times(turned(candidate, angle / (2.0 * std::numbers::pi)), size),
            left(size * (std::cos(angle) * *readings + std::sin(angle) * *quarter))};
  }

 private:
  bool is_combination(const Eigen::VectorXd& expected, const Candidate& candidate) const {
    constexpr double kRounding = 1e-9;
    const auto made = laws_.readings(candidate);
    return made && (*made - expected).norm() <= kRounding * expected.norm();
  }
  Candidate times(const Candidate& candidate, double size) const {
    Candidate made = candidate;
    for (const std::size_t i : amplitudes_) made.values[first_ + i] *= size;
    return made;
  }
  Candidate turned(const Candidate& candidate, double turns) const {
    Candidate made = candidate;
    double& value = made.values[first_ + *phase_];
    const double lowest = candidate.effects.back().parameters[*phase_].lowest;
    const double place = (value - lowest) / turn_ + turns;
    value = lowest + turn_ * (place - std::floor(place));
    return made;
  }
  double largest_size(const Candidate& candidate) const {
    double largest = std::numeric_limits<double>::max();
    for (const std::size_t i : amplitudes_) {
      const double highest = candidate.effects.back().parameters[i].highest;
      largest = std::min(largest, highest / candidate.values[first_ + i]);
    }
    return std::max(largest, 1.0);
  }

  const LawRegression& laws_;
  std::size_t first_ = 0;  // of the last effect's values
  std::vector<std::size_t> amplitudes_;
  std::optional<std::size_t> phase_ = {};
  double turn_ = 0.0;
};

/// `from` with the law that leaves least, and its sum of squares.
std::pair<Candidate, double> refined(const LawRegression& laws, const Candidate& from,
                                     const ReportedWork* work) {
  const auto left_at = [&](const Eigen::VectorXd& places) -> Eigen::VectorXd {
    if (work != nullptr) work->go_on();
    Candidate tried = from;
    put_last(tried, places);
    const auto left = laws.left_by(tried);
    return left ? *left
                : Eigen::VectorXd::Constant(laws.hub().residuals().size(), kImpossibleResidual);
  };
  const LeastSquares best =
      least_squares(left_at, last_places(from), {.most_steps = kSteps, .tolerance = kTolerance});
  Candidate found = from;
  put_last(found, best.places);
  return {found, best.residuals.squaredNorm()};
}

}  // namespace

std::optional<HubLawScan> scan_hub_law(const Problem& problem, const Candidate& start,
                                       const HubLawScanOptions& options) {
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
  const LawRegression laws(arm, motions);
  const LinearParameters linear(laws, start);
  const std::vector<Index> scanned = linear.other_coordinates(start);
  HubLawScan made;
  if (scanned.empty()) {
    made.starts = {start};
  } else {
    const std::size_t n = std::min(scanned.size(), options.evaluations.size());
    made.starts = scan([&](const Candidate& candidate) { return linear.best(candidate).second; },
                       start, scanned,
                       {.evaluations = options.evaluations[n - 1],
                        .starts = options.starts,
                        .work = options.work});
  }
  for (Candidate& one : made.starts) one = linear.best(one).first;
  double least = linear.best(made.starts.front()).second;
  for (const Candidate& from : refined_from(made.starts.front())) {
    if (!laws.readings(from)) continue;
    const auto [found, left] = refined(laws, from, options.work);
    if (!(left < least)) continue;
    least = left;
    made.starts.front() = found;
  }
  const HubRegression& hub = laws.hub();
  made.share = std::clamp((hub.residuals().squaredNorm() - least) / hub.beyond_noise(), 0.0, 1.0);
  return made;
}

}  // namespace flexarm::diagnose
