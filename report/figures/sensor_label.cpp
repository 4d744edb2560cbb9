#include "report/figures/sensor_label.hpp"

#include "report/words.hpp"

namespace flexarm::report {

std::string sensor_label(const arm::Sensor& sensor) {
  return in_words(arm::to_string(sensor));
}

std::string axis_unit(const arm::Sensor& sensor) {
  return unit_text(arm::unit(sensor));
}

}  // namespace flexarm::report
