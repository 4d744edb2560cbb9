#pragma once

#include "response/time/reading_times.hpp"
#include "response/time/sensor_readings.hpp"
#include "response/time/time_stepper.hpp"
#include "response/time/torque_path.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace flexarm::response {

/// An instant at which sensors may be read.
struct ReadingInstant {
  std::ptrdiff_t sample = 0;  ///< at it, or the last one before
  std::size_t part = 0;       ///< of the sample interval (TorquePath::edges), which begins now
  double time_s = 0.0;
  double actuator_N_m = 0.0;  ///< torque of the actuator
};

/// Which of an arm's sensors are read where a part of the sample interval begins, and for which
/// sample.
class ReadingPlan {
 public:
  /// For these `sensors`, places in `times`, of a run of `samples`. `path` is cut at
  /// `times.cuts()`.
  ReadingPlan(const ReadingTimes& times, std::span<const std::size_t> sensors,
              const TorquePath& path, std::size_t samples);

  /// Calls `take(j, k, reading)` for each sensor, j its place in `times`, whose reading of sample k
  /// is taken now. `readings` are those of all sensors.
  template <class Take>
  void at(const ReadingInstant& now, const TimeStepper& stepper, SensorReadings& readings,
          Take take) const {
    const Eigen::VectorXd* values = nullptr;
    for (const Entry& entry : entries_) {
      const std::ptrdiff_t k = now.sample + entry.samples_later;
      if (entry.part != now.part || k < 0 || k >= samples_) continue;
      if (values == nullptr) values = &readings.read(stepper, now.actuator_N_m);
      take(entry.sensor, static_cast<std::size_t>(k),
           (*values)(static_cast<Eigen::Index>(entry.sensor)));
    }
  }

 private:
  struct Entry {
    std::size_t sensor;
    std::size_t part;
    std::ptrdiff_t samples_later;
  };
  std::ptrdiff_t samples_;
  std::vector<Entry> entries_;
};

}  // namespace flexarm::response
