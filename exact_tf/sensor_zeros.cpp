#include "exact_tf/sensor_zeros.hpp"

#include "exact_tf/complex_frequency.hpp"
#include "exact_tf/numerator.hpp"

#include <algorithm>
#include <cmath>

namespace flexarm::exact_tf {

namespace {

/// s with Re s >= 0, Im s >= 0 of the pair or quadruple that belongs to a zero in z.
std::complex<double> s_of(const AnalyticZero& zero, Real scale_rad_per_s) {
  const Real modulus = std::abs(zero.lambda);
  const Complex square = zero.lambda * zero.lambda;
  switch (zero.locus) {
    case ZeroLocus::positive_axis:
      return {0.0, static_cast<double>(modulus * modulus * scale_rad_per_s)};
    case ZeroLocus::negative_axis:
      return {static_cast<double>(modulus * modulus * scale_rad_per_s), 0.0};
    case ZeroLocus::off_axis:
      break;
  }
  // i lambda^2 mirrored in the imaginary axis.
  return {static_cast<double>(square.imag() * scale_rad_per_s),
          static_cast<double>(square.real() * scale_rad_per_s)};
}

}  // namespace

arm::ZeroSet find_sensor_zeros(const SectorFunction& numerator, Real omega_scale_rad_per_s,
                               int count, const AnalyticZeroOptions& options) {
  const AnalyticZeros found = find_analytic_zeros(numerator, count, options);
  const auto wanted = std::min(found.zeros.size(), static_cast<std::size_t>(count));
  arm::ZeroSet set;
  for (std::size_t i = 0; i < wanted; ++i) {
    set.s_rad_per_s.push_back(s_of(found.zeros[i], omega_scale_rad_per_s));
  }
  set.count.found = static_cast<int>(wanted);
  set.count.expected = set.count.found + found.missing();
  set.count.method = "argument principle";
  set.summary.method = "changes of sign on both axes, TOMS 748; argument principle, secant method";
  set.summary.iterations = static_cast<int>(found.function_values);
  set.summary.converged = found.converged;
  return set;
}

arm::ZeroSet find_sensor_zeros(const arm::LinearArm& arm, const arm::Sensor& sensor, int count,
                               Arithmetic arithmetic) {
  const auto value_at = [&](const auto& ratios, const auto& lambda) -> Complex {
    // Real lambda costs half as much.
    if (lambda.imag() == 0) return sensor_numerator(arm, ratios, sensor, lambda.real()).value;
    return in<Real>(sensor_numerator(arm, ratios, sensor, lambda).value);
  };
  const auto extended_ratios = inertia_ratios<Real>(arm);
  const auto working_ratios = inertia_ratios<double>(arm);
  const auto numerator = [&](const Complex& lambda) {
    return arithmetic == Arithmetic::working ? value_at(working_ratios, in<double>(lambda))
                                             : value_at(extended_ratios, lambda);
  };
  return find_sensor_zeros(numerator, frequency_scale_rad_per_s(arm), count,
                           zero_options(arithmetic));
}

}  // namespace flexarm::exact_tf
