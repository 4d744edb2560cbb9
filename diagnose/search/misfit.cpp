#include "diagnose/search/misfit.hpp"

#include "measured/spectra/fourier.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

namespace flexarm::diagnose {

using Eigen::Index;

namespace {

/// Autocorrelations about the mean at lags 0 to n - 1, by the transform of the values with as many
/// zeros behind. Of values that are all the same they are not numbers.
std::vector<double> autocorrelations(const Eigen::Ref<const Eigen::VectorXd>& values) {
  const auto n = static_cast<std::size_t>(values.size());
  const std::size_t padded = measured::fast_length(2 * n);
  measured::RealTransform transform(padded);
  std::vector<double> samples(padded, 0.0);
  const double mean = values.mean();
  std::ranges::transform(values, samples.begin(), [mean](double value) { return value - mean; });
  std::vector<std::complex<double>> spectrum(transform.lines());
  transform(samples, spectrum);
  for (std::size_t k = 0; k < padded; ++k) {
    samples[k] = std::norm(spectrum[std::min(k, padded - k)]);
  }
  transform(samples, spectrum);
  std::vector<double> made(n);
  for (std::size_t k = 0; k < n; ++k) made[k] = spectrum[k].real() / spectrum[0].real();
  return made;
}

/// 1 + 2 (r_1 + r_2 + ...) up to where pairs of neighbours no longer add up to more than 0
/// [Geyer1992]: beyond it correlations are chance.
double correlated_samples(const std::vector<double>& correlations) {
  double sum = -1.0;
  for (std::size_t k = 0; k + 1 < correlations.size(); k += 2) {
    const double pair = correlations[k] + correlations[k + 1];
    if (!(pair > 0.0)) break;
    sum += 2.0 * pair;
  }
  return std::max(1.0, sum);
}

/// Of n squares.
double beyond_chance(double squares, double expected, double n) {
  return std::max(0.0, squares - expected - kChance * std::sqrt(2.0 * n));
}

}  // namespace

double beyond_noise(const Eigen::VectorXd& residuals) {
  const auto n = static_cast<double>(residuals.size());
  return std::max(residuals.squaredNorm() - n, std::sqrt(2.0 * n));
}

double independent(const Eigen::Ref<const Eigen::VectorXd>& residuals, measured::RunKind kind) {
  const auto n = static_cast<double>(residuals.size());
  if (kind != measured::RunKind::time || residuals.size() < 3) return n;
  const double squares = residuals.squaredNorm();
  if (!(squares > 0.0)) return n;
  const Index last = residuals.size() - 1;
  const double r = std::clamp(residuals.head(last).dot(residuals.tail(last)) / squares, 0.0, 1.0);
  const double by_neighbours = n * (1.0 - r) / (1.0 + r);
  const double by_all = n / correlated_samples(autocorrelations(residuals));
  return std::max(1.0, std::min(by_neighbours, by_all));
}

double Misfit::excess() const {
  if (disturbance) {
    if (disturbance->relative() <= kNegligibleDisturbance) return nuisance_excess();
    const double negligible_N_m = kNegligibleDisturbance * disturbance->torque_rms_N_m;
    const double ratio = disturbance->estimated_N_m / negligible_N_m;
    return ratio * ratio + nuisance_excess();
  }
  return beyond_chance(sum_of_squares, (1.0 + kNoiseKnown) * count, count) + simulation_excess +
         nuisance_excess();
}

double Misfit::nuisance_excess() const {
  return beyond_chance(nuisance_squares, nuisances, nuisances);
}

double Misfit::variance() const {
  const double mean_square = sum_of_squares / count;
  return disturbance ? mean_square : std::max(1.0, mean_square);
}

double Misfit::variance_of_estimates() const {
  return variance() * count / std::max(1.0, independent);
}

double Misfit::minus_two_log_likelihood() const {
  return disturbance ? disturbance->minus_two_log_likelihood : sum_of_squares + simulation_excess;
}

double Misfit::unexplained_error() const {
  if (disturbance) return disturbance->relative();
  return std::sqrt(std::max(0.0, relative_error * relative_error - noise_floor * noise_floor));
}

double relative_error(const Observations& observations, const Experiment& experiment,
                      const ObservedChannel& channel, const Eigen::VectorXd& residuals) {
  const auto values = observations.values.segment(channel.first, channel.count).array();
  Eigen::VectorXd relative = residuals.segment(channel.first, channel.count);
  channel.autoregression.colour(relative);
  for (const std::size_t k : channel.left_out) relative(static_cast<Index>(k)) = 0.0;
  const auto errors =
      relative.array() * observations.deviations.segment(channel.first, channel.count).array();
  const auto n = static_cast<double>(channel.used());
  if (experiment.runs[channel.run].run.kind == measured::RunKind::time) {
    return std::sqrt(errors.square().sum() / n / (values - values.mean()).square().mean());
  }
  // Weighted as in the fit: deviations are proportional to the noise floor.
  return channel.floor() *
         std::sqrt(residuals.segment(channel.first, channel.count).squaredNorm() / n);
}

Misfit misfit(const Observations& observations, const Experiment& experiment,
              const Eigen::VectorXd& residuals, const std::vector<bool>& runs) {
  Misfit made;
  double channels = 0.0;
  for (const ObservedChannel& channel : observations.channels) {
    if (!runs[channel.run]) continue;
    const auto part = residuals.segment(channel.first, channel.count);
    const auto used = static_cast<double>(channel.used());
    made.count += used;
    made.sum_of_squares += part.squaredNorm();
    made.independent += independent(part, experiment.runs[channel.run].run.kind) * used /
                        static_cast<double>(channel.count);
    made.relative_error += relative_error(observations, experiment, channel, residuals);
    made.noise_floor += channel.noise;
    made.numerical_error += channel.numerical_error;
    if (experiment.runs[channel.run].run.kind == measured::RunKind::time) made.simulated += 1.0;
    channels += 1.0;
  }
  if (channels > 0.0) {
    made.relative_error /= channels;
    made.noise_floor /= channels;
    made.numerical_error /= channels;
    made.simulated /= channels;
  }
  return made;
}

double share_taken(const Misfit& before, const Misfit& after) {
  if (!(before.excess() > 0.0) || !std::isfinite(after.excess())) return 0.0;
  return 1.0 - after.excess() / before.excess();
}

double information_gain(const Misfit& simpler, const Misfit& fuller, int more_parameters) {
  const double n = std::max(2.0, fuller.independent);
  const double displaced = simpler.nuisance_squares - fuller.nuisance_squares;
  const bool has_free_scale = !fuller.disturbance && fuller.variance() > 1.0;
  // With the scale at the noise this is the difference of sums of squares.
  const double likelihood =
      has_free_scale ? n * std::log(simpler.variance() / fuller.variance())
                     : (simpler.minus_two_log_likelihood() - fuller.minus_two_log_likelihood()) *
                           n / fuller.count;
  return likelihood + displaced - more_parameters * std::log(n);
}

}  // namespace flexarm::diagnose
