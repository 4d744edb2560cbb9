#include "response/frequency/transfer_forms.hpp"

#include "arm/linear_arm.hpp"
#include "response/formulation_maker.hpp"
#include "response/frequency/modal_response.hpp"
#include "response/time/taylor_series.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace flexarm::response {

namespace {

using Complex = std::complex<double>;

/// Of the size on the circle, below which a Taylor coefficient is rounding: at a quarter of the
/// first pole's z those that are not zero are of its order.
constexpr double kNothing = 1e-10;
constexpr double kOfFirstPole = 0.25;
constexpr int kMostPowers = 3;

/// s^n, exact on the axes.
Complex power_of(Complex s, int n) {
  Complex power = 1.0;
  for (int i = 0; i < std::abs(n); ++i) power *= s;
  return n < 0 ? 1.0 / power : power;
}

/// |z| of the pole nearest to the origin, the rigid-body mode's left out; 1 where there is none.
double nearest_pole(const ProductFactors& factors) {
  if (factors.omega_rad_per_s.empty()) {
    return factors.turns_freely ? 1.0 : factors.lowest_omega_squared_rad2_per_s2;
  }
  const double first = factors.omega_rad_per_s.front() * factors.omega_rad_per_s.front();
  if (factors.turns_freely) return first;
  return std::min(first, std::abs(factors.lowest_omega_squared_rad2_per_s2));
}

/// Gain and power from G(s) s^-k, times s^2 for an arm that turns freely, as a series in s^2.
void find_leading_term(const AnyFormulation& undamped, ProductFactors& factors) {
  const int derivatives = arm::derivative_order(factors.sensor);
  const int at_origin = factors.turns_freely ? derivatives - 2 : derivatives;
  double largest = 0.0;
  const auto analytic = [&](Complex z) {
    const Complex s = std::sqrt(z);
    const Complex value = transfer_function(undamped, factors.sensor, s) * power_of(s, -at_origin);
    largest = std::max(largest, std::abs(value));
    return value;
  };
  const double radius = kOfFirstPole * nearest_pole(factors);
  const auto coefficients =
      taylor_coefficients(analytic, radius, points_on_circle(kOfFirstPole), kMostPowers);
  double size = 1.0;
  for (int k = 0; k < kMostPowers; ++k, size *= radius) {
    const double coefficient = coefficients[static_cast<std::size_t>(k)];
    if (std::abs(coefficient) * size <= kNothing * largest) continue;
    factors.gain = coefficient;
    factors.power = at_origin + 2 * k;
    return;
  }
  throw std::runtime_error("product form: the response has no leading power of s");
}

}  // namespace

ProductFactors product_factors(const AnyFormulation& formulation, const arm::Sensor& sensor,
                               int count) {
  ProductFactors factors;
  factors.sensor = sensor;
  const auto pole_set = poles(formulation, count);
  factors.turns_freely = arm::linear_arm(arm_of(formulation)).turns_freely();
  factors.lowest_omega_squared_rad2_per_s2 = pole_set.lowest_omega_squared_rad2_per_s2;
  factors.omega_rad_per_s = pole_set.omega_rad_per_s;
  factors.zeros_rad_per_s = zeros(formulation, sensor, count).s_rad_per_s;
  find_leading_term(with_arm(formulation, without_damping(arm_of(formulation))), factors);
  return factors;
}

Complex value(const ProductFactors& factors, Complex s_rad_per_s) {
  const Complex z = s_rad_per_s * s_rad_per_s;
  Complex product = factors.gain * power_of(s_rad_per_s, factors.power);
  if (!factors.turns_freely) product /= 1.0 + z / factors.lowest_omega_squared_rad2_per_s2;
  for (const double omega : factors.omega_rad_per_s) product /= 1.0 + z / (omega * omega);
  for (const auto& zero : factors.zeros_rad_per_s) {
    product *= 1.0 - z / (zero * zero);
    if (zero.real() != 0.0 && zero.imag() != 0.0) product *= 1.0 - z / std::conj(zero * zero);
  }
  return product;
}

std::vector<PartialFraction> partial_fractions(const arm::ModalModel& model, std::size_t index) {
  std::vector<PartialFraction> terms;
  const std::size_t n = model.modes.size();
  for (std::size_t i = 0; i < n; ++i) {
    const auto& mode = model.modes[i];
    terms.push_back({omega_squared(model, i), model.damping_rad_per_s[i * n + i],
                     mode.sensor_values.at(index) * mode.hub_slope / model.modal_mass_kg_m2});
  }
  return terms;
}

}  // namespace flexarm::response
