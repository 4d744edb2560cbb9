#pragma once

#include "arm/sensor.hpp"
#include "tests/trials/true_arm.hpp"

namespace flexarm::trials {

/// The base of the motor, which turns as the torque reacts on it.
class MovedBase {
 public:
  explicit MovedBase(const TrueArm::TurningBase& of) : of_(of) {}

  /// Under a torque that holds for the step; average acceleration.
  void step(double torque_N_m, double step_s);
  /// What a sensor of this kind reads of it: angle or speed at the hub, else 0.
  double motion(arm::SensorKind kind) const;

 private:
  TrueArm::TurningBase of_;
  double angle_rad_ = 0.0;
  double speed_rad_per_s_ = 0.0;
};

/// A payload that hangs on the tip by friction.
class SlippingPayload {
 public:
  explicit SlippingPayload(const TrueArm::SlippingMass& of) : of_(of) {}

  double force_N() const { return force_N_; }  ///< on the tip
  /// One step of its mass, at the end of which the tip is there.
  void step(double tip_m, double tip_speed_m_per_s, double step_s);

 private:
  TrueArm::SlippingMass of_;
  double place_m_ = 0.0;
  double speed_m_per_s_ = 0.0;
  double slipped_m_ = 0.0;
  double force_N_ = 0.0;
};

}  // namespace flexarm::trials
