#include "measured/spectra/correlation.hpp"

#include "measured/spectra/fourier.hpp"

#include <boost/math/distributions/normal.hpp>
#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <cmath>
#include <complex>

namespace flexarm::measured {

namespace {

using Spectrum = std::vector<std::complex<double>>;

/// Deviations from the mean of what is finite, 0 elsewhere, followed by zeros.
std::vector<double> centred(std::span<const double> values, std::size_t padded) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    sum += value;
    ++count;
  }
  const double middle = count > 0 ? sum / static_cast<double>(count) : 0.0;
  std::vector<double> made(padded, 0.0);
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (std::isfinite(values[k])) made[k] = values[k] - middle;
  }
  return made;
}

double sum_of_squares(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return sum;
}

/// sum_t x(t) y(t - k) of padded signals from X conj(Y): index k, or padded + k where k < 0.
std::vector<double> correlated(Eigen::FFT<double>& transform, const Spectrum& x,
                               const Spectrum& y) {
  Spectrum product(x.size());
  for (std::size_t k = 0; k < x.size(); ++k) product[k] = x[k] * std::conj(y[k]);
  std::vector<double> made;
  transform.inv(made, product);
  return made;
}

std::size_t beyond(std::span<const double> values, double bound) {
  return static_cast<std::size_t>(
      std::ranges::count_if(values, [bound](double r) { return std::abs(r) > bound; }));
}

}  // namespace

std::size_t ResidualCorrelation::auto_beyond() const {
  return auto_lag.empty() ? 0 : beyond(std::span(auto_lag).subspan(1), auto_bound);
}

std::size_t ResidualCorrelation::cross_beyond() const {
  return beyond(cross_lag, cross_bound);
}

ResidualCorrelation residual_correlation(std::span<const double> residual,
                                         std::span<const double> input, std::size_t most_lag) {
  ResidualCorrelation made;
  made.samples = static_cast<std::size_t>(
      std::ranges::count_if(residual, [](double value) { return std::isfinite(value); }));
  if (made.samples == 0) return made;
  made.greatest_lag = std::min(most_lag, residual.size() - 1);
  // Room for all lags: products of the ends with the beginnings stay out.
  const std::size_t padded = fast_length(2 * residual.size());
  Eigen::FFT<double> transform;
  const std::vector<double> e = centred(residual, padded);
  Spectrum e_spectrum;
  transform.fwd(e_spectrum, e);
  const std::vector<double> e_with_e = correlated(transform, e_spectrum, e_spectrum);
  const double e_power = sum_of_squares(e);
  const auto over = [](double value, double scale) { return scale > 0.0 ? value / scale : 0.0; };
  for (std::size_t k = 0; k <= made.greatest_lag; ++k) {
    made.auto_lag.push_back(over(e_with_e[k], e_power));
  }
  const auto n = static_cast<double>(made.samples);
  const double deviate =
      boost::math::quantile(boost::math::normal(), 0.5 * (1.0 + kCorrelationLevel));
  made.auto_bound = deviate / std::sqrt(n);
  if (input.empty()) return made;

  const std::vector<double> u = centred(input, padded);
  Spectrum u_spectrum;
  transform.fwd(u_spectrum, u);
  const std::vector<double> e_with_u = correlated(transform, e_spectrum, u_spectrum);
  const double u_power = sum_of_squares(u);
  const double scale = std::sqrt(e_power * u_power);
  for (std::size_t k = made.greatest_lag; k > 0; --k) {
    made.cross_lag.push_back(over(e_with_u[padded - k], scale));
  }
  for (std::size_t k = 0; k <= made.greatest_lag; ++k) {
    made.cross_lag.push_back(over(e_with_u[k], scale));
  }
  // sum_j r_ee(j) r_uu(j) over all lags, by Parseval: 0 or more.
  double sum = 0.0;
  for (std::size_t k = 0; k < padded; ++k)
    sum += std::norm(e_spectrum[k]) * std::norm(u_spectrum[k]);
  sum /= static_cast<double>(padded);
  made.cross_bound = deviate * std::sqrt(over(sum, e_power * u_power) / n);
  return made;
}

double ljung_box(std::span<const double> residual, int lags, std::size_t stride) {
  const std::size_t n = residual.size();
  double squares = 0.0;
  for (const double value : residual) squares += value * value;
  if (squares == 0.0) return 0.0;
  double sum = 0.0;
  for (std::size_t shift = stride; shift <= static_cast<std::size_t>(lags) * stride;
       shift += stride) {
    double products = 0.0;
    for (std::size_t k = shift; k < n; ++k) products += residual[k] * residual[k - shift];
    const double rho = products / squares;
    sum += rho * rho / static_cast<double>(n - shift);
  }
  return static_cast<double>(n) * static_cast<double>(n + 2) * sum;
}

}  // namespace flexarm::measured
