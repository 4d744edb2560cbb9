#include "response/time/quick_simulation.hpp"

#include "arm/input_error.hpp"
#include "response/time/added_forces.hpp"
#include "response/time/propagator.hpp"
#include "response/time/sensor_readings.hpp"
#include "response/time/simulation_input.hpp"
#include "response/time/torque_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

namespace flexarm::response {

using Eigen::Index;

/// Inner steps of one length, with a force that is constant over each.
struct InnerSteps {
  InnerSteps(const ModalDynamics& arm, double length_s, int steps)
      : count(steps),
        propagator(response::propagator(arm.turning, length_s / steps, 1.0, Precision::working)) {
    force = propagator.constant_force();
    const Eigen::VectorXd by_torque = force * arm.hub_force;
    speed_per_torque = arm.hub_velocity(by_torque);
  }

  int count;
  Propagator propagator;
  Eigen::MatrixXd force;
  double speed_per_torque = 0.0;  ///< theta' at the end of a step by a torque on the hub in it
};

namespace {

class QuickStepper {
 public:
  QuickStepper(const ModalDynamics& arm, const AddedForces& forces, const HubFriction& friction,
               bool varies, const Eigen::VectorXd& initial)
      : arm_(arm),
        forces_(forces),
        friction_(friction),
        varies_(varies),
        x_(initial.size() > 0 ? initial : Eigen::VectorXd::Zero(arm.size())),
        is_held_(!friction.is_zero() && initial.size() == 0) {}

  void advance(const InnerSteps& steps, double u0, double u1) {
    for (int i = 0; i < steps.count; ++i) {
      const double a = static_cast<double>(i) / steps.count;
      const double b = static_cast<double>(i + 1) / steps.count;
      step(steps, u0 + a * (u1 - u0), u0 + b * (u1 - u0));
    }
  }

  const Eigen::VectorXd& state() const { return x_; }

  /// What acts at this instant behind a torque of the actuator, and whether the hub is held.
  struct Instant {
    Eigen::VectorXd f;
    std::optional<double> held_angle_rad;
  };
  Instant instant(double actuator_N_m) const {
    const double offset = forces_.offset_N_m(arm_.hub_angle(x_));
    const Eigen::VectorXd f = forces_.force(x_, offset);
    if (friction_.is_zero()) return {f, std::nullopt};
    const double speed = arm_.hub_velocity(x_);
    if (!is_held_) return {forces_.force(x_, offset - sliding(speed)), std::nullopt};
    const double needed = arm_.reaction.state.dot(x_) + arm_.reaction.actuator * actuator_N_m +
                          arm_.reaction.force.dot(f);
    if (std::abs(needed) <= friction_.breakaway_N_m()) return {f, arm_.hub_angle(x_)};
    return {forces_.force(x_, offset - std::copysign(friction_.breakaway_N_m(), needed)),
            std::nullopt};
  }

 private:
  double sliding(double speed) const { return std::copysign(friction_.torque_N_m(speed), speed); }

  void step(const InnerSteps& steps, double u0, double u1) {
    const Propagator& p = steps.propagator;
    free_.noalias() = p.state * x_;
    free_ += p.actuator_begin * u0 + p.actuator_end * u1;
    Eigen::VectorXd f = forces_.force(x_, forces_.offset_N_m(arm_.hub_angle(x_)));
    end_ = free_ + steps.force * f;
    if (friction_.is_zero()) {
      if (varies_) correct(steps, f);
      x_.swap(end_);
      return;
    }
    if (varies_) {
      add_friction(steps);
      f = mean_with_end(f);
      end_ = free_ + steps.force * f;
    }
    is_held_ = add_friction(steps);
    x_.swap(end_);
    if (is_held_) arm_.stop_hub(x_);
  }

  /// The end once more, with the mean of the forces at both.
  void correct(const InnerSteps& steps, const Eigen::VectorXd& f) {
    end_ = free_ + steps.force * mean_with_end(f);
  }

  Eigen::VectorXd mean_with_end(const Eigen::VectorXd& f) const {
    return 0.5 * (f + forces_.force(end_, forces_.offset_N_m(arm_.hub_angle(end_))));
  }

  /// Adds friction to the end of a step; whether it stops the hub there.
  ///
  /// All else changes the hub's speed by `drift`, evenly over the step as far as can be seen. A hub
  /// that comes to rest at the part a of the step is held from there on, or driven back by what
  /// is left of the drift, (1 - a)(drift + friction the other way).
  bool add_friction(const InnerSteps& steps) {
    const double begin = is_held_ ? 0.0 : arm_.hub_velocity(x_);
    const double free = arm_.hub_velocity(end_);
    const double drift = free - begin;
    const double per_torque = steps.speed_per_torque;
    double speed = free;
    bool stops = false;
    if (is_held_ && std::abs(drift) <= friction_.breakaway_N_m() * per_torque) {
      speed = 0.0;
      stops = true;
    } else {
      const double way = begin != 0.0 ? begin : free;
      const auto slid = [&](double mean) {
        return free - std::copysign(friction_.torque_N_m(mean), way) * per_torque;
      };
      speed = slid(0.5 * (begin + slid(0.5 * (begin + free))));
      if (speed * way < 0.0) {
        const double moving = begin / (begin - speed);
        stops = std::abs(drift) <= friction_.breakaway_N_m() * per_torque;
        const double back = std::copysign(friction_.torque_N_m(0.5 * speed), drift) * per_torque;
        speed = stops ? 0.0 : (1.0 - moving) * (drift - back);
      }
    }
    end_.noalias() += steps.force * (arm_.hub_force * ((speed - free) / per_torque));
    return stops;
  }

  const ModalDynamics& arm_;
  const AddedForces& forces_;
  const HubFriction& friction_;
  bool varies_;
  Eigen::VectorXd x_;
  Eigen::VectorXd free_;
  Eigen::VectorXd end_;
  bool is_held_;
};

double mean_torque(const TorquePath::Pieces& pieces) {
  double sum = 0.0;
  double length = 0.0;
  for (const TorquePiece& piece : pieces) {
    sum += (piece.end - piece.begin) * 0.5 * (piece.begin_N_m + piece.end_N_m);
    length += piece.end - piece.begin;
  }
  return sum / length;
}

bool has_drag(const ArmParts& parts) {
  return parts.quadratic_drag_N_s2_per_m3 > 0.0;
}

AddedForces added_forces(const ModalDynamics& arm, const arm::ModalModel& model,
                         const ArmParts& parts) {
  std::optional<QuadraticDrag> drag;
  if (has_drag(parts)) {
    drag.emplace(model, parts.linear.beam.length_m, parts.quadratic_drag_N_s2_per_m3);
  }
  return {arm, parts, std::move(drag)};
}

}  // namespace

/// All that a torque does not change.
struct QuickSimulation::Parts {
  Parts(const arm::ModalModel& model, const ArmParts& of_arm, std::span<const arm::Sensor> read,
        const QuickSimulationOptions& chosen)
      : options(chosen),
        arm_parts(of_arm),
        sensors(read.begin(), read.end()),
        varies(has_drag(of_arm) || of_arm.actuator.ripple),
        arm(modal_dynamics(model, of_arm, read, has_drag(of_arm))),
        forces(added_forces(arm, model, of_arm)),
        whole(arm, chosen.sample_time_s, inner_steps()) {
    const double phi =
        TorquePath(of_arm.actuator, {}, chosen.sample_time_s, chosen.hold).delay_fraction();
    if (phi > 0.0) {
      parted.emplace(
          std::array{InnerSteps(arm, phi * chosen.sample_time_s, inner_steps()),
                     InnerSteps(arm, (1.0 - phi) * chosen.sample_time_s, inner_steps())});
    }
  }

  bool is_linear() const { return !varies && arm_parts.friction.is_zero(); }
  int inner_steps() const { return is_linear() ? 1 : options.substeps; }
  const InnerSteps& steps_of(const TorquePiece& piece) const {
    if (piece.length == TorquePiece::Length::whole) return whole;
    return (*parted)[piece.begin > 0.0 ? 1 : 0];
  }

  QuickSimulationOptions options;
  ArmParts arm_parts;
  std::vector<arm::Sensor> sensors;
  bool varies;
  ModalDynamics arm;
  AddedForces forces;
  InnerSteps whole;
  std::optional<std::array<InnerSteps, 2>> parted;
};

QuickSimulation::QuickSimulation(const arm::ModalModel& model, const ArmParts& parts,
                                 std::span<const arm::Sensor> sensors,
                                 const QuickSimulationOptions& options)
    : parts_(std::make_unique<const Parts>(model, parts, sensors, options)) {}

QuickSimulation::~QuickSimulation() = default;

Index QuickSimulation::states() const {
  return parts_->arm.size();
}

bool QuickSimulation::is_linear() const {
  return parts_->is_linear();
}

Eigen::MatrixXd QuickSimulation::operator()(std::span<const double> torque_N_m,
                                            const Eigen::VectorXd& initial) const {
  const Parts& parts = *parts_;
  const double h = parts.options.sample_time_s;
  require_simulable(parts.arm_parts, torque_N_m, {.sample_time_s = h, .hold = parts.options.hold});
  const TorquePath path(parts.arm_parts.actuator, torque_N_m, h, parts.options.hold);
  QuickStepper stepper(parts.arm, parts.forces, parts.arm_parts.friction, parts.varies, initial);
  SensorReadings readings(parts.arm, parts.arm_parts, parts.sensors);
  Eigen::MatrixXd made(static_cast<Index>(torque_N_m.size()),
                       static_cast<Index>(parts.sensors.size()));
  TorquePath::Pieces pieces;
  for (std::size_t k = 0; k < torque_N_m.size(); ++k) {
    path.pieces(k, pieces);
    const double now_N_m = pieces.front().begin_N_m;
    const QuickStepper::Instant instant = stepper.instant(now_N_m);
    const Eigen::VectorXd& now =
        readings.read(stepper.state(), instant.f, now_N_m, instant.held_angle_rad);
    if (!now.allFinite()) {
      throw arm::InputError(
          fmt::format("reading at {:.6g} s: too large for a number", static_cast<double>(k) * h));
    }
    made.row(static_cast<Index>(k)) = now.transpose();
    const bool is_regular = std::ranges::none_of(pieces, [](const TorquePiece& piece) {
      return piece.length == TorquePiece::Length::other;
    });
    if (!is_regular) {
      const double mean = mean_torque(pieces);
      stepper.advance(parts.whole, mean, mean);
      continue;
    }
    for (const TorquePiece& piece : pieces) {
      stepper.advance(parts.steps_of(piece), piece.begin_N_m, piece.end_N_m);
    }
  }
  return made;
}

Eigen::MatrixXd QuickSimulation::free_readings(std::size_t samples) const {
  const Parts& parts = *parts_;
  const auto n = static_cast<Index>(samples);
  const Eigen::MatrixXd step =
      propagator(parts.arm.turning, parts.options.sample_time_s, 1.0, Precision::working).state;
  const auto& sensors = parts.arm.turning.sensors;
  Eigen::MatrixXd made(n * static_cast<Index>(sensors.size()), states());
  // Row k of a sensor is its row of readings times the k-th power of the step.
  for (std::size_t j = 0; j < sensors.size(); ++j) {
    Eigen::RowVectorXd row = sensors[j].state;
    for (Index k = 0; k < n; ++k) {
      made.row(static_cast<Index>(j) * n + k) = row;
      row = row * step;
    }
  }
  return made;
}

}  // namespace flexarm::response
