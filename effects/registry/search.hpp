#pragma once

#include "arm/arm.hpp"
#include "arm/linear_arm.hpp"
#include "arm/sensor.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::effects {

/// Unit of a parameter that has the unit of the sensor that its effect acts on.
inline constexpr std::string_view kSensorUnit = "unit of the sensor";

/// Sizes by which a parameter of an effect is small or large in an experiment.
struct Scales {
  arm::Arm arm;  ///< as its file has it
  /// Its linear equations; of a rigid hub with a beam whose sizes are those of hub and runs.
  arm::LinearArm beam;
  std::vector<arm::Sensor> sensors;  ///< of `time` and `frf` runs
  /// The sensor that the effect acts on, where it acts on one.
  std::optional<arm::Sensor> sensor = {};
  double reading_rms = 0.0;       ///< of that sensor in all `time` runs, in its unit
  bool has_payload_mass = false;  ///< in some run
  double torque_rms_N_m = 0.0;    ///< of all `time` runs; 0 where there are none
  double torque_peak_N_m = 0.0;
  double torque_low_N_m = 0.0;       ///< one in ten torques that are not 0 is smaller
  double hub_angle_range_rad = 0.0;  ///< largest of a `time` run; 0 where none shows it
  /// Root mean square of the hub's velocity as measured, else of a rigid arm that this torque
  /// turns.
  double speed_rms_rad_per_s = 1.0;
  double shortest_time_s = 1e-3;  ///< half a sampling period, or 1/(20 highest frequency)

  /// EI/l [N m/rad].
  double bending_stiffness_N_m_per_rad() const {
    return beam.flexural_rigidity_N_m2 / beam.length_m;
  }
  /// Twice the natural time of the beam, sqrt(m l^4/(EI)): what is later, or lags behind for
  /// longer, is another motion.
  double longest_lag_s() const { return 2.0 / arm::omega_scale_rad_per_s(beam); }
  /// m l [kg].
  double beam_mass_kg() const { return beam.linear_density_kg_per_m * beam.length_m; }
};

/// Sums over the torques of runs, and what of Scales they give.
class TorqueScales {
 public:
  /// Adds the torque of a run, a value every `period_s`, on an arm of this inertia.
  void add(std::span<const double> torque_N_m, double period_s, double inertia_kg_m2);
  /// Sets rms, peak and low torque, and the velocity of the rigid arm; nothing without a torque.
  void put(Scales& scales) const;

 private:
  std::vector<double> sizes_N_m_;
  double squares_ = 0.0;
  double speed_squares_ = 0.0;
};

enum class Spacing {
  linear,
  logarithmic,  ///< in equal ratios
  /// From 0, where the effect does nothing: evenly below `lowest`, in equal ratios above.
  from_zero,
  /// From infinity, where the effect does nothing, down to `lowest`: from_zero of the reciprocal.
  from_infinity,
  /// From `lowest`, below 0, through 0, where the effect does nothing: evenly within 10 % of
  /// -`lowest` of it, in equal ratios beyond.
  about_zero,
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
  /// All this is of how much the parameter is above the one before it, not of the parameter itself:
  /// from 0 on, it is never below that one.
  bool above_previous = false;

  /// The value (or how much it is above the one before it) at a coordinate, 0 at the lowest and 1
  /// at the highest, and back.
  double value(double coordinate) const;
  double coordinate(double value) const;
  /// The coordinate where the effect does nothing, if the parameter has one.
  std::optional<double> neutral_coordinate() const;
  /// What a coordinate there is from where the effect does nothing. From zero, and for the
  /// reciprocal from infinity, it is by the derivative there: the standard error of the coordinate
  /// is a part of this as that of the value is of the value. Where there is no such place it is
  /// that of the value itself, or half of a linear range.
  double size(double coordinate) const;

  bool operator==(const SearchedParameter&) const = default;
};

/// The parameters of an effect, or of several one after the other, at these coordinates, and back.
/// As many as there are parameters.
std::vector<double> values_at(std::span<const SearchedParameter> parameters,
                              std::span<const double> coordinates);
std::vector<double> coordinates_of(std::span<const SearchedParameter> parameters,
                                   std::span<const double> values);

/// Of values of these parameters, each itself, or how much it is above the one before it
/// (SearchedParameter::above_previous), and back. As many as there are parameters.
std::vector<double> parts_of(std::span<const SearchedParameter> parameters,
                             std::span<const double> values);
std::vector<double> values_of(std::span<const SearchedParameter> parameters,
                              std::vector<double> parts);

}  // namespace flexarm::effects
