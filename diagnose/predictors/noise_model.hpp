#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::diagnose {

/// What a stochastic grey-box model adds to an arm in `time` runs: a torque on the hub that nobody
/// recorded (response::HubDisturbance), forces on its flexible modes where the data ask for them,
/// and what the sensors show beside the arm's motion.
struct NoiseModel {
  double disturbance_N_m = 0.0;     ///< stationary standard deviation, above 0
  double correlation_time_s = 0.0;  ///< above 0
  double modal_force_N_m = 0.0;     ///< as response::ProcessNoise has it
  /// Standard deviation of a sensor's readings over that of its noise (Observations), 1 or more;
  /// 1 where none is given.
  std::map<std::string, double> reading_factors = {};
  /// Of each run the standard deviation of white noise in its recorded torque (torque_noise.hpp).
  /// Where it is given the disturbance is that noise, held from sample to sample: `disturbance_N_m`
  /// and `correlation_time_s` have no influence, and no number of the model is estimated.
  std::vector<double> torque_noise_N_m = {};

  bool is_torque_noise() const { return !torque_noise_N_m.empty(); }

  double reading_factor(const std::string& sensor) const {
    const auto found = reading_factors.find(sensor);
    return found == reading_factors.end() ? 1.0 : found->second;
  }
};

}  // namespace flexarm::diagnose
