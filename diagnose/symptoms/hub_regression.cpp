#include "diagnose/symptoms/hub_regression.hpp"

#include "diagnose/parallel.hpp"
#include "diagnose/search/misfit.hpp"

#include <algorithm>
#include <cmath>

namespace flexarm::diagnose {

using Eigen::Index;

HubRegression::HubRegression(const std::vector<HubMotion>& motions) : motions_(motions) {
  Index n = 0;
  for (const HubMotion& motion : motions) {
    for (const HubReading& reading : motion.readings) n += std::ssize(reading.residual);
  }
  residuals_.resize(n);
  Index at = 0;
  for (const HubMotion& motion : motions) {
    for (const HubReading& reading : motion.readings) {
      const auto count = std::ssize(reading.residual);
      residuals_.segment(at, count) =
          Eigen::VectorXd::Map(reading.residual.data(), count) / reading.noise;
      at += count;
    }
  }
  take_out_initial_motion(residuals_);
}

void HubRegression::take_out_initial_motion(Eigen::VectorXd& signals) const {
  Index at = 0;
  for (const HubMotion& motion : motions_) {
    const auto count = std::ssize(motion.time_s);
    const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(count, -1.0, 1.0);
    for (std::size_t i = 0; i < motion.readings.size(); ++i) {
      if (motion.starts_free) {
        auto signal = signals.segment(at, count);
        const double slope = time.dot(signal) / time.squaredNorm();
        signal.array() -= signal.mean() + slope * time.array();
      }
      at += count;
    }
  }
}

Eigen::VectorXd HubRegression::readings(const HubTorques& torques) const {
  Eigen::VectorXd made(residuals_.size());
  Index at = 0;
  for (std::size_t m = 0; m < motions_.size(); ++m) {
    for (const HubReading& reading : motions_[m].readings) {
      const std::vector<double> values = reading.response.reading(torques[m]);
      const auto count = std::ssize(values);
      made.segment(at, count) = Eigen::VectorXd::Map(values.data(), count) / reading.noise;
      at += count;
    }
  }
  take_out_initial_motion(made);
  return made;
}

Eigen::VectorXd HubRegression::of_hub(const Eigen::VectorXd& of_problem) const {
  Eigen::VectorXd made(residuals_.size());
  Index at = 0;
  for (const HubMotion& motion : motions_) {
    const auto count = std::ssize(motion.time_s);
    for (const HubReading& reading : motion.readings) {
      made.segment(at, count) = of_problem.segment(reading.first, count);
      at += count;
    }
  }
  take_out_initial_motion(made);
  return made;
}

Eigen::VectorXd HubRegression::adjoint(Eigen::VectorXd signals) const {
  take_out_initial_motion(signals);  // an orthogonal projection
  Index samples = 0;
  for (const HubMotion& motion : motions_) samples += std::ssize(motion.time_s);
  Eigen::VectorXd made = Eigen::VectorXd::Zero(samples);
  Index at = 0;
  Index first = 0;
  for (const HubMotion& motion : motions_) {
    const auto count = std::ssize(motion.time_s);
    for (const HubReading& reading : motion.readings) {
      const Eigen::VectorXd own = signals.segment(at, count) / reading.noise;
      const std::vector<double> torque =
          reading.response.adjoint({own.data(), motion.time_s.size()});
      made.segment(first, count) += Eigen::VectorXd::Map(torque.data(), count);
      at += count;
    }
    first += count;
  }
  return made;
}

double HubRegression::independent(const Eigen::VectorXd& left) const {
  double sum = 0.0;
  Index at = 0;
  for (const HubMotion& motion : motions_) {
    for (const HubReading& reading : motion.readings) {
      const auto count = std::ssize(reading.residual);
      sum += diagnose::independent(left.segment(at, count), measured::RunKind::time);
      at += count;
    }
  }
  return sum;
}

HubTorques HubRegression::torques(const Eigen::VectorXd& left) const {
  std::vector<Index> first_of_run = {0};
  for (const HubMotion& motion : motions_) {
    first_of_run.push_back(first_of_run.back() +
                           static_cast<Index>(motion.time_s.size() * motion.readings.size()));
  }
  HubTorques made(motions_.size());
  in_parallel(motions_.size(), [&](std::size_t m) {
    const HubReading& first = motions_[m].readings.front();
    const auto count = std::ssize(first.residual);
    const Eigen::VectorXd own = left.segment(first_of_run[m], count) * first.noise;
    made[m] = first.response.torque({own.data(), first.residual.size()}, first.noise);
  });
  return made;
}

double at_sample(const HubMotion& motion, const std::vector<double>& values, std::size_t k) {
  const bool is_held = motion.hold == measured::TorqueHold::zero && k + 1 < values.size();
  return is_held ? 0.5 * (values[k] + values[k + 1]) : values[k];
}

double sign_at_sample(const HubMotion& motion, std::size_t k) {
  constexpr double kKnown = 2.0;  // deviations
  const auto& speed = motion.velocity_rad_per_s;
  const bool is_held = motion.hold == measured::TorqueHold::zero && k + 1 < speed.size();
  const double other = is_held ? speed[k + 1] : speed[k];
  const double size = std::max(std::abs(speed[k]) + std::abs(other),
                               2.0 * kKnown * motion.velocity_noise_rad_per_s);
  return size > 0.0 ? (speed[k] + other) / size : 0.0;
}

}  // namespace flexarm::diagnose
