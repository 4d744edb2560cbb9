#include "response/time/driven_arm.hpp"

#include "arm/input_error.hpp"
#include "response/time/beam_forces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace flexarm::response {

namespace {

using Eigen::Index;

constexpr double kTurn_rad = 2.0 * std::numbers::pi;

/// The reading with the torque `per_sine` S added to the actuator's.
Reading extended(const Reading& reading, double per_sine) {
  Reading made = reading;
  made.state.conservativeResize(reading.state.size() + 2);
  made.state.tail(2) << 0.0, reading.actuator * per_sine;
  return made;
}

LinearSystem extended(const LinearSystem& system, double omega, double per_sine) {
  const Index n = system.a.rows();
  LinearSystem made;
  made.a.setZero(n + 2, n + 2);
  made.a.topLeftCorner(n, n) = system.a;
  made.a.col(n + 1).head(n) = system.actuator * per_sine;
  made.a(n, n + 1) = -omega;
  made.a(n + 1, n) = omega;
  made.actuator.setZero(n + 2);
  made.actuator.head(n) = system.actuator;
  made.force.setZero(n + 2, system.force.cols());
  made.force.topRows(n) = system.force;
  made.hub_acceleration = extended(system.hub_acceleration, per_sine);
  for (const auto& sensor : system.sensors) made.sensors.push_back(extended(sensor, per_sine));
  made.lagged_readings = system.lagged_readings;
  return made;
}

double largest_command(const SineDrive& drive) {
  return std::abs(drive.offset_N_m) + drive.amplitude_N_m;
}

/// Of a command that is not clipped.
double gain_of(const Actuator& actuator, const SineDrive& drive) {
  return actuator.mapped(largest_command(drive)) / largest_command(drive);
}

/// Throws InputError by name of effect and port for laws that a steady state cannot have.
const ArmParts& checked(const ArmParts& parts) {
  for (const auto& [effect, law] : parts.hub.smooth) {
    if (!law.depends_on_time) continue;
    throw arm::InputError(
        fmt::format("effects.{}: port {}: a law that depends on time has no steady state", effect,
                    arm::to_string(arm::Port::hub_torque)),
        "effects." + effect);
  }
  return parts;
}

double sinc(double x) {
  return std::sin(std::numbers::pi * x) / (std::numbers::pi * x);
}

}  // namespace

ModalDynamics with_sine(const ModalDynamics& arm, const SineDrive& drive, double scale) {
  const double omega = kTurn_rad * drive.frequency_Hz;
  const double per_sine = drive.amplitude_N_m / scale;
  ModalDynamics made = arm;
  made.turning = extended(arm.turning, omega, per_sine);
  made.held = extended(arm.held, omega, per_sine);
  made.lagged_torque.reset();  // S drives Z, which no constant rate of u settles
  made.reaction = extended(arm.reaction, per_sine);
  made.hub_torque = extended(arm.hub_torque, per_sine);
  made.fastest_rate_rad_per_s = fastest_rate_rad_per_s(made.turning);
  return made;
}

bool clips(const Actuator& actuator, const SineDrive& drive) {
  return std::ranges::any_of(actuator.bends(),
                             [&](double bend) { return std::abs(bend) < largest_command(drive); });
}

DrivenArm::DrivenArm(const ModalDynamics& arm, const arm::ModalModel& model, const ArmParts& parts,
                     std::span<const arm::Sensor> sensors, const SineDrive& drive,
                     int samples_per_period, int substeps)
    : size_(arm.size()),
      // S is as large as the states that it moves, as far as inertia alone holds them.
      scale_(drive.amplitude_N_m * arm.turning.actuator.norm() / (kTurn_rad * drive.frequency_Hz)),
      sine_N_m_(drive.amplitude_N_m),
      sample_time_s_(1.0 / (drive.frequency_Hz * samples_per_period)),
      arm_(with_sine(
          arm,
          {clips(parts.actuator, drive) ? 0.0
                                        : gain_of(parts.actuator, drive) * drive.amplitude_N_m,
           drive.offset_N_m, drive.frequency_Hz},
          scale_)),
      forces_(added_forces(arm_, model, checked(parts))),
      readings_(arm_, parts, sensors) {
  is_linear_ = !forces_.has_friction() && !forces_.vary();
  std::vector<double> command_N_m;
  // Where nothing is clipped the sine has its delay in its phase.
  Actuator actuator{.maps = {arm::PiecewiseLinear(gain_of(parts.actuator, drive))}};
  std::size_t lead = 0;
  const auto n = static_cast<std::size_t>(samples_per_period);
  if (clips(parts.actuator, drive)) {
    actuator = parts.actuator;
    actuator.delay_s = std::fmod(actuator.delay_s, 1.0 / drive.frequency_Hz);
    // One that leads is one that is late by the rest of a period.
    if (actuator.delay_s < 0.0) actuator.delay_s += 1.0 / drive.frequency_Hz;
    // As many samples before the period as the delay needs, and the one that ends the period.
    lead = static_cast<std::size_t>(std::ceil(actuator.delay_s / sample_time_s_)) + 1;
    for (std::size_t k = 0; k < lead + n + 1; ++k) {
      const double turns = static_cast<double>(k) - static_cast<double>(lead);
      const double sine = std::sin(kTurn_rad * turns / samples_per_period);
      command_N_m.push_back(drive.offset_N_m + drive.amplitude_N_m * sine);
    }
    const double held = sinc(1.0 / samples_per_period);
    sine_N_m_ *= held * held;
  } else {
    phase_rad_ = -kTurn_rad * std::fmod(drive.frequency_Hz * parts.actuator.delay_s, 1.0);
    command_N_m.assign(n + 1, drive.offset_N_m);
  }
  const TorquePath path(actuator, command_N_m, sample_time_s_, TorqueHold::first);
  pieces_.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    path.pieces(static_cast<std::ptrdiff_t>(lead + k), pieces_[k]);
  }
  SimulationOptions options;
  options.sample_time_s = sample_time_s_;
  options.hold = TorqueHold::first;
  options.substeps = substeps;
  plan_.emplace(arm_, forces_, actuator, options, nullptr);
  stepper_.emplace(*plan_, nullptr);
}

void DrivenArm::put(const Eigen::VectorXd& state, bool held) {
  Eigen::VectorXd x(size_ + 2);
  x << state, scale_ * std::cos(phase_rad_), scale_ * std::sin(phase_rad_);
  stepper_->put(x, held);
}

void DrivenArm::drive_period(std::vector<std::vector<double>>* readings) {
  // The sine begins each period anew: its rounding does not add up.
  put(state(), is_held());
  if (!stepper_->state().allFinite()) {
    throw arm::InputError("motion: numeric overflow; reduce the torque");
  }
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    const double time_s = static_cast<double>(k) * sample_time_s_;
    const double actuator_N_m = pieces_[k].front().begin_N_m;
    stepper_->take_up(actuator_N_m, time_s);
    if (readings != nullptr) {
      const Eigen::VectorXd& now = readings_.read(*stepper_, actuator_N_m);
      for (std::size_t j = 0; j < readings->size(); ++j) {
        (*readings)[j].push_back(now(static_cast<Index>(j)));
      }
    }
    for (const TorquePiece& piece : pieces_[k]) {
      const double begin_s = time_s + piece.begin * sample_time_s_;
      if (piece.begin > 0.0) stepper_->take_up(piece.begin_N_m, begin_s);
      stepper_->advance(piece, begin_s);
    }
  }
}

}  // namespace flexarm::response
