#include "arm/hub_torque_formula.hpp"

#include <cmath>

namespace flexarm::arm {

double Interval::middle() const {
  return lowest > 0.0 ? std::sqrt(lowest) * std::sqrt(highest) : 0.5 * lowest + 0.5 * highest;
}

std::map<std::string, double> HubTorqueHypothesis::typical() const {
  std::map<std::string, double> values = known;
  for (const auto& [name, range] : ranges) values[name] = range.middle();
  return values;
}

}  // namespace flexarm::arm
