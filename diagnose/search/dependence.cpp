#include "diagnose/search/dependence.hpp"

#include "diagnose/search/channel_independence.hpp"
#include "diagnose/search/hub_torque_probes.hpp"
#include "diagnose/search/refit_projection.hpp"
#include "diagnose/search/residual_test.hpp"
#include "measured/spectra/tail_probability.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <variant>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;

/// Step in a place, for directions.
constexpr double kProbeStep = 1e-2;
/// Samples of the torque up to the sample that residuals are regressed on.
constexpr Index kTorqueLags = 40;

/// A few values of a hypothesis: on each side of where its single parameter does nothing, or over
/// the ranges. The sides differ for some: in closed loop a delay below 0 is one of the log alone.
std::vector<std::vector<double>> probes_of(const Hypothesis& hypothesis) {
  std::vector<double> places = {0.2, 0.5, 0.8};
  const auto neutral = hypothesis.parameters.front().neutral_coordinate();
  if (hypothesis.parameters.size() == 1 && neutral) {
    places.clear();
    for (const double place : {*neutral - kProbeStep, *neutral + kProbeStep}) {
      if (place >= 0.0 && place <= 1.0) places.push_back(place);
    }
  }
  std::vector<std::vector<double>> probes;
  for (const double place : places) {
    const std::vector<double> all(hypothesis.parameters.size(), place);
    probes.push_back(effects::values_at(hypothesis.parameters, all));
  }
  return probes;
}

/// Root mean square of whitened residuals of these runs, relative to the signals.
double relative_size(const Problem& problem, const Eigen::VectorXd& residuals,
                     const std::vector<bool>& runs) {
  const Eigen::VectorXd errors = to_errors(problem.observations(), residuals);
  double squares = 0.0;
  double count = 0.0;
  for (const ObservedChannel& channel : problem.observations().channels) {
    if (!runs[channel.run]) continue;
    squares +=
        errors.segment(channel.first, channel.count).squaredNorm() * std::pow(channel.floor(), 2);
    count += static_cast<double>(channel.used());
  }
  return std::sqrt(squares / count);
}

/// One set of runs: what the candidate leaves, and the directions that it has itself.
struct ScoredRuns {
  const std::vector<bool>& runs;
  Eigen::VectorXd residuals;
  Eigen::VectorXd time;  ///< from -1 to 1 along each channel of a `time` run, 0 elsewhere
  RefitProjection beyond_refit;

  /// Of the change that a candidate makes, and of one that grows from the begin of each run to its
  /// end, as where a number drifts: `kTestsOfChange` tests.
  double p_value_of_change(const Problem& problem, const Candidate& changed) const {
    const auto with = problem.residuals(changed, runs);
    if (!with) return 1.0;
    const Eigen::VectorXd change = residuals - *with;
    return std::min(p_value_along(problem, change),
                    p_value_along(problem, change.cwiseProduct(time)));
  }
  static constexpr double kTestsOfChange = 2.0;
  /// 1 of a change that refitting makes too.
  double p_value_along(const Problem& problem, const Eigen::VectorXd& change) const {
    const Eigen::VectorXd beyond = beyond_refit(change);
    const double size = beyond.norm();
    if (!(size > kLeastPart * change.norm())) return 1.0;
    const double z = beyond.dot(residuals) / size;
    const double along = relative_size(problem, beyond * (z / size), runs);
    if (along <= negligible_dependence(problem)) return 1.0;
    return measured::normal_tails(z);
  }
  /// Less of a change than this beyond refitting is rounding.
  static constexpr double kLeastPart = 1e-4;

  /// Of each sensor in all `time` runs on the torque up to the sample, or on the hub's acceleration
  /// where that drives the arm; the least, after Bonferroni. In the sum over all sensors a model
  /// error that shows in one would be less than the negligible dependence of all.
  double p_value_on_torque(const Problem& problem) const;
};

/// A column for each lag, the torque before the first sample being 0.
Eigen::MatrixXd lagged(const std::vector<double>& torque_N_m) {
  const auto n = std::ssize(torque_N_m);
  Eigen::MatrixXd made = Eigen::MatrixXd::Zero(n, kTorqueLags);
  const auto torque = Eigen::VectorXd::Map(torque_N_m.data(), n);
  for (Index lag = 0; lag < std::min<Index>(kTorqueLags, n); ++lag) {
    made.col(lag).tail(n - lag) = torque.head(n - lag);
  }
  return made;
}

double ScoredRuns::p_value_on_torque(const Problem& problem) const {
  std::map<std::string, ChiSquaredStatistic> of_sensors;
  const auto& experiment = problem.experiment();
  std::optional<std::size_t> run;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> torque;
  torque.setThreshold(kLeastPart);
  for (const ObservedChannel& channel : problem.observations().channels) {
    const auto* record = std::get_if<measured::TimeRecord>(&experiment.runs[channel.run].data);
    if (!runs[channel.run] || record == nullptr) continue;
    if (run != channel.run) {
      run = channel.run;
      const bool is_driven = is_driven_by_motion(experiment);
      torque.compute(lagged(is_driven ? experiment.motions[*run].motion.acceleration_rad_per_s2
                                      : record->torque_N_m));
    }
    const Eigen::VectorXd along =
        torque.householderQ().adjoint() * residuals.segment(channel.first, channel.count);
    ChiSquaredStatistic& own = of_sensors[channel.sensor];
    own.value += along.head(torque.rank()).squaredNorm();
    own.freedom += static_cast<double>(torque.rank());
    own.lambda += residual_variance(channel, negligible_dependence(problem)) *
                  static_cast<double>(channel.used());
  }
  double least = 1.0;
  for (const auto& [sensor, own] : of_sensors) least = std::min(least, own.p_value());
  return bonferroni(least, static_cast<double>(of_sensors.size()));
}

Eigen::VectorXd time_along(const Problem& problem, Index size) {
  Eigen::VectorXd time = Eigen::VectorXd::Zero(size);
  const auto& runs = problem.experiment().runs;
  for (const ObservedChannel& channel : problem.observations().channels) {
    if (runs[channel.run].run.kind != measured::RunKind::time) continue;
    time.segment(channel.first, channel.count).setLinSpaced(-1.0, 1.0);
  }
  return time;
}

std::optional<ScoredRuns> scored(const Problem& problem, const Candidate& fitted,
                                 const std::vector<bool>& runs) {
  if (std::ranges::count(runs, true) == 0) return std::nullopt;
  const auto residuals = problem.residuals(fitted, runs);
  if (!residuals) return std::nullopt;
  const Eigen::VectorXd places = fitted.coordinates();
  Eigen::MatrixXd directions(residuals->size(), places.size());
  for (Index i = 0; i < places.size(); ++i) {
    Eigen::VectorXd beside = places;
    beside(i) += places(i) < 0.5 ? kProbeStep : -kProbeStep;
    Candidate moved = fitted;
    moved.put(beside);
    const auto with = problem.residuals(moved, runs);
    directions.col(i) = with.value_or(*residuals) - *residuals;
  }
  return ScoredRuns{runs, *residuals, time_along(problem, residuals->size()),
                    RefitProjection(directions)};
}

}  // namespace

double negligible_dependence(const Problem& problem) {
  return is_driven_by_motion(problem.experiment()) ? kNegligibleByMotion : kNegligibleDependence;
}

double dependence_p_value(const Problem& problem, const Candidate& fitted, ReportedWork& work,
                          double level) {
  std::vector<Candidate> changed;
  const Experiment& experiment = problem.experiment();
  for (const auto& all : {distinct(hypotheses(experiment)), hub_torque_probes(experiment)}) {
    for (const Hypothesis& hypothesis : all) {
      if (fitted.has_effect(hypothesis.effect)) continue;
      for (const auto& values : probes_of(hypothesis)) {
        changed.push_back(fitted.with(hypothesis, values));
      }
    }
  }
  const std::array sets = {scored(problem, fitted, problem.estimation_runs()),
                           scored(problem, fitted, problem.validation_runs())};
  const bool is_driven = problem.is_driven_by_torque() || is_driven_by_motion(experiment);
  constexpr std::size_t kWithoutChange = 2;  // on the torque, and of channels on each other
  std::vector<double> p_values(sets.size() * (changed.size() + kWithoutChange), 1.0);
  const double tests = static_cast<double>(sets.size()) *
                       (static_cast<double>(kWithoutChange) +
                        ScoredRuns::kTestsOfChange * static_cast<double>(changed.size()));
  std::atomic<bool> is_rejected = false;
  const auto keep = [&](std::size_t i, double p_value) {
    p_values[i] = p_value;
    if (tests * p_value < level) is_rejected = true;
  };
  // First what no simulation is needed for.
  for (std::size_t i = 0; i < sets.size() && is_driven; ++i) {
    if (!sets[i]) continue;
    keep(i, sets[i]->p_value_on_torque(problem));
    // A measured motion that drives all sensors has one error for all.
    if (!problem.is_driven_by_torque()) continue;
    keep(sets.size() + i, independence_p_value(problem, sets[i]->residuals, sets[i]->runs));
  }
  const std::size_t first = kWithoutChange * sets.size();
  work.in_parallel(p_values.size() - first, "what residuals depend on", work.done(), work.done(),
                   [&](std::size_t i) {
                     work.go_on();
                     const auto& set = sets[i % sets.size()];
                     if (!set || is_rejected) return;
                     keep(first + i, set->p_value_of_change(problem, changed[i / sets.size()]));
                   });
  return bonferroni(std::ranges::min(p_values), tests);
}

}  // namespace flexarm::diagnose
