#pragma once

#include "response/time/sensor_readings.hpp"
#include "response/time/step_plan.hpp"
#include "response/time/time_stepper.hpp"

#include <optional>
#include <span>
#include <vector>

namespace flexarm::response {

/// The torque offset + amplitude sin(2 pi f t), which has gone on for ever.
struct SineDrive {
  double amplitude_N_m = 0.0;
  double offset_N_m = 0.0;
  double frequency_Hz = 1.0;
};

/// The same arm with two more states behind the others, C and S with C' = -omega S, S' = omega C,
/// and the torque `amplitude` S/`scale` added to that of the actuator: a sine that is none of
/// samples, so that a linear arm is stepped exactly whatever the step.
ModalDynamics with_sine(const ModalDynamics& arm, const SineDrive& drive, double scale);

/// An arm that a sine drives, period by period, read at whole fractions of the period.
///
/// A delay turns the sine's phase; gain, lag, laws of hub torque and forces along the beam act as
/// in `simulate`; a law that depends on time is refused by name. Where the maps of the actuator
/// bend within the command it is a sine through `samples_per_period` points, linear between them,
/// clipped exactly; its part at f is amplitude sinc^2(1/n), and its harmonics n m +- 1 are 1/(n m
/// +- 1)^2 of that.
class DrivenArm {
 public:
  /// `arm` and `parts` must outlive the object. `samples_per_period` above 2.
  DrivenArm(const ModalDynamics& arm, const arm::ModalModel& model, const ArmParts& parts,
            std::span<const arm::Sensor> sensors, const SineDrive& drive, int samples_per_period,
            int substeps);
  DrivenArm(const DrivenArm&) = delete;
  DrivenArm& operator=(const DrivenArm&) = delete;

  /// The states of `arm` at the beginning of a period; `held` as in TimeStepper::put.
  void put(const Eigen::VectorXd& state, bool held);
  /// A period from where it is. Adds a reading of each sensor at the period's beginning and at each
  /// fraction, but not at its end, to `readings`, unless it is null.
  /// Throws InputError where the motion is too large for a number.
  void drive_period(std::vector<std::vector<double>>* readings);

  Eigen::VectorXd state() const { return stepper_->state().head(size_); }
  bool is_held() const { return stepper_->motion() == HubMotion::held; }
  /// What friction, drag or ripple make of a period's end is not linear in its beginning.
  bool is_linear() const { return is_linear_; }
  /// Coefficient of the sine at f in the command.
  double sine_N_m() const { return sine_N_m_; }
  /// What the sine's torque alone does to the states in 1/omega, their scale.
  double state_scale() const { return scale_; }
  const SimulationSummary& summary() const { return stepper_->summary(); }

 private:
  Eigen::Index size_;
  double scale_;
  double sine_N_m_;
  bool is_linear_;
  double phase_rad_ = 0.0;  // of the sine behind the delay, at the beginning of a period
  double sample_time_s_;
  ModalDynamics arm_;
  AddedForces forces_;
  std::vector<TorquePath::Pieces> pieces_;  // of a period
  std::optional<StepPlan> plan_;
  std::optional<TimeStepper> stepper_;
  SensorReadings readings_;
};

/// Whether the actuator's maps bend within the command.
bool clips(const Actuator& actuator, const SineDrive& drive);

}  // namespace flexarm::response
