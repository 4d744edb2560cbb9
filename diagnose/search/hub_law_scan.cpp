#include "diagnose/search/hub_law_scan.hpp"

#include "diagnose/search/hub_laws.hpp"
#include "diagnose/search/least_squares.hpp"
#include "diagnose/search/misfit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;

/// Of the refinement: the share to four digits.
constexpr int kSteps = 8;
constexpr double kTolerance = 1e-4;

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

/// `from` with the law that leaves least of `residuals`, and its sum of squares.
std::pair<Candidate, double> refined(const LawRegression& laws, const Eigen::VectorXd& residuals,
                                     const Candidate& from, const ReportedWork* work) {
  const auto left_at = [&](const Eigen::VectorXd& places) -> Eigen::VectorXd {
    if (work != nullptr) work->go_on();
    Candidate tried = from;
    put_last(tried, places);
    const auto made = laws.readings(tried);
    if (made) return residuals - *made;
    return Eigen::VectorXd::Constant(residuals.size(), kImpossibleResidual);
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
  HubLaws& laws = problem.hub_laws();
  const std::size_t last = start.effects.size() - 1;
  const Candidate law = Candidate{}.with(start.effects[last], start.values_of(last));
  const HubLawGrid* grid = laws.grid(law, options.evaluations, options.work);
  if (grid == nullptr) return std::nullopt;
  const Candidate base = start.without(last);
  std::optional<Eigen::VectorXd> simulated;
  const Eigen::VectorXd* all = options.base_residuals;
  if (all == nullptr) {
    simulated = problem.residuals(base, problem.estimation_runs());
    if (!simulated) return std::nullopt;
    all = &*simulated;
  }
  const Eigen::VectorXd residuals = laws.residuals(*all);
  std::vector<std::pair<Candidate, double>> found = grid->best(residuals, options.starts);
  auto& [best, least] = found.front();
  for (const Candidate& from : refined_from(best)) {
    if (!laws.regression().readings(from)) continue;
    const auto [other, left] = refined(laws.regression(), residuals, from, options.work);
    if (!(left < least)) continue;
    least = left;
    best = other;
  }
  HubLawScan made;
  for (const auto& [candidate, left] : found) {
    made.starts.push_back(base.with(candidate.effects.front(), candidate.values));
  }
  made.share = std::clamp((residuals.squaredNorm() - least) / beyond_noise(residuals), 0.0, 1.0);
  return made;
}

}  // namespace flexarm::diagnose
