#pragma once

#include "measured/files/time_record.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace flexarm::measured {

/// A column of a record, as the checks see it.
struct CheckedSignal {
  std::string name;                   ///< "torque", "hub_angle", ...
  std::optional<arm::Sensor> sensor;  ///< empty: the torque
  std::span<const double> values;
  double deviation = 0.0;  ///< standard deviation

  bool is(arm::SensorKind kind) const { return sensor && sensor->kind == kind; }
  bool is_torque() const { return !sensor; }
};

/// Torque first, then the channels; samples [first, first + count). They point into `record`.
std::vector<CheckedSignal> signals_of(const TimeRecord& record, std::size_t first,
                                      std::size_t count);

/// The values less what least squares finds in them of 50 and of 60 Hz, and of their mean: mains
/// hum is related to nothing, but a single line passes for related to anything. As they are where
/// the sampling cannot show 60 Hz.
std::vector<double> without_hum(const CheckedSignal& signal, double period_s);

/// The usable signal of the hub's motion: its velocity, else its angle; null without one.
const CheckedSignal* hub_signal(std::span<const CheckedSignal> signals,
                                const std::vector<bool>& usable);

/// Equal values one after the other.
struct EqualRun {
  std::size_t first = 0;
  std::size_t count = 0;
};

/// Runs of `least` equal values or more, in order.
std::vector<EqualRun> equal_runs(std::span<const double> values, std::size_t least);

/// Standard deviation of the white noise of readings, by their second differences: what is smooth
/// from one sample to the next has no part in it.
double reading_noise(std::span<const double> values);

/// The step of which all values are whole multiples but for one offset, to a fiftieth of a step;
/// empty where there is none as large as `least_step`, or fewer than three values.
std::optional<double> lattice_step(std::span<const double> values, double least_step);

}  // namespace flexarm::measured
