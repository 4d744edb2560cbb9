#pragma once

#include "response/time/sensor_imperfections.hpp"
#include "response/time/simulation.hpp"
#include "response/time/stepped_sine.hpp"

#include <complex>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace flexarm::response {

struct SteppedSineOptions {
  int substeps = 0;  ///< as SimulationOptions::substeps
  /// One a sensor, or none at all.
  std::vector<SensorImperfections> imperfections = {};
  std::uint64_t noise_seed = 1;
  std::uint32_t first_noise_stream = 1;  ///< of the first sensor; counted up
};

/// What stepping took, and what it leaves.
struct SteppedSineSummary {
  bool completed = true;  ///< false: cancelled; there are the frequencies up to there
  int least_samples_per_period = 0;
  int most_samples_per_period = 0;
  std::int64_t periods = 0;  ///< simulated, those of the search for steady states included
  double measured_s = 0.0;   ///< cycles that were correlated
  /// Largest difference of the first cycle's response from the last one's, over the larger of the
  /// two: of all frequencies and sensors, without noise. What is left of the transient.
  double largest_change = 0.0;
  double largest_change_Hz = 0.0;
  int unsettled = 0;           ///< frequencies with a change above kSettledChange
  std::int64_t reversals = 0;  ///< of the hub in dry friction, in the measured cycles, as are
  std::int64_t stops = 0;      ///< these
  double stick_time_s = 0.0;
};
inline constexpr double kSettledChange = 1e-6;

/// Frequency response as a stepped sine shows it. Vectors in vectors are one a sensor.
struct SteppedSineResponse {
  std::vector<double> frequency_Hz;
  std::vector<std::vector<std::complex<double>>> values;  ///< reading per N m, for exp(+i omega t)
  /// Estimated from the measured cycles where noise or quantisation act on the sensor, else NaN:
  /// cycles of a simulation repeat, linear or not.
  std::vector<std::vector<double>> coherence;
  std::vector<double> noise_deviation;
  SteppedSineSummary summary;
};

/// Samples of a period. A linear arm's readings are sines: 64 show them exactly. Dry friction,
/// drag, ripple and clipping make harmonics, of which orders n m +- 1 fall on the sine: 256 or
/// more, and so many that the highest mode, `highest_Hz`, lies below a quarter of the sampling
/// frequency, up to 2^16. The k-th harmonic of a friction torque is 1/k of its first: the sine of
/// an angle or a speed is then wrong by 2/n^2 of what friction does to it, that of an acceleration,
/// which jumps with it, by 2/n.
int samples_per_period(bool is_linear, double frequency_Hz, double highest_Hz);

/// The arm under a stepped sine, simulated in time at each frequency
/// (response/time/driven_arm.hpp): from its steady state, or, where `sine.settle_s` is given, from
/// rest at the first frequency and from where it is at the others. The response is the sine's part
/// of the reading over that of the commanded torque (response/time/sine_correlation.hpp). It is
/// that of a linear arm to rounding: some 1e-13 of the largest term of the modal sum.
///
/// Of a sensor that is delayed the cycles measured begin as much later: its delay turns the phase
/// of its response, and no sample is taken between two others.
///
/// Noise acts on the samples: its relative part on the root mean square of the sines of the whole
/// run.
///
/// `model` as in `simulate`. Throws InputError as `simulate` and `frequencies_Hz`, and for an arm
/// that falls.
SteppedSineResponse measure_stepped_sine(const arm::ModalModel& model, const ArmParts& parts,
                                         std::span<const arm::Sensor> sensors,
                                         const SteppedSine& sine,
                                         const SteppedSineOptions& options = {},
                                         const SimulationProgress& progress = {});

}  // namespace flexarm::response
