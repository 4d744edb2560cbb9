#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace flexarm::arm {

/// A measured law of hub torque: values over the hub's angle, its velocity or both, linear between
/// them and constant beyond the ends.
///
/// Over velocity the 0 may stand twice. The torque then jumps there, from f(0-) to f(0+): dry
/// friction F = (f(0-) - f(0+))/2, the same at every angle.
struct HubTorqueTable {
  std::vector<double> angle_rad = {};           ///< A, ascending; empty: the same at every angle
  std::vector<double> velocity_rad_per_s = {};  ///< V, ascending but for a double 0; or empty
  /// At each angle (one, where there are none) the torque at each velocity (likewise), angle by
  /// angle: max(A, 1) max(V, 1) values.
  std::vector<double> torque_N_m = {};

  struct Value {
    double torque_N_m = 0.0;
    double per_velocity_N_m_s = 0.0;
  };
  /// Without dry friction: continuous in angle and velocity.
  Value smooth(double angle_rad, double velocity_rad_per_s) const;
  /// F, 0 without a jump.
  double friction_N_m() const;

  std::size_t columns() const { return velocity_rad_per_s.empty() ? 1 : velocity_rad_per_s.size(); }

  bool operator==(const HubTorqueTable&) const = default;
};

/// Its table in an arm file: [effects.measured_hub_torque].
inline constexpr std::string_view kHubTorqueTable = "measured_hub_torque";

/// Throws InputError, with the key, for a table without an axis, axes that do not ascend, fewer
/// than two places on an axis, torques of another number, numbers that are not finite, and dry
/// friction below 0 or not the same at every angle.
void require_valid(const HubTorqueTable& table);

}  // namespace flexarm::arm
