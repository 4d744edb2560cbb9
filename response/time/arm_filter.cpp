#include "arm/input_error.hpp"
#include "response/time/arm_simulator.hpp"
#include "response/time/lifted_filter.hpp"
#include "response/time/sensor_readings.hpp"
#include "response/time/simulation_input.hpp"
#include "response/time/simulator_commands.hpp"
#include "response/time/time_stepper.hpp"

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace flexarm::response {

using Eigen::Index;

// A reading that is later by n samples is taken n samples before it is measured: until then it is a
// state of the sampled system beside the arm's N. Of each delayed sensor there are n of them, the
// next one to be measured first.

SampledSystem ArmSimulator::sampled(const ProcessNoise& noise,
                                    const Eigen::VectorXd& deviations) const {
  const Index pending = times_.pending_readings();
  if (pending > kMostPendingReadings) {
    throw arm::InputError(fmt::format(
        "Kalman filter: readings that are delayed by {} samples in all; at most {} are possible",
        pending, kMostPendingReadings));
  }
  const Index d = arm_.disturbance.value();
  const Index n = states();
  const Eigen::MatrixXd step = sample_transition();
  const Eigen::MatrixXd taken = linear_readings();
  SampledSystem made{Eigen::MatrixXd::Zero(n + pending, n + pending),
                     Eigen::MatrixXd::Zero(taken.rows(), n + pending),
                     Eigen::MatrixXd::Zero(n + pending, n + pending), deviations.cwiseAbs2()};
  made.transition.topLeftCorner(n, n) = step;
  Index next = n;
  for (Index j = 0; j < taken.rows(); ++j) {
    const Index later = times_.sensors[static_cast<std::size_t>(j)].samples_later;
    if (later == 0) {
      made.readings.row(j).head(n) = taken.row(j);
      continue;
    }
    made.readings(j, next) = 1.0;
    made.transition.block(next, next + 1, later - 1, later - 1).setIdentity();
    made.transition.row(next + later - 1).head(n) = taken.row(j);
    next += later;
  }
  // From sample to sample a stationary disturbance forgets 1 - e^(-2 h/T) of its variance.
  const double kept = step(d, d);
  made.process_covariance(d, d) =
      std::pow(noise.disturbance_N_m / arm_.disturbance_N_m, 2) * (1.0 - kept * kept);
  const double pushed_rad_per_s =
      noise.modal_force_N_m * options_.sample_time_s / arm_.modal_mass_kg_m2;
  made.process_covariance.diagonal()
      .segment(arm_.modes + 1, arm_.modes - 1)
      .setConstant(pushed_rad_per_s * pushed_rad_per_s);
  return made;
}

namespace {

/// Innovations with those that are not numbers, their readings being missing, as the others of the
/// sample let expect: e_m = S_mo S_oo^-1 e_o, S being their covariance. The gain P H^T S^-1 makes
/// of all what that of the others alone, P H_o^T S_oo^-1, makes of e_o.
Eigen::VectorXd with_expected(const Eigen::MatrixXd& covariance, Eigen::VectorXd innovation) {
  std::vector<Index> missing;
  std::vector<Index> there;
  for (Index j = 0; j < innovation.size(); ++j) {
    (std::isnan(innovation(j)) ? missing : there).push_back(j);
  }
  if (there.empty()) return Eigen::VectorXd::Zero(innovation.size());
  const Eigen::MatrixXd own = covariance(there, there);
  const Eigen::VectorXd others = innovation(there);
  innovation(missing) =
      covariance(missing, there) * Eigen::LDLT<Eigen::MatrixXd>(own).solve(others);
  return innovation;
}

}  // namespace

/// The filter at a sample, its readings included.
struct ArmSimulator::FilteredSample {
  Index row;
  const TimeStepper& stepper;
  const Eigen::VectorXd& innovation;
  const Eigen::MatrixXd& predicted;  ///< what is taken already of later samples included
};

void ArmSimulator::forget_white_disturbance(TimeStepper& stepper, const ReadingInstant& now) const {
  if (!parts_.disturbance || !parts_.disturbance->is_white()) return;
  Eigen::VectorXd state = stepper.state();
  state(arm_.disturbance.value()) = 0.0;
  stepper.put(state, stepper.motion() == HubMotion::held);
  stepper.take_up(now.actuator_N_m, now.time_s);
}

template <class AtSample>
void ArmSimulator::follow(Commands& commands, const Eigen::MatrixXd& measured,
                          const FilterGains& gains, AtSample at_sample) const {
  const ReadingPlan reading_plan = commands.reading_plan();
  TimeStepper stepper(plan_, nullptr);
  SensorReadings readings(arm_, parts_, sensors_);
  Eigen::MatrixXd predicted = unread(static_cast<std::size_t>(measured.rows()));
  Eigen::VectorXd state;
  Eigen::VectorXd innovation;
  Eigen::VectorXd correction;
  const auto predict = [&](const ReadingInstant& now) {
    reading_plan.at(now, stepper, readings, [&](std::size_t j, std::size_t k, double reading) {
      predicted(static_cast<Index>(k), static_cast<Index>(j)) = reading;
    });
  };
  const auto correct_pending = [&](Index row) {
    Index next = states();
    for (Index j = 0; j < predicted.cols(); ++j) {
      const Index later = times_.sensors[static_cast<std::size_t>(j)].samples_later;
      const Index behind = std::min(later, predicted.rows() - row) - 1;
      if (behind > 0) {
        predicted.col(j).segment(row + 1, behind) += correction.segment(next + 1, behind);
      }
      next += later;
    }
  };
  commands.step_through(stepper, 0, [&](const ReadingInstant& now) {
    if (now.part == 0) forget_white_disturbance(stepper, now);
    predict(now);
    if (now.part > 0) return true;
    const Index row = now.sample;
    const FilterGain& filter = gains.at(static_cast<std::size_t>(row));
    innovation = (measured.row(row) - predicted.row(row)).transpose();
    innovation = predicted.row(row).transpose().array().isNaN().select(0.0, innovation);
    if (innovation.hasNaN()) {
      correction = filter.gain * with_expected(filter.innovation_covariance, innovation);
      innovation = innovation.array().isNaN().select(0.0, innovation);
    } else {
      correction = filter.gain * innovation;
    }
    state = stepper.state() + correction.head(states());
    if (!state.allFinite()) throw too_large("filtered state", now.time_s);
    stepper.put(state, stepper.motion() == HubMotion::held);
    stepper.take_up(now.actuator_N_m, now.time_s);
    correct_pending(row);
    // What is taken now to be measured later is that of the corrected state.
    if (times_.longest_samples() > 0) predict(now);
    at_sample(FilteredSample{row, stepper, innovation, predicted});
    return true;
  });
}

FilteredRun ArmSimulator::filtered_in_blocks(const Eigen::MatrixXd& torques,
                                             const Eigen::MatrixXd& measured,
                                             const FilterGains& gains) const {
  Eigen::MatrixXd shown = Eigen::MatrixXd::Zero(2, states());
  if (arm_.disturbance) shown(0, *arm_.disturbance) = arm_.disturbance_N_m;
  shown.row(1) = plan_.velocity_row();
  const bool is_white = parts_.disturbance && parts_.disturbance->is_white();
  const LiftedFilter filter(interval_, is_white ? arm_.disturbance : std::nullopt, shown);
  const Eigen::MatrixXd followed = filter.follow(torques, measured, gains);
  for (Index k = 0; k < followed.rows(); ++k) {
    if (followed.row(k).allFinite()) continue;
    throw too_large("filtered state", static_cast<double>(k) * options_.sample_time_s);
  }
  const auto column = [&](Index j) {
    const auto values = followed.col(j);
    return std::vector<double>(values.begin(), values.end());
  };
  return {followed.leftCols(measured.cols()), column(measured.cols()), column(measured.cols() + 1)};
}

FilteredRun ArmSimulator::filtered(std::span<const double> torque_N_m,
                                   const Eigen::MatrixXd& measured,
                                   const FilterGains& gains) const {
  Commands commands(*this, torque_N_m);
  const bool is_whole = !measured.hasNaN() && times_.longest_samples() == 0;
  if (lifted_ && is_whole) {
    if (const auto torques = commands.path().whole_parts(0)) {
      return filtered_in_blocks(*torques, measured, gains);
    }
  }
  FilteredRun made{.innovations = {measured.rows(), measured.cols()}};
  follow(commands, measured, gains, [&](const FilteredSample& now) {
    const Eigen::VectorXd& state = now.stepper.state();
    made.innovations.row(now.row) = now.innovation.transpose();
    made.disturbance_N_m.push_back(
        arm_.disturbance ? arm_.disturbance_N_m * state(*arm_.disturbance) : 0.0);
    const bool is_held = now.stepper.motion() == HubMotion::held;
    made.hub_velocity_rad_per_s.push_back(is_held ? 0.0 : arm_.hub_velocity(state));
  });
  return made;
}

ErrorsAhead ArmSimulator::errors_ahead(std::span<const double> torque_N_m,
                                       const Eigen::MatrixXd& measured, const FilterGains& gains,
                                       const StartsAhead& starts) const {
  Commands commands(*this, torque_N_m);
  const ReadingPlan reading_plan = commands.reading_plan();
  SensorReadings readings(arm_, parts_, sensors_);
  ErrorsAhead made(starts.horizons.size());
  if (made.empty()) return made;
  const Index furthest = starts.horizons.back();
  follow(commands, measured, gains, [&](const FilteredSample& now) {
    if (now.row % starts.stride != 0 || now.row + furthest >= measured.rows()) return;
    TimeStepper ahead = now.stepper;
    Eigen::MatrixXd predicted = now.predicted.middleRows(now.row, furthest + 1);
    commands.step_through(ahead, now.row, [&](const ReadingInstant& at) {
      if (at.part == 0 && at.sample > now.row) forget_white_disturbance(ahead, at);
      reading_plan.at(at, ahead, readings, [&](std::size_t j, std::size_t k, double reading) {
        const Index later = static_cast<Index>(k) - now.row;
        if (later <= furthest) predicted(later, static_cast<Index>(j)) = reading;
      });
      return at.sample < now.row + furthest;
    });
    if (!predicted.allFinite()) {
      throw too_large("reading", static_cast<double>(now.row) * options_.sample_time_s);
    }
    for (std::size_t h = 0; h < starts.horizons.size(); ++h) {
      const Index later = starts.horizons[h];
      made[h].push_back((measured.row(now.row + later) - predicted.row(later)).transpose());
    }
  });
  return made;
}

}  // namespace flexarm::response
