#pragma once

#include "tests/trials/true_arm.hpp"

#include <memory>
#include <vector>

namespace flexarm::trials {

/// All torques on the hub but dry friction, of one run.
class HubTorques {
 public:
  HubTorques(const TrueArm& arm, const RunConditions& run);

  bool none() const { return torques_.empty(); }
  double mean_N_m(const HubStep& step) const;
  /// Takes note of a step that has been made.
  void made(const HubStep& step);

 private:
  std::vector<std::unique_ptr<HubTorque>> torques_;
};

/// The hub's speed over a step, of which the end falls by `slope` times the friction.
struct FrictionStep {
  double start_rad_per_s = 0.0;
  double free_end_rad_per_s = 0.0;  ///< without friction
  double slope_rad_per_s_per_N_m = 0.0;
};

/// A hub slower than this rests: rounding of a speed that friction has set to zero.
inline constexpr double kRest_rad_per_s = 1e-10;

/// Dry friction by the size of the hub's speed.
class DryFriction {
 public:
  explicit DryFriction(const TrueArm& arm) : sizes_(arm.dry_frictions) {}

  bool none() const { return sizes_.empty(); }
  double size_N_m(double speed_rad_per_s) const;
  /// Mean of the friction over a step: what slips, up to the instant at which the hub turns around
  /// or comes to rest, and there what the rest takes where that is no more than the size at rest.
  double mean_N_m(const FrictionStep& step) const;

 private:
  double slipping_N_m(double sign, const FrictionStep& step) const;

  std::vector<FrictionSize> sizes_;
};

}  // namespace flexarm::trials
