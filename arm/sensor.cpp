#include "arm/sensor.hpp"

#include "arm/input_error.hpp"
#include "arm/linear_arm.hpp"
#include "arm/nearest_name.hpp"
#include "arm/number.hpp"
#include "arm/rigid_hub.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <stdexcept>

namespace flexarm::arm {

namespace {

struct KindEntry {
  SensorKind kind;
  std::string_view name;
  std::string_view unit;
  int derivative_order;
};

constexpr std::array<KindEntry, 6> kKinds = {{
    {SensorKind::hub_angle, "hub_angle", "rad", 0},
    {SensorKind::hub_velocity, "hub_velocity", "rad/s", 1},
    {SensorKind::tip_acceleration, "tip_acceleration", "m/s^2", 2},
    {SensorKind::tip_displacement, "tip_displacement", "m", 0},
    {SensorKind::tip_deflection, "tip_deflection", "m", 0},
    {SensorKind::strain, "strain", "1", 0},
}};

const KindEntry& entry_of(SensorKind kind) {
  for (const auto& entry : kKinds) {
    if (entry.kind == kind) return entry;
  }
  throw std::logic_error("sensor kind outside its enumeration");
}

double changed_length_m(const Arm& arm) {
  return with_changed_numbers(arm).beam.length_m;
}

/// Where a gauge is with the arm's effects, `length_m` being the length with them.
double place_m(const Sensor& sensor, const Arm& arm, double length_m) {
  double place_m = sensor.position_m == arm.beam.length_m ? length_m : sensor.position_m;
  for (const auto& [name, effect] : arm.effects) {
    if (!effect.definition->sensor_place) continue;
    const SensorPlace moved = effect.definition->sensor_place(effect);
    if (moved.sensor == sensor) place_m += moved.shift_m;
  }
  return place_m;
}

}  // namespace

Sensor parse_sensor(std::string_view name) {
  constexpr std::string_view kStrain = "strain@";
  if (name.starts_with(kStrain)) {
    const auto position_m = parse_number<double>(name.substr(kStrain.size()));
    if (!position_m || !std::isfinite(*position_m)) {
      throw InputError(fmt::format(
          "sensor {}: the position after strain@ must be in m, e.g. strain@0.05", shown(name)));
    }
    return {SensorKind::strain, *position_m};
  }
  std::vector<std::string> names;
  for (const auto& entry : kKinds) {
    if (entry.kind == SensorKind::strain) continue;
    if (entry.name == name) return {entry.kind, 0.0};
    names.emplace_back(entry.name);
  }
  names.emplace_back("strain@X");
  // A place is compared as X, so that its digits do not count as typing errors.
  const auto at = name.find('@');
  const std::string typed =
      at == std::string_view::npos ? std::string(name) : std::string(name.substr(0, at)) + "@X";
  throw InputError(fmt::format("sensor {}: unknown{}; allowed: {} (X in metres from the hub)",
                               shown(name), did_you_mean(typed, names), fmt::join(names, ", ")));
}

std::string to_string(const Sensor& sensor) {
  const std::string name(entry_of(sensor.kind).name);
  return sensor.kind == SensorKind::strain ? fmt::format("{}@{}", name, sensor.position_m) : name;
}

std::string_view unit(const Sensor& sensor) {
  return entry_of(sensor.kind).unit;
}

int derivative_order(const Sensor& sensor) {
  return entry_of(sensor.kind).derivative_order;
}

bool is_collocated(const Sensor& sensor) {
  return sensor.kind == SensorKind::hub_angle || sensor.kind == SensorKind::hub_velocity;
}

Sensor placed(const Sensor& sensor, const Arm& arm) {
  if (!is_collocated(sensor)) require_beam(arm, "sensor " + to_string(sensor));
  if (sensor.kind != SensorKind::strain) return sensor;
  const double length_m = changed_length_m(arm);
  const double position_m = place_m(sensor, arm, length_m);
  if (!(position_m >= 0.0 && position_m <= length_m)) {
    const bool is_moved = position_m != sensor.position_m;
    throw InputError(
        fmt::format("sensor {}: {}position must be from 0 to the beam's length, {} m{}",
                    to_string(sensor), is_moved ? fmt::format("is at {} m; ", position_m) : "",
                    length_m, length_m == arm.beam.length_m ? "" : " with the arm's effects"));
  }
  if (!arm.beam.thickness_m) {
    throw InputError(fmt::format("sensor {}: needs beam.thickness", to_string(sensor)));
  }
  return {sensor.kind, position_m};
}

std::vector<Sensor> placed(std::span<const Sensor> sensors, const Arm& arm) {
  std::vector<Sensor> all;
  for (const Sensor& sensor : sensors) all.push_back(placed(sensor, arm));
  return all;
}

void require_valid(const Sensor& sensor, const Arm& arm) {
  placed(sensor, arm);
}

bool is_responsive(const Sensor& sensor, const Arm& arm) {
  if (sensor.kind != SensorKind::strain) return true;
  const LinearArm linear = linear_arm(arm);
  const bool is_at_tip = place_m(sensor, arm, linear.length_m) == linear.length_m;
  return !is_at_tip || linear.payload_tip_inertia_kg_m2 != 0.0;
}

void require_responsive(const Sensor& sensor, const Arm& arm) {
  if (!is_responsive(sensor, arm)) {
    throw InputError(
        fmt::format("sensor {}: strain at the tip is identically zero without payload.inertia; "
                    "place it below {} m",
                    to_string(sensor), changed_length_m(arm)));
  }
}

}  // namespace flexarm::arm
