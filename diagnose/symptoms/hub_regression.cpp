#include "diagnose/symptoms/hub_regression.hpp"

#include "diagnose/parallel.hpp"
#include "diagnose/search/misfit.hpp"

#include <algorithm>
#include <cmath>

namespace flexarm::diagnose {

using Eigen::Index;

namespace {

/// Calls use(m, reading, first, count) for each hub signal of motion m: its place in the order of
/// the residuals.
template <class Use>
void for_each_signal(const std::vector<HubMotion>& motions, const Use& use) {
  Index first = 0;
  for (std::size_t m = 0; m < motions.size(); ++m) {
    const auto count = std::ssize(motions[m].time_s);
    for (const HubReading& reading : motions[m].readings) {
      use(m, reading, first, count);
      first += count;
    }
  }
}

}  // namespace

HubRegression::HubRegression(const std::vector<HubMotion>& motions) : motions_(motions) {
  Index n = 0;
  for_each_signal(motions, [&](std::size_t, const HubReading&, Index, Index count) { n += count; });
  residuals_.resize(n);
  for_each_signal(motions, [&](std::size_t, const HubReading& reading, Index first, Index count) {
    residuals_.segment(first, count) =
        Eigen::VectorXd::Map(reading.residual.data(), count) / reading.noise;
  });
  take_out_initial_motion(residuals_);
}

void HubRegression::take_out_initial_motion(Eigen::VectorXd& signals) const {
  for_each_signal(motions_, [&](std::size_t m, const HubReading&, Index first, Index count) {
    if (!motions_[m].starts_free) return;
    const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(count, -1.0, 1.0);
    auto signal = signals.segment(first, count);
    const double slope = time.dot(signal) / time.squaredNorm();
    signal.array() -= signal.mean() + slope * time.array();
  });
}

Eigen::VectorXd HubRegression::readings(const HubTorques& torques) const {
  Eigen::VectorXd made(residuals_.size());
  for_each_signal(
      motions_, [&](std::size_t m, const HubReading& reading, Index first, Index count) {
        const std::vector<double> values = reading.response.reading(torques[m]);
        made.segment(first, count) = Eigen::VectorXd::Map(values.data(), count) / reading.noise;
      });
  take_out_initial_motion(made);
  return made;
}

Eigen::VectorXd HubRegression::of_hub(const Eigen::VectorXd& of_problem) const {
  Eigen::VectorXd made(residuals_.size());
  for_each_signal(motions_, [&](std::size_t, const HubReading& reading, Index first, Index count) {
    made.segment(first, count) = of_problem.segment(reading.first, count);
  });
  take_out_initial_motion(made);
  return made;
}

Eigen::VectorXd HubRegression::adjoint(Eigen::VectorXd signals) const {
  take_out_initial_motion(signals);  // an orthogonal projection
  std::vector<Index> first_of_motion = {0};
  for (const HubMotion& motion : motions_) {
    first_of_motion.push_back(first_of_motion.back() + std::ssize(motion.time_s));
  }
  Eigen::VectorXd made = Eigen::VectorXd::Zero(first_of_motion.back());
  for_each_signal(
      motions_, [&](std::size_t m, const HubReading& reading, Index first, Index count) {
        const Eigen::VectorXd own = signals.segment(first, count) / reading.noise;
        const std::vector<double> torque =
            reading.response.adjoint({own.data(), motions_[m].time_s.size()});
        made.segment(first_of_motion[m], count) += Eigen::VectorXd::Map(torque.data(), count);
      });
  return made;
}

double HubRegression::independent(const Eigen::VectorXd& left) const {
  double sum = 0.0;
  for_each_signal(motions_, [&](std::size_t, const HubReading&, Index first, Index count) {
    sum += diagnose::independent(left.segment(first, count), measured::RunKind::time);
  });
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
