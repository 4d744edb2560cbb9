#pragma once

#include "arm/deadline.hpp"
#include "measured/checks/described_arm.hpp"
#include "measured/files/time_record.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::measured {

/// What can be wrong with recorded data, whatever the arm does.
enum class Fault {
  clock_jitter,      ///< times off the even grid
  clock_rate,        ///< times that run too fast or too slow
  missing_samples,   ///< gaps in the times
  backward_time,     ///< times that repeat or go back
  saturation,        ///< a channel that its range clips
  dead_channel,      ///< constant, or noise that nothing else knows of
  stuck_values,      ///< a value repeated while others move
  quantisation,      ///< a step that is coarse for the signal
  spikes,            ///< single samples far off
  drift,             ///< a slow trend that no other channel explains
  offset,            ///< a reading at rest that is not zero; a torque that moves nothing
  swapped_channels,  ///< two columns exchanged
  sign_flipped,
  wrong_unit,          ///< off by a power of ten, degrees for radians and the like
  wrong_scale,         ///< off by another factor
  delay,               ///< later than the other channels
  zero_torque,         ///< a torque that says nothing of what moves the arm
  duplicated_samples,  ///< rows written twice while the time goes on
  sampling_jitter,     ///< instants of sampling off the even times that are written
  hum,                 ///< a line of the mains frequency that is none of the arm's
  wrong_payload,       ///< another than the run states, by comparison with other runs
  uneven_noise,        ///< of a channel in one run, by comparison with other runs
};

inline constexpr std::array kFaults = {
    Fault::clock_jitter,    Fault::clock_rate,   Fault::missing_samples,
    Fault::backward_time,   Fault::saturation,   Fault::dead_channel,
    Fault::stuck_values,    Fault::quantisation, Fault::spikes,
    Fault::drift,           Fault::offset,       Fault::swapped_channels,
    Fault::sign_flipped,    Fault::wrong_unit,   Fault::wrong_scale,
    Fault::delay,           Fault::zero_torque,  Fault::duplicated_samples,
    Fault::sampling_jitter, Fault::hum,          Fault::wrong_payload,
    Fault::uneven_noise};

/// "clock jitter", "missing samples": as in a sentence.
std::string_view to_string(Fault fault);

/// The name of its check, as an option has it: "clock_jitter", "sign_inverted".
std::string check_name(Fault fault);
/// The fault whose check has this name. Throws InputError for another, with the names.
Fault fault_of_check(std::string_view name);

/// What a reading would be without its fault, in the channel's unit.
struct PredictedReading {
  std::size_t sample = 0;  ///< from 0
  double value = 0.0;
};

/// One fault: what and where.
struct DataFinding {
  Fault fault = Fault::clock_jitter;
  std::string channel;           ///< "time", "torque", "hub_angle", ...
  std::size_t first_sample = 0;  ///< from 0; the first of those that show it
  double time_s = 0.0;           ///< as recorded for that sample
  double value = 0.0;            ///< the size, in the unit that `text` names
  std::string text;              ///< one sentence without a full stop
  /// Of spikes: what the other samples and channels predict in their place.
  std::vector<PredictedReading> predicted = {};
};

/// What is known of the arm, and how much of a fault is one. Sizes relative to a channel are in its
/// standard deviations. A finding asks for all the inequalities of its kind.
struct DataCheckOptions {
  std::optional<double> length_m;             ///< from the motor axis to the tip
  std::optional<double> total_inertia_kg_m2;  ///< of the rigid arm, payload included
  bool starts_at_rest = true;                 ///< the arm is at rest at the first sample
  DescribedArm described = {};                ///< empty: no arm is described
  VariationsOfArm variations = {};            ///< arms that the described one may stand for
  arm::Deadline deadline = {};                ///< what comes after it is not checked

  /// Jitter: |t_k - (a + period k)| > this period, with a, period by least squares and gaps
  /// counted.
  double most_jitter_periods = kMostJitter_periods;
  /// Saturation: samples at the limit, in runs of two or more, >= this.
  int least_clipped_samples = 5;
  /// Stuck: equal values in a row >= this.
  int least_stuck_samples = 6;
  /// Quantisation: step >= `coarse_step` deviations, or step >= `fine_step` deviations and its
  /// error, step^2/12, makes up `floor_share` of the power of the floor of the spectrum.
  double coarse_step = 0.05;
  double fine_step = 0.01;
  double floor_share = 0.5;
  /// Spike: what neighbours in time and in other channels do not predict is > this many of its own
  /// robust deviations, and > `least_spike` deviations of the channel; within twelve samples after
  /// a jump of the torque or about a stop of the hub, > `least_shaken_spike`, of a tip
  /// acceleration beside a known torque twice that, and twice again where both meet. Of a tip
  /// acceleration whose record does not show when the hub stops, anywhere, >
  /// `least_unseen_stop_spike`.
  double spike_deviations = 8.0;
  double least_spike = 0.6;
  double least_shaken_spike = 2.5;
  double least_unseen_stop_spike = 1.5;
  /// Drift: from start to end > `least_drift` deviations of the channel, and > this many standard
  /// errors.
  double least_drift = 0.7;
  double drift_errors = 5.0;
  /// Delay: |delay| > this, and > `delay_errors` standard errors.
  double least_delay_periods = 0.3;
  double least_described_delay_periods = 1.7;  ///< by the described arm
  double delay_errors = 5.0;
  /// Unit: gain of a relation that is exact off by a factor > this; of one that holds roughly, off
  /// by > `rough_unit_factor`.
  double unit_factor = 2.0;
  double rough_unit_factor = 4.0;
  /// Scale: no unit, and off by a factor > this.
  double least_scale = 1.2;
  /// Offset: at rest > `least_offset` deviations of the channel, and > this many standard errors.
  double least_offset = 0.1;
  double least_torque_offset = 0.1;
  double offset_errors = 5.0;
};

/// Checks a run for faults of the recording, by what holds for any arm of this kind whatever its
/// parameters (docs/measured-data.md, "Faults in data"). Times may be uneven: channels are compared
/// over the longest stretch without gap. Findings come in the order of `Fault`, one a channel and
/// kind, with the number of places in its text.
///
/// A channel with a fault in its values (dead, clipped, stuck, spikes) is not compared with
/// others, nor is one that is swapped, flipped or in a wrong unit searched for drift and delay:
/// what such a comparison finds would be the same fault again.
///
/// Throws std::invalid_argument for vectors of unlike length or fewer than two samples, or a value
/// that is not finite.
std::vector<DataFinding> check_data(const TimeRecord& record, const DataCheckOptions& options = {});

/// Takes the channels that `findings` call dead out of the record, and returns their sensors.
std::vector<arm::Sensor> leave_out_dead_channels(TimeRecord& record,
                                                 const std::vector<DataFinding>& findings);

/// Leaves the spikes of a finding out of its channel (Channel::left_out) and puts what is predicted
/// in their place; the number of them. The torque gets the prediction alone: a simulation needs one
/// at every sample, and an error of the prediction acts for one sample only. Where they are more
/// than `kMostLeftOut` of the samples they are no outliers of a channel but its noise: nothing is
/// done then, and for other findings.
std::size_t leave_out_spikes(TimeRecord& record, const DataFinding& finding);
/// Estimates lose 1 - sqrt(0.95) = 2.5 % of their precision by as many. A sensor that is wrong more
/// often has noise of another distribution, which its good readings show as well.
inline constexpr double kMostLeftOut = 0.05;

}  // namespace flexarm::measured
