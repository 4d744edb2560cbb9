#pragma once

#include "response/time/arm_simulator.hpp"
#include "response/time/controller_run.hpp"
#include "response/time/reading_plan.hpp"
#include "response/time/sensor_readings.hpp"
#include "response/time/time_stepper.hpp"
#include "response/time/torque_path.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace flexarm::response {

/// The commanded torque of a run, sample by sample: given, or made by a controller on the way.
class ArmSimulator::Commands {
 public:
  /// Of an open loop. `torque_N_m` must outlive the object.
  Commands(const ArmSimulator& arm, std::span<const double> torque_N_m);
  /// Of a closed loop. `loop` must outlive the object.
  Commands(const ArmSimulator& arm, const ClosedLoop& loop);
  Commands(const Commands&) = delete;
  Commands& operator=(const Commands&) = delete;

  /// As many as samples; up to the sample that was reached.
  std::span<const double> torque_N_m() const { return torque_N_m_; }
  std::vector<double> take_torque_N_m() { return std::move(made_N_m_); }

  const TorquePath& path() const { return *path_; }
  /// Of all sensors of the arm.
  ReadingPlan reading_plan() const;

  /// Steps through the samples, from `first` on, which may be before 0; `at(instant)`, called at
  /// each sample and where each further part of its interval begins, says whether to go on. The
  /// last sample is looked at, not stepped from.
  template <class At>
  void step_through(TimeStepper& stepper, std::ptrdiff_t first, At at) {
    step_through(stepper, first, at, [](std::ptrdiff_t) { return std::ptrdiff_t{0}; });
  }
  /// The same in an open loop. `leap(k)`, called before sample k, may take the stepper over some
  /// samples, k the first of them, and says how many these are.
  template <class At, class Leap>
  void step_through(TimeStepper& stepper, std::ptrdiff_t first, At at, Leap leap) {
    const double sample_time_s = arm_->options_.sample_time_s;
    const auto end = std::ssize(torque_N_m_);
    TorquePath::Pieces pieces;
    double actuator_N_m = 0.0;
    for (std::ptrdiff_t k = first; k < end; ++k) {
      if (const std::ptrdiff_t taken = leap(k); taken > 0) {
        k += taken - 1;
        continue;
      }
      const double time_s = static_cast<double>(k) * sample_time_s;
      look({k, 0, time_s, actuator_N_m}, stepper);
      if (k >= 0) reach(static_cast<std::size_t>(k));
      path_->pieces(k, pieces);
      std::size_t parts = 0;
      for (const TorquePiece& piece : pieces) {
        const double begin_s = time_s + piece.begin * sample_time_s;
        const bool begins_part = piece.part == parts;
        if (begins_part && parts > 0) look({k, parts, begin_s, actuator_N_m}, stepper);
        stepper.take_up(piece.begin_N_m, begin_s);
        if (begins_part) {
          ++parts;
          if (!at(ReadingInstant{k, piece.part, begin_s, piece.begin_N_m})) return;
          if (k + 1 == end) return;
        }
        stepper.advance(piece, begin_s);
        actuator_N_m = piece.end_N_m;
      }
    }
  }

 private:
  void make_path();
  /// What the controller sees at an instant, before the torque there is taken up.
  void look(const ReadingInstant& now, const TimeStepper& stepper);
  /// Before the torque of sample `k` is taken up.
  void reach(std::size_t k);

  const ArmSimulator* arm_;
  const ClosedLoop* loop_ = nullptr;
  std::vector<double> made_N_m_;
  std::span<const double> torque_N_m_;
  std::optional<TorquePath> path_;
  // Of a closed loop.
  std::vector<std::size_t> places_;  // of the controller's sensors
  std::size_t period_ = 1;           // of the controller, in samples
  std::optional<ControllerRun> run_;
  std::optional<SensorReadings> readings_;
  std::optional<ReadingPlan> plan_;
  Eigen::MatrixXd read_;  // a row a sample, a column a sensor
  std::vector<double> now_;
};

}  // namespace flexarm::response
