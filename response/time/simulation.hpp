#pragma once

#include "arm/formulation.hpp"
#include "arm/sensor.hpp"
#include "response/arm_parts.hpp"
#include "response/time/propagator.hpp"

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace flexarm::response {

/// What the torque does from one sample to the next: stay, or go straight to the next value.
enum class TorqueHold { zero, first };

struct SimulationOptions {
  double sample_time_s = 1e-3;
  TorqueHold hold = TorqueHold::zero;
  /// Inner steps a sample, at least; more are taken where the solution asks for them.
  int substeps = 0;
  bool energy = true;  ///< form the energy balance; costs several times the simulation itself
  /// Nonlinear forces of an inner step are iterated until one iteration changes none by more than
  /// this times the largest of them, or the next would change none by a tenth of that (StepSolver).
  double force_tolerance = 1e-13;
  int most_iterations = 30;  ///< for those forces; an inner step that needs more is halved
  /// A run that halves more steps by power series than this, and than the samples it has passed,
  /// throws std::runtime_error: friction that changes within nearly every one would cost minutes.
  std::int64_t most_halved_steps = std::numeric_limits<std::int64_t>::max();
  /// So does a run that takes more inner steps than this for each sample it has passed, and than
  /// 50 000: where a mode is stiff, the halves in which friction may change can be without end.
  double most_steps_per_sample = std::numeric_limits<double>::infinity();
  /// Where forces vary inner steps resolve the fastest mode; else `substeps` decide, which is
  /// enough for fits.
  bool resolve_every_mode = true;
  Precision precision = Precision::extended;  ///< of e^(A dt); `working` is made ten times as fast
};

/// Where the energy went, from the first sample to the last [J]:
/// work_in - kinetic - potential - dissipated() = residual(), 0 but for errors.
struct EnergyBalance {
  double work_in_J = 0.0;       ///< of the torque that reaches the hub, bias and ripple included
  double kinetic_J = 0.0;       ///< at the end
  double potential_J = 0.0;     ///< at the end
  double viscous_J = 0.0;       ///< lost in the hub's viscous friction
  double material_air_J = 0.0;  ///< lost in the other linear damping
  double dry_friction_J = 0.0;  ///< lost in Coulomb and Stribeck friction
  double drag_J = 0.0;          ///< lost in quadratic drag
  double largest_residual_J = 0.0;  ///< of the balances at the samples, in size
  double lowest_loss_J = 0.0;  ///< most negative loss of one kind between samples; below 0 by more
                               ///< than rounding: energy was created

  double dissipated_J() const;
  double residual_J() const;
};

/// What the sampling shows of the highest mode kept. The simulation itself has no step error that
/// grows with it: inner steps are chosen, and the linear part is exact.
enum class Sampling {
  fine,    ///< kFineSamplesPerPeriod or more
  coarse,  ///< fewer: the largest sample of a period may lie 1 - cos(pi/10) = 5 % below its peak
  aliased  ///< 2 or fewer: its motion shows at a frequency that is not its own (Nyquist)
};
inline constexpr double kFineSamplesPerPeriod = 10.0;
inline constexpr double kAliasedSamplesPerPeriod = 2.0;

struct SimulationSummary {
  bool completed = true;          ///< false: cancelled, everything below is up to there
  std::int64_t steps = 0;         ///< from sample to sample
  int substeps = 1;               ///< planned inner steps a sample
  std::int64_t inner_steps = 0;   ///< taken, those cut short at events included
  std::int64_t reversals = 0;     ///< the hub turned without a rest
  std::int64_t stops = 0;         ///< the hub came to rest in friction
  std::int64_t breakaways = 0;    ///< the hub left its rest
  std::int64_t forced_rests = 0;  ///< inner steps at rest because events piled up at one instant
  double stick_time_s = 0.0;
  int most_iterations = 0;        ///< of the nonlinear solve of an inner step
  std::int64_t halved_steps = 0;  ///< inner steps halved: no convergence, or friction fell too much
  std::vector<double> event_times_s;  ///< of the first kRecordedEvents reversals, stops, breakaways
  double samples_per_period = 0.0;    ///< of the highest mode kept; infinite without vibration
  Sampling sampling = Sampling::fine;
};
inline constexpr std::size_t kRecordedEvents = 100'000;

/// Sampled time response. At a sample where the torque jumps, values are those just after it.
struct Simulation {
  std::vector<double> time_s;
  std::vector<double> commanded_torque_N_m;
  std::vector<double> hub_torque_N_m;  ///< that reaches the hub: bias and ripple included, friction
                                       ///< not
  std::vector<std::vector<double>> channels;  ///< one a sensor, in its unit: what it reads
  EnergyBalance energy;                       ///< zeros unless asked for
  SimulationSummary summary;
};

/// Called now and then with the fraction done; false cancels.
using SimulationProgress = std::function<bool(double fraction)>;

/// Time response of an arm, at rest at the first sample, to the commanded torque's samples.
///
///     q_i'' + sum_j D_ij q_j' + omega_i^2 q_i = hub_slope_i (T - F)/I_T + force_i/I_T
///
/// with T = torque after the actuator, F = dry friction of the hub, and
/// force_i = int force(v) phi_i dx over the stations of response/time/beam_forces.hpp. Derived
/// sensors (velocity, acceleration) come from the state and the equations of motion, not from
/// differences. A delayed sensor is read at the delayed instants themselves, not between samples;
/// it reads its offset alone until the first sample reaches it.
///
/// Torque that is held or linear between samples, delays, lags, clipping and constant friction are
/// stepped exactly; reversals, stops and breakaways of the hub are located on the exact solution.
/// Forces that vary with the state are solved implicitly, of order 4 in the inner step.
///
/// `model` has sensor values for each of `sensors` and, where forces act along the beam,
/// displacements at `beam_stations(length).stations_m`. Throws InputError for torque that is empty
/// or not finite, a sample time that is not above 0, negative parameters, a model without the
/// values needed; for a reading or an energy that overflows; and where friction, drag or ripple
/// would need inner steps more than kMostSubsteps times shorter than samples.
Simulation simulate(const arm::ModalModel& model, const ArmParts& parts,
                    std::span<const arm::Sensor> sensors, std::span<const double> torque_N_m,
                    const SimulationOptions& options = {}, const SimulationProgress& progress = {});
inline constexpr int kMostSubsteps = 100'000;

}  // namespace flexarm::response
