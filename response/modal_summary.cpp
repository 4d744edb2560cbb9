#include "response/modal_summary.hpp"

#include <cmath>

namespace flexarm::response {

ModalSummary summarise(const AnyFormulation& formulation, int count,
                       std::span<const arm::Sensor> sensors, std::span<const double> stations_m) {
  for (const auto& sensor : sensors) arm::require_valid(sensor, arm_of(formulation));
  ModalSummary summary;
  summary.poles = poles(formulation, count);
  summary.damped_poles = damped_poles(formulation, count);
  summary.sensors.assign(sensors.begin(), sensors.end());
  summary.modes = modes(formulation, count, sensors, stations_m);
  summary.stations_m.assign(stations_m.begin(), stations_m.end());
  for (const auto& sensor : sensors) {
    summary.zeros.push_back({sensor, zeros(formulation, sensor, count)});
  }
  return summary;
}

double lambda_of(const arm::Arm& arm, double omega_rad_per_s) {
  return std::sqrt(omega_rad_per_s / arm::omega_scale_rad_per_s(arm));
}

}  // namespace flexarm::response
