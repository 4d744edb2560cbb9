#include "measured/spectra/tail_probability.hpp"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/complement.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flexarm::measured {

namespace {

/// The law is made only where its numbers are some: Boost throws for NaN and infinity.
template <class Law, class... Numbers>
double tail(double value, Numbers... numbers) {
  const bool is_law = ((std::isfinite(numbers) && numbers > 0.0) && ...);
  if (!is_law || std::isnan(value) || value <= 0.0) return 1.0;
  if (std::isinf(value)) return 0.0;
  return boost::math::cdf(boost::math::complement(Law(numbers...), value));
}

}  // namespace

double chi_squared_tail(double value, double freedom) {
  return tail<boost::math::chi_squared>(value, freedom);
}

double chi_squared_tail(double value, double freedom, double lambda) {
  if (lambda == 0.0) return chi_squared_tail(value, freedom);
  return tail<boost::math::non_central_chi_squared>(value, freedom, lambda);
}

double f_tail(double value, double freedom, double freedom_of_noise) {
  return tail<boost::math::fisher_f>(value, freedom, freedom_of_noise);
}

double normal_tails(double value) {
  return std::isnan(value) ? 1.0 : std::erfc(std::abs(value) / std::numbers::sqrt2);
}

double students_t_tails(double value, double freedom) {
  return std::min(1.0, 2.0 * tail<boost::math::students_t>(std::abs(value), freedom));
}

}  // namespace flexarm::measured
