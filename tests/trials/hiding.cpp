#include "tests/trials/hiding.hpp"

#include "arm/effects.hpp"
#include "arm/input_error.hpp"
#include "arm/linear_arm.hpp"
#include "arm/nearest_name.hpp"
#include "effects/registry/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flexarm::trials {

namespace {

/// Torques of a case against the lowest root mean square (experiment_plan.cpp).
constexpr double kTypicalTorque = 2.0;
constexpr double kPeakTorque = 12.0;

/// What is natural to an arm.
struct NaturalSizes {
  explicit NaturalSizes(const TrialArm& of) {
    const arm::LinearArm beam = arm::linear_arm(of.arm);
    length_m = beam.length_m;
    beam_kg = beam.linear_density_kg_per_m * length_m;
    spring_N_m_per_rad = beam.flexural_rigidity_N_m2 / length_m;
    omega_rad_per_s = arm::omega_scale_rad_per_s(beam);
    inertia_kg_m2 = arm::total_inertia_kg_m2(beam);
    torque_N_m = kTypicalTorque * of.low_torque_N_m;
    peak_N_m = kPeakTorque / kTypicalTorque * torque_N_m;
  }

  double length_m = 0.0;
  double beam_kg = 0.0;
  double spring_N_m_per_rad = 0.0;
  double omega_rad_per_s = 0.0;
  double inertia_kg_m2 = 0.0;
  double torque_N_m = 0.0;
  double peak_N_m = 0.0;
};

using Parameters = std::map<std::string, double>;

double between(double lowest, double highest, double part) {
  return lowest + (highest - lowest) * part;
}

Parameters beam_parameters(const std::string& name, const NaturalSizes& arm, double size,
                           const Chance& chance) {
  if (name == "payload_mass") return {{"mass", size * arm.beam_kg}};
  if (name == "payload_inertia") {
    return {{"inertia", size * arm.beam_kg * arm.length_m * arm.length_m}};
  }
  if (name == "payload_offset") return {{"offset", chance.sign * size * arm.length_m}};
  if (name == "hub_radius") return {{"radius", size * arm.length_m}};
  if (name == "root_compliance") return {{"stiffness", arm.spring_N_m_per_rad / size}};
  if (name == "local_stiffness_loss") {
    return {{"position", between(0.1, 0.7, chance.place) * arm.length_m},
            {"stiffness", arm.spring_N_m_per_rad / size}};
  }
  if (name == "hub_spring") return {{"stiffness", size * arm.spring_N_m_per_rad}};
  if (name == "gravity") return {{"acceleration", size * 9.81}};
  if (name == "shear_and_rotary_inertia") return {{"shear_coefficient", 1.0 / size}};
  if (name == "hub_viscous_friction") {
    return {{"coefficient", size * arm.inertia_kg_m2 * arm.omega_rad_per_s}};
  }
  if (name == "structural_damping") return {{"time", size / arm.omega_rad_per_s}};
  if (name == "air_damping") {
    return {{"coefficient", size * arm.beam_kg / arm.length_m * arm.omega_rad_per_s}};
  }
  if (name == "quadratic_drag") {
    return {{"coefficient", size * arm.beam_kg / (arm.length_m * arm.length_m)}};
  }
  return {{"factor", std::exp(chance.sign * size)}};
}

Parameters torque_parameters(const std::string& name, const NaturalSizes& arm, double size,
                             const Chance& chance) {
  const double torque = size * arm.torque_N_m;
  if (name == "coulomb_friction") return {{"torque", torque}};
  if (name == "stribeck_friction") {
    // Of the speed that the typical torque gives the rigid arm in a swing of its slowest mode.
    const double speed = arm.torque_N_m / (arm.inertia_kg_m2 * arm.omega_rad_per_s);
    return {{"torque", torque},
            {"static_torque", torque * between(1.5, 2.5, chance.ratio)},
            {"velocity", speed * between(0.2, 0.8, chance.place)}};
  }
  if (name == "torque_bias") return {{"torque", chance.sign * torque}};
  if (name == "torque_saturation") return {{"limit", arm.peak_N_m * std::exp(-size)}};
  if (name == "torque_dead_zone") return {{"width", torque}};
  if (name == "torque_ripple") {
    return {{"amplitude", torque},
            {"cycles", between(2.0, 16.0, chance.place)},
            {"phase", chance.phase_rad}};
  }
  if (name == "time_delay") return {{"delay", size}};
  return {{"time_constant", size}};
}

bool acts_on_torque(const std::string& name) {
  return name != "torque_gain" && name != "quadratic_drag" &&
         !effects::find(name)->definition->is_of_linear_arm();
}

Parameters outside_parameters(const std::string& name, const NaturalSizes& arm, double size,
                              const Chance& chance) {
  const double torque = size * arm.torque_N_m;
  if (name == "hub_hysteresis") {
    return {{"torque", torque}, {"angle", between(0.05, 0.3, chance.place)}};
  }
  if (name == "tuned_mass") {
    // 15.4 omega is the first pole of an arm of no hub inertia.
    return {{"mass", size * arm.beam_kg},
            {"frequency", between(0.5, 3.0, chance.place) * 15.4 * arm.omega_rad_per_s /
                              (2.0 * std::numbers::pi)},
            {"damping_ratio", 0.02},
            {"position", between(0.4, 1.0, chance.ratio) * arm.length_m}};
  }
  if (name == "disturbance_torque") {
    return {{"rms", torque}, {"lowest", 0.5}, {"highest", between(5.0, 40.0, chance.place)}};
  }
  return {{"coefficient", size * arm.spring_N_m_per_rad}};
}

std::vector<Hideable> all_hideables() {
  // Sizes beyond which the arm is another one: twice the beam's mass, a crack as soft as the beam.
  const std::map<std::string, double> largest = {
      {"hub_inertia", 1.1},       {"flexural_rigidity", 0.9}, {"linear_density", 0.9},
      {"payload_mass", 2.0},      {"payload_inertia", 0.1},   {"payload_offset", 0.2},
      {"hub_radius", 0.3},        {"root_compliance", 2.0},   {"local_stiffness_loss", 3.0},
      {"hub_spring", 3.0},        {"gravity", 2.0},           {"shear_and_rotary_inertia", 5.0},
      {"air_damping", 3.0},       {"quadratic_drag", 30.0},   {"coulomb_friction", 2.0},
      {"stribeck_friction", 1.0}, {"torque_gain", 1.0},       {"torque_saturation", 3.0},
      {"torque_dead_zone", 2.0},  {"actuator_lag", 0.1},      {"time_delay", 0.1},
      {"sensor_lag", 0.1},        {"tuned_mass", 0.5},        {"hub_hardening_spring", 300.0}};
  const auto largest_of = [&](const std::string& name) {
    const auto found = largest.find(name);
    return found == largest.end() ? 1.0 : found->second;
  };
  std::vector<Hideable> all;
  for (const effects::Entry& entry : effects::entries()) {
    const std::string& name = entry.definition->name;
    Hideable cause{.name = name, .largest = largest_of(name)};
    cause.in_modes = entry.shows == effects::Shows::in_all;
    cause.in_frequency = entry.shows != effects::Shows::in_time;
    cause.smallest = 1e-5 * cause.largest;
    if (cause.name == "shear_and_rotary_inertia") cause.smallest = 0.5;
    all.push_back(cause);
  }
  for (const std::string& name : outside_names()) {
    all.push_back({.name = name,
                   .outside = true,
                   .in_frequency = name == "tuned_mass",
                   .smallest = 1e-5 * largest_of(name),
                   .largest = largest_of(name)});
  }
  return all;
}

}  // namespace

Chance draw_chance(Random& random) {
  Chance chance;
  chance.sign = random.sign();
  chance.place = random.uniform();
  chance.ratio = random.uniform();
  chance.phase_rad = random.uniform(0.0, 2.0 * std::numbers::pi);
  const std::vector<std::string> sensors = {"tip_acceleration", "hub_velocity", "strain@0.05"};
  chance.sensor = sensors[random.below(sensors.size())];
  return chance;
}

bool Hideable::shows_in(measured::RunKind kind) const {
  if (kind == measured::RunKind::frf) return in_frequency;
  return kind == measured::RunKind::time || in_modes;
}

const std::vector<Hideable>& hideables() {
  static const std::vector<Hideable> all = all_hideables();
  return all;
}

const Hideable& find_hideable(const std::string& name) {
  const auto found = std::ranges::find(hideables(), name, &Hideable::name);
  if (found != hideables().end()) return *found;
  std::vector<std::string> names;
  for (const auto& cause : hideables()) names.push_back(cause.name);
  throw arm::InputError(
      fmt::format("{}: no cause that can be hidden{}", name, arm::did_you_mean(name, names)));
}

World with_hidden(const World& world, const TrialArm& of, const Hideable& cause, double size,
                  const Chance& chance) {
  World hidden = world;
  const NaturalSizes natural(of);
  if (cause.outside) {
    hidden.outside[cause.name] = outside_parameters(cause.name, natural, size, chance);
    return hidden;
  }
  const Parameters parameters = acts_on_torque(cause.name)
                                    ? torque_parameters(cause.name, natural, size, chance)
                                    : beam_parameters(cause.name, natural, size, chance);
  effects::put(hidden.arm, cause.name, parameters,
               cause.name == "sensor_lag" ? chance.sensor : std::string());
  return hidden;
}

}  // namespace flexarm::trials
