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
  enum class Kind { forced, remainder, jump, free, offset };
  Kind kind = Kind::forced;
  std::size_t block = 0;
  int power = 0;
  std::size_t stretch = 0;  ///< that has this column alone; free and offset only
  /// Of a coefficient that is 0 give or take a deviation before there are data: the noise's
  /// deviation over it. 0: nothing is known beforehand.
  double tightness = 0.0;

  bool is_of_block() const { return kind == Kind::forced || kind == Kind::free; }
  /// Of all stretches alike.
  bool is_common() const { return kind != Kind::free && kind != Kind::offset; }

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
/// An accelerometer beside a torque that jumps at the samples shows, just after each jump, what
/// modes far above the band answer to it at once: b0 times the jump, of a mode however fast, though
/// to a torque without jumps it answers by b0 s^2/omega^2 alone. That column is no part of G.
///
/// Undamped residues leave only what undamped modes have: b0 s^k over each block. Held blocks have
/// nothing else, and no free motion: it has died away.
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
  bool jumps = true;  ///< the torque is held from sample to sample
  /// Some torque is not zero: a free decay has neither forced columns nor a remainder.
  bool forced = true;
  /// `SensorColumn::tightness` of held blocks: sensors x held.
  Eigen::MatrixXd held_tightness = {};
};

/// Columns of `sensor`, which is number `index` in the stretches' lists.
SensorModel sensor_model(const arm::Sensor& sensor, Eigen::Index index, const BlockSet& blocks,
                         std::span<const Stretch> stretches, const ColumnChoices& choices);

/// The column as a combination of the signals in `triangle` (any rows of them).
Eigen::VectorXd column_of(const SensorColumn& column, const Eigen::MatrixXd& triangle,
                          const SignalLayout& layout, const BlockSet& blocks);

/// Its derivatives to the block's own parameters: rows x 1 or 2; empty for a column without block,
/// or of one that is held.
Eigen::MatrixXd column_derivatives(const SensorColumn& column, const Eigen::MatrixXd& triangle,
                                   const SignalLayout& layout, const BlockSet& blocks);

}  // namespace flexarm::measured
