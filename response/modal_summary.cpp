#include "response/modal_summary.hpp"

#include <cmath>

namespace flexarm::response {

ModalSummary summarise(const AnyFormulation& formulation, int count,
                       std::span<const arm::Sensor> sensors, std::span<const double> stations_m,
                       const SummaryProgress& tell) {
  for (const auto& sensor : sensors) arm::require_valid(sensor, arm_of(formulation));
  // The poles are one step, and so are the damped poles, the modes and the zeros of a sensor.
  // Shapes at so many stations take as long as one, measured with 100,000 modes of exact_tf.
  constexpr double kStationsOfAStep = 20.0;
  const double modes_steps = 1.0 + static_cast<double>(stations_m.size()) / kStationsOfAStep;
  const double steps = 2.0 + modes_steps + static_cast<double>(sensors.size());
  double done = 0.0;
  const auto goes_on = [&](std::string_view what, double its_steps = 1.0) {
    const double fraction = done / steps;
    done += its_steps;
    return !tell || tell(what, fraction);
  };

  ModalSummary summary;
  summary.sensors.assign(sensors.begin(), sensors.end());
  summary.stations_m.assign(stations_m.begin(), stations_m.end());
  if (!goes_on("poles")) return summary;
  summary.poles = poles(formulation, count);
  if (!goes_on("damped poles")) return summary;
  summary.damped_poles = damped_poles(formulation, count);
  if (!goes_on("modes", modes_steps)) return summary;
  summary.modes = modes(formulation, count, sensors, stations_m);
  for (const auto& sensor : sensors) {
    if (!goes_on("zeros")) return summary;
    summary.zeros.push_back({sensor, zeros(formulation, sensor, count)});
  }
  return summary;
}

double lambda_of(const arm::Arm& arm, double omega_rad_per_s) {
  return std::sqrt(omega_rad_per_s / arm::omega_scale_rad_per_s(arm));
}

}  // namespace flexarm::response
