#include "diagnose/symptoms/hub_motion.hpp"

#include "arm/rigid_hub.hpp"
#include "exact_tf/exact_arm.hpp"
#include "response/arm_parts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <variant>

namespace flexarm::diagnose {

namespace {

/// Slope of the line of least squares through `half` samples to both sides, fewer at the ends.
std::vector<double> slope(const std::vector<double>& values, double period_s, std::size_t half) {
  const std::size_t n = values.size();
  std::vector<double> made(n);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t from = k < half ? 0 : k - half;
    const std::size_t to = std::min(n - 1, k + half);
    const double middle = 0.5 * static_cast<double>(from + to);
    double moment = 0.0;
    double squares = 0.0;
    for (std::size_t i = from; i <= to; ++i) {
      const double x = static_cast<double>(i) - middle;
      moment += x * values[i];
      squares += x * x;
    }
    made[k] = moment / (squares * period_s);
  }
  return made;
}

/// By the trapezoidal rule, from 0.
std::vector<double> integral(const std::vector<double>& values, double period_s) {
  std::vector<double> made(values.size());
  for (std::size_t k = 1; k < values.size(); ++k) {
    made[k] = made[k - 1] + 0.5 * period_s * (values[k - 1] + values[k]);
  }
  return made;
}

/// Half of the samples that a slope of the angle is taken over: by the first mode, or without a
/// beam by the time midway, in ratio, between a sample and the record.
std::size_t samples_of_slope(const arm::Arm& arm, double period_s, std::size_t samples) {
  double mode_s = period_s * std::sqrt(static_cast<double>(samples));
  if (arm::has_beam(arm)) {
    const exact_tf::ExactArm exact(response::take_apart(arm).linear);
    mode_s = 2.0 * std::numbers::pi / exact.poles(1).omega_rad_per_s.front();
  }
  return static_cast<std::size_t>(std::max(1.0, 0.5 * kSlope_periods * mode_s / period_s));
}

const ObservedChannel* channel_of(const Problem& problem, std::size_t run, arm::SensorKind kind) {
  const auto& channels = problem.observations().channels;
  const std::string sensor = arm::to_string(arm::Sensor{kind, 0.0});
  const auto found = std::ranges::find_if(
      channels, [&](const ObservedChannel& one) { return one.run == run && one.sensor == sensor; });
  return found == channels.end() ? nullptr : &*found;
}

/// Standard deviation of the noise of a channel.
double noise_of(const Problem& problem, const ObservedChannel& channel) {
  return problem.observations().deviations(channel.first);
}

std::vector<HubReading> readings_of(const SymptomsInput& input, std::size_t run) {
  const Experiment& experiment = input.problem.experiment();
  const auto& [stated, data] = experiment.runs[run];
  const auto& record = std::get<measured::TimeRecord>(data);
  std::vector<HubReading> readings;
  for (const arm::SensorKind kind : {arm::SensorKind::hub_velocity, arm::SensorKind::hub_angle}) {
    const ObservedChannel* channel = channel_of(input.problem, run, kind);
    if (channel == nullptr) continue;
    const double noise = noise_of(input.problem, *channel);
    const Eigen::VectorXd residual = noise * input.before.segment(channel->first, channel->count);
    readings.push_back({HubResponse(arm_in(experiment, stated), {kind, 0.0},
                                    input.problem.predictor().flexible_modes(), stated.torque_hold,
                                    sampling_period_s(record), record.time_s.size()),
                        channel->first,
                        {residual.begin(), residual.end()},
                        noise,
                        channel->noise});
  }
  return readings;
}

}  // namespace

std::optional<HubMotion> hub_motion(const Problem& problem, std::size_t run) {
  const Experiment& experiment = problem.experiment();
  const auto& [stated, data] = experiment.runs[run];
  const auto* record = std::get_if<measured::TimeRecord>(&data);
  if (record == nullptr) return std::nullopt;
  const auto* angle = values_of(*record, arm::SensorKind::hub_angle);
  const auto* velocity = values_of(*record, arm::SensorKind::hub_velocity);
  if (angle == nullptr && velocity == nullptr) return std::nullopt;
  const double period_s = sampling_period_s(*record);
  HubMotion motion;
  motion.run = run;
  motion.run_id = stated.id;
  motion.hold = stated.torque_hold;
  motion.starts_free = stated.initial == measured::InitialState::free;
  motion.time_s = record->time_s;
  motion.torque_N_m = record->torque_N_m;
  const std::size_t half =
      samples_of_slope(arm_in(experiment, stated), period_s, record->time_s.size());
  motion.velocity_rad_per_s = velocity != nullptr ? *velocity : slope(*angle, period_s, half);
  motion.angle_rad = angle != nullptr ? *angle : integral(*velocity, period_s);
  motion.acceleration_rad_per_s2 = slope(motion.velocity_rad_per_s, period_s, 1);
  const auto shown =
      velocity != nullptr ? arm::SensorKind::hub_velocity : arm::SensorKind::hub_angle;
  motion.velocity_noise_rad_per_s = noise_of(problem, *channel_of(problem, run, shown));
  if (velocity == nullptr) {
    // Of a slope through 2 h + 1 values: sum of squares of their places h (h + 1)(2 h + 1)/3.
    const auto h = static_cast<double>(half);
    motion.velocity_noise_rad_per_s /= period_s * std::sqrt(h * (h + 1) * (2 * h + 1) / 3.0);
  }
  return motion;
}

std::vector<HubMotion> hub_motions(const SymptomsInput& input) {
  std::vector<HubMotion> motions;
  for (std::size_t r = 0; r < input.problem.experiment().runs.size(); ++r) {
    auto motion = hub_motion(input.problem, r);
    if (!motion) continue;
    motion->readings = readings_of(input, r);
    motions.push_back(*std::move(motion));
  }
  return motions;
}

}  // namespace flexarm::diagnose
