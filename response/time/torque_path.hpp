#pragma once

#include "response/arm_parts.hpp"
#include "response/time/sample_delay.hpp"
#include "response/time/simulation.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace flexarm::response {

/// A torque that goes straight from `begin_N_m` to `end_N_m` over a part of a sample interval.
struct TorquePiece {
  double begin = 0.0;  ///< in samples, from 0
  double end = 1.0;    ///< to 1
  double begin_N_m = 0.0;
  double end_N_m = 0.0;
  std::size_t part = 0;       ///< of the interval, between two of TorquePath::edges
  bool is_whole_part = true;  ///< its length then comes again from sample to sample
};

/// The commanded torque behind delay and maps, exactly: straight pieces between the breaks that the
/// delayed samples, the bends of the maps and `cuts` make. The lag comes later. Before the first
/// sample the command is zero, and behind the last it stays as it is: with a delay below 0 the
/// torque leads its samples.
class TorquePath {
 public:
  using Pieces = std::vector<TorquePiece>;

  /// `torque_N_m` must outlive the object. A piece ends at each of `cuts`, fractions of every
  /// sample interval above 0 and below 1.
  TorquePath(const Actuator& actuator, std::span<const double> torque_N_m, double sample_time_s,
             TorqueHold hold, std::span<const double> cuts = {});

  /// The pieces from sample `k` to the next, in order, none empty; `k` may be before the first.
  void pieces(std::ptrdiff_t k, Pieces& pieces) const;

  /// The torques [N m] of the parts of the sample intervals from `first` on, up to that of the last
  /// sample: a column an interval, and for each part torques_of_part() rows, the torque in it or
  /// those at its beginning and its end. Empty where a map bends within a part.
  std::optional<Eigen::MatrixXd> whole_parts(std::ptrdiff_t first) const;
  int torques_of_part() const { return hold_ == TorqueHold::zero ? 1 : 2; }

  /// Where every sample interval is divided, ascending from 0 to 1: at the delayed samples and at
  /// the cuts.
  const std::vector<double>& edges() const { return edges_; }
  /// The part of the interval that begins at a cut, or at 0.
  std::size_t part_from(double cut) const;

 private:
  /// The sample whose command acts in a part of the interval behind sample `k`, the last one at
  /// most; below 0 before that of the first.
  double acting_sample(std::ptrdiff_t k, std::size_t part) const;
  /// whole_parts of a torque that is held.
  Eigen::MatrixXd held_parts(std::ptrdiff_t first) const;
  /// The command in a part of the interval behind sample `k`, delayed and not yet mapped.
  TorquePiece command(std::ptrdiff_t k, std::size_t part) const;
  void add(const TorquePiece& command, Pieces& pieces) const;

  Actuator actuator_;
  std::vector<double> bends_;
  std::span<const double> torque_N_m_;
  TorqueHold hold_;
  SampleDelay delay_;
  std::vector<double> edges_;
};

}  // namespace flexarm::response
