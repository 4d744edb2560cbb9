#pragma once

#include "arm/sensor.hpp"
#include "measured/modal/block_signals.hpp"

#include <Eigen/Core>

#include <limits>
#include <span>
#include <vector>

namespace flexarm::measured {

/// One column of a sensor's linear model: s^power q of a block, forced or free, or a signal alone.
struct SensorColumn {
  enum class Kind { forced, remainder, free, offset };
  Kind kind = Kind::forced;
  std::size_t block = 0;
  int power = 0;
  std::size_t stretch = 0;  ///< that has this column alone; free and offset only

  bool operator==(const SensorColumn&) const = default;
};

/// What a sensor's reading is made of, G = sum c s^power/(s^2 + a1 s + a0):
///
/// - displacements (hub angle, tip displacement): c0 + c1 s over each block;
/// - bending (tip deflection, strain): the same, but c1 s over the rigid-body block alone, whose
///   pole at 0 does not bend;
/// - velocity: s cancels the pole at 0: c0 + c1 s over flexible blocks, c1 s over the rigid-body
///   block;
/// - acceleration: s times that: c1 s + c2 s^2, and c2 s^2. It needs no direct term: the rigid
///   body's s/(s + a1) is one above its corner.
///
/// Undamped residues leave only what undamped modes have: b0 s^k over each block.
struct SensorModel {
  arm::Sensor sensor;
  std::vector<SensorColumn> columns;  ///< forced ones and the remainder first: `shared` of them
  Eigen::Index shared = 0;
};

/// Whether a sensor shows bending alone, to which the rigid body adds nothing at rest.
bool bends_only(arm::SensorKind kind);

struct ColumnChoices {
  bool undamped_residues = false;
  /// Blocks that begin above it have undamped residues, too: beyond the band, and most of all next
  /// to half the sampling frequency, data tell no more of them than one number.
  double undamped_above_rad_per_s = std::numeric_limits<double>::infinity();
  bool static_remainder = true;
  bool offset = true;
};

/// Columns of `sensor`, which is number `index` in the stretches' lists.
SensorModel sensor_model(const arm::Sensor& sensor, Eigen::Index index, const BlockSet& blocks,
                         std::span<const Stretch> stretches, const ColumnChoices& choices);

/// The column as a combination of the signals in `triangle` (any rows of them).
Eigen::VectorXd column_of(const SensorColumn& column, const Eigen::MatrixXd& triangle,
                          const SignalLayout& layout, const BlockSet& blocks);

/// Its derivatives to the block's own parameters: rows x 1 or 2; empty for a column without block.
Eigen::MatrixXd column_derivatives(const SensorColumn& column, const Eigen::MatrixXd& triangle,
                                   const SignalLayout& layout, const BlockSet& blocks);

}  // namespace flexarm::measured
