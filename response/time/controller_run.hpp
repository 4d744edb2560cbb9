#pragma once

#include "arm/controller.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace flexarm::response {

/// Numbers of the controller's state that a start may give: the integral torque I [N m] of a PID
/// before its first sample, or x of a state space.
std::size_t controller_states(const arm::Controller& controller);

/// A controller at work, sample by sample of its own period (the equations of arm/controller.hpp).
class ControllerRun {
 public:
  /// `controller` must outlive the object. `state` has `controller_states` entries; empty: zeros.
  /// Throws InputError for another number of them, or a value that is not finite.
  ControllerRun(const arm::Controller& controller, double period_s, std::span<const double> state);

  /// The torque [N m] of the next sample; `readings` are those of its sensors, in their order.
  double command(double reference, std::span<const double> readings);

 private:
  double of(const arm::PidController& law, double reference, std::span<const double> readings);
  double of(const arm::StateSpaceController& law, double reference,
            std::span<const double> readings);
  double limited(double torque_N_m) const;

  const arm::Controller* controller_;
  double period_s_;
  std::vector<double> state_;
  std::vector<double> next_;
  bool is_first_ = true;
  double last_ = 0.0;  // v of a PID, at the last sample
};

}  // namespace flexarm::response
