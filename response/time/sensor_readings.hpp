#pragma once

#include "response/time/time_stepper.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace flexarm::response {

/// What sensors read of a TimeStepper: with gain, lag and offset, before their delay.
class SensorReadings {
 public:
  /// `arm` has the systems that the stepper steps.
  SensorReadings(const ModalDynamics& arm, const ArmParts& parts,
                 std::span<const arm::Sensor> sensors);

  /// One a sensor, with that torque of the actuator. A hub that is held reads its angle and no
  /// speed to the last bit.
  const Eigen::VectorXd& read(const TimeStepper& stepper, double actuator_N_m);
  /// The same for the state `x` with the added forces `f`; `held_angle_rad` where the hub is held.
  const Eigen::VectorXd& read(const Eigen::VectorXd& x, const Eigen::VectorXd& f,
                              double actuator_N_m, std::optional<double> held_angle_rad);

 private:
  /// The readings of one system, stacked.
  struct Stack {
    explicit Stack(const LinearSystem& system);

    Eigen::MatrixXd state;
    Eigen::VectorXd actuator;
    Eigen::MatrixXd force;
  };

  Stack turning_;
  Stack held_;
  Eigen::VectorXd gain_;
  Eigen::VectorXd offset_;
  Eigen::VectorXd now_;
  Eigen::VectorXd force_;
  std::vector<Eigen::Index> hub_angles_;  // sensors that stand still with the hub
  std::vector<Eigen::Index> hub_velocities_;
};

}  // namespace flexarm::response
