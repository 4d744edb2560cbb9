#include "tests/trials/time_simulation.hpp"

#include "tests/trials/companions.hpp"
#include "tests/trials/hub_torques.hpp"
#include "tests/trials/torque_chain.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <vector>

namespace flexarm::trials {

namespace {

constexpr int kMostIterations = 20;
/// Of the speed of the hub, or its size, from one iteration to the next.
constexpr double kIterationTolerance = 1e-11;

struct LaggedReading {
  std::size_t sensor = 0;
  double time_constant_s = 0.0;
  double value = 0.0;
};

std::vector<LaggedReading> lagged_readings(const TrueArm& arm,
                                           std::span<const arm::Sensor> sensors) {
  std::vector<LaggedReading> lagged;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const double time_constant_s = known_path(arm, sensors[i]).time_constant_s;
    if (time_constant_s > 0.0) lagged.push_back({i, time_constant_s});
  }
  return lagged;
}

/// What a late sensor has seen: at both ends of each step, between which it went straight, but for
/// h^2/8 of its second derivative.
class LateReading {
 public:
  LateReading(std::size_t sensor, double delay_s, double step_s)
      : sensor_(sensor), delay_steps_(delay_s / step_s) {}

  std::size_t sensor() const { return sensor_; }
  void note(double begin, double end) { steps_.push_back({begin, end}); }
  /// At the end of the last step; at rest it was 0 before the first.
  double value() const {
    const double at = static_cast<double>(steps_.size()) - delay_steps_;
    if (at < 0.0 || steps_.empty()) return 0.0;
    const auto step = std::min(static_cast<std::size_t>(at), steps_.size() - 1);
    const double part = at - static_cast<double>(step);
    return (1.0 - part) * steps_[step].begin + part * steps_[step].end;
  }

 private:
  struct Step {
    double begin;
    double end;
  };
  std::size_t sensor_;
  double delay_steps_;
  std::vector<Step> steps_;
};

std::vector<LateReading> late_readings(const TrueArm& arm, std::span<const arm::Sensor> sensors,
                                       double step_s) {
  std::vector<LateReading> late;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const double delay_s = known_path(arm, sensors[i]).delay_s;
    if (delay_s > 0.0) late.emplace_back(i, delay_s, step_s);
  }
  return late;
}

class NewmarkIntegrator {
 public:
  NewmarkIntegrator(const World& world, std::span<const arm::Sensor> sensors,
                    std::span<const double> torque_N_m, const TimeOptions& options)
      : sensors_(sensors),
        arm_(true_arm(world)),
        plant_(make_plant(arm_, really_placed(arm_, sensors), options.plant)),
        chain_(arm_, torque_N_m, options.sample_time_s),
        torques_(arm_, {options.sample_time_s * static_cast<double>(torque_N_m.size()),
                        options.disturbance_seed}),
        friction_(arm_),
        lagged_(lagged_readings(arm_, sensors)),
        step_s_(options.sample_time_s / options.substeps),
        duration_s_(options.sample_time_s * static_cast<double>(torque_N_m.size())),
        late_(late_readings(arm_, sensors, step_s_)) {
    const Eigen::Index n = plant_.hub.size();
    // Newmark's scheme for any beta as average acceleration (1/4) of an arm of another inertia:
    // the difference 1/4 - beta of the stiffness's part is one of mass.
    constexpr double kBeta = 1.0 / 12.0;
    const Eigen::MatrixXd inertia =
        Eigen::MatrixXd::Identity(n, n) - (0.25 - kBeta) * step_s_ * step_s_ * plant_.stiffness;
    inverse_ =
        (inertia + 0.5 * step_s_ * plant_.damping + 0.25 * step_s_ * step_s_ * plant_.stiffness)
            .inverse();
    from_velocity_ = inverse_ * inertia;
    constexpr double kStable = 6.0;  // (omega h)^2
    if (plant_.stiffness.diagonal().maxCoeff() * step_s_ * step_s_ > kStable) {
      throw std::runtime_error("the step is too long for the highest mode");
    }
    from_displacement_ = -0.5 * step_s_ * inverse_ * plant_.stiffness;
    to_hub_ = 0.5 * step_s_ / plant_.modal_mass_kg_m2 * (inverse_ * plant_.hub);
    hub_to_hub_ = plant_.hub.dot(to_hub_);
    u_ = v_ = middle_ = Eigen::VectorXd::Zero(n);
    if (arm_.base) base_.emplace(*arm_.base);
    if (arm_.slipping) {
      slipping_.emplace(*arm_.slipping);
      tip_to_middle_ = 0.5 * step_s_ / plant_.modal_mass_kg_m2 *
                       (inverse_ * plant_.stations.bottomRows(1).row(0).transpose());
    }
    if (has_beam_forces()) {
      to_modes_ = plant_.stations.transpose() * plant_.station_weights_m.asDiagonal() /
                  plant_.modal_mass_kg_m2;
      beam_to_middle_ = 0.5 * step_s_ * inverse_ * to_modes_;
    }
  }

  /// One step from `from_s`.
  void step(double from_s) {
    const std::vector<double> begin = late_.empty() ? std::vector<double>() : shown(from_s);
    const double torque = chain_.advance(from_s, step_s_);
    free_.noalias() = from_velocity_ * v_;
    free_.noalias() += from_displacement_ * u_;
    free_ += torque * to_hub_;
    const double hub_speed = plant_.hub.dot(v_);
    const double hub_angle = plant_.hub.dot(u_);
    const bool linear = torques_.none() && !has_beam_forces() && arm_.softening == 0.0;
    if (slipping_) free_ += slipping_->force_N() * tip_to_middle_;
    // Forces that depend on the motion: by fixed-point iteration, from the last step's motion.
    double before = plant_.hub.dot(middle_);
    for (int iteration = 0; iteration < kMostIterations; ++iteration) {
      next_ = free_;
      if (!torques_.none()) {
        next_ += torques_.mean_N_m(hub_step(from_s, hub_angle, torque)) * to_hub_;
      }
      if (arm_.softening > 0.0) {
        next_ -=
            softened(from_s + 0.5 * step_s_) * from_displacement_ * (u_ + 0.5 * step_s_ * middle_);
      }
      if (has_beam_forces()) next_.noalias() += beam_to_middle_ * beam_forces(middle_);
      if (!friction_.none()) {
        const double end_speed = 2.0 * plant_.hub.dot(next_) - hub_speed;
        next_ -= friction_.mean_N_m({hub_speed, end_speed, 2.0 * hub_to_hub_}) * to_hub_;
      }
      middle_.swap(next_);
      const double now = plant_.hub.dot(middle_);
      if (linear) break;
      if (std::abs(now - before) <= kIterationTolerance * (1.0 + std::abs(now)) && iteration > 0) {
        break;
      }
      before = now;
    }
    if (!torques_.none()) torques_.made(hub_step(from_s, hub_angle, torque));
    if (base_) base_->step(-torque, step_s_);
    for (LaggedReading& lagged : lagged_) pass_lag(lagged);
    const Eigen::VectorXd v_begin = v_;
    u_ += step_s_ * middle_;
    v_ = 2.0 * middle_ - v_;
    if (slipping_) {
      slipping_->step(plant_.stations.bottomRows(1).row(0).dot(u_),
                      plant_.stations.bottomRows(1).row(0).dot(v_), step_s_);
    }
    for (LateReading& late : late_) {
      const double first = begin[late.sensor()];
      late.note(first, shown_at_end(late.sensor(), first, v_begin));
    }
  }

  /// What is recorded of the sensors just after `time_s`.
  std::vector<double> read(double time_s) const {
    std::vector<double> values = shown(time_s);
    for (const LateReading& late : late_) values[late.sensor()] = late.value();
    for (std::size_t i = 0; i < values.size(); ++i) {
      const TrueArm::SensorPath path = known_path(arm_, sensors_[i]);
      values[i] = path.gain * values[i] + path.offset;
    }
    add_cross_talk(values);
    return values;
  }

 private:
  /// The step from `from_s`, where the hub was at `angle_rad`, by the present mean motion.
  HubStep hub_step(double from_s, double angle_rad, double driving_N_m) const {
    const double speed = plant_.hub.dot(middle_);
    const double turn = step_s_ * speed;
    return {from_s + 0.5 * step_s_, angle_rad + 0.5 * turn, turn, speed, driving_N_m, step_s_};
  }

  /// Part of the stiffness that is lost at that time.
  double softened(double time_s) const {
    return arm_.softening * std::min(1.0, time_s / duration_s_);
  }

  void add_cross_talk(std::vector<double>& values) const {
    const std::vector<double> own = values;
    const auto at = [&](const arm::Sensor& sensor) {
      return static_cast<std::size_t>(std::ranges::find(sensors_, sensor) - sensors_.begin());
    };
    for (const TrueArm::CrossTalk& one : arm_.cross_talks) {
      const std::size_t from = at(one.from);
      const std::size_t to = at(one.to);
      if (from < own.size() && to < own.size()) values[to] += one.factor * own[from];
    }
  }

  bool has_beam_forces() const { return !arm_.beam_forces_N_per_m.empty(); }

  /// What the sensors show just after `time_s` behind their lag, before gain, delay and offset:
  /// gain, delay and lag may change places.
  std::vector<double> shown(double time_s) const {
    const Eigen::VectorXd acceleration = acceleration_at(time_s);
    std::vector<double> values;
    for (std::size_t i = 0; i < sensors_.size(); ++i) {
      const auto lagged = std::ranges::find(lagged_, i, &LaggedReading::sensor);
      if (lagged != lagged_.end()) {
        values.push_back(lagged->value);
        continue;
      }
      const auto row = plant_.readings.row(static_cast<Eigen::Index>(i));
      const int order = arm::derivative_order(sensors_[i]);
      values.push_back(row.dot(order == 0 ? u_ : order == 1 ? v_ : acceleration));
      if (base_) values.back() -= base_->motion(sensors_[i].kind);
    }
    return values;
  }

  /// What a sensor shows at the end of the step that has been made, before the torque jumps there.
  double shown_at_end(std::size_t sensor, double at_begin, const Eigen::VectorXd& v_begin) const {
    const auto lagged = std::ranges::find(lagged_, sensor, &LaggedReading::sensor);
    if (lagged != lagged_.end()) return lagged->value;
    const auto row = plant_.readings.row(static_cast<Eigen::Index>(sensor));
    const int order = arm::derivative_order(sensors_[sensor]);
    const double base = base_ ? base_->motion(sensors_[sensor].kind) : 0.0;
    if (order == 0) return row.dot(u_) - base;
    if (order == 1) return row.dot(v_) - base;
    return 2.0 * (row.dot(v_) - row.dot(v_begin)) / step_s_ - at_begin;
  }

  /// Per length, at the stations.
  Eigen::VectorXd beam_forces(const Eigen::VectorXd& velocity) const {
    const Eigen::VectorXd speed = plant_.stations * velocity;
    Eigen::VectorXd force = Eigen::VectorXd::Zero(speed.size());
    for (const auto& law : arm_.beam_forces_N_per_m) force += speed.unaryExpr(law);
    return force;
  }

  /// The mean of the sensor over the step passes 1/(1 + time_constant s).
  void pass_lag(LaggedReading& lagged) {
    const arm::Sensor& sensor = sensors_[lagged.sensor];
    const auto row = plant_.readings.row(static_cast<Eigen::Index>(lagged.sensor));
    const int order = arm::derivative_order(sensor);
    double mean = row.dot(middle_);
    if (order == 0) mean = row.dot(u_) + 0.5 * step_s_ * mean;
    if (order == 2) mean = 2.0 * (mean - row.dot(v_)) / step_s_;
    const double decay = std::exp(-step_s_ / lagged.time_constant_s);
    lagged.value = mean + (lagged.value - mean) * decay;
  }

  Eigen::VectorXd acceleration_at(double time_s) const {
    const double mass = plant_.modal_mass_kg_m2;
    double torque = chain_.now(time_s);
    if (!torques_.none()) {
      torque += torques_.mean_N_m({.time_s = time_s,
                                   .angle_rad = plant_.hub.dot(u_),
                                   .speed_rad_per_s = plant_.hub.dot(v_),
                                   .driving_N_m = torque});
    }
    Eigen::VectorXd a = -(plant_.damping * v_) - plant_.stiffness * u_ + torque / mass * plant_.hub;
    if (has_beam_forces()) a += to_modes_ * beam_forces(v_);
    if (arm_.softening > 0.0) a += softened(time_s) * (plant_.stiffness * u_);
    if (slipping_) {
      a += slipping_->force_N() / mass * plant_.stations.bottomRows(1).row(0).transpose();
    }
    if (friction_.none()) return a;
    const double speed = plant_.hub.dot(v_);
    double size = friction_.size_N_m(speed);
    if (std::abs(speed) < kRest_rad_per_s) {
      const double holding = plant_.hub.dot(a) * mass / plant_.hub.squaredNorm();
      const double most = friction_.size_N_m(0.0);
      size = std::clamp(holding, -most, most);
    } else {
      size = std::copysign(size, speed);
    }
    return a - size / mass * plant_.hub;
  }

  std::span<const arm::Sensor> sensors_;
  TrueArm arm_;
  Plant plant_;
  TorqueChain chain_;
  HubTorques torques_;
  DryFriction friction_;
  std::vector<LaggedReading> lagged_;
  double step_s_;
  double duration_s_;
  std::optional<MovedBase> base_;
  std::optional<SlippingPayload> slipping_;
  Eigen::VectorXd tip_to_middle_;  // mean velocity per force at the tip
  std::vector<LateReading> late_;
  Eigen::MatrixXd inverse_;  // (1 + h/2 D + beta h^2 W)^-1
  Eigen::MatrixXd from_velocity_;
  Eigen::MatrixXd from_displacement_;  // -h/2 of it times W
  Eigen::VectorXd to_hub_;             // mean velocity per torque on the hub
  double hub_to_hub_ = 0.0;
  Eigen::MatrixXd to_modes_;  // acceleration per force per length at the stations
  Eigen::MatrixXd beam_to_middle_;
  Eigen::VectorXd u_;
  Eigen::VectorXd v_;
  Eigen::VectorXd middle_;  // mean velocity of the step
  Eigen::VectorXd free_;
  Eigen::VectorXd next_;
};

}  // namespace

SimulatedRun simulate_run(const World& world, std::span<const arm::Sensor> sensors,
                          std::span<const double> torque_N_m, const TimeOptions& options) {
  SimulatedRun made;
  // The integrator reads the command of a sample only when it is there.
  made.torque_N_m.assign(torque_N_m.begin(), torque_N_m.end());
  made.channels.resize(sensors.size());
  NewmarkIntegrator integrator(world, sensors, made.torque_N_m, options);
  const double step_s = options.sample_time_s / options.substeps;
  for (std::size_t k = 0; k < torque_N_m.size(); ++k) {
    const double sample_s = static_cast<double>(k) * options.sample_time_s;
    if (options.control) made.torque_N_m[k] = options.control(k, integrator.read(sample_s));
    const int read_at = options.late_substeps.empty() ? 0 : options.late_substeps.at(k);
    for (int j = 0; j < options.substeps; ++j) {
      const double time_s = sample_s + j * step_s;
      if (j == read_at) {
        const std::vector<double> values = integrator.read(time_s);
        for (std::size_t i = 0; i < values.size(); ++i) made.channels[i].push_back(values[i]);
      }
      integrator.step(time_s);
    }
  }
  return made;
}

std::vector<std::vector<double>> simulate_in_time(const World& world,
                                                  std::span<const arm::Sensor> sensors,
                                                  std::span<const double> torque_N_m,
                                                  const TimeOptions& options) {
  return simulate_run(world, sensors, torque_N_m, options).channels;
}

}  // namespace flexarm::trials
