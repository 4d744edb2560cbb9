#include "response/residual_mode.hpp"

#include "arm/linear_arm.hpp"
#include "response/formulation_maker.hpp"
#include "response/frequency/modal_response.hpp"
#include "response/time/taylor_series.hpp"

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

/// Beyond those kept, half as many modes or these are known one by one in the pseudo-mode's
/// damping.
constexpr std::size_t kLeastFurtherModes = 8;

/// |z| of the circle: the geometric mean of two neighbouring kept poles, or of the last of them and
/// `left_out`, the nearest below left_out/2; the smallest one where that has none.
double circle_radius(const arm::ModalModel& model, double left_out) {
  std::vector<double> poles;
  for (std::size_t i = 0; i < model.modes.size(); ++i) {
    poles.push_back(std::abs(omega_squared(model, i)));
  }
  poles.push_back(left_out);
  std::ranges::sort(poles);
  // Nothing lies between a rigid-body mode and the first flexible pole.
  std::vector<double> radii = {std::max(std::sqrt(poles[0] * poles[1]), poles[1] / 4.0)};
  for (std::size_t i = 1; i + 1 < poles.size(); ++i) {
    radii.push_back(std::sqrt(poles[i] * poles[i + 1]));
  }
  double best = radii.front();
  for (const double radius : radii) {
    if (radius <= left_out / 2.0) best = std::max(best, radius);
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

/// What the hub's moments say of the pseudo-mode.
struct HubPart {
  double omega_squared_rad2_per_s2 = 0.0;
  double slope = 0.0;
  double compliance_rad_per_N_m = 0.0;  ///< A_0
  bool is_first_left_out = false;       ///< the moments are lost: it is mode n + 1
};

HubPart hub_part(const Moments& hub, const arm::Mode& left_out, double inertia, double radius) {
  const double a0 = hub.constant;
  const double a1 = -hub.linear;
  const double least_a1 = kLeastSignificance * hub.largest_on_circle / radius;
  const double first = left_out.omega_rad_per_s * left_out.omega_rad_per_s;
  if (hub.has_constant() && a0 > 0.0 && a1 > least_a1 && a0 >= a1 * first) {
    return {a0 / a1, a0 * std::sqrt(inertia / a1), a0, false};
  }
  const double slope = left_out.hub_slope;
  return {first, slope, slope * slope / (inertia * first), true};
}

/// The pseudo-mode as sum a_i phi_i over the known modes n + 1 ... m and `rest` times a shape
/// orthogonal to all of them.
struct PseudoModeExpansion {
  std::vector<double> a;            ///< by mode of `known`, 0 for those kept
  double rest_hub_slope = 0.0;      ///< what is missing from the pseudo-mode's
  double rest_squared = 0.0;        ///< of its modal mass, relative
  double rest_omega_squared = 0.0;  ///< of its omega_r^2
};

PseudoModeExpansion expand(const arm::ModalModel& known, std::size_t kept, const HubPart& hub) {
  PseudoModeExpansion expansion;
  expansion.a.assign(known.modes.size(), 0.0);
  if (hub.is_first_left_out) {
    expansion.a[kept] = 1.0;
    return expansion;
  }
  expansion.rest_hub_slope = hub.slope;
  expansion.rest_squared = 1.0;
  expansion.rest_omega_squared = hub.omega_squared_rad2_per_s2;
  // 1/sqrt(I_T A_1) = omega_r^2/theta_r: theta_r = A_0 sqrt(I_T/A_1) with I_T A_0 =
  // theta_r^2/omega_r^2.
  const double scale = hub.omega_squared_rad2_per_s2 / hub.slope;
  for (std::size_t i = kept; i < known.modes.size(); ++i) {
    const double squared = omega_squared(known, i);
    const double a = scale * known.modes[i].hub_slope / squared;
    expansion.a[i] = a;
    expansion.rest_hub_slope -= a * known.modes[i].hub_slope;
    expansion.rest_squared -= a * a;
    expansion.rest_omega_squared -= a * a * squared;
  }
  // Differences of what is equal but for the tail and rounding.
  expansion.rest_hub_slope = std::max(0.0, expansion.rest_hub_slope);
  expansion.rest_squared = std::max(0.0, expansion.rest_squared);
  expansion.rest_omega_squared = std::max(0.0, expansion.rest_omega_squared);
  return expansion;
}

/// Row and column of D for the pseudo-mode, the last of `model`. Of `rest` the friction of the hub
/// is known, Kelvin-Voigt damping but for the springs it leaves out, and the drag of air to be no
/// more than ca/m.
void append_damping(arm::ModalModel& model, const arm::ModalModel& known,
                    const PseudoModeExpansion& expansion, const arm::LinearArm& arm) {
  const std::size_t kept = model.modes.size() - 1;
  const std::size_t all = known.modes.size();
  const double friction = arm.hub_viscous_friction_N_m_s_per_rad / model.modal_mass_kg_m2;
  const double rest = friction * expansion.rest_hub_slope;
  // D of the pseudo-mode with each known mode.
  std::vector<double> row(all);
  for (std::size_t j = 0; j < all; ++j) {
    row[j] = rest * known.modes[j].hub_slope;
    for (std::size_t i = kept; i < all; ++i) {
      row[j] += expansion.a[i] * known.damping_rad_per_s[i * all + j];
    }
  }
  double own = friction * expansion.rest_hub_slope * expansion.rest_hub_slope +
               arm.kelvin_voigt_s * expansion.rest_omega_squared +
               arm.air_damping_N_s_per_m2 / arm.linear_density_kg_per_m * expansion.rest_squared;
  for (std::size_t j = kept; j < all; ++j) {
    own += expansion.a[j] * (row[j] + rest * known.modes[j].hub_slope);
  }

  const std::size_t n = kept + 1;
  std::vector<double> damping(n * n);
  for (std::size_t i = 0; i < kept; ++i) {
    for (std::size_t j = 0; j < kept; ++j) {
      damping[i * n + j] = model.damping_rad_per_s[i * kept + j];
    }
    damping[i * n + kept] = row[i];
    damping[kept * n + i] = row[i];
  }
  damping.back() = own;
  model.damping_rad_per_s = std::move(damping);
  model.modes.back().damping_ratio = own / (2.0 * model.modes.back().omega_rad_per_s);
}

}  // namespace

arm::ModalModel with_residual_mode(const AnyFormulation& formulation, const arm::ModalModel& model,
                                   std::span<const arm::Sensor> sensors) {
  const bool matches = std::ranges::all_of(model.modes, [&](const arm::Mode& mode) {
    return mode.sensor_values.size() == sensors.size();
  });
  if (model.modes.empty() || !matches) {
    throw std::invalid_argument("residual mode: the modal model has other sensors");
  }
  const std::size_t kept = model.modes.size();
  const std::size_t further = std::max(kLeastFurtherModes, kept / 2);
  const auto known = modal_model(formulation, static_cast<int>(kept + further) - 1, sensors, {});
  if (known.modes.size() <= kept) return model;
  const arm::Mode& left_out = known.modes[kept];

  const double inertia = model.modal_mass_kg_m2;
  const double first = left_out.omega_rad_per_s * left_out.omega_rad_per_s;
  const double radius = circle_radius(model, first);
  const int points = points_on_circle(radius / first);
  const auto undamped = with_arm(formulation, without_damping(arm_of(formulation)));
  Values slopes;
  for (const auto& mode : model.modes) slopes.push_back(mode.hub_slope);
  const HubPart hub =
      hub_part(moments(undamped, model, {arm::SensorKind::hub_angle}, slopes, radius, points),
               left_out, inertia, radius);

  arm::ModalModel augmented = model;
  arm::Mode residual;
  residual.omega_rad_per_s = std::sqrt(hub.omega_squared_rad2_per_s2);
  residual.hub_slope = hub.slope;
  residual.displacement_m.assign(model.modes.front().displacement_m.size(), 0.0);
  for (std::size_t k = 0; k < sensors.size(); ++k) {
    Values values;
    for (const auto& mode : model.modes) values.push_back(mode.sensor_values[k]);
    const Moments sensor = moments(undamped, model, sensors[k], values, radius, points);
    const double compliance =
        sensor.has_constant() ? sensor.constant
                              : left_out.sensor_values[k] * left_out.hub_slope / (inertia * first);
    residual.sensor_values.push_back(compliance * hub.slope / hub.compliance_rad_per_N_m);
  }
  augmented.modes.push_back(std::move(residual));
  append_damping(augmented, known, expand(known, kept, hub), arm::linear_arm(arm_of(formulation)));
  return augmented;
}

}  // namespace flexarm::response
