#include "measured/modal/noise_levels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexarm::measured {

bool weigh_runs(const BlockFit& fit, std::span<Stretch> to) {
  bool uneven = false;
  for (const SensorEstimate& sensor : fit.sensors) {
    double least = std::numeric_limits<double>::infinity();
    double most = 0.0;
    for (const StretchResidual& run : sensor.stretches) {
      least = std::min(least, run.variance());
      most = std::max(most, run.variance());
    }
    uneven = uneven || most > kUneven * kUneven * least;
  }
  if (!uneven) return false;
  for (Stretch& stretch : to) stretch.weights.assign(stretch.sensors.size(), 1.0);
  for (std::size_t j = 0; j < fit.sensors.size(); ++j) {
    double squares = 0.0;
    double rows = 0.0;
    for (const StretchResidual& run : fit.sensors[j].stretches) {
      squares += run.squares;
      rows += run.rows;
    }
    for (const StretchResidual& run : fit.sensors[j].stretches) {
      Stretch& stretch = to[run.stretch];
      const auto at = std::ranges::find(stretch.sensors, static_cast<Eigen::Index>(j));
      if (run.squares > 0.0) {
        stretch.weights[static_cast<std::size_t>(at - stretch.sensors.begin())] =
            std::sqrt(squares / rows / run.variance());
      }
    }
  }
  return true;
}

}  // namespace flexarm::measured
