#pragma once

#include "arm/sensor.hpp"
#include "measured/files/time_record.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace flexarm::diagnose {

/// The motion of a hub: a cubic spline of its angle, whose second derivative is linear between
/// samples.
struct PrescribedMotion {
  double angle_rad = 0.0;                            ///< at the first sample
  double velocity_rad_per_s = 0.0;                   ///< likewise
  std::vector<double> acceleration_rad_per_s2 = {};  ///< a value a sample
};

/// Returns what smoothing readings makes of another signal with as many samples, or of its first
/// ones. Concurrent calls are safe.
using ReadingFilter = std::function<std::vector<double>(const std::vector<double>&)>;

/// Readings without their noise, by penalised least squares [Whittaker1923]: the values
/// that make
///
///     sum (reading - value)^2 + mu sum (w d-th difference of the values)^2
///
/// least, the sum being over the readings that are not left out. They are the most likely ones
/// where the noise is white and the differences are, of standard deviations s and s/(w sqrt(mu)). s
/// and mu are those of the restricted likelihood [PattersonThompson1971]; the weights w follow the
/// local size of the differences: a hub moves and rests. The filter has no delay, and passes what
/// stands out of the noise.
struct SmoothedReadings {
  std::vector<double> values;
  double noise = 0.0;    ///< s, in the unit of the readings
  double penalty = 0.0;  ///< mu
  /// A draw of the error of `values` under that likelihood: what is wrong with them may look so.
  std::vector<double> error;
  ReadingFilter filtered;
};

/// What is known of a reading before the first: nothing, that it was the same all the time, or that
/// it was zero.
enum class BeforeFirst { unknown, same, zero };

/// `differences` d is 1 or more and below the number of readings. The time it takes is proportional
/// to that. `seed` is that of the draw. Readings at `left_out` have no weight.
SmoothedReadings smooth(const std::vector<double>& readings, int differences, BeforeFirst before,
                        std::uint64_t seed, const std::vector<std::size_t>& left_out = {});

/// How the hub moved in a `time` run by one of its sensors.
struct MeasuredMotion {
  arm::Sensor sensor;
  double noise = 0.0;  ///< standard deviation of its readings, in its unit
  PrescribedMotion motion;
  PrescribedMotion error;  ///< a draw of what may be wrong with it
  ReadingFilter filtered;
};

/// `read` are readings of a hub angle or velocity, without what its chain does to them, a value
/// every `period_s`, from rest or in the midst of a motion. An angle has white third differences
/// (jumps of the torque), a velocity second ones; of a velocity the angle is the integral. Throws
/// InputError for fewer than `kFewestReadings`.
MeasuredMotion motion_of_hub(const measured::Channel& read, double period_s, bool from_rest);
inline constexpr std::size_t kFewestReadings = 8;

}  // namespace flexarm::diagnose
