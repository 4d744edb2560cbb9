#pragma once

#include "diagnose/symptoms/band_errors.hpp"
#include "diagnose/symptoms/symptoms_input.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace flexarm::diagnose {

/// A quantity whose values part the readings into regimes. Velocity and angle of the hub are
/// those of `hub_motion`: as measured, else the slope of the angle over a tenth of the first mode's
/// period, or the integral of the velocity from 0. Runs without a hub sensor have neither.
enum class RegimeQuantity {
  frequency,     ///< the bands of the arm's modes (frequency_bands) [Hz]
  torque,        ///< size of the commanded torque [N m]
  hub_velocity,  ///< its size [rad/s]
  hub_angle,     ///< with its sign [rad]
  time,          ///< since the run began [s]
  payload,       ///< mass [kg]
};

/// Returns "frequency", "torque", "hub_velocity", "hub_angle", "time", "payload".
std::string_view to_string(RegimeQuantity quantity);
/// Returns "Hz", "N m", "rad/s", "rad", "s", "kg".
std::string_view unit_of(RegimeQuantity quantity);

/// The error in one regime, over all channels of the judged runs (Problem::judged_runs): the
/// validation runs, or without any those for estimation, whose NRMSE the report has. Relative
/// numbers are root mean squares over that of the channel's whole signal in the run, as of
/// `ChannelGain`. Within a quantity the mean of their squares by `share` is the square of the
/// whole. Those of a frequency band are its part of the whole, as of `BandError`: their squares add
/// up.
struct RegimeError {
  RegimeQuantity quantity = RegimeQuantity::frequency;
  double from = 0.0;   ///< in the unit of the quantity (RegimeBounds)
  double to = 0.0;     ///< the same as `from` where the regime is one value
  double share = 0.0;  ///< part of the readings, or of the spectral lines
  double before = 0.0;
  double after = 0.0;
  double noise_floor = 0.0;  ///< noise and numerical error (ObservedChannel::floor)
  /// The mean square of the residual after over that outside of the regime, a reading or a spectral
  /// line.
  double ratio = 1.0;
  /// The ratio of the innovations of the residual, which are the errors of its prediction from the
  /// samples before by an autoregression of each channel. An error that arises here goes on in a
  /// simulation, and makes the residual large elsewhere; its innovations are here. Each channel's
  /// are scaled to the mean square of its residual, and compared with others of the run. Empty for
  /// frequency bands and payloads.
  std::optional<double> innovation_ratio = {};
  /// The larger p-value of two hypotheses: residual and innovations after are no larger than
  /// outside, or the residual is noise; after Bonferroni over all regimes of the table and over
  /// residual and innovations. Noise: `noise_probability`.
  ///
  /// Larger than outside: the logarithm of the ratio by its standard error, the delete-one
  /// jackknife over consecutive blocks of the runs, kErrorBlocks of them in all or one a run; of
  /// payloads one a run. Student's t, one-sided; its degrees of freedom are those of Welch for as
  /// many blocks as the readings inside and outside fill, less than all blocks. Of frequency bands:
  /// F test of white residuals, one channel of a run counting as independent.
  double p_value = 1.0;

  bool is_significant() const;
  /// Part of the mean square of all that is here beyond the level outside, by the larger ratio; 0
  /// where it is lower.
  double excess_share() const;
};
/// A jackknife of some ten blocks has the tails of Student's t to about this level.
inline constexpr double kSignificantRegime = 0.01;

/// Regimes of `time` runs, and of the bands of `time` and `frf` runs, by quantity and then
/// ascending. A quantity with a single regime is left out; so is the torque of runs that measured
/// motion drives. `bands` are those of `band_errors`.
std::vector<RegimeError> regime_errors(const SymptomsInput& input,
                                       const std::vector<BandError>& bands);

}  // namespace flexarm::diagnose
