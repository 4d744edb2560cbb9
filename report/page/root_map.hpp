#pragma once

#include "arm/sensor.hpp"
#include "compare/identification.hpp"
#include "report/page/page_document.hpp"

#include <complex>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::report::page {

/// One entry of the legend of a map.
struct MapSeries {
  std::string name;
  Role role = Role::measured;
};

/// Sensors whose transfer functions have the same zeros but for those at 0: hub angle and velocity,
/// tip displacement and acceleration; each sensor in one group.
std::vector<std::vector<arm::Sensor>> sensors_by_zeros(const std::vector<arm::Sensor>& sensors);

/// "Torque to hub angle, hub velocity".
std::string map_title(const std::vector<arm::Sensor>& sensors);

/// An empty map of the s plane.
MapBlock root_map(const std::string& id, const std::string& title, const std::string& caption = "");

/// Poles with their conjugates; of two real ones both.
void add_poles(MapBlock& map, const MapSeries& series,
               const std::vector<compare::AnalyticalPole>& poles);

/// Zeros, each with all its roots: conjugates, mirror images.
void add_zeros(MapBlock& map, const MapSeries& series,
               const std::vector<std::vector<std::complex<double>>>& roots_rad_per_s);

/// Returns the zeros, without the roots of those that lie beyond `to_rad_per_s`: numbers stay.
std::vector<std::vector<std::complex<double>>> zeros_up_to(
    std::vector<std::vector<std::complex<double>>> roots_rad_per_s, double to_rad_per_s);

/// A measured pole or zero, by frequency and damping ratio; without a damping ratio it is on the
/// imaginary axis.
struct MeasuredRoot {
  Mark mark = Mark::pole;
  std::string name;  ///< "pole 2", "zero 1 of the hub angle"
  double frequency_Hz = 0.0;
  std::optional<double> frequency_std_Hz = {};
  std::optional<double> damping_ratio = {};
  std::optional<double> damping_ratio_std = {};
};
void add_root(MapBlock& map, const MapSeries& series, const MeasuredRoot& root);

}  // namespace flexarm::report::page
