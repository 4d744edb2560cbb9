#include "diagnose/search/parameter_errors.hpp"

#include <Eigen/Cholesky>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;

/// A column J_b^T r_b for each of the stretches b of a channel.
Eigen::MatrixXd gradients_of(const Fit& fit, const ObservedChannel& channel, Index stretches) {
  Eigen::MatrixXd gradients(fit.jacobian.cols(), stretches);
  for (Index b = 0; b < stretches; ++b) {
    const Index begin = channel.first + b * channel.count / stretches;
    const Index count = channel.first + (b + 1) * channel.count / stretches - begin;
    gradients.col(b) =
        fit.jacobian.middleRows(begin, count).transpose() * fit.residuals.segment(begin, count);
  }
  return gradients;
}

/// Sum of g g^T over the clusters that are put in.
class Clusters {
 public:
  explicit Clusters(Index parameters) : sum_(Eigen::MatrixXd::Zero(parameters, parameters)) {}

  void put(const Eigen::MatrixXd& gradients) {
    sum_.noalias() += gradients * gradients.transpose();
    count_ += static_cast<double>(gradients.cols());
  }
  /// Those beyond what the fitted parameters take.
  double freedom() const { return count_ - static_cast<double>(sum_.cols()); }
  /// Corrected for the parameters that were fitted; 0 where there are too few to say.
  Eigen::MatrixXd sum() const {
    if (freedom() < 1.0) return Eigen::MatrixXd::Zero(sum_.rows(), sum_.cols());
    return sum_ * (count_ / freedom());
  }

 private:
  Eigen::MatrixXd sum_;
  double count_ = 0.0;
};

/// Of residuals that go together over stretches of a run: of `time` runs through all channels, of
/// `frf` runs channel by channel; `modal` entries are taken one by one.
Clusters clustered_by_stretches(const Problem& problem, const Fit& fit) {
  const Experiment& experiment = problem.experiment();
  const Index n = fit.jacobian.cols();
  Clusters clusters(n);
  Eigen::MatrixXd of_run = Eigen::MatrixXd::Zero(n, kStretches);
  const auto& channels = problem.observations().channels;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const ObservedChannel& channel = channels[c];
    if (!problem.estimation_runs()[channel.run]) continue;
    const auto kind = experiment.runs[channel.run].run.kind;
    const Index stretches = kind == measured::RunKind::modal
                                ? channel.count
                                : std::min<Index>(kStretches, channel.count);
    const Eigen::MatrixXd gradients = gradients_of(fit, channel, stretches);
    if (kind != measured::RunKind::time || stretches < kStretches) {
      clusters.put(gradients);
      continue;
    }
    of_run += gradients;
    if (c + 1 == channels.size() || channels[c + 1].run != channel.run) {
      clusters.put(of_run);
      of_run.setZero();
    }
  }
  return clusters;
}

/// Of residuals that go together over whole runs: estimates that are inconsistent between runs.
Clusters clustered_by_runs(const Problem& problem, const Fit& fit) {
  const Index n = fit.jacobian.cols();
  Clusters clusters(n);
  const auto& channels = problem.observations().channels;
  Eigen::VectorXd of_run = Eigen::VectorXd::Zero(n);
  for (std::size_t c = 0; c < channels.size(); ++c) {
    if (!problem.estimation_runs()[channels[c].run]) continue;
    of_run += gradients_of(fit, channels[c], 1);
    if (c + 1 == channels.size() || channels[c + 1].run != channels[c].run) {
      clusters.put(of_run);
      of_run.setZero();
    }
  }
  return clusters;
}

/// The ratio of a variance by so many clusters to its expectation that chance exceeds in 5 %.
double inconsistent_from(double freedom) {
  return boost::math::quantile(boost::math::chi_squared(freedom), 0.95) / freedom;
}

/// By which 1.96 standard errors become Student's 95 % interval.
double students_widening(double freedom) {
  return boost::math::quantile(boost::math::students_t(freedom), 0.975) /
         boost::math::quantile(boost::math::normal(), 0.975);
}

/// What a step in each coordinate changes of the nuisances and of the parameters, in their units: a
/// row each.
Eigen::MatrixXd slopes_of(const Candidate& candidate) {
  constexpr double kSlopeStep = 1e-6;
  const Eigen::VectorXd places = candidate.coordinates();
  const auto parameters = candidate.parameters();
  const auto first = places.size() - static_cast<Index>(parameters.size());
  Eigen::MatrixXd made = Eigen::MatrixXd::Identity(places.size(), places.size());
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const Index at = first + static_cast<Index>(i);
    made(at, at) = (parameters[i].value(places(at) + kSlopeStep) -
                    parameters[i].value(places(at) - kSlopeStep)) /
                   (2.0 * kSlopeStep);
    if (parameters[i].above_previous) made.row(at) += made.row(at - 1);
  }
  return made;
}

/// Of as many quantities as coordinates, which change with these as the rows of `slopes` say.
Eigen::VectorXd errors_of_quantities(const Problem& problem, const Explanation& explanation,
                                     int further_modes, const Eigen::MatrixXd& slopes) {
  const Fit& fit = explanation.fit;
  const Index n = fit.jacobian.cols();
  if (n == 0) return Eigen::VectorXd();
  const double scale = explanation.estimation.variance_of_estimates();
  const Eigen::LDLT<Eigen::MatrixXd> information(fit.jacobian.transpose() * fit.jacobian);
  const Eigen::MatrixXd by_gradient = slopes * information.solve(Eigen::MatrixXd::Identity(n, n));
  const auto sandwich = [&](const Clusters& clusters) -> Eigen::VectorXd {
    return (by_gradient * clusters.sum() * by_gradient.transpose()).diagonal();
  };
  Eigen::VectorXd variances = (by_gradient * slopes.transpose() * scale)
                                  .diagonal()
                                  .cwiseMax(sandwich(clustered_by_stretches(problem, fit)));
  const Clusters runs = clustered_by_runs(problem, fit);
  if (runs.freedom() >= 1.0) {
    const Eigen::VectorXd of_runs = sandwich(runs);
    const double limit = inconsistent_from(runs.freedom());
    const double widened = students_widening(runs.freedom());
    for (Index i = 0; i < n; ++i) {
      if (of_runs(i) > limit * variances(i)) variances(i) = widened * widened * of_runs(i);
    }
  }
  if (further_modes > 0) {
    const Problem finer = problem.with_modes(problem.predictor().flexible_modes() + further_modes);
    if (const auto refined = finer.residuals(fit.candidate, problem.estimation_runs())) {
      const Eigen::VectorXd shift =
          by_gradient * (fit.jacobian.transpose() * (*refined - fit.residuals));
      variances += shift.cwiseAbs2();
    }
  }
  // What is known of a nuisance without data holds however large the residuals are.
  auto nuisances = variances.head(static_cast<Index>(fit.candidate.nuisances.size()));
  nuisances = nuisances.cwiseMin(1.0);
  return variances.cwiseMax(0.0).cwiseSqrt();
}

}  // namespace

std::vector<double> standard_errors(const Problem& problem, const Explanation& explanation,
                                    int further_modes) {
  if (explanation.fit.jacobian.cols() == 0) return {};
  const Eigen::VectorXd errors = errors_of_quantities(problem, explanation, further_modes,
                                                      slopes_of(explanation.fit.candidate));
  return {errors.begin(), errors.end()};
}

Eigen::MatrixXd correlation_of_estimates(const Explanation& explanation) {
  const Fit& fit = explanation.fit;
  const Index n = fit.jacobian.cols();
  if (n == 0) return Eigen::MatrixXd();
  const Eigen::MatrixXd slopes = slopes_of(fit.candidate);
  const Eigen::LDLT<Eigen::MatrixXd> information(fit.jacobian.transpose() * fit.jacobian);
  const Eigen::MatrixXd covariance =
      slopes * information.solve(Eigen::MatrixXd::Identity(n, n)) * slopes.transpose();
  const Eigen::VectorXd scale = covariance.diagonal().cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd made = scale.asDiagonal() * covariance * scale.asDiagonal();
  made = 0.5 * (made + made.transpose().eval());
  made.diagonal().setOnes();
  return made;
}

}  // namespace flexarm::diagnose
