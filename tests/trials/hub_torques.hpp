#pragma once

#include "tests/trials/world.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace flexarm::trials {

/// Torques on the hub that depend on its motion or on time alone, dry friction excepted: ripple,
/// and of the causes outside the vocabulary hysteresis, hardening spring and disturbance.
class HubTorques {
 public:
  /// `seed` is that of the run's disturbance, over `duration_s`.
  HubTorques(const World& world, double duration_s, std::uint64_t seed);

  bool none() const { return none_; }
  /// Mean over a step around `time_s`, in which the hub turns by `turn_rad` about `angle_rad`.
  double mean_N_m(double time_s, double angle_rad, double turn_rad) const;
  /// Takes note that the hub has turned.
  void turned(double turn_rad);

 private:
  struct Line {
    double amplitude_N_m;
    double omega_rad_per_s;
    double phase_rad;
  };

  double hysteresis_after(double turn_rad) const;

  bool none_ = true;
  double ripple_N_m_ = 0.0;
  double cycles_ = 0.0;
  double phase_rad_ = 0.0;
  double hardening_N_m_per_rad3_ = 0.0;
  double hysteresis_N_m_ = 0.0;
  double hysteresis_angle_rad_ = 1.0;
  double held_N_m_ = 0.0;  // of the hysteresis
  std::vector<Line> disturbance_;
};

/// The hub's speed over a step, of which the end falls by `slope` times the friction.
struct FrictionStep {
  double start_rad_per_s = 0.0;
  double free_end_rad_per_s = 0.0;  ///< without friction
  double slope_rad_per_s_per_N_m = 0.0;
};

/// A hub slower than this rests: rounding of a speed that friction has set to zero.
inline constexpr double kRest_rad_per_s = 1e-10;

/// Dry friction: Coulomb's and Stribeck's, by the size of the hub's speed.
class DryFriction {
 public:
  explicit DryFriction(const arm::Arm& arm);

  bool none() const { return coulomb_N_m_ == 0.0 && torque_N_m_ == 0.0 && static_N_m_ == 0.0; }
  double size_N_m(double speed_rad_per_s) const;
  /// Mean of the friction over a step: what slips, up to the instant at which the hub turns around
  /// or comes to rest, and there what the rest takes where that is no more than the size at rest.
  double mean_N_m(const FrictionStep& step) const;

 private:
  double slipping_N_m(double sign, const FrictionStep& step) const;

  double coulomb_N_m_;
  double torque_N_m_;
  double static_N_m_;
  double velocity_rad_per_s_;
};

}  // namespace flexarm::trials
