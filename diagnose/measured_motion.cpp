#include "diagnose/measured_motion.hpp"

#include "arm/input_error.hpp"
#include "response/time/random_numbers.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <boost/math/interpolators/cardinal_cubic_b_spline.hpp>
#include <boost/math/tools/minima.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace flexarm::diagnose {

using Eigen::Index;

namespace {

/// Bounds of ln mu: readings as they are, and what the precision of numbers allows, which is a
/// cutoff at 0.1 % of the sampling frequency with third differences.
constexpr double kLeastLogPenalty = -20.0;
constexpr double kMostLogPenalty = 30.0;
constexpr double kLogPenaltyStep = 4.0;
/// Of ln mu, over the width of its bracket.
constexpr int kPenaltyBits = 9;
constexpr std::uintmax_t kMostPenaltySteps = 12;
/// Of the solution of the normal equations, whose condition number is about 64 mu.
constexpr int kRefinements = 2;
/// Differences on either side of one whose mean square its own is taken to be, and the least part
/// of the mean of all.
constexpr Index kLocalDifferences = 25;
constexpr double kLeastLocalPart = 1e-6;
constexpr int kWeightPasses = 2;
/// Readings without noise: its variance over that of the signal is this or more.
constexpr double kLeastVariance = 1e-26;

using Sparse = Eigen::SparseMatrix<double>;
using Solver = Eigen::SimplicialLDLT<Sparse, Eigen::Lower, Eigen::NaturalOrdering<int>>;

/// The differences, one a row.
Sparse differences_of(Index samples, int order, BeforeFirst before) {
  std::vector<Eigen::Triplet<double>> entries;
  Index row = 0;
  Index first = order;
  if (before == BeforeFirst::same) first = 1;
  if (before == BeforeFirst::zero) first = 0;
  for (Index k = first; k < samples; ++k, ++row) {
    double binomial = 1.0;
    for (int j = 0; j <= order; ++j) {
      const bool is_before = k < j;
      if (!is_before || before == BeforeFirst::same) {
        entries.emplace_back(row, is_before ? 0 : k - j, binomial);
      }
      binomial *= -static_cast<double>(order - j) / static_cast<double>(j + 1);
    }
  }
  Sparse made(row, samples);
  made.setFromTriplets(entries.begin(), entries.end());
  return made;
}

/// Penalised least squares with any penalty.
class PenalisedFit {
 public:
  /// `weights` are 1, or 0 for readings that are left out.
  PenalisedFit(const Eigen::VectorXd& readings, const Eigen::VectorXd& weights, Sparse differences)
      : readings_(readings.cwiseProduct(weights)),
        weights_(weights),
        differences_(std::move(differences)),
        squares_(differences_.transpose() * differences_),
        freedom_(static_cast<double>(differences_.rows() - weights.size()) + weights.sum()) {
    solver_->analyzePattern(weighed() + squares_);
  }

  /// -2 ln of the restricted likelihood, up to a constant, with the most likely noise.
  double minus_two_log_likelihood(double log_penalty) {
    take(std::exp(log_penalty));
    const auto rank = static_cast<double>(differences_.rows());
    return freedom_ * std::log(variance()) + solver_->vectorD().array().log().sum() -
           rank * log_penalty;
  }
  void take(double penalty) {
    penalty_ = penalty;
    solver_->factorize(weighed() + penalty * squares_);
    values_ = solved(readings_);
  }
  const Eigen::VectorXd& values() const { return values_; }
  /// Returns what takes the readings to the values, for another signal.
  Eigen::VectorXd filtered(const Eigen::VectorXd& signal) const {
    return solved(weights_.cwiseProduct(signal));
  }
  double variance() const {
    const double squares = (readings_ - weights_.cwiseProduct(values_)).squaredNorm() +
                           penalty_ * (differences_ * values_).squaredNorm();
    const double least = kLeastVariance * readings_.squaredNorm();
    return std::max({squares, least, std::numeric_limits<double>::min()}) / freedom_;
  }
  /// Of the values' error, whose covariance is variance (W + mu D^T D)^-1, W the weights.
  Eigen::VectorXd draw(response::RandomNumbers& random) const {
    const auto normal = [&random] { return random.normal(); };
    const Eigen::VectorXd of_readings = Eigen::VectorXd::NullaryExpr(readings_.size(), normal);
    const Eigen::VectorXd of_differences =
        Eigen::VectorXd::NullaryExpr(differences_.rows(), normal);
    const Eigen::VectorXd both = weights_.cwiseProduct(of_readings) +
                                 std::sqrt(penalty_) * (differences_.transpose() * of_differences);
    return std::sqrt(variance()) * solved(both);
  }

 private:
  Sparse weighed() const { return Sparse(weights_.asDiagonal()); }
  Eigen::VectorXd solved(const Eigen::VectorXd& right) const {
    Eigen::VectorXd made = solver_->solve(right);
    for (int i = 0; i < kRefinements; ++i) {
      const Eigen::VectorXd bent = differences_ * made;
      made += solver_->solve(right - weights_.cwiseProduct(made) -
                             penalty_ * (differences_.transpose() * bent));
    }
    return made;
  }

  Eigen::VectorXd readings_;  // 0 where they are left out
  Eigen::VectorXd weights_;
  Sparse differences_;
  Sparse squares_;
  double freedom_;
  std::unique_ptr<Solver> solver_ = std::make_unique<Solver>();  // which is not copied
  double penalty_ = 0.0;
  Eigen::VectorXd values_;
};

/// Of each difference over all others: one over the local root mean square of its `squares`, with a
/// geometric mean of 1.
Eigen::VectorXd relative_weights(const Eigen::VectorXd& squares) {
  const Index n = squares.size();
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(n + 1);
  for (Index k = 0; k < n; ++k) sums(k + 1) = sums(k) + squares(k);
  const double least = kLeastLocalPart * sums(n) / static_cast<double>(n);
  Eigen::VectorXd logarithms(n);
  for (Index k = 0; k < n; ++k) {
    const Index first = std::max<Index>(0, k - kLocalDifferences);
    const Index last = std::min(n, k + kLocalDifferences + 1);
    const double local = (sums(last) - sums(first)) / static_cast<double>(last - first);
    logarithms(k) = -0.5 * std::log(std::max({local, least, std::numeric_limits<double>::min()}));
  }
  return (logarithms.array() - logarithms.mean()).exp();
}

double likely_log_penalty(PenalisedFit& fit) {
  const auto cost = [&fit](double at) { return fit.minus_two_log_likelihood(at); };
  double best = kLeastLogPenalty;
  double least = std::numeric_limits<double>::infinity();
  for (double at = kLeastLogPenalty; at <= kMostLogPenalty; at += kLogPenaltyStep) {
    const double value = cost(at);
    if (value < least) {
      least = value;
      best = at;
    }
  }
  std::uintmax_t steps = kMostPenaltySteps;
  return boost::math::tools::brent_find_minima(cost, best - kLogPenaltyStep, best + kLogPenaltyStep,
                                               kPenaltyBits, steps)
      .first;
}

using Spline = boost::math::interpolators::cardinal_cubic_b_spline<double>;

Spline spline_of(const std::vector<double>& values, double period_s, double first_slope) {
  return {values.data(), values.size(), 0.0, period_s, first_slope};
}

/// The angle at each sample of a hub with these velocities, 0 at the first.
std::vector<double> integral_of(const std::vector<double>& velocities, double period_s) {
  const Spline spline = spline_of(velocities, period_s, std::numeric_limits<double>::quiet_NaN());
  std::vector<double> angles = {0.0};
  double slope = spline.prime(0.0);
  for (std::size_t k = 1; k < velocities.size(); ++k) {
    const double next = spline.prime(static_cast<double>(k) * period_s);
    angles.push_back(angles.back() + 0.5 * period_s * (velocities[k - 1] + velocities[k]) +
                     period_s * period_s / 12.0 * (slope - next));
    slope = next;
  }
  return angles;
}

PrescribedMotion motion_by_angles(const std::vector<double>& angles, double period_s,
                                  bool from_rest) {
  const Spline spline =
      spline_of(angles, period_s, from_rest ? 0.0 : std::numeric_limits<double>::quiet_NaN());
  PrescribedMotion made{angles.front(), from_rest ? 0.0 : spline.prime(0.0)};
  for (std::size_t k = 0; k < angles.size(); ++k) {
    made.acceleration_rad_per_s2.push_back(spline.double_prime(static_cast<double>(k) * period_s));
  }
  return made;
}

}  // namespace

SmoothedReadings smooth(const std::vector<double>& readings, int differences, BeforeFirst before,
                        std::uint64_t seed, const std::vector<std::size_t>& left_out) {
  const Eigen::VectorXd as_read = Eigen::VectorXd::Map(readings.data(), std::ssize(readings));
  const Sparse plain = differences_of(as_read.size(), differences, before);
  response::RandomNumbers random(seed);
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(as_read.size());
  for (const std::size_t k : left_out) weights(static_cast<Index>(k)) = 0.0;
  PenalisedFit fit(as_read, weights, plain);
  double log_penalty = likely_log_penalty(fit);
  fit.take(std::exp(log_penalty));
  Eigen::VectorXd error = fit.draw(random);
  for (int pass = 0; pass < kWeightPasses; ++pass) {
    const Eigen::VectorXd squares =
        (plain * fit.values()).cwiseAbs2() + (plain * error).cwiseAbs2();
    fit = PenalisedFit(as_read, weights, Sparse(relative_weights(squares).asDiagonal() * plain));
    log_penalty = likely_log_penalty(fit);
    fit.take(std::exp(log_penalty));
    error = fit.draw(random);
  }
  const auto shared = std::make_shared<const PenalisedFit>(std::move(fit));
  const Eigen::VectorXd& values = shared->values();
  return {{values.begin(), values.end()},
          std::sqrt(shared->variance()),
          std::exp(log_penalty),
          {error.begin(), error.end()},
          [shared](const std::vector<double>& signal) {
            const auto count = std::ssize(signal);
            // A part goes on as it ends.
            Eigen::VectorXd whole =
                Eigen::VectorXd::Constant(shared->values().size(), signal.back());
            whole.head(count) = Eigen::VectorXd::Map(signal.data(), count);
            const Eigen::VectorXd made = shared->filtered(whole).head(count);
            return std::vector<double>(made.begin(), made.end());
          }};
}

MeasuredMotion motion_of_hub(const measured::Channel& read, double period_s, bool from_rest) {
  const auto& [sensor, values, left_out] = read;
  if (values.size() < kFewestReadings) {
    throw arm::InputError(fmt::format("{}: {} samples; the motion of the hub needs {} or more",
                                      arm::to_string(sensor), values.size(), kFewestReadings));
  }
  constexpr std::uint64_t kSeed = 1;
  const bool is_angle = sensor.kind == arm::SensorKind::hub_angle;
  BeforeFirst before = BeforeFirst::unknown;
  if (from_rest) before = is_angle ? BeforeFirst::same : BeforeFirst::zero;
  SmoothedReadings smoothed = smooth(values, is_angle ? 3 : 2, before, kSeed, left_out);
  if (!is_angle) {
    smoothed.values = integral_of(smoothed.values, period_s);
    smoothed.error = integral_of(smoothed.error, period_s);
  }
  return {sensor, smoothed.noise, motion_by_angles(smoothed.values, period_s, from_rest),
          motion_by_angles(smoothed.error, period_s, from_rest), std::move(smoothed.filtered)};
}

}  // namespace flexarm::diagnose
