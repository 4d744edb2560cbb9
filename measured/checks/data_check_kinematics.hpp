#pragma once

#include "measured/checks/data_check.hpp"
#include "measured/checks/data_check_described.hpp"
#include "measured/checks/data_check_relation.hpp"
#include "measured/checks/data_check_signal.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace flexarm::measured {

/// What channels are compared by: the longest even stretch of a record.
struct Comparison {
  std::span<const CheckedSignal> signals;  ///< the torque first
  const Transforms& transforms;
  std::vector<bool> usable;  ///< a signal whose own values are in order
  const DataCheckOptions& options;
  /// By what the described arm reads; empty where no arm is described.
  std::span<const DescribedRelation> described = {};

  /// The first usable signal of a kind.
  std::optional<std::size_t> find(arm::SensorKind kind) const;
  /// The relations to the described arm that hold between usable signals, over two blocks or more.
  std::vector<DescribedRelation> described_and_held() const;
};

/// x = y for any arm: hub_velocity = d/dt hub_angle, tip_acceleration = d^2/dt^2 tip_displacement.
struct Identity {
  Quantity x;
  Quantity y;
};

/// The identities between the channels there are.
std::vector<Identity> identities_of(const Comparison& comparison);

/// One term of tip_displacement = gain hub_angle + gain tip_deflection.
struct TipTerm {
  std::size_t signal = 0;
  double gain = 0.0;
  double score = 0.0;  ///< gain over its standard error
};

/// The tip's displacement in its parts, by least squares over the record: (hub radius + length)
/// hub_angle + 1 tip_deflection.
struct TipFit {
  std::size_t displacement = 0;
  TipTerm angle;
  TipTerm deflection;
};

/// Empty unless there are all three.
std::optional<TipFit> fit_tip(const Comparison& comparison);

/// One gain for all frequencies, and one sign.
bool holds(const GainFit& fit);

/// The upper frequency of what counts as rigid motion: far below the first frequency of the
/// clamped arm, yet high enough to hold a line of the record.
double rigid_band_Hz(const Transforms& transforms);
/// Whether the record is long enough for that.
bool shows_rigid_motion(const Transforms& transforms);

/// What a gain off by 10^log10_factor says of a unit ("degrees for radians", "a factor of 1e3");
/// empty for one that is within 10 % of 1, or of none of the usual factors.
std::string unit_slip(double log10_factor);

/// log10 of how far a standard deviation lies outside of what a sensor on a laboratory arm shows; 0
/// inside.
double implausibility(const CheckedSignal& signal, double deviation);

/// Two channels whose columns are exchanged: an identity that does not hold, and that holds with
/// gain 1 when they are exchanged; or two that are each implausible and would both be plausible.
std::vector<DataFinding> check_swaps(const Comparison& comparison);

}  // namespace flexarm::measured
