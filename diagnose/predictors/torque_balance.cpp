#include "diagnose/predictors/torque_balance.hpp"

#include "response/time/torque_for_motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace flexarm::diagnose {

namespace {

/// A hub rests where it turns no faster than this many standard errors of its velocity.
constexpr double kRests = 2.0;

/// The difference quotient of a torque that depends on that of the drive.
constexpr double kRelativeStep = 1e-4;

/// Returns the means of neighbours; behind the last value that value.
std::vector<double> interval_means(std::vector<double> values) {
  for (std::size_t k = 0; k + 1 < values.size(); ++k) {
    values[k] = std::midpoint(values[k], values[k + 1]);
  }
  return values;
}

/// Returns the root mean square of the velocity of a draw of the motion's error.
double velocity_error_rad_per_s(const PrescribedMotion& error, double period_s) {
  double velocity = error.velocity_rad_per_s;
  double squares = 0.0;
  const auto& accelerations = error.acceleration_rad_per_s2;
  for (std::size_t k = 0; k < accelerations.size(); ++k) {
    if (k > 0) velocity += 0.5 * period_s * (accelerations[k - 1] + accelerations[k]);
    squares += velocity * velocity;
  }
  return std::sqrt(squares / static_cast<double>(std::max<std::size_t>(1, accelerations.size())));
}

/// Returns values before a lag of so many samples: value + lag d/dt value.
std::vector<double> before_lag(const std::vector<double>& values, double lag_samples) {
  if (lag_samples == 0.0) return values;
  std::vector<double> made = values;
  for (std::size_t k = 1; k + 1 < values.size(); ++k) {
    made[k] += 0.5 * lag_samples * (values[k + 1] - values[k - 1]);
  }
  return made;
}

/// The smooth laws of hub torque along a motion, with their own states.
class SmoothLaws {
 public:
  SmoothLaws(const response::HubLaws& laws, double period_s) : laws_(laws), period_s_(period_s) {
    for (const auto& law : laws.smooth) {
      states_.emplace_back(static_cast<std::size_t>(law.part.states), 0.0);
    }
  }

  /// Returns their torque [N m] in the middle of an interval in which the hub turns by `turn_rad`.
  double operator()(const arm::HubState& middle, double turn_rad) {
    double sum_N_m = 0.0;
    for (std::size_t i = 0; i < laws_.smooth.size(); ++i) {
      const arm::SmoothHubTorque& law = laws_.smooth[i].part;
      std::vector<double>& z = states_[i];
      if (z.empty()) {
        sum_N_m += law.law(middle, {}, {}).torque_N_m;
        continue;
      }
      std::vector<double> rates(z.size());
      std::vector<double> half = z;
      law.law(middle, z, rates);
      move(law, z, rates, 0.5 * turn_rad, 0.5 * period_s_, half);
      sum_N_m += law.law(middle, half, rates).torque_N_m;
      std::vector<double> after = z;
      move(law, z, rates, turn_rad, period_s_, after);
      z = after;
    }
    return sum_N_m;
  }

 private:
  static void move(const arm::SmoothHubTorque& law, const std::vector<double>& z,
                   const std::vector<double>& rates, double turn_rad, double time_s,
                   std::vector<double>& after) {
    if (law.after_turn) {
      law.after_turn(turn_rad, z, after);
    } else {
      for (std::size_t j = 0; j < z.size(); ++j) after[j] = z[j] + time_s * rates[j];
    }
  }

  const response::HubLaws& laws_;
  double period_s_;
  std::vector<std::vector<double>> states_;
};

}  // namespace

BalancedRun balance(const arm::ModalModel& model, const response::ArmParts& parts,
                    const measured::TimeRecord& record, response::TorqueHold hold,
                    const MeasuredMotion& motion) {
  const double period_s = measured::sampling_period_s(record);
  const PrescribedMotion& hub = motion.motion;
  const response::DrivenMotion taken = response::torque_for_motion(
      model, parts, hub.angle_rad, hub.velocity_rad_per_s, hub.acceleration_rad_per_s2, period_s);
  const std::vector<double> needed_N_m = interval_means(taken.torque_N_m);
  BalancedRun made{.angle_rad = interval_means(taken.angle_rad),
                   .velocity_rad_per_s = interval_means(taken.velocity_rad_per_s),
                   .transmitted_N_m = response::transmitted_torque_N_m(
                       parts.actuator, record.torque_N_m, period_s, hold)};
  const double slow_rad_per_s = kRests * velocity_error_rad_per_s(motion.error, period_s);
  const std::size_t samples = needed_N_m.size();
  SmoothLaws laws(parts.hub, period_s);
  SmoothLaws laws_beside(parts.hub, period_s);  // of a torque that is a little larger
  std::vector<double> given_N_m(samples);
  std::vector<double> holding_N_m(samples, 0.0);  // the most that friction can, of a hub at rest
  for (std::size_t k = 0; k < samples; ++k) {
    const double velocity = made.velocity_rad_per_s[k];
    arm::HubState middle{made.angle_rad[k], velocity, made.transmitted_N_m[k],
                         (static_cast<double>(k) + 0.5) * period_s};
    const double of_laws = laws(middle, velocity * period_s);
    given_N_m[k] = middle.torque_N_m + parts.hub.constant_N_m + of_laws;
    middle.torque_N_m *= 1.0 + kRelativeStep;
    made.transmitted_N_m[k] += (laws_beside(middle, velocity * period_s) - of_laws) / kRelativeStep;
    const double friction_N_m = parts.hub.friction_at(std::abs(velocity)).torque_N_m;
    if (std::abs(velocity) <= slow_rad_per_s) {
      holding_N_m[k] = friction_N_m;
    } else {
      given_N_m[k] -= std::copysign(friction_N_m, velocity);
    }
  }
  const std::vector<double> filtered_N_m = motion.filtered(given_N_m);
  std::vector<double> missing_N_m;
  for (std::size_t k = 0; k < samples; ++k) {
    const double missing = needed_N_m[k] - filtered_N_m[k];
    missing_N_m.push_back(missing - std::clamp(missing, -holding_N_m[k], holding_N_m[k]));
  }
  made.missing_N_m = before_lag(missing_N_m, parts.actuator.lag_s / period_s);
  return made;
}

}  // namespace flexarm::diagnose
