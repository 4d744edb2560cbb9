#pragma once

#include "arm/formulation.hpp"
#include "arm/sensor.hpp"
#include "response/arm_parts.hpp"
#include "response/time/simulation.hpp"
#include "response/time/time_stepper.hpp"

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace flexarm::response {

/// An instant: whole sample times since the beginning, and the fraction of one behind them, 0 or
/// more and below 1.
struct SampleInstant {
  std::int64_t sample = 0;
  double fraction = 0.0;
};

/// An arm whose torque is commanded on the way, as a co-simulation does: from one communication
/// point to the next the torque is constant.
///
/// Where communication points are samples (whole multiples of the sample time since the beginning)
/// the motion is that of `simulate` with the same torque and a zero-order hold, to rounding. Other
/// communication points are reached exactly, by inner steps of other lengths: what `simulate` steps
/// exactly stays exact, forces that vary with the state have the same order of error, and such a
/// step costs a matrix exponential or power series of its own.
///
/// A copy goes on by itself. Copies share what does not change.
class CosimulatedArm {
 public:
  /// At rest, with torque 0. `model` as in `simulate`. Throws InputError as `simulate` does for
  /// parts and options that do not fit together.
  CosimulatedArm(const arm::ModalModel& model, const ArmParts& parts,
                 std::span<const arm::Sensor> sensors, const SimulationOptions& options);

  /// The commanded torque from now on. Throws InputError for a torque that `simulate` refuses.
  void set_torque(double torque_N_m);
  double torque_N_m() const { return torque_N_m_; }

  /// Goes on by that time, 0 or more. A length within kWholeSamples of a whole number of sample
  /// times is that number of them. Throws InputError where the motion grows too large for a number,
  /// std::runtime_error where an inner step does not converge.
  void advance(double duration_s);
  static constexpr double kWholeSamples = 1e-6;  ///< of a sample time

  double time_s() const { return time_of(now_); }

  /// What the sensors show now, in their units. At the beginning and once the torque has been set
  /// at this communication point: just after the torque there has jumped, as `simulate` records a
  /// sample. Before that: just before any jump, as the controller of a closed loop reads it. The
  /// two differ where a torque jumps at the hub now, or did at the instant that a delayed sensor
  /// shows. A delayed sensor shows its offset alone until its first instant. Throws InputError for
  /// a reading that is too large for a number.
  std::vector<double> readings() const;

  /// All that changes, as numbers: `restore` of them gives the same motion again, within the
  /// tolerance of varying forces (a copy of the object: bit for bit).
  std::vector<double> state() const;
  /// `state` of an object that was made of the same arguments. Throws InputError for other numbers.
  void restore(std::span<const double> state);

 private:
  struct Model;
  struct Command {
    SampleInstant from;
    double torque_N_m = 0.0;
  };
  /// The motion as sensors of one delay show it, that much later.
  struct Delayed {
    std::vector<std::size_t> sensors;  ///< their places
    std::int64_t samples_later = 0;    ///< as ReadingTimes::OfSensor
    double at = 0.0;
    SampleInstant now = {};
    double actuator_N_m = 0.0;  ///< torque of the actuator up to now
    TimeStepper stepper;
  };

  double time_of(SampleInstant instant) const;
  SampleInstant shown_by(const Delayed& motion) const;
  double command_at(SampleInstant instant) const;
  std::optional<SampleInstant> next_arrival(SampleInstant after) const;
  void advance(Delayed& motion, SampleInstant to);
  void forget_commands();

  std::shared_ptr<const Model> model_;
  std::vector<Delayed> motions_;  // one a delay
  std::deque<Command> commands_;  // before now, ascending
  SampleInstant now_;
  double torque_N_m_ = 0.0;
  bool is_torque_new_ = true;
};

}  // namespace flexarm::response
