#include "diagnose/search/channel_independence.hpp"

#include "arm/sensor.hpp"
#include "diagnose/search/dependence.hpp"
#include "diagnose/search/residual_test.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;

enum class Place { hub, tip, strain };

Place place_of(const ObservedChannel& channel) {
  const arm::Sensor sensor = arm::parse_sensor(channel.sensor);
  if (arm::is_collocated(sensor)) return Place::hub;
  return sensor.kind == arm::SensorKind::strain ? Place::strain : Place::tip;
}

bool are_compared(const ObservedChannel& one, const ObservedChannel& other) {
  if (one.run != other.run || one.count != other.count) return false;
  const Place place = place_of(one);
  return place == Place::strain || place != place_of(other);
}

bool is_reading_in_time(const Problem& problem, const ObservedChannel& channel) {
  const Experiment& experiment = problem.experiment();
  return experiment.runs[channel.run].run.kind == measured::RunKind::time &&
         channel.sensor != kTorqueChannel;
}

Eigen::VectorXd without_slow_part(const Eigen::Ref<const Eigen::VectorXd>& values) {
  const Index n = values.size();
  const auto time = Eigen::ArrayXd::LinSpaced(n, 0.5, static_cast<double>(n) - 0.5);
  Eigen::MatrixXd slow(n, kSlowHalfPeriods + 1);
  for (Index i = 0; i < slow.cols(); ++i) {
    slow.col(i) = (std::numbers::pi * static_cast<double>(i) / static_cast<double>(n) * time).cos();
    slow.col(i).normalize();
  }
  return values - slow * (slow.transpose() * values);  // the cosines are orthogonal
}

/// n^2 sum_k r_k^2/(n - |k|) over lags k from -lags to lags.
double cross_correlation_statistic(const Eigen::VectorXd& one, const Eigen::VectorXd& other,
                                   int lags) {
  const Index n = one.size();
  const double squares = one.squaredNorm() * other.squaredNorm();
  if (!(squares > 0.0)) return 0.0;
  double sum = 0.0;
  for (Index lag = -lags; lag <= lags; ++lag) {
    const Index rest = n - std::abs(lag);
    const double product = one.segment(std::max<Index>(-lag, 0), rest)
                               .dot(other.segment(std::max<Index>(lag, 0), rest));
    sum += product * product / static_cast<double>(rest);
  }
  return static_cast<double>(n) * static_cast<double>(n) * sum / squares;
}

/// Part of the variance of the residuals that is the simulation's own error.
double granted_part(const ObservedChannel& channel) {
  const double granted = residual_variance(channel, kNegligibleDependence);
  return granted / (1.0 + granted);
}

}  // namespace

double independence_p_value(const Problem& problem, const Eigen::VectorXd& residuals,
                            const std::vector<bool>& runs) {
  std::vector<const ObservedChannel*> compared;
  std::vector<Eigen::VectorXd> fast;
  for (const ObservedChannel& channel : problem.observations().channels) {
    if (!runs[channel.run] || !is_reading_in_time(problem, channel)) continue;
    compared.push_back(&channel);
    fast.push_back(without_slow_part(residuals.segment(channel.first, channel.count)));
  }
  ChiSquaredStatistic all;
  for (std::size_t i = 0; i < compared.size(); ++i) {
    for (std::size_t j = i + 1; j < compared.size(); ++j) {
      if (!are_compared(*compared[i], *compared[j])) continue;
      const auto n = static_cast<double>(compared[i]->count);
      const int lags = std::min(kLags, static_cast<int>(compared[i]->count / 4));
      const double of_pair = 2.0 * lags + 1.0;
      all.value += cross_correlation_statistic(fast[i], fast[j], lags);
      all.freedom += of_pair;
      all.lambda += n * granted_part(*compared[i]) * granted_part(*compared[j]);
    }
  }
  return all.p_value();
}

bool exceeds_noise_of_one_sensor(const Problem& coloured, const Problem& white) {
  const auto& channels = white.observations().channels;
  const auto is_compared = [&](const ObservedChannel& channel) {
    return white.is_driven_by_torque() &&
           std::ranges::any_of(channels, [&](const ObservedChannel& other) {
             return &other != &channel && is_reading_in_time(white, other) &&
                    are_compared(channel, other);
           });
  };
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const bool is_seen =
        white.estimation_runs()[channels[c].run] && is_reading_in_time(white, channels[c]);
    if (!is_seen || is_compared(channels[c])) continue;
    const double granted =
        std::max(kMostOfOneSensor * channels[c].noise, negligible_dependence(white));
    if (coloured.observations().channels[c].noise > granted) return true;
  }
  return false;
}

}  // namespace flexarm::diagnose
