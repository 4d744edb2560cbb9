#include "arm/hub_torque_table.hpp"

#include "arm/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

namespace flexarm::arm {

namespace {

std::string key_in_table(const char* leaf) {
  return fmt::format("effects.{}.{}", kHubTorqueTable, leaf);
}

/// Between two places of an axis: the first of them, and how far behind it, 0 to 1.
struct AxisPlace {
  std::size_t first = 0;
  double part = 0.0;
  double span = 0.0;  ///< from the one to the other; 0 beyond the ends, where nothing changes
};

AxisPlace place_on(std::span<const double> axis, double x) {
  if (axis.empty() || x < axis.front()) return {};
  if (x >= axis.back()) return {axis.size() - 1, 0.0, 0.0};
  const auto above = std::ranges::upper_bound(axis, x);
  const auto first = static_cast<std::size_t>(above - axis.begin()) - 1;
  const double span = axis[first + 1] - axis[first];
  return {first, (x - axis[first]) / span, span};
}

/// The first of the two velocities 0; the number of velocities where there is none.
std::size_t jump_of(const std::vector<double>& velocities) {
  const auto at = std::ranges::adjacent_find(
      velocities, [](double one, double next) { return one == 0.0 && next == 0.0; });
  return static_cast<std::size_t>(at - velocities.begin());
}

void require_axis(const char* leaf, const std::vector<double>& axis, bool may_jump) {
  const std::string key = key_in_table(leaf);
  if (axis.size() == 1) {
    throw InputError(fmt::format("{}: has one place; needs two or more", key), key);
  }
  for (std::size_t i = 0; i < axis.size(); ++i) {
    if (!std::isfinite(axis[i])) {
      throw InputError(fmt::format("{}: {} at place {}; must be finite", key, axis[i], i + 1), key);
    }
    if (i == 0 || axis[i] > axis[i - 1]) continue;
    const bool is_jump =
        may_jump && axis[i] == 0.0 && axis[i - 1] == 0.0 && (i < 2 || axis[i - 2] < 0.0);
    if (is_jump) continue;
    throw InputError(
        fmt::format("{}: {} at place {} is not above {}; must ascend{}", key, axis[i], i + 1,
                    axis[i - 1], may_jump ? "; 0 alone may stand twice, for dry friction" : ""),
        key);
  }
}

/// Half of the fall from the one velocity 0 to the other, at an angle.
double jump_at(const HubTorqueTable& table, std::size_t row, std::size_t jump) {
  const std::size_t at = row * table.columns() + jump;
  return 0.5 * (table.torque_N_m[at] - table.torque_N_m[at + 1]);
}

void require_friction(const HubTorqueTable& table) {
  const std::size_t jump = jump_of(table.velocity_rad_per_s);
  if (jump == table.velocity_rad_per_s.size()) return;
  const std::string key = key_in_table("torque_N_m");
  const double friction_N_m = jump_at(table, 0, jump);
  if (friction_N_m < 0.0) {
    throw InputError(fmt::format("{}: rises by {} N m at velocity 0; dry friction acts against the "
                                 "motion, so that it must fall there",
                                 key, -2.0 * friction_N_m),
                     key);
  }
  constexpr double kAlike = 1e-12;
  for (std::size_t row = 1; row < table.angle_rad.size(); ++row) {
    const double other_N_m = jump_at(table, row, jump);
    if (std::abs(other_N_m - friction_N_m) <= kAlike * friction_N_m) continue;
    throw InputError(fmt::format("{}: falls by {} N m at velocity 0 at the first angle, by {} N m "
                                 "at angle {}; must be the same at every angle",
                                 key, 2.0 * friction_N_m, 2.0 * other_N_m, row + 1),
                     key);
  }
}

}  // namespace

double HubTorqueTable::friction_N_m() const {
  const std::size_t jump = jump_of(velocity_rad_per_s);
  return jump == velocity_rad_per_s.size() ? 0.0 : jump_at(*this, 0, jump);
}

HubTorqueTable::Value HubTorqueTable::smooth(double angle_rad_, double velocity) const {
  const AxisPlace row = place_on(angle_rad, angle_rad_);
  const AxisPlace column = place_on(velocity_rad_per_s, velocity);
  const std::size_t jump = jump_of(velocity_rad_per_s);
  const double friction = jump == velocity_rad_per_s.size() ? 0.0 : jump_at(*this, 0, jump);
  // With F added at the velocities above 0 and taken off below it does not jump.
  const auto at = [&](std::size_t i, std::size_t j) {
    const double torque = torque_N_m[i * columns() + j];
    return j > jump ? torque + friction : torque - friction;
  };
  const auto along = [&](std::size_t i) {
    Value made{at(i, column.first), 0.0};
    if (column.span == 0.0) return made;
    const double rise = at(i, column.first + 1) - made.torque_N_m;
    return Value{made.torque_N_m + column.part * rise, rise / column.span};
  };
  const Value one = along(row.first);
  if (row.span == 0.0) return one;
  const Value other = along(row.first + 1);
  return {std::lerp(one.torque_N_m, other.torque_N_m, row.part),
          std::lerp(one.per_velocity_N_m_s, other.per_velocity_N_m_s, row.part)};
}

void require_valid(const HubTorqueTable& table) {
  const std::string key = key_in_table("torque_N_m");
  if (table.angle_rad.empty() && table.velocity_rad_per_s.empty()) {
    const std::string whole = fmt::format("effects.{}", kHubTorqueTable);
    throw InputError(fmt::format("{}: needs angle_rad, velocity_rad_per_s or both", whole), whole);
  }
  require_axis("angle_rad", table.angle_rad, false);
  require_axis("velocity_rad_per_s", table.velocity_rad_per_s, true);
  const std::size_t rows = std::max<std::size_t>(1, table.angle_rad.size());
  if (table.torque_N_m.size() != rows * table.columns()) {
    throw InputError(
        fmt::format("{}: has {} values; must have {} (angles {}, velocities {})", key,
                    table.torque_N_m.size(), rows * table.columns(), rows, table.columns()),
        key);
  }
  const auto wrong =
      std::ranges::find_if(table.torque_N_m, [](double v) { return !std::isfinite(v); });
  if (wrong != table.torque_N_m.end()) {
    throw InputError(fmt::format("{}: {} at place {}; must be finite", key, *wrong,
                                 wrong - table.torque_N_m.begin() + 1),
                     key);
  }
  require_friction(table);
}

}  // namespace flexarm::arm
