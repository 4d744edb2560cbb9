#include "diagnose/search/torque_timing.hpp"

#include "diagnose/parallel.hpp"
#include "diagnose/search/misfit.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <utility>
#include <variant>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;

/// Lateness by which derivatives are taken.
constexpr double kProbe = 0.05;

/// Changes the torque from `begin` to before `end` as if it were late.
void retime(std::vector<double>& torque_N_m, std::size_t begin, std::size_t end, double late) {
  double before = begin > 0 ? torque_N_m[begin - 1] : 0.0;
  for (std::size_t k = begin; k < end; ++k) {
    const double now = torque_N_m[k];
    torque_N_m[k] += late * (before - now);
    before = now;
  }
}

/// Begin of a stretch, and of the one behind the last.
std::size_t begin_of(int stretch, std::size_t samples) {
  return static_cast<std::size_t>(stretch) * samples / kTimedStretches;
}

/// Residuals of a run by the lateness of each stretch, a column each.
Eigen::MatrixXd derivatives(const Problem& problem, const arm::Arm& arm, std::size_t run) {
  const Experiment& experiment = problem.experiment();
  const Observations& all = problem.observations();
  const Index first = all.first_of_run[run];
  const Index count = all.first_of_run[run + 1] - first;
  // As many runs as stretches, and at last the run itself.
  Experiment probes;
  probes.arm = experiment.arm;
  Observations observations;
  observations.values = all.values.segment(first, count).replicate(kTimedStretches + 1, 1);
  observations.deviations = all.deviations.segment(first, count).replicate(kTimedStretches + 1, 1);
  for (int s = 0; s <= kTimedStretches; ++s) {
    observations.first_of_run.push_back(s * count);
    probes.runs.push_back(experiment.runs[run]);
    if (s == kTimedStretches) continue;
    auto& torque_N_m = std::get<measured::TimeRecord>(probes.runs.back().data).torque_N_m;
    retime(torque_N_m, begin_of(s, torque_N_m.size()), begin_of(s + 1, torque_N_m.size()), kProbe);
  }
  observations.first_of_run.push_back((kTimedStretches + 1) * count);
  const Predictor& own = problem.predictor();
  const Predictor predictor(probes, observations, own.flexible_modes());
  const Eigen::VectorXd made = predictor(arm, std::vector<bool>(probes.runs.size(), true));
  Eigen::MatrixXd columns = made.head(kTimedStretches * count).reshaped(count, kTimedStretches);
  columns.colwise() -= made.tail(count);
  const Eigen::VectorXd weights = weighing_deviations(all).segment(first, count).cwiseInverse();
  return weights.asDiagonal() * columns / kProbe;
}

/// The value with half the weight on either side; 0 of nothing.
double weighted_median(std::vector<std::pair<double, double>> values_and_weights) {
  std::ranges::sort(values_and_weights);
  double half = 0.0;
  for (const auto& [value, weight] : values_and_weights) half += 0.5 * weight;
  for (const auto& [value, weight] : values_and_weights) {
    half -= weight;
    if (half <= 0.0) return value;
  }
  return 0.0;
}

}  // namespace

TorqueTiming torque_timing(const Problem& problem, const Fit& fit) {
  const Experiment& experiment = problem.experiment();
  const Observations& observations = problem.observations();
  TorqueTiming timing;
  timing.late.resize(experiment.runs.size());
  const auto residuals =
      problem.residuals(fit.candidate, std::vector<bool>(experiment.runs.size(), true));
  const bool is_timed =
      has_runs(experiment, measured::Purpose::estimation, measured::RunKind::time);
  if (!residuals || !is_timed) return timing;
  const arm::Arm arm = fit.candidate.extend(experiment.arm);
  std::vector<Eigen::MatrixXd> columns(experiment.runs.size());
  std::vector<Eigen::LDLT<Eigen::MatrixXd>> information(experiment.runs.size());
  in_parallel(experiment.runs.size(), [&](std::size_t r) {
    if (experiment.runs[r].run.kind != measured::RunKind::time) return;
    columns[r] = derivatives(problem, arm, r);
    Eigen::MatrixXd of_run = columns[r].transpose() * columns[r];
    of_run.diagonal().array() += 1.0 / (kTimingKnown * kTimingKnown);
    information[r].compute(of_run);
  });

  // What timing leaves of a vector: its part that no lateness of the run makes.
  const auto without_timing = [&](std::size_t r, const Eigen::MatrixXd& of_run) {
    return Eigen::MatrixXd(of_run -
                           columns[r] * information[r].solve(columns[r].transpose() * of_run));
  };
  // The parameters of the fit beside it: (J^T P J) p = J^T P r.
  Eigen::MatrixXd normal = fit.jacobian.transpose() * fit.jacobian;
  Eigen::VectorXd gradient = fit.jacobian.transpose() * fit.residuals;
  for (std::size_t r = 0; r < columns.size(); ++r) {
    if (columns[r].size() == 0 || !problem.estimation_runs()[r]) continue;
    const Index first = observations.first_of_run[r];
    const Eigen::MatrixXd own = fit.jacobian.middleRows(first, columns[r].rows());
    const Eigen::MatrixXd timed = own - without_timing(r, own);
    normal -= own.transpose() * timed;
    gradient -= timed.transpose() * residuals->segment(first, columns[r].rows());
  }
  Eigen::VectorXd moved = *residuals;
  if (fit.jacobian.cols() > 0) moved -= fit.jacobian * normal.ldlt().solve(gradient);

  std::vector<std::pair<double, double>> weighted;  // lateness, what is known of it
  for (std::size_t r = 0; r < columns.size(); ++r) {
    if (columns[r].size() == 0) continue;
    const auto of_run = moved.segment(observations.first_of_run[r], columns[r].rows());
    timing.late[r] = information[r].solve(columns[r].transpose() * of_run);
    for (int s = 0; s < kTimedStretches; ++s) {
      weighted.emplace_back(timing.late[r](s), columns[r].col(s).squaredNorm());
    }
  }
  const double median = weighted_median(std::move(weighted));
  Eigen::VectorXd left = moved;
  for (std::size_t r = 0; r < columns.size(); ++r) {
    if (columns[r].size() == 0) continue;
    timing.late[r].array() -= median;
    left.segment(observations.first_of_run[r], columns[r].rows()) -= columns[r] * timing.late[r];
  }
  const auto misfit_of = [&](const Eigen::VectorXd& of) {
    return misfit(observations, experiment, of, problem.estimation_runs());
  };
  timing.share = share_taken(misfit_of(*residuals), misfit_of(left));
  return timing;
}

Experiment retimed(Experiment experiment, const TorqueTiming& timing) {
  for (std::size_t r = 0; r < experiment.runs.size(); ++r) {
    auto* record = std::get_if<measured::TimeRecord>(&experiment.runs[r].data);
    if (record == nullptr || timing.late[r].size() == 0) continue;
    auto& torque_N_m = record->torque_N_m;
    // From behind: a stretch begins with what the one before it has commanded.
    for (int s = kTimedStretches; s-- > 0;) {
      retime(torque_N_m, begin_of(s, torque_N_m.size()), begin_of(s + 1, torque_N_m.size()),
             timing.late[r](s));
    }
  }
  return experiment;
}

}  // namespace flexarm::diagnose
