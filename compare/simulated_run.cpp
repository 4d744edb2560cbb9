#include "compare/simulated_run.hpp"

#include "compare/initial_state.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <variant>
#include <vector>

namespace flexarm::compare {

using Eigen::Index;

namespace {

/// The initial states that are possible: `known` plus any combination of the columns of `unknown`.
struct InitialStates {
  Eigen::VectorXd known;    ///< N, of ArmSimulator
  Eigen::MatrixXd unknown;  ///< N x k
};

/// Readings of a run from the most likely of these states, `from_known` being those from the known
/// part alone: a row a sample and a column a sensor. With forces that are not linear by
/// Gauss-Newton steps, with the linear arm's derivatives.
Eigen::MatrixXd from_likely_state(const response::ArmSimulator& simulation,
                                  const std::vector<double>& torque_N_m,
                                  const InitialStates& initial, const Eigen::MatrixXd& from_known,
                                  const Eigen::VectorXd& measured,
                                  const Eigen::VectorXd& deviations,
                                  const arm::Deadline& deadline) {
  // Where friction holds the hub the linear derivatives are far off: twenty short steps and more.
  constexpr int kSteps = 30;
  constexpr double kShorter = 0.3;
  constexpr double kShortest = 0.005;
  constexpr double kNearEnough = 1e-4;  // the sum of squares falls by less than this part of it
  const Eigen::MatrixXd free = simulation.free_readings(torque_N_m.size()) * initial.unknown;
  const InitialStateEstimator estimator(free, deviations, measured);
  Eigen::VectorXd state = Eigen::VectorXd::Zero(initial.unknown.cols());
  const auto left = [&](const Eigen::MatrixXd& readings) {
    return Eigen::VectorXd(measured - readings.reshaped());
  };
  if (simulation.is_linear()) {
    const Eigen::VectorXd made =
        from_known.reshaped() + free * estimator.step(left(from_known), state);
    return made.reshaped(from_known.rows(), from_known.cols());
  }
  Eigen::MatrixXd made = from_known;
  double length = 1.0;
  for (int step = 0; step < kSteps && length > kShortest; ++step) {
    arm::require_time(deadline);
    const Eigen::VectorXd further = state + length * estimator.step(left(made), state);
    const Eigen::MatrixXd there =
        simulation.readings(torque_N_m, initial.known + initial.unknown * further, deadline);
    const double before = estimator.cost(left(made), state);
    const double after = estimator.cost(left(there), further);
    if (after < before) {
      state = further;
      made = there;
      length = std::min(1.0, length / kShorter);
      if (before - after < kNearEnough * before) break;
    } else {
      length *= kShorter;
    }
  }
  return made;
}

/// Angle and velocity of the hub at the first sample, by a parabola through the first angles that
/// are not left out, or the first velocity; 0 where no sensor shows them.
Eigen::Vector2d first_hub_motion(const measured::TimeRecord& record) {
  constexpr std::size_t kSamples = 16;
  Eigen::Vector2d motion = Eigen::Vector2d::Zero();
  if (const auto* velocity = values_of(record, arm::SensorKind::hub_velocity)) {
    motion(1) = velocity->front();
  }
  const auto angle = std::ranges::find(record.channels, arm::SensorKind::hub_angle,
                                       [](const auto& channel) { return channel.sensor.kind; });
  if (angle == record.channels.end()) return motion;
  motion(0) = angle->values.front();
  const auto n = static_cast<Index>(std::min(kSamples, angle->values.size()));
  if (n < 3) return motion;
  const Eigen::VectorXd time_s = measured::sampling_period_s(record) *
                                 Eigen::VectorXd::LinSpaced(n, 0.0, static_cast<double>(n - 1));
  Eigen::MatrixXd powers(n, 3);
  powers << Eigen::VectorXd::Ones(n), time_s, time_s.cwiseAbs2();
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(n);
  for (const std::size_t k : angle->left_out) {
    if (static_cast<Index>(k) < n) weights(static_cast<Index>(k)) = 0.0;
  }
  const Eigen::MatrixXd weighted = weights.asDiagonal() * powers;
  return weighted.householderQr()
      .solve(weights.cwiseProduct(Eigen::VectorXd::Map(angle->values.data(), n)))
      .head<2>();
}

/// The initial state of ArmSimulator::readings, `lead` samples before the first, of an arm that
/// turns as a rigid one at constant velocity: `hub` is its angle [rad] and velocity [rad/s] at the
/// first sample.
Eigen::VectorXd rigid_motion(const response::ArmSimulator& simulation,
                             const measured::TimeRecord& record, const Eigen::Vector2d& hub) {
  const auto lead = static_cast<double>(simulation.lead(record.time_s.size()));
  const double before_s = lead * measured::sampling_period_s(record);
  return simulation.rigid_states() * Eigen::Vector2d(hub(0) - before_s * hub(1), hub(1));
}

/// Torques as a log has them that is so many samples late, straight between two samples; 0 before
/// the first.
Eigen::VectorXd logged(const std::vector<double>& torque_N_m, double late_samples) {
  const double whole = std::floor(late_samples);
  const double part = late_samples - whole;
  const auto at = [&](Index k) { return k < 0 ? 0.0 : torque_N_m[static_cast<std::size_t>(k)]; };
  Eigen::VectorXd made(std::ssize(torque_N_m));
  for (Index k = 0; k < made.size(); ++k) {
    const Index later = k - static_cast<Index>(whole);
    made(k) = (1.0 - part) * at(later) + part * at(later - 1);
  }
  return made;
}

Eigen::VectorXd in_closed_loop(const response::ArmSimulator& simulation,
                               const measured::MeasuredRun& run, double logged_late_s,
                               const arm::Deadline& deadline) {
  const auto& record = std::get<measured::TimeRecord>(run.data);
  const bool is_free = run.run.initial == measured::InitialState::free;
  const Eigen::VectorXd initial =
      is_free ? rigid_motion(simulation, record, first_hub_motion(record)) : Eigen::VectorXd();
  const auto made = simulation.closed_loop_readings({*run.run.controller, record.reference.values},
                                                    initial, deadline);
  Eigen::VectorXd shown(made.readings.size() + std::ssize(made.torque_N_m));
  shown << made.readings.reshaped(),
      logged(made.torque_N_m, logged_late_s / measured::sampling_period_s(record));
  return shown;
}

}  // namespace

Eigen::VectorXd simulated_run(const response::ArmSimulator& simulation,
                              const measured::MeasuredRun& run, double logged_late_s,
                              const Eigen::VectorXd& measured, const Eigen::VectorXd& deviations,
                              const arm::Deadline& deadline) {
  if (run.run.controller) return in_closed_loop(simulation, run, logged_late_s, deadline);
  const auto& record = std::get<measured::TimeRecord>(run.data);
  const auto& torque_N_m = record.torque_N_m;
  if (run.run.initial != measured::InitialState::free) {
    return simulation.readings(torque_N_m, {}, deadline).reshaped();
  }
  const InitialStates initial{rigid_motion(simulation, record, first_hub_motion(record)),
                              simulation.resolved_states()};
  const Eigen::MatrixXd readings = simulation.readings(torque_N_m, initial.known, deadline);
  return from_likely_state(simulation, torque_N_m, initial, readings, measured, deviations,
                           deadline)
      .reshaped();
}

Eigen::VectorXd driven_run(const response::ArmSimulator& simulation, const Eigen::Vector2d& hub,
                           const std::vector<double>& acceleration_rad_per_s2,
                           const measured::MeasuredRun& run, const Eigen::VectorXd& measured,
                           const Eigen::VectorXd& deviations, const arm::Deadline& deadline) {
  const auto& record = std::get<measured::TimeRecord>(run.data);
  const InitialStates initial{rigid_motion(simulation, record, hub),
                              simulation.resolved_states_of_resting_hub()};
  Eigen::MatrixXd readings = simulation.readings(acceleration_rad_per_s2, initial.known, deadline);
  if (run.run.initial == measured::InitialState::free) {
    readings = from_likely_state(simulation, acceleration_rad_per_s2, initial, readings, measured,
                                 deviations, deadline);
  }
  return readings.reshaped();
}

}  // namespace flexarm::compare
