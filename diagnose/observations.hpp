#pragma once

#include "diagnose/autoregression.hpp"
#include "diagnose/experiment.hpp"

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::diagnose {

/// The channel of a controller's torque, behind those of the sensors.
inline constexpr std::string_view kTorqueChannel = "torque";

/// The numbers that one sensor gave in one run, a stretch of the vectors of `Observations`:
/// readings of a `time` run, and the torque of one whose controller is stated; real and imaginary
/// parts, frequency by frequency, of an `frf` run; of a `modal` run natural frequencies and damping
/// ratios, entry by entry, as far as known.
struct ObservedChannel {
  std::size_t run = 0;  ///< index of Experiment::runs
  std::string sensor;   ///< "hub_angle", kTorqueChannel; of a modal run "hub_angle zero", "pole"
  Eigen::Index first = 0;
  Eigen::Index count = 0;
  double noise = 0.0;  ///< standard deviation over that of the signal; the noise floor
  /// The simulation's own error, in the same measure: never to be taken for physics.
  double numerical_error = 0.0;

  /// How the noise of a `time` channel goes on from reading to reading; white where the data do
  /// not show another (Problem::with_coloured_noise).
  Autoregression autoregression = {};

  /// Both together: what residuals are in units of.
  double floor() const { return std::hypot(noise, numerical_error); }
};

/// ObservedChannel::noise is this or more. Readings that repeat to the last digit leave no noise to
/// be seen; this part of the signal then stands for what a model cannot be asked to reach.
inline constexpr double kLeastNoise = 1e-6;

/// All that an experiment measured, in one vector, run by run and channel by channel.
struct Observations {
  Eigen::VectorXd values;
  Eigen::VectorXd deviations;  ///< of each, noise and numerical error together; above 0
  std::vector<ObservedChannel> channels;
  std::vector<Eigen::Index> first_of_run;  ///< where each run begins, and at last the end
};

/// Errors in standard deviations of each number, in their order, as independent residuals of unit
/// variance; and back. Of channels whose noise is white, and behind the numbers, nothing changes.
void whiten(const Observations& observations, Eigen::VectorXd& errors);
Eigen::VectorXd coloured(const Observations& observations, Eigen::VectorXd residuals);

/// Poles, or the zeros of one sensor, of a modal table: indices of its entries, in their order.
struct ModalGroup {
  std::optional<arm::Sensor> zeros_of;  ///< empty: poles, which are the same in every sensor
  std::vector<std::size_t> entries;
};
std::vector<ModalGroup> modal_groups(const measured::ModalTable& table);

/// Standard deviations are those that the data show by themselves, whatever the arm does:
/// diagnose/noise_floor.hpp.
Observations observe(const Experiment& experiment);

}  // namespace flexarm::diagnose
