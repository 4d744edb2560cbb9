#pragma once

#include "arm/arm.hpp"
#include "arm/linear_arm.hpp"
#include "diagnose/experiment.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace flexarm::diagnose {

/// Sizes by which a parameter of an effect is small or large in an experiment.
struct Scales {
  arm::LinearArm beam;               ///< the arm as its file has it
  std::vector<arm::Sensor> sensors;  ///< of `time` and `frf` runs
  double torque_rms_N_m = 0.0;       ///< of all `time` runs; 0 where there are none
  double torque_peak_N_m = 0.0;
  double speed_rms_rad_per_s = 1.0;  ///< of a rigid arm that this torque turns
  double shortest_time_s = 1e-3;     ///< half a sampling period, or 1/(20 highest frequency)
};
Scales scales_of(const Experiment& experiment);

enum class Spacing {
  linear,
  logarithmic,  ///< in equal ratios
  /// From 0, where the effect does nothing: evenly below `lowest`, in equal ratios above.
  from_zero,
  /// From infinity, where the effect does nothing, down to `lowest`: from_zero of the reciprocal.
  from_infinity,
};

/// A parameter of an effect and where it is looked for.
struct SearchedParameter {
  std::string name;
  double lowest = 0.0;
  double highest = 1.0;
  Spacing spacing = Spacing::logarithmic;
  bool periodic = false;  ///< the ends are the same
  /// Where the effect does nothing, if that is neither 0 nor infinity by the spacing.
  std::optional<double> neutral = {};

  /// The value at `place`, 0 at the lowest and 1 at the highest, and back.
  double value(double place) const;
  double place(double value) const;
  /// The place where the effect does nothing, if the parameter has one.
  std::optional<double> neutral_place() const;
};

/// What data an effect shows in.
enum class Shows {
  in_time,                ///< alone: it is not linear, or shifts the working point
  in_time_and_frequency,  ///< not in poles and zeros
  in_all,
};

/// An effect of the vocabulary as a possible cause: docs/diagnosis.md says how to add one.
struct Hypothesis {
  std::string effect;
  std::string sensor = {};  ///< the sensor it acts on, where it acts on one
  std::vector<SearchedParameter> parameters = {};
  Shows shows = Shows::in_all;
  /// Effects that this one becomes at a limit of its parameters: being more general is no rivalry.
  std::vector<std::string> contains = {};
  std::string speaks_for = {};  ///< what the data show where it is the cause
  std::string refuted_by = {};  ///< what would show that it is not

  /// "sensor_lag on tip_acceleration".
  std::string label() const;
  bool shows_in(measured::RunKind kind) const;
};

/// Unit of a parameter of the effect, as the vocabulary has it; empty for a plain number.
std::string unit_of(const Hypothesis& hypothesis, const SearchedParameter& parameter);

/// The arm with the effect at these values, one a parameter.
arm::Arm extended(const arm::Arm& arm, const Hypothesis& hypothesis,
                  std::span<const double> values);

}  // namespace flexarm::diagnose
