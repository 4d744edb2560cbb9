#include "diagnose/search/hub_law_scan.hpp"

#include "diagnose/search/law_regression.hpp"
#include "diagnose/search/law_torques.hpp"
#include "diagnose/search/least_squares.hpp"
#include "diagnose/search/misfit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>
#include <variant>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;

/// Of the refinement: the share to four digits.
constexpr int kSteps = 8;
constexpr double kTolerance = 1e-4;

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
  const auto* smooth = std::get_if<arm::SmoothHubTorque>(&*law);
  const bool may_stick = smooth == nullptr || smooth->states > 0;
  if (may_stick && part_at_rest(motions) > kMostRest) return std::nullopt;
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
  std::vector<double> left_by_starts;
  for (Candidate& one : made.starts) {
    std::tie(one, left_by_starts.emplace_back()) = linear.best(one);
  }
  double least = left_by_starts.front();
  for (const Candidate& from : refined_from(made.starts.front())) {
    if (!laws.readings(from)) continue;
    const auto [found, left] = refined(laws, from, options.work);
    if (!(left < least)) continue;
    least = left;
    made.starts.front() = found;
  }
  const Eigen::VectorXd& of_hub = laws.hub().residuals();
  made.share = std::clamp((of_hub.squaredNorm() - least) / beyond_noise(of_hub), 0.0, 1.0);
  return made;
}

}  // namespace flexarm::diagnose
