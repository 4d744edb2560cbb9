#include "diagnose/search/parameter_errors.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;

/// Sum of g g^T over stretches, one row J_b^T r_b each: of `time` runs through all channels, whose
/// misfits go together, of `frf` runs channel by channel. `modal` entries are taken one by one.
Eigen::MatrixXd clustered(const Problem& problem, const Fit& fit) {
  const Experiment& experiment = problem.experiment();
  const Index n = fit.jacobian.cols();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXd of_run = Eigen::MatrixXd::Zero(n, kStretches);
  double clusters = 0.0;
  const auto close = [&](const Eigen::MatrixXd& gradients) {
    sum.noalias() += gradients * gradients.transpose();
    clusters += static_cast<double>(gradients.cols());
  };
  const auto& channels = problem.observations().channels;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const ObservedChannel& channel = channels[c];
    if (!problem.estimation_runs()[channel.run]) continue;
    const auto kind = experiment.runs[channel.run].run.kind;
    const Index stretches = kind == measured::RunKind::modal
                                ? channel.count
                                : std::min<Index>(kStretches, channel.count);
    Eigen::MatrixXd gradients(n, stretches);
    for (Index b = 0; b < stretches; ++b) {
      const Index begin = channel.first + b * channel.count / stretches;
      const Index count = channel.first + (b + 1) * channel.count / stretches - begin;
      gradients.col(b) =
          fit.jacobian.middleRows(begin, count).transpose() * fit.residuals.segment(begin, count);
    }
    if (kind != measured::RunKind::time || stretches < kStretches) {
      close(gradients);
      continue;
    }
    of_run += gradients;
    if (c + 1 == channels.size() || channels[c + 1].run != channel.run) {
      close(of_run);
      of_run.setZero();
    }
  }
  const double free = clusters - static_cast<double>(n);
  return free > 0.0 ? Eigen::MatrixXd(sum * (clusters / free)) : Eigen::MatrixXd::Zero(n, n);
}

/// What a step in each place is in the parameter's own unit.
Eigen::VectorXd slopes(const Candidate& candidate) {
  constexpr double kSlopeStep = 1e-6;
  const Eigen::VectorXd places = candidate.coordinates();
  const auto parameters = candidate.parameters();
  const auto first = places.size() - static_cast<Index>(parameters.size());
  Eigen::VectorXd made = Eigen::VectorXd::Ones(places.size());
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const Index at = first + static_cast<Index>(i);
    made(at) = std::abs(parameters[i].value(places(at) + kSlopeStep) -
                        parameters[i].value(places(at) - kSlopeStep)) /
               (2.0 * kSlopeStep);
  }
  return made;
}

}  // namespace

std::vector<double> standard_errors(const Problem& problem, const Explanation& explanation,
                                    const Problem& finer) {
  const Fit& fit = explanation.fit;
  const Misfit& misfit = explanation.estimation;
  const Index n = fit.jacobian.cols();
  if (n == 0) return {};
  const double scale = std::max(1.0, misfit.sum_of_squares / misfit.count) * misfit.count /
                       std::max(1.0, misfit.independent);
  const Eigen::LDLT<Eigen::MatrixXd> information(fit.jacobian.transpose() * fit.jacobian);
  const Eigen::MatrixXd inverse = information.solve(Eigen::MatrixXd::Identity(n, n));
  Eigen::VectorXd variances =
      (inverse * scale)
          .diagonal()
          .cwiseMax((inverse * clustered(problem, fit) * inverse).diagonal());
  if (const auto refined = finer.residuals(fit.candidate, problem.estimation_runs())) {
    const Eigen::VectorXd shift =
        information.solve(fit.jacobian.transpose() * (*refined - fit.residuals));
    variances += shift.cwiseAbs2();
  }
  const Eigen::VectorXd errors =
      slopes(fit.candidate).cwiseProduct(variances.cwiseMax(0.0).cwiseSqrt());
  return {errors.begin(), errors.end()};
}

}  // namespace flexarm::diagnose
