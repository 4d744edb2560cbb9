#include "diagnose/search/hub_laws.hpp"

#include "diagnose/parallel.hpp"
#include "diagnose/search/law_torques.hpp"
#include "diagnose/search/problem.hpp"
#include "diagnose/search/scan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <variant>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;

/// Torques of a grid that are kept: 64 MB.
constexpr std::size_t kMostKept = std::size_t{1} << 24;

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

/// Motions with what a torque on the hub makes of the residuals of all its sensors.
std::vector<HubMotion> simulated_motions(const Problem& problem) {
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(problem.residual_count());
  return hub_motions({problem, none, none, problem.as_filed()});
}

/// Motions with what a torque on the hub makes of the missing torque of a balance. An initial state
/// that is not known is the filter's.
std::vector<HubMotion> balanced_motions(const Problem& problem) {
  std::vector<HubMotion> made;
  for (std::size_t r = 0; r < problem.experiment().runs.size(); ++r) {
    auto motion = problem.estimation_runs()[r] ? hub_motion(problem, r) : std::nullopt;
    if (!motion) continue;
    const auto [first, pulse_response] = problem.predictor().balanced_torque(r);
    motion->starts_free = false;
    motion->readings = {{.response = HubResponse(pulse_response),
                         .first = first,
                         .residual = std::vector<double>(pulse_response.size()),
                         .noise = 1.0}};
    made.push_back(*std::move(motion));
  }
  return made;
}

/// Of the estimation runs; empty unless each of them shows the hub.
std::vector<HubMotion> estimation_motions(const Problem& problem) {
  std::vector<HubMotion> motions = problem.predictor().is_torque_balance()
                                       ? balanced_motions(problem)
                                       : simulated_motions(problem);
  const std::vector<bool>& runs = problem.estimation_runs();
  std::erase_if(motions, [&](const HubMotion& motion) { return !runs[motion.run]; });
  if (std::ssize(motions) != std::ranges::count(runs, true)) motions.clear();
  return motions;
}

/// A column each, the motions one after the other.
Eigen::MatrixXf in_columns(const std::vector<HubTorques>& torques) {
  std::size_t samples = 0;
  for (const std::vector<double>& of_motion : torques.front()) samples += of_motion.size();
  Eigen::MatrixXf made(static_cast<Index>(samples), std::ssize(torques));
  for (Index i = 0; i < made.cols(); ++i) {
    Index first = 0;
    for (const std::vector<double>& of_motion : torques[static_cast<std::size_t>(i)]) {
      const auto count = std::ssize(of_motion);
      made.col(i).segment(first, count) =
          Eigen::VectorXd::Map(of_motion.data(), count).cast<float>();
      first += count;
    }
  }
  return made;
}

bool is_same_law(const Candidate& one, const Candidate& other) {
  return one.labels() == other.labels() && one.values == other.values &&
         one.effects.front().parameters == other.effects.front().parameters;
}

}  // namespace

HubLawGrid::HubLawGrid(const LawRegression& laws, const Candidate& start,
                       const std::array<int, 3>& evaluations, const ReportedWork* work)
    : laws_(laws), linear_(laws, start) {
  const std::vector<Index> scanned = linear_.other_coordinates(start);
  const std::size_t n = std::min(scanned.size(), evaluations.size());
  places_ = n == 0 ? std::vector<Eigen::VectorXd>(1)
                   : grid_places(std::ssize(scanned), evaluations[n - 1]);
  for (const Eigen::VectorXd& place : places_) {
    Candidate& law = entries_.emplace_back(Entry{.law = start, .products = {}}).law;
    Eigen::VectorXd all = start.coordinates();
    all(scanned) = place;
    if (n > 0) law.put(all);
  }
  std::size_t samples = 0;
  for (const HubMotion& motion : laws.hub().motions()) samples += motion.time_s.size();
  const std::size_t columns = (linear_.companion_of(start) ? 2 : 1) * entries_.size();
  const bool is_kept = samples * columns <= kMostKept;
  if (is_kept) torques_.resize(entries_.size());
  in_parallel(entries_.size(), [&](std::size_t i) {
    if (work != nullptr) work->go_on();
    compute(i, is_kept);
  });
}

std::vector<HubTorques> HubLawGrid::hub_torques(const Candidate& law) const {
  const auto own = laws_.torques(law);
  if (!own) return {};
  const auto companion = linear_.companion_of(law);
  if (!companion) return {*own};
  const auto of_companion = laws_.torques(*companion);
  return of_companion ? std::vector{*own, *of_companion} : std::vector<HubTorques>{};
}

void HubLawGrid::compute(std::size_t index, bool is_kept) {
  Entry& entry = entries_[index];
  const std::vector<HubTorques> torques = hub_torques(entry.law);
  if (torques.empty()) return;
  const Eigen::VectorXd own = laws_.hub().readings(torques.front());
  entry.products.aa = own.squaredNorm();
  if (torques.size() > 1) {
    const Eigen::VectorXd of_companion = laws_.hub().readings(torques.back());
    entry.products.ab = own.dot(of_companion);
    entry.products.bb = of_companion.squaredNorm();
  }
  // Else it is too large.
  entry.has_readings = std::isfinite(entry.products.aa + entry.products.bb);
  if (!entry.has_readings) return;
  if (is_kept) torques_[index] = in_columns(torques);
}

std::vector<std::pair<Candidate, double>> HubLawGrid::best(const Eigen::VectorXd& residuals,
                                                           int most) const {
  const Eigen::VectorXf along = laws_.hub().adjoint(residuals).cast<float>();
  const double rr = residuals.squaredNorm();
  std::vector<Candidate> solved(entries_.size());
  std::vector<double> sums(entries_.size(), std::numeric_limits<double>::infinity());
  const auto product = [&](const Torques& torques) -> Eigen::VectorXf {
    return torques.transpose() * along;
  };
  const auto solve = [&](std::size_t i) {
    const Entry& entry = entries_[i];
    solved[i] = entry.law;
    if (!entry.has_readings) return;
    const Eigen::VectorXf with_residuals =
        torques_.empty() ? product(in_columns(hub_torques(entry.law))) : product(torques_[i]);
    LawProducts products = entry.products;
    products.rr = rr;
    products.ra = static_cast<double>(with_residuals(0));
    if (with_residuals.size() > 1) products.rb = static_cast<double>(with_residuals(1));
    std::tie(solved[i], sums[i]) = linear_.solved(entry.law, products);
  };
  in_parallel(entries_.size(), solve);
  std::vector<std::pair<Candidate, double>> made;
  for (const std::size_t i : best_apart(places_, sums, most)) {
    made.emplace_back(solved[i], sums[i]);
  }
  return made;
}

HubLaws::HubLaws(const Problem& problem) : arm_(problem.experiment().arm) {
  if (!problem.is_driven_by_torque() && !problem.predictor().is_torque_balance()) return;
  motions_ = estimation_motions(problem);
  if (!motions_.empty()) regression_.emplace(arm_, motions_);
}

Eigen::VectorXd HubLaws::residuals(const Eigen::VectorXd& of_problem) const {
  return regression_->hub().of_hub(of_problem);
}

bool HubLaws::is_told(const Candidate& start) const {
  const std::optional<arm::HubLaw> law = last_law(start, arm_);
  if (!law) return false;
  const auto* smooth = std::get_if<arm::SmoothHubTorque>(&*law);
  const bool may_stick = smooth == nullptr || smooth->states > 0;
  return !may_stick || part_at_rest(motions_) <= kMostRest;
}

const HubLawGrid* HubLaws::grid(const Candidate& start, const std::array<int, 3>& evaluations,
                                const ReportedWork* work) {
  if (!are_shown() || !is_told(start)) return nullptr;
  Known* known = nullptr;
  {
    const std::scoped_lock lock(mutex_);
    const auto found = std::ranges::find_if(known_, [&](const auto& one) {
      return one->evaluations == evaluations && is_same_law(one->start, start);
    });
    known = found != known_.end() ? found->get()
                                  : known_.emplace_back(new Known{start, evaluations}).get();
  }
  std::call_once(known->once, [&] {
    known->grid = std::make_unique<const HubLawGrid>(*regression_, start, evaluations, work);
  });
  return known->grid.get();
}

}  // namespace flexarm::diagnose
