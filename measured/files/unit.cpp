#include "measured/files/unit.hpp"

#include <array>
#include <numbers>
#include <stdexcept>
#include <string>

namespace flexarm::measured {

namespace {

constexpr double kStandardGravity_m_per_s2 = 9.80665;

constexpr std::array<Unit, 3> kTimeUnits = {{{"s"}, {"ms", 1.0, 1e3}, {"us", 1.0, 1e6}}};
constexpr std::array<Unit, 2> kTorqueUnits = {{{"N m"}, {"N mm", 1.0, 1e3}}};
constexpr std::array<Unit, 2> kAngle = {{{"rad"}, {"deg", std::numbers::pi, 180.0}}};
constexpr std::array<Unit, 2> kAngularVelocity = {{{"rad/s"}, {"deg/s", std::numbers::pi, 180.0}}};
constexpr std::array<Unit, 2> kAcceleration = {{{"m/s^2"}, {"g", kStandardGravity_m_per_s2}}};
constexpr std::array<Unit, 2> kLength = {{{"m"}, {"mm", 1.0, 1e3}}};
constexpr std::array<Unit, 2> kStrain = {{{"1"}, {"ustrain", 1.0, 1e6}}};

constexpr std::array<std::span<const Unit>, 7> kQuantities = {
    kTimeUnits, kTorqueUnits, kAngle, kAngularVelocity, kAcceleration, kLength, kStrain};

}  // namespace

std::span<const Unit> units_for(std::string_view si_unit) {
  for (const auto& units : kQuantities) {
    if (units.front().name == si_unit) return units;
  }
  throw std::invalid_argument("no units for " + std::string(si_unit));
}

}  // namespace flexarm::measured
