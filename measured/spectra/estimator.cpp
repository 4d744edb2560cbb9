#include "measured/spectra/estimator.hpp"

namespace flexarm::measured {

std::string_view to_string(RecordedSignal signal) {
  constexpr std::array<std::string_view, 4> kNames = {"torque", "reference", "hub_angle",
                                                      "hub_velocity"};
  return kNames.at(static_cast<std::size_t>(signal));
}

Signal signal_of(const TimeRecord& record, RecordedSignal signal) {
  if (signal == RecordedSignal::torque) return {record.torque_N_m};
  if (signal == RecordedSignal::reference) return {record.reference.values};
  const arm::Sensor sensor{signal == RecordedSignal::hub_angle ? arm::SensorKind::hub_angle
                                                               : arm::SensorKind::hub_velocity,
                           0.0};
  const auto* values = values_of(record, sensor.kind);
  if (values == nullptr) return {};
  return {*values, differences_until_steady(sensor)};
}

}  // namespace flexarm::measured
