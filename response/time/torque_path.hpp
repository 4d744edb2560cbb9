#pragma once

#include "response/arm_parts.hpp"
#include "response/time/simulation.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace flexarm::response {

/// A torque that goes straight from `begin_N_m` to `end_N_m` over a part of a sample interval.
struct TorquePiece {
  enum class Length { whole, before_delay, after_delay, other };
  double begin = 0.0;  ///< in samples, from 0
  double end = 1.0;    ///< to 1
  double begin_N_m = 0.0;
  double end_N_m = 0.0;
  Length length = Length::whole;  ///< the same from sample to sample, unless `other`
};

/// The commanded torque behind delay and maps, exactly: straight pieces between the breaks that the
/// delayed samples and the bends of the maps make. The lag comes later. Before the first sample the
/// command is zero.
class TorquePath {
 public:
  using Pieces = std::vector<TorquePiece>;

  /// `torque_N_m` must outlive the object.
  TorquePath(const Actuator& actuator, std::span<const double> torque_N_m, double sample_time_s,
             TorqueHold hold);

  /// The pieces from sample `k` to the next, in order, none empty. Behind the last sample the
  /// command stays as it is.
  void pieces(std::size_t k, Pieces& pieces) const;

  /// The delay is whole samples and this fraction of one.
  double delay_fraction() const { return delay_fraction_; }

 private:
  void add(TorquePiece command, Pieces& pieces) const;

  Actuator actuator_;
  std::vector<double> bends_;
  std::span<const double> torque_N_m_;
  TorqueHold hold_;
  double delay_samples_ = 0.0;
  double delay_fraction_ = 0.0;
};

}  // namespace flexarm::response
