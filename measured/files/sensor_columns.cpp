#include "measured/files/sensor_columns.hpp"

#include <algorithm>

namespace flexarm::measured {
namespace {

using Eigen::Index;
using Kind = SensorColumn::Kind;

/// The powers of s over a block that the sensor's transfer function has.
std::vector<int> powers(const arm::Sensor& sensor, bool rigid, bool undamped) {
  const int derivatives = arm::derivative_order(sensor);
  if (derivatives == 0) {
    if (rigid && bends_only(sensor.kind)) return undamped ? std::vector<int>{} : std::vector{1};
    return undamped ? std::vector{0} : std::vector{0, 1};
  }
  return rigid || undamped ? std::vector{derivatives} : std::vector{derivatives - 1, derivatives};
}

/// The powers over a block in free motion, besides the constant of `offset`.
std::vector<int> free_powers(const arm::Sensor& sensor, bool rigid, bool offset) {
  if (!rigid) return {0, 1};
  const bool moves = arm::derivative_order(sensor) == 0 && !bends_only(sensor.kind);
  if (!moves) return {1};
  return offset ? std::vector{0} : std::vector{0, 1};
}

}  // namespace

bool bends_only(arm::SensorKind kind) {
  return kind == arm::SensorKind::tip_deflection || kind == arm::SensorKind::strain;
}

SensorModel sensor_model(const arm::Sensor& sensor, Index index, const BlockSet& blocks,
                         std::span<const Stretch> stretches, const ColumnChoices& choices) {
  SensorModel model{.sensor = sensor, .columns = {}, .shared = 0};
  for (std::size_t m = 0; choices.forced && m < blocks.blocks.size(); ++m) {
    const bool held = blocks.is_held(m);
    const bool undamped = held || choices.undamped_residues ||
                          blocks.blocks[m].omega_rad_per_s() > choices.undamped_above_rad_per_s;
    for (const int power : powers(sensor, blocks.is_rigid(m), undamped)) {
      const double tightness =
          held ? choices.held_tightness(index, static_cast<Index>(m - blocks.free_blocks())) : 0.0;
      model.columns.push_back({Kind::forced, m, power, 0, tightness});
    }
  }
  const bool in_time = std::ranges::any_of(stretches, &Stretch::in_time);
  if (choices.forced && choices.static_remainder &&
      (!in_time || arm::derivative_order(sensor) == 0)) {
    model.columns.push_back({.kind = Kind::remainder});
  }
  model.shared = static_cast<Index>(model.columns.size());
  if (in_time && choices.forced && choices.jumps && arm::derivative_order(sensor) == 2) {
    model.columns.push_back({.kind = Kind::jump});
  }
  for (std::size_t r = 0; r < stretches.size(); ++r) {
    if (!stretches[r].in_time || !std::ranges::count(stretches[r].sensors, index)) continue;
    if (choices.offset) model.columns.push_back({.kind = Kind::offset, .stretch = r});
    if (!stretches[r].begins_in_motion) continue;
    for (std::size_t m = 0; m < blocks.free_blocks(); ++m) {
      for (const int power : free_powers(sensor, blocks.is_rigid(m), choices.offset)) {
        model.columns.push_back({Kind::free, m, power, r, 0.0});
      }
    }
  }
  return model;
}

Eigen::VectorXd column_of(const SensorColumn& column, const Eigen::MatrixXd& triangle,
                          const SignalLayout& layout, const BlockSet& blocks) {
  if (column.kind == Kind::offset) return triangle.col(layout.one());
  if (column.kind == Kind::remainder) return triangle.col(layout.remainder());
  if (column.kind == Kind::jump)
    return triangle.col(layout.torque()) - triangle.col(layout.remainder());
  const auto& [a1, a0] = blocks.blocks[column.block];
  const auto x = triangle.middleCols<2>(layout.block(column.block, column.kind == Kind::free));
  if (column.power < 2) return x.col(column.power);
  return triangle.col(layout.torque()) - a1 * x.col(1) - a0 * x.col(0);  // q''
}

Eigen::MatrixXd column_derivatives(const SensorColumn& column, const Eigen::MatrixXd& triangle,
                                   const SignalLayout& layout, const BlockSet& blocks) {
  if (!column.is_of_block()) return {};
  if (blocks.is_held(column.block)) return {};
  const auto& [a1, a0] = blocks.blocks[column.block];
  const auto x = triangle.middleCols<4>(layout.block(column.block, column.kind == Kind::free));
  // s^k p for k = 0 to 3, from p'' + a1 p' + a0 p = q.
  Eigen::MatrixXd p(triangle.rows(), 4);
  p.leftCols(2) = x.rightCols(2);
  p.col(2) = x.col(0) - a1 * p.col(1) - a0 * p.col(0);
  p.col(3) = x.col(1) - a1 * p.col(2) - a0 * p.col(1);
  Eigen::MatrixXd to_coefficients(triangle.rows(), 2);
  to_coefficients << -p.col(column.power + 1), -p.col(column.power);
  return to_coefficients * blocks.coefficient_derivatives(column.block).transpose();
}

}  // namespace flexarm::measured
