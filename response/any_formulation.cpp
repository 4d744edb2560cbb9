#include "response/any_formulation.hpp"

namespace flexarm::response {

std::string_view name(const AnyFormulation& formulation) {
  return std::visit([](const auto& f) -> std::string_view { return f.kName; }, formulation);
}

const arm::Arm& arm_of(const AnyFormulation& formulation) {
  return std::visit([](const auto& f) -> const arm::Arm& { return f.arm(); }, formulation);
}

int degrees_of_freedom(const AnyFormulation& formulation) {
  return std::visit([](const auto& f) { return f.degrees_of_freedom(); }, formulation);
}

arm::PoleSet poles(const AnyFormulation& formulation, int count) {
  return std::visit([&](const auto& f) { return f.poles(count); }, formulation);
}

arm::DampedPoleSet damped_poles(const AnyFormulation& formulation, int count) {
  return std::visit([&](const auto& f) { return f.damped_poles(count); }, formulation);
}

arm::ZeroSet zeros(const AnyFormulation& formulation, const arm::Sensor& sensor, int count) {
  return std::visit([&](const auto& f) { return f.zeros(sensor, count); }, formulation);
}

std::vector<arm::Mode> modes(const AnyFormulation& formulation, int count,
                             std::span<const arm::Sensor> sensors,
                             std::span<const double> stations_m) {
  return std::visit([&](const auto& f) { return f.modes(count, sensors, stations_m); },
                    formulation);
}

arm::ModalModel modal_model(const AnyFormulation& formulation, int count,
                            std::span<const arm::Sensor> sensors,
                            std::span<const double> stations_m) {
  return std::visit([&](const auto& f) { return f.modal_model(count, sensors, stations_m); },
                    formulation);
}

std::complex<double> transfer_function(const AnyFormulation& formulation, const arm::Sensor& sensor,
                                       std::complex<double> s_rad_per_s) {
  return std::visit([&](const auto& f) { return f.transfer_function(sensor, s_rad_per_s); },
                    formulation);
}

std::vector<std::complex<double>> transfer_functions(const AnyFormulation& formulation,
                                                     std::span<const arm::Sensor> sensors,
                                                     std::complex<double> s_rad_per_s) {
  if (const auto* exact = std::get_if<exact_tf::ExactArm>(&formulation)) {
    return exact->transfer_functions(sensors, s_rad_per_s);
  }
  std::vector<std::complex<double>> values;
  for (const auto& sensor : sensors) {
    values.push_back(transfer_function(formulation, sensor, s_rad_per_s));
  }
  return values;
}

}  // namespace flexarm::response
