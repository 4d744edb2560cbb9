#pragma once

#include "arm/arm.hpp"
#include "arm/formulation.hpp"
#include "arm/sensor.hpp"
#include "compare/standard_models.hpp"
#include "compare/sweeps/sweep_parameter.hpp"
#include "response/any_formulation.hpp"

#include <atomic>
#include <complex>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace flexarm::compare {

/// What is computed at every point of the grid.
struct SweepQuestions {
  int poles = 5;  ///< poles, modes and zeros of collocated sensors, 1 or more
  int zeros = 4;  ///< zeros of each other sensor, 1 or more
  std::vector<arm::Sensor> sensors = {{arm::SensorKind::hub_angle, 0.0},
                                      {arm::SensorKind::tip_acceleration, 0.0}};
  bool modes = true;  ///< hub slopes, end-point values and damping ratios too
};

/// What one formulation says of one arm.
struct SweepPoint {
  std::vector<double> omega_rad_per_s;  ///< undamped poles, ascending
  std::vector<double> hub_slope;        ///< of the modes, as in arm::Mode; empty without `modes`
  std::vector<double> tip_value_m;      ///< phi(l)
  /// Poles of the damped arm, those of the lowest pair but for s = 0 and of the flexible ones:
  /// complex ones by the upper of each pair; ascending in |s|. Empty without `modes`.
  std::vector<std::complex<double>> damped_poles_rad_per_s;
  std::vector<std::vector<std::complex<double>>> zeros_rad_per_s;  ///< [sensor]
};

/// A sweep over one or two parameters of an arm. Point (i, j) of two axes has index
/// i * axes[1].values.size() + j.
struct SweepTask {
  arm::Arm arm;  ///< its nonlinear, actuator and sensor effects are left out
  std::vector<SweepAxis> axes;
  std::vector<Model> models;  ///< the first is the reference
  SweepQuestions questions;

  std::size_t points() const;
  /// The places on the axes of a point.
  std::vector<double> places_of(std::size_t point) const;
  /// The value of a parameter at a point.
  double value(std::size_t axis, std::size_t point) const;
  arm::Arm arm_of(std::size_t point) const;
  /// "payload.mass = 0.1 kg, hub.inertia = 0.002 kg m^2".
  std::string describe(std::size_t point) const;
};

/// How a sweep is run; nothing here changes its result.
struct SweepRun {
  /// Called after each point by the thread that computed it.
  std::function<void()> progress;
  const std::atomic<bool>* stop = nullptr;  ///< set: the sweep ends as soon as it can
  std::filesystem::path checkpoint;         ///< empty: none is kept
  bool resume = false;                      ///< goes on from the checkpoint
  std::string program_version;              ///< a checkpoint of another version is refused
  double checkpoint_interval_s = 5.0;       ///< at least, from one writing to the next
};

/// The values of a task's grid.
struct SweepValues {
  std::vector<std::vector<SweepPoint>> points;  ///< [model][point]
  std::size_t resumed = 0;                      ///< points taken from the checkpoint
};

/// `stop` was set before the sweep was done. The checkpoint, where there is one, holds what is.
struct SweepInterrupted : std::runtime_error {
  SweepInterrupted(std::size_t done, std::size_t total);
  std::size_t done = 0;  ///< points computed
  std::size_t total = 0;
};

/// Throws InputError for an arm, axis, count or sensor that cannot be used, at any point of the
/// grid, and for a parameter on which the linear arm does not depend.
void require_valid(const SweepTask& task);

/// Computes the grid on all cores that oneTBB may use. The values do not depend on the number of
/// threads, nor on interruptions. Throws InputError for what `require_valid` refuses, for an arm
/// that a model refuses (the first such point of the grid, with its place), and for a checkpoint
/// that is not of this task; SweepInterrupted when `stop` was set.
SweepValues evaluate(const SweepTask& task, const SweepRun& run);

/// The poles of an arm with its damping, as SweepPoint holds them; `undamped`: its PoleSet.
std::vector<std::complex<double>> damped_poles(const response::AnyFormulation& formulation,
                                               const arm::PoleSet& undamped, int count);

/// What a model says of one arm of the task.
SweepPoint evaluate_point(const Model& model, const arm::Arm& arm, const SweepQuestions& questions);

/// Zeros asked of a sensor: two more than are judged, so that a root near the last one is the same
/// in every model's list.
int zeros_asked(const arm::Sensor& sensor, const SweepQuestions& questions);

}  // namespace flexarm::compare
