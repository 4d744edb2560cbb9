#pragma once

#include "measured/files/time_record.hpp"
#include "measured/spectra/spectra.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace flexarm::measured {

/// A signal of a record that responses are estimated from.
enum class RecordedSignal { torque, reference, hub_angle, hub_velocity };

/// Those that may be the input.
inline constexpr std::array kResponseInputs = {RecordedSignal::torque, RecordedSignal::hub_angle,
                                               RecordedSignal::hub_velocity};

/// "torque", "reference", "hub_angle", "hub_velocity".
std::string_view to_string(RecordedSignal signal);

/// How responses are estimated: from the input x to an output y, with the instrument z,
///
///     H = S_zy/S_zx
///
/// ([Wellstead1981]; the joint input-output method of [PintelonSchoukens2012] for a reference z).
/// It has no asymptotic bias where z has nothing in common with the noise of x and y and with
/// forces that were not recorded. In closed loop that is the reference: the torque contains both
/// through the feedback. Without an instrument the input is its own, z = x: H1.
///
/// From the hub's motion to another sensor the poles are those of the beam with the hub held,
/// whatever torque moves the hub.
struct Estimator {
  RecordedSignal input = RecordedSignal::torque;
  std::optional<RecordedSignal> instrument = {};
  std::string reason = {};  ///< why; empty: not chosen by evidence

  bool hub_held() const { return input != RecordedSignal::torque; }
  /// Returns the sensor of the hub that is the input; empty where that is the torque.
  std::optional<arm::Sensor> hub_sensor() const {
    if (!hub_held()) return std::nullopt;
    return arm::parse_sensor(to_string(input));
  }
  /// The signal whose period is that of a periodic excitation.
  RecordedSignal excitation() const { return instrument.value_or(input); }
};

/// A record's signal with the differences that take its drift off; no values where it was not
/// recorded.
Signal signal_of(const TimeRecord& record, RecordedSignal signal);

}  // namespace flexarm::measured
