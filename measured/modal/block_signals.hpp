#pragma once

#include "measured/files/frequency_record.hpp"
#include "measured/files/measurement.hpp"
#include "measured/files/time_record.hpp"
#include "measured/modal/second_order_block.hpp"

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace flexarm::measured {

/// Columns of a stretch's rows: of each block that moves q, q', p, p' of
/// measured/modal/held_response.hpp forced by the torque; the same free, from q' = 1 at the first
/// sample, where the stretch begins in motion; of each held block q, q' alone, forced; the torque
/// u; the static remainder; 1; then what the stretch's sensors read.
struct SignalLayout {
  Eigen::Index moving = 0;
  Eigen::Index held = 0;
  bool free = false;

  static SignalLayout of(const BlockSet& blocks, bool free) {
    return {static_cast<Eigen::Index>(blocks.free_blocks()), static_cast<Eigen::Index>(blocks.held),
            free};
  }
  Eigen::Index block(std::size_t m, bool of_free) const {
    const auto at = static_cast<Eigen::Index>(m);
    if (at >= moving) return first_held() + 2 * (at - moving);
    return 4 * (at + (of_free ? moving : 0));
  }
  Eigen::Index first_held() const { return 4 * moving * (free ? 2 : 1); }
  Eigen::Index torque() const { return first_held() + 2 * held; }
  Eigen::Index remainder() const { return torque() + 1; }
  Eigen::Index one() const { return torque() + 2; }
  Eigen::Index first_reading() const { return torque() + 3; }
};

using RowVisitor = std::function<void(const Eigen::Ref<const Eigen::MatrixXd>& rows)>;

/// Rows of data with noise of their own: a run in time, or one sensor's frequency response.
struct Stretch {
  std::vector<Eigen::Index> sensors;  ///< whose readings the last columns are
  /// What a residual of each of them counts, against those of the same sensor in other stretches;
  /// empty: 1.
  std::vector<double> weights = {};
  bool begins_in_motion = false;
  bool in_time = true;
  Eigen::Index rows = 0;
  double duration_s = 0.0;  ///< 0 for a frequency response
  /// Calls the visitor with the stretch's rows in order, some hundreds at a time: r x columns.
  std::function<void(const BlockSet&, const RowVisitor&)> visit;

  double weight(Eigen::Index reading) const {
    return weights.empty() ? 1.0 : weights[static_cast<std::size_t>(reading)];
  }
  SignalLayout layout(const BlockSet& blocks) const {
    return SignalLayout::of(blocks, begins_in_motion);
  }
};

/// The first `samples` samples of a record, which must outlive the result. The static remainder is
/// what modes far above the band, whose transients die within a period, show at the samples: the
/// torque before the jump (zero hold), the torque itself (first hold).
Stretch time_stretch(const TimeRecord& record, std::vector<Eigen::Index> sensors, TorqueHold hold,
                     InitialState initial, std::size_t samples);

/// One sensor's response, each row over `deviation` (of real and imaginary part) of its frequency:
/// real parts and imaginary parts in turn. The static remainder is (j omega)^k, k the sensor's
/// derivatives. `channel` must outlive the result; frequency 0 and lines of infinite deviation are
/// left out.
Stretch frequency_stretch(const FrequencyChannel& channel, Eigen::Index sensor,
                          const std::vector<double>& deviation);

/// The upper triangular factor R of the stretch's rows, columns as the rows': rows = Q R, whatever
/// their number. Householder, chunk by chunk: no digits are lost to squares.
Eigen::MatrixXd triangle(const Stretch& stretch, const BlockSet& blocks);
/// The same of each stretch.
std::vector<Eigen::MatrixXd> triangles(std::span<const Stretch> stretches, const BlockSet& blocks);

}  // namespace flexarm::measured
