#pragma once

#include "arm/deadline.hpp"
#include "arm/formulation.hpp"
#include "response/time/added_forces.hpp"
#include "response/time/closed_loop.hpp"
#include "response/time/energy_ledger.hpp"
#include "response/time/kalman_filter.hpp"
#include "response/time/lifted_arm.hpp"
#include "response/time/modal_dynamics.hpp"
#include "response/time/reading_times.hpp"
#include "response/time/simulation.hpp"
#include "response/time/step_plan.hpp"
#include "response/time/turning_blocks.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace flexarm::response {

class TimeStepper;
struct ReadingInstant;

/// What a Kalman filter makes of a run.
struct FilteredRun {
  /// Measured minus predicted from the samples before, a row a sample and a column a sensor; 0 for
  /// readings that are missing.
  Eigen::MatrixXd innovations;
  // The state at each sample, its own readings included.
  std::vector<double> disturbance_N_m = {};
  std::vector<double> hub_velocity_rad_per_s = {};
};

/// What moves an arm that nobody recorded, changing at the samples.
struct ProcessNoise {
  double disturbance_N_m = 0.0;  ///< stationary standard deviation of ArmParts::disturbance
  /// Standard deviation of a white force on each flexible mode, in units of a torque on a hub that
  /// moves with slope 1 in that mode, over a sample. Such are the forces on the modes by a force
  /// along a uniform beam that is white in time and place.
  double modal_force_N_m = 0.0;
};

/// Where free simulations begin in a filtered run, and how far ahead they are compared with it.
struct StartsAhead {
  Eigen::Index stride = 1;                  ///< from the first sample on, every so many of them
  std::vector<Eigen::Index> horizons = {};  ///< samples after the start, ascending, 1 or more
};

/// Measured minus predicted: of each horizon and each start one a sensor, not a number for readings
/// that are missing.
using ErrorsAhead = std::vector<std::vector<Eigen::VectorXd>>;

/// An arm with all that a torque does not change, for any number of runs: `simulate` is one of
/// them, fits make them by the thousand.
class ArmSimulator {
 public:
  /// Throws InputError as `simulate` does for parts that do not fit together.
  ArmSimulator(const arm::ModalModel& model, const ArmParts& parts,
               std::span<const arm::Sensor> sensors, const SimulationOptions& options);
  ArmSimulator(const ArmSimulator&) = delete;
  ArmSimulator& operator=(const ArmSimulator&) = delete;

  /// Entries of the state, ModalDynamics::size().
  Eigen::Index states() const { return arm_.size(); }
  /// Two columns: the hub turned by 1 rad, and turning at 1 rad/s, in the first mode alone: that of
  /// the rigid arm where nothing holds the hub.
  Eigen::MatrixXd rigid_states() const;
  /// A basis of what an unknown initial state is made of: displacement and velocity of the modes
  /// below the Nyquist frequency, of the first two modes at least, and all states that are not of
  /// modes (lags, states of laws). Samples do not determine the amplitudes of modes above it, and
  /// dry friction would reverse with each of their periods. N rows, a column a state.
  Eigen::MatrixXd resolved_states() const;
  /// A basis of those of them with the hub at rest at angle 0: two columns less.
  Eigen::MatrixXd resolved_states_of_resting_hub() const;
  /// No friction, and no force that varies with the state: responses add up.
  bool is_linear() const { return plan_.is_linear(); }

  /// From rest. Throws InputError for a torque that `simulate` refuses.
  Simulation run(std::span<const double> torque_N_m, const SimulationProgress& progress = {}) const;

  /// Readings alone, a row a sample and a column a sensor, from the state `initial` (at rest where
  /// it is empty). Where a sensor is delayed `initial` is the state as many samples before the
  /// first as the longest delay needs, at most as many as there are: what a delayed sensor shows
  /// first is then motion too, without commanded torque. At rest it shows nothing before the first
  /// sample. Throws InputError for a torque that `simulate` refuses, and for readings that are too
  /// large for a number; arm::Cancelled where samples are stepped through after the deadline.
  /// Concurrent calls are safe.
  Eigen::MatrixXd readings(std::span<const double> torque_N_m, const Eigen::VectorXd& initial = {},
                           const arm::Deadline& deadline = {}) const;

  /// In closed loop, from rest, as `closed_loop_readings`; the controller's torque is the commanded
  /// one. Throws InputError as that does.
  Simulation run(const ClosedLoop& loop, const SimulationProgress& progress = {}) const;

  /// Readings and torque in closed loop, from the state `initial` (at rest where it is empty). They
  /// are those of `readings` with that torque, but for rounding. Throws InputError for a controller
  /// that is not valid, whose period is no whole multiple of the sample time, or that reads another
  /// sensor than this object's; for a first-order hold, a reference that is empty or not finite,
  /// and for torques and readings that are too large for a number: of a loop that is unstable;
  /// arm::Cancelled after the deadline. Concurrent calls are safe.
  ClosedLoopReadings closed_loop_readings(const ClosedLoop& loop,
                                          const Eigen::VectorXd& initial = {},
                                          const arm::Deadline& deadline = {}) const;

  /// Readings of the arm left alone from each unit state, the samples of all sensors one after the
  /// other in a column (as the columns above), a column a state. Without friction and forces that
  /// vary.
  Eigen::MatrixXd free_readings(std::size_t samples) const;

  /// How many samples before the first the initial state of a run of so many samples is.
  std::ptrdiff_t lead(std::size_t samples) const;

  /// The filter for the arm that turns without friction and forces that vary: readings with white
  /// noise of these deviations, a column a sensor, and what `noise` says. A disturbance of the hub
  /// torque (ArmParts::disturbance) is required.
  /// Its state is the arm's and, behind that, the readings of delayed sensors that are taken but
  /// not measured yet. Throws InputError for more than `kMostPendingReadings` of them.
  SampledSystem sampled(const ProcessNoise& noise, const Eigen::VectorXd& deviations) const;

  /// The arm follows the `measured` readings (a row a sample and a column a sensor, not a number
  /// where one is missing: the state then moves by the others of the sample alone) by `gains`, at
  /// rest before the first sample, and goes from sample to sample as in `readings`: friction and
  /// forces act on the filtered motion. A hub that friction holds stays held until the torque,
  /// disturbance included, breaks it loose.
  FilteredRun filtered(std::span<const double> torque_N_m, const Eigen::MatrixXd& measured,
                       const FilterGains& gains) const;

  /// Errors of predictions from the samples of `filtered`: at each of `starts` that has the
  /// furthest horizon in the run, the arm goes on from the filter's state without further readings.
  /// The disturbance of the hub torque decays. Where `starts` has no horizon there is nothing.
  /// Throws InputError as `filtered`, and for readings that are too large for a number.
  ErrorsAhead errors_ahead(std::span<const double> torque_N_m, const Eigen::MatrixXd& measured,
                           const FilterGains& gains, const StartsAhead& starts) const;

 private:
  class Commands;
  struct FilteredSample;

  /// The arm follows `measured` as in `filtered`; calls at_sample(FilteredSample) at each sample.
  template <class AtSample>
  void follow(Commands& commands, const Eigen::MatrixXd& measured, const FilterGains& gains,
              AtSample at_sample) const;

  /// `filtered` of a linear arm whose sensors have no delay, without missing readings.
  /// `torques` are TorquePath::whole_parts.
  FilteredRun filtered_in_blocks(const Eigen::MatrixXd& torques, const Eigen::MatrixXd& measured,
                                 const FilterGains& gains) const;

  Simulation run(Commands& commands, const SimulationProgress& progress) const;
  /// With the `torques` of an open loop (TorquePath::whole_parts from first_interval on) by
  /// `blocks_` where the hub surely turns; step by step where they are null.
  Eigen::MatrixXd readings(Commands& commands, const Eigen::VectorXd& initial,
                           const Eigen::MatrixXd* torques, const arm::Deadline& deadline) const;
  /// The sample interval at whose beginning the state is `initial`.
  std::ptrdiff_t first_interval(std::size_t samples, const Eigen::VectorXd& initial) const;
  /// The number of modes of resolved_states; they are the first ones.
  Eigen::Index resolved_modes() const;
  /// What a sensor reads before the first sample reaches it, a row a sample and a column a sensor.
  Eigen::MatrixXd unread(std::size_t samples) const;
  /// Of the state over that part of a sample interval, N x N.
  Eigen::MatrixXd transition(double fraction) const;
  /// ... from sample to sample, where a white disturbance begins anew.
  Eigen::MatrixXd sample_transition() const;
  /// No disturbance, where it is white: that of this sample is not known yet.
  void forget_white_disturbance(TimeStepper& stepper, const ReadingInstant& now) const;
  /// What is read in a sample interval (ReadingTimes), of the state at its beginning: p x N.
  Eigen::MatrixXd linear_readings() const;

  ArmParts parts_;
  std::vector<arm::Sensor> sensors_;
  SimulationOptions options_;
  ModalDynamics arm_;
  AddedForces forces_;
  std::optional<EnergyLedger> ledger_;  ///< as it is before a run
  ReadingTimes times_;
  StepPlan plan_;
  // Without a ledger.
  IntervalMap interval_;                 ///< of an arm that has one of these
  std::optional<LiftedArm> lifted_;      ///< of a linear arm
  std::optional<TurningBlocks> blocks_;  ///< of an arm with constant friction
};

/// At so many the gain of a filter takes some ten milliseconds.
inline constexpr std::ptrdiff_t kMostPendingReadings = 60;

/// Options with which the readings of a fit are simulated: no energy balance, and a step a sample
/// where forces vary, with an error of order 4 in it; reversals and rests of the hub are located
/// exactly.
SimulationOptions options_of_fit(double sample_time_s, TorqueHold hold);

}  // namespace flexarm::response
