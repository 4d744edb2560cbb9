#include "diagnose/search/residual_test.hpp"

#include "diagnose/search/misfit.hpp"
#include "measured/spectra/correlation.hpp"
#include "measured/spectra/tail_probability.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flexarm::diagnose {

double bonferroni(double p_value, double tests) {
  return std::min(1.0, tests * p_value);
}

double exceedance(double value, double n, double lambda) {
  if (std::isnan(value)) return 0.0;  // residuals that are no numbers are no noise
  // Chernoff: P(chi^2_n < z n) <= exp(-n (z - 1 - ln z)/2) for z < 1, less with lambda. Beyond the
  // rounding of 1 this is 1, and Boost's incomplete gamma function overflows for n above 3500.
  const double z = std::max(value, 0.0) / n;
  if (z == 0.0 || (z < 1.0 && 0.5 * n * (z - 1.0 - std::log(z)) > 40.0)) return 1.0;
  // Above this the series of the noncentral distribution is long, and Sankaran's normal
  // approximation [Sankaran1963] is good to 1e-4.
  constexpr double kLarge = 1e4;
  if (n + lambda <= kLarge) return measured::chi_squared_tail(value, n, lambda);
  const double sum = n + lambda;
  const double h = 1.0 - 2.0 * sum * (n + 3.0 * lambda) / (3.0 * std::pow(n + 2.0 * lambda, 2));
  const double p = (n + 2.0 * lambda) / (sum * sum);
  const double m = (h - 1.0) * (1.0 - 3.0 * h);
  const double mean = 1.0 + h * p * (h - 1.0 - 0.5 * (2.0 - h) * m * p);
  const double deviation = h * std::sqrt(2.0 * p * (1.0 + 0.5 * m * p));
  return 0.5 * std::erfc((std::pow(value / sum, h) - mean) / (deviation * std::numbers::sqrt2));
}

double residual_variance(const ObservedChannel& channel, double relative_error) {
  return std::pow(relative_error / (channel.floor() * channel.autoregression.innovation()), 2);
}

bool ResidualTest::is_noise() const {
  return std::min({level_p_value, whiteness_p_value, nuisance_p_value}) >= kResidualLevel;
}

ResidualTest test_residuals(const Observations& observations, const Experiment& experiment,
                            const Eigen::VectorXd& residuals, const std::vector<bool>& runs) {
  ChiSquaredStatistic level;
  ChiSquaredStatistic whiteness;
  double worst_channel = 1.0;
  double channels = 0.0;
  for (const ObservedChannel& channel : observations.channels) {
    if (!runs[channel.run]) continue;
    const auto part = residuals.segment(channel.first, channel.count);
    const auto n = static_cast<double>(channel.used());
    const measured::RunKind kind = experiment.runs[channel.run].run.kind;
    const bool is_simulated = kind == measured::RunKind::time;
    const double granted = is_simulated ? residual_variance(channel, kSimulationError) : 0.0;
    const ChiSquaredStatistic own{part.squaredNorm() / (1.0 + kNoiseKnown), n, 4.0 * granted * n};
    worst_channel = std::min(worst_channel, own.p_value());
    channels += 1.0;
    level.value += own.value;
    level.freedom += n;
    level.lambda += granted * n;
    const int lags = std::min(kLags, static_cast<int>(channel.count / 4));
    if (kind == measured::RunKind::modal || lags == 0) continue;
    // Real and imaginary part of a line stand side by side.
    whiteness.value += measured::ljung_box({part.data(), static_cast<std::size_t>(part.size())},
                                           lags, is_simulated ? 1 : 2);
    whiteness.freedom += lags;
    whiteness.lambda += n * lags * std::pow(granted / (1.0 + granted), 2);
  }
  const auto nuisances = residuals.tail(residuals.size() - observations.values.size());
  const ChiSquaredStatistic nuisance{nuisances.squaredNorm(), static_cast<double>(nuisances.size()),
                                     0.0};
  const double tests =
      channels + 1.0 + (whiteness.freedom > 0.0 ? 1.0 : 0.0) + (nuisance.freedom > 0.0 ? 1.0 : 0.0);
  return {bonferroni(std::min(worst_channel, level.p_value()), tests),
          bonferroni(whiteness.p_value(), tests), bonferroni(nuisance.p_value(), tests)};
}

}  // namespace flexarm::diagnose
