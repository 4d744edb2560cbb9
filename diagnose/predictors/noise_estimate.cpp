#include "diagnose/predictors/noise_estimate.hpp"

#include "arm/input_error.hpp"

#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <limits>
#include <nlopt.hpp>
#include <stdexcept>
#include <utility>

namespace flexarm::diagnose {

namespace {

/// Of -2 ln L: a difference that no decision depends on.
constexpr double kLikelihoodTolerance = 0.2;
constexpr int kMostEvaluations = 200;
/// Bits of the logarithm of the deviation, over the width of its bounds: 0.4 %.
constexpr int kDeviationBits = 12;
constexpr std::uintmax_t kMostBrentSteps = 30;
/// Natural logarithm of a first step.
constexpr double kFirstNoiseStep = 1.0;
/// Bounds: of the deviation over the torque's root mean square, of the correlation time over the
/// sampling period (least) and over the longest run (most), of reading factors.
constexpr double kLeastDisturbance = 1e-6;
constexpr double kMostDisturbance = 100.0;
constexpr double kLeastCorrelation = 1.0 / 3.0;
constexpr double kMostReadingFactor = 1e6;
constexpr double kStartDisturbance = 0.1;
/// Stands for -2 ln L where there is none.
constexpr double kNoLikelihood = std::numeric_limits<double>::max();

}  // namespace

double estimated_disturbance_N_m(const Predictor& predictor, const arm::Arm& arm,
                                 const std::vector<bool>& runs, const NoiseModel& noise) {
  double squares = 0.0;
  double samples = 0.0;
  try {
    for (const RunInnovations& run : predictor.innovations(arm, runs, noise)) {
      const auto& torque_N_m = run.filtered.disturbance_N_m;
      squares += Eigen::VectorXd::Map(torque_N_m.data(), std::ssize(torque_N_m)).squaredNorm();
      samples += static_cast<double>(torque_N_m.size());
    }
  } catch (const std::runtime_error&) {
    // An arm that is none, or whose equations no step solves.
    return std::numeric_limits<double>::infinity();
  }
  return samples > 0.0 ? std::sqrt(squares / samples) : 0.0;
}

NoiseEstimator::NoiseEstimator(const Experiment& experiment, const Observations& observations,
                               const Predictor& predictor, std::function<void()> go_on)
    : predictor_(&predictor), go_on_(std::move(go_on)) {
  double squares = 0.0;
  double samples = 0.0;
  double longest_s = 0.0;
  for (const auto& run : experiment.runs) {
    const auto* record = std::get_if<measured::TimeRecord>(&run.data);
    if (record == nullptr) continue;
    for (const double torque : record->torque_N_m) squares += torque * torque;
    const auto n = static_cast<double>(record->torque_N_m.size());
    const double period_s = measured::sampling_period_s(*record);
    samples += n;
    period_s_ = period_s_ > 0.0 ? std::min(period_s_, period_s) : period_s;
    longest_s = std::max(longest_s, n * period_s);
  }
  torque_rms_N_m_ = std::sqrt(squares / samples);
  lower_ = {std::log(kLeastDisturbance * torque_rms_N_m_), std::log(kLeastCorrelation * period_s_)};
  upper_ = {std::log(kMostDisturbance * torque_rms_N_m_), std::log(longest_s)};
  for (const ObservedChannel& channel : observations.channels) {
    const bool is_time = experiment.runs[channel.run].run.kind == measured::RunKind::time;
    if (!is_time || std::ranges::find(sensors_, channel.sensor) != sensors_.end()) continue;
    sensors_.push_back(channel.sensor);
    lower_.push_back(0.0);
    upper_.push_back(std::log(kMostReadingFactor));
  }
  lower_.push_back(lower_.front());
  upper_.push_back(upper_.front());
}

double NoiseEstimator::minus_two_log_likelihood(const arm::Arm& arm, const std::vector<bool>& runs,
                                                const NoiseModel& model) const {
  if (go_on_) go_on_();
  double sum = 0.0;
  try {
    for (const RunInnovations& run : predictor_->innovations(arm, runs, model)) {
      sum += run.standardised.squaredNorm() + run.log_determinant;
    }
  } catch (const std::runtime_error&) {
    // An arm that is none, or whose equations no step solves.
    return kNoLikelihood;
  }
  return std::isfinite(sum) ? sum : kNoLikelihood;
}

NoiseModel NoiseEstimator::model_at(const std::vector<double>& logarithms) const {
  NoiseModel made{std::exp(logarithms[0]), std::exp(logarithms[1])};
  for (std::size_t j = 0; j < sensors_.size(); ++j) {
    made.reading_factors[sensors_[j]] = std::exp(logarithms[2 + j]);
  }
  if (logarithms.size() == lower_.size()) made.modal_force_N_m = std::exp(logarithms.back());
  return made;
}

std::vector<double> NoiseEstimator::place_of(const NoiseModel& model) const {
  std::vector<double> place = {std::log(model.disturbance_N_m), std::log(model.correlation_time_s)};
  for (const std::string& sensor : sensors_) {
    place.push_back(std::log(model.reading_factor(sensor)));
  }
  if (model.modal_force_N_m > 0.0) place.push_back(std::log(model.modal_force_N_m));
  for (std::size_t i = 0; i < place.size(); ++i) {
    place[i] = std::clamp(place[i], lower_[i], upper_[i]);
  }
  return place;
}

NoiseEstimate NoiseEstimator::model(const arm::Arm& arm, const std::vector<bool>& runs,
                                    const std::vector<NoiseModel>& starts) const {
  std::vector<NoiseModel> begun = starts;
  if (begun.empty()) {
    for (const double samples : kCorrelationStarts) {
      begun.push_back({kStartDisturbance * torque_rms_N_m_, samples * period_s_});
    }
  }
  return searched(arm, runs, begun);
}

NoiseEstimate NoiseEstimator::with_modal_force(const arm::Arm& arm, const std::vector<bool>& runs,
                                               const NoiseEstimate& found) const {
  const NoiseEstimate forced = along(&NoiseModel::modal_force_N_m, arm, runs, found.model);
  const double bar = found.minus_two_log_likelihood - kLeastModalGain;
  return forced.minus_two_log_likelihood < bar ? searched(arm, runs, {forced.model}) : found;
}

NoiseEstimate NoiseEstimator::searched(const arm::Arm& arm, const std::vector<bool>& runs,
                                       const std::vector<NoiseModel>& starts) const {
  struct Task {
    const NoiseEstimator& estimator;
    const arm::Arm& arm;
    const std::vector<bool>& runs;
    NoiseEstimate best;
    std::exception_ptr ended_by;
  } task{*this, arm, runs, {}, nullptr};
  task.best.minus_two_log_likelihood = std::numeric_limits<double>::infinity();
  const nlopt::vfunc cost = [](const std::vector<double>& x, std::vector<double>&, void* data) {
    Task& own = *static_cast<Task*>(data);
    const NoiseModel model = own.estimator.model_at(x);
    double value = 0.0;
    try {
      value = own.estimator.minus_two_log_likelihood(own.arm, own.runs, model);
    } catch (...) {
      own.ended_by = std::current_exception();  // NLopt passes no exception on but its own
      throw nlopt::forced_stop();
    }
    ++own.best.evaluations;
    if (value < own.best.minus_two_log_likelihood) {
      own.best.minus_two_log_likelihood = value;
      own.best.model = model;
    }
    return value;
  };
  for (const NoiseModel& start : starts) {
    std::vector<double> place = place_of(start);
    nlopt::opt search(nlopt::LN_SBPLX, static_cast<unsigned>(place.size()));
    search.set_lower_bounds({lower_.begin(), lower_.begin() + std::ssize(place)});
    search.set_upper_bounds({upper_.begin(), upper_.begin() + std::ssize(place)});
    search.set_min_objective(cost, &task);
    search.set_ftol_abs(kLikelihoodTolerance);
    search.set_initial_step(kFirstNoiseStep);
    search.set_maxeval(kMostEvaluations);
    double least = 0.0;
    try {
      search.optimize(place, least);
    } catch (const nlopt::forced_stop&) {
      std::rethrow_exception(task.ended_by);
    }
  }
  if (!(task.best.minus_two_log_likelihood < kNoLikelihood)) {
    predictor_->innovations(arm, runs, starts.front());  // throws where the arm is the reason
    throw arm::InputError("Kalman filter: the runs cannot be filtered with this arm");
  }
  return task.best;
}

NoiseEstimate NoiseEstimator::disturbance(const arm::Arm& arm, const std::vector<bool>& runs,
                                          const NoiseModel& shared) const {
  return along(&NoiseModel::disturbance_N_m, arm, runs, shared);
}

NoiseEstimate NoiseEstimator::along(double NoiseModel::*number, const arm::Arm& arm,
                                    const std::vector<bool>& runs, const NoiseModel& shared) const {
  NoiseEstimate made{.model = shared};
  const auto cost = [&](double logarithm) {
    NoiseModel model = shared;
    model.*number = std::exp(logarithm);
    ++made.evaluations;
    return minus_two_log_likelihood(arm, runs, model);
  };
  std::uintmax_t steps = kMostBrentSteps;
  const auto [place, least] =
      boost::math::tools::brent_find_minima(cost, lower_[0], upper_[0], kDeviationBits, steps);
  made.model.*number = std::exp(place);
  made.minus_two_log_likelihood = least;
  return made;
}

}  // namespace flexarm::diagnose
