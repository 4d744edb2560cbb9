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

/// A unit that a log may be in.
struct OtherUnit {
  std::string_view si_unit;
  std::string_view name;
  double scale = 1.0;
};

constexpr double kPoundForce_N = 4.4482216152605;
constexpr double kInch_m = 0.0254;
constexpr double kTurn_rad = 2.0 * std::numbers::pi;

constexpr std::array<OtherUnit, 35> kOtherUnits = {{
    {"s", "ns", 1e-9},
    {"s", "min", 60.0},
    {"s", "h", 3600.0},
    {"N m", "N cm", 1e-2},
    {"N m", "kN m", 1e3},
    {"N m", "MN m", 1e6},
    {"N m", "kgf cm", kStandardGravity_m_per_s2 * 1e-2},
    {"N m", "lbf in", kPoundForce_N* kInch_m},
    {"N m", "lbf ft", kPoundForce_N * 12.0 * kInch_m},
    {"N m", "ozf in", kPoundForce_N / 16.0 * kInch_m},
    {"N m", "uN m", 1e-6},
    {"N m", "cN m", 1e-2},
    {"N m", "daN m", 10.0},
    {"N m", "gf cm", kStandardGravity_m_per_s2 * 1e-5},
    {"rad", "mrad", 1e-3},
    {"rad", "rev", kTurn_rad},
    {"rad", "urad", 1e-6},
    {"rad", "mdeg", kTurn_rad / 360e3},
    {"rad/s", "mrad/s", 1e-3},
    {"rad/s", "rev/s", kTurn_rad},
    {"rad/s", "rpm", kTurn_rad / 60.0},
    {"rad/s", "krpm", kTurn_rad / 60.0 * 1e3},
    {"rad/s", "rad/min", 1.0 / 60.0},
    {"m/s^2", "mg", kStandardGravity_m_per_s2 * 1e-3},
    {"m/s^2", "mm/s^2", 1e-3},
    {"m/s^2", "cm/s^2", 1e-2},
    {"m/s^2", "in/s^2", kInch_m},
    {"m/s^2", "ft/s^2", 12.0 * kInch_m},
    {"m", "cm", 1e-2},
    {"m", "um", 1e-6},
    {"m", "inch", kInch_m},
    {"m", "ft", 12.0 * kInch_m},
    {"m", "mil", kInch_m * 1e-3},
    {"1", "mstrain", 1e-3},
    {"1", "%", 1e-2},
}};

}  // namespace

std::optional<double> other_unit_scale(std::string_view si_unit, std::string_view unit) {
  for (const auto& other : kOtherUnits) {
    if (other.si_unit == si_unit && other.name == unit) return other.scale;
  }
  return std::nullopt;
}

std::vector<std::string_view> other_units(std::string_view si_unit) {
  std::vector<std::string_view> names;
  for (const auto& other : kOtherUnits) {
    if (other.si_unit == si_unit) names.push_back(other.name);
  }
  return names;
}

std::span<const Unit> units_for(std::string_view si_unit) {
  for (const auto& units : kQuantities) {
    if (units.front().name == si_unit) return units;
  }
  throw std::invalid_argument("no units for " + std::string(si_unit));
}

}  // namespace flexarm::measured
