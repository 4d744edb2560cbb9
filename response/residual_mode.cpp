#include "response/residual_mode.hpp"

#include "arm/linear_arm.hpp"
#include "response/formulation_maker.hpp"
#include "response/modal_response.hpp"
#include "response/taylor_series.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <stdexcept>
#include <vector>

namespace flexarm::response {

namespace {

using Complex = std::complex<double>;

/// Digits of a Taylor coefficient below which mode n + 1 alone is nearer to the truth.
constexpr double kLeastSignificance = 1e3 * std::numeric_limits<double>::epsilon();

/// |z| of the circle: the geometric mean of two neighbouring kept poles, or of the last of them and
/// `truncated`, the nearest below truncated/2; the smallest one where that has none.
double circle_radius(const arm::ModalModel& model, double truncated) {
  std::vector<double> poles;
  for (std::size_t i = 0; i < model.modes.size(); ++i) {
    poles.push_back(std::abs(omega_squared(model, i)));
  }
  poles.push_back(truncated);
  std::ranges::sort(poles);
  // Nothing lies between a rigid-body mode and the first flexible pole.
  std::vector<double> radii = {std::max(std::sqrt(poles[0] * poles[1]), poles[1] / 4.0)};
  for (std::size_t i = 1; i + 1 < poles.size(); ++i) {
    radii.push_back(std::sqrt(poles[i] * poles[i + 1]));
  }
  double best = radii.front();
  for (const double radius : radii) {
    if (radius <= truncated / 2.0) best = std::max(best, radius);
  }
  return best;
}

/// Constant and linear coefficient of what the modes kept leave of one displacement, and how much
/// of it is rounding.
struct Moments {
  double constant = 0.0;
  double linear = 0.0;
  double largest_on_circle = 0.0;

  bool has_constant() const { return std::abs(constant) > kLeastSignificance * largest_on_circle; }
};

/// Values of the modes kept at what is looked at: hub slopes, or those of a sensor.
using Values = std::vector<double>;

Moments moments(const AnyFormulation& undamped, const arm::ModalModel& model,
                const arm::Sensor& sensor, const Values& values, double radius, int points) {
  Moments found;
  const int derivatives = arm::derivative_order(sensor);
  const auto remainder = [&](Complex z) {
    const Complex s = std::sqrt(z);
    Complex value = transfer_function(undamped, sensor, s);
    for (int i = 0; i < derivatives; ++i) value /= s;
    found.largest_on_circle = std::max(found.largest_on_circle, std::abs(value));
    for (std::size_t i = 0; i < model.modes.size(); ++i) {
      value -= values[i] * model.modes[i].hub_slope /
               (model.modal_mass_kg_m2 * (z + omega_squared(model, i)));
    }
    return value;
  };
  const auto coefficients = taylor_coefficients(remainder, radius, points, 2);
  found.constant = coefficients[0];
  found.linear = coefficients[1];
  return found;
}

/// Frequency, hub slope and static share of the hub.
struct HubPart {
  double omega_squared_rad2_per_s2 = 0.0;
  double slope = 0.0;
  double compliance_rad_per_N_m = 0.0;  ///< A_0
};

HubPart hub_part(const Moments& hub, const arm::Mode& truncated, double inertia, double radius) {
  const double a0 = hub.constant;
  const double a1 = -hub.linear;
  const double least_a1 = kLeastSignificance * hub.largest_on_circle / radius;
  const double first = truncated.omega_rad_per_s * truncated.omega_rad_per_s;
  if (hub.has_constant() && a0 > 0.0 && a1 > least_a1 && a0 >= a1 * first) {
    return {a0 / a1, a0 * std::sqrt(inertia / a1), a0};
  }
  const double slope = truncated.hub_slope;
  return {first, slope, slope * slope / (inertia * first)};
}

void append_damping(arm::ModalModel& model, const arm::LinearArm& arm) {
  const std::size_t n = model.modes.size();
  const arm::Mode& residual = model.modes.back();
  std::vector<double> damping(n * n);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    for (std::size_t j = 0; j + 1 < n; ++j) {
      damping[i * n + j] = model.damping_rad_per_s[i * (n - 1) + j];
    }
  }
  const double friction = arm.hub_viscous_friction_N_m_s_per_rad / model.modal_mass_kg_m2;
  for (std::size_t j = 0; j < n; ++j) {
    const double coupling = friction * residual.hub_slope * model.modes[j].hub_slope;
    damping[(n - 1) * n + j] = coupling;
    damping[j * n + n - 1] = coupling;
  }
  damping.back() += arm.kelvin_voigt_s * residual.omega_rad_per_s * residual.omega_rad_per_s +
                    arm.air_damping_N_s_per_m2 / arm.linear_density_kg_per_m;
  model.damping_rad_per_s = std::move(damping);
  model.modes.back().damping_ratio =
      model.damping_rad_per_s.back() / (2.0 * residual.omega_rad_per_s);
}

}  // namespace

arm::ModalModel with_residual_mode(const AnyFormulation& formulation, const arm::ModalModel& model,
                                   std::span<const arm::Sensor> sensors) {
  const bool matches = std::ranges::all_of(model.modes, [&](const arm::Mode& mode) {
    return mode.sensor_values.size() == sensors.size();
  });
  if (model.modes.empty() || !matches) {
    throw std::invalid_argument("residual mode: the modal model is not one of these sensors");
  }
  const auto kept = static_cast<int>(model.modes.size());
  const auto known = modes(formulation, kept, sensors, {});
  if (known.size() < model.modes.size()) return model;
  const arm::Mode& truncated = known.back();

  const double inertia = model.modal_mass_kg_m2;
  const double first = truncated.omega_rad_per_s * truncated.omega_rad_per_s;
  const double radius = circle_radius(model, first);
  const int points = points_on_circle(radius / first);
  const auto undamped = with_arm(formulation, without_damping(arm_of(formulation)));
  Values slopes;
  for (const auto& mode : model.modes) slopes.push_back(mode.hub_slope);
  const HubPart hub =
      hub_part(moments(undamped, model, {arm::SensorKind::hub_angle}, slopes, radius, points),
               truncated, inertia, radius);

  arm::ModalModel augmented = model;
  arm::Mode residual;
  residual.omega_rad_per_s = std::sqrt(hub.omega_squared_rad2_per_s2);
  residual.hub_slope = hub.slope;
  residual.displacement_m.assign(model.modes.front().displacement_m.size(), 0.0);
  for (std::size_t k = 0; k < sensors.size(); ++k) {
    Values values;
    for (const auto& mode : model.modes) values.push_back(mode.sensor_values[k]);
    const Moments sensor = moments(undamped, model, sensors[k], values, radius, points);
    const double compliance = sensor.has_constant() ? sensor.constant
                                                    : truncated.sensor_values[k] *
                                                          truncated.hub_slope / (inertia * first);
    residual.sensor_values.push_back(compliance * hub.slope / hub.compliance_rad_per_N_m);
  }
  augmented.modes.push_back(std::move(residual));
  append_damping(augmented, arm::linear_arm(arm_of(formulation)));
  return augmented;
}

}  // namespace flexarm::response
