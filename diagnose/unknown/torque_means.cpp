#include "diagnose/unknown/torque_means.hpp"

#include "diagnose/search/misfit.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace flexarm::diagnose {

namespace {

/// Indices of samples.
using Samples = std::vector<std::size_t>;

std::vector<Samples> samples_of_curves(const arm::HubTorqueTable& table,
                                       const BalancedMotion& motion) {
  const bool is_over_both = !table.angle_rad.empty() && !table.velocity_rad_per_s.empty();
  std::vector<Samples> curves(is_over_both ? table.velocity_rad_per_s.size() : 1);
  for (std::size_t k = 0; k < motion.missing_N_m.size(); ++k) {
    std::size_t curve = 0;
    if (is_over_both) {
      const auto nearest = std::ranges::min_element(
          table.velocity_rad_per_s, {},
          [&](double velocity) { return std::abs(motion.velocity_rad_per_s[k] - velocity); });
      curve = static_cast<std::size_t>(nearest - table.velocity_rad_per_s.begin());
    }
    curves[curve].push_back(k);
  }
  return curves;
}

}  // namespace

std::vector<std::vector<TorqueMean>> torque_means(const arm::HubTorqueTable& table,
                                                  const BalancedMotion& motion) {
  const auto& axis = table.angle_rad.empty() ? motion.velocity_rad_per_s : motion.angle_rad;
  std::vector<std::vector<TorqueMean>> made;
  Eigen::VectorXd left = Eigen::VectorXd::Zero(std::ssize(motion.missing_N_m));
  for (Samples& samples : samples_of_curves(table, motion)) {
    std::ranges::stable_sort(samples, {}, [&](std::size_t k) { return axis[k]; });
    auto& means = made.emplace_back();
    for (std::size_t i = 0; i < kIntervals; ++i) {
      const std::size_t first = i * samples.size() / kIntervals;
      const std::size_t end = (i + 1) * samples.size() / kIntervals;
      if (end - first < 2) continue;
      const auto n = static_cast<double>(end - first);
      TorqueMean mean;
      for (std::size_t k = first; k < end; ++k) {
        mean.at += axis[samples[k]] / n;
        mean.torque_N_m += motion.missing_N_m[samples[k]] / n;
      }
      double squares = 0.0;
      for (std::size_t k = first; k < end; ++k) {
        const double rest = motion.missing_N_m[samples[k]] - mean.torque_N_m;
        left(static_cast<Eigen::Index>(samples[k])) = rest;
        squares += rest * rest;
      }
      mean.std_error_N_m = std::sqrt(squares / (n * (n - 1.0)));
      means.push_back(mean);
    }
  }
  const double samples_per_independent =
      static_cast<double>(left.size()) / independent(left, measured::RunKind::time);
  for (auto& means : made) {
    for (TorqueMean& mean : means) mean.std_error_N_m *= std::sqrt(samples_per_independent);
  }
  return made;
}

}  // namespace flexarm::diagnose
