#pragma once

#include "diagnose/autoregression.hpp"
#include "diagnose/experiment.hpp"

#include <Eigen/Core>

#include <cmath>
#include <complex>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::diagnose {

/// The channel of a torque that is judged, behind those of the sensors: a controller's, or that
/// which a measured motion takes.
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
  /// Standard deviation over that of the signal; the noise floor. Of a response the deviation of
  /// both parts over the modulus, root mean square of the lines by their weights in a fit.
  double noise = 0.0;
  /// The simulation's own error, in the same measure: never to be taken for physics.
  double numerical_error = 0.0;
  /// What noise of the recorded torque adds to a simulation, in the same measure; 0 where a filter
  /// does not account for it (search/torque_noise.hpp).
  double torque_error = 0.0;
  bool logarithmic = false;  ///< lines of a response that `to_residuals` takes logarithms of

  /// Readings of a `time` channel that are none (measured::Channel::left_out), from 0 at `first`.
  /// Their values have no weight: they are not among what residuals are counted by.
  std::vector<std::size_t> left_out = {};

  /// How the noise of a `time` channel goes on from reading to reading; white where the data do
  /// not show another (Problem::with_coloured_noise).
  Autoregression autoregression = {};

  /// Numbers with a weight.
  Eigen::Index used() const { return count - static_cast<Eigen::Index>(left_out.size()); }

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

/// Residuals of errors in standard deviations of each number, in their order; and back. Behind the
/// numbers nothing changes.
///
/// - `time` channels: whitened, independent with unit variance; the same where noise is white.
///   Numbers that are left out are taken for the most likely ones beside the others
///   (Autoregression::whiten), of which `to_errors` has the errors.
/// - Lines of a logarithmic channel: of the simulated response p and the measured one h, in
///   standard deviations,
///
///       |h| ln(h/p)                              where |h| >= kResponseFloor,
///       k ln(1 + |h - p|/k) (h - p)/|h - p|      elsewhere, k = kResponseFloor,
///
///   which are h - p where they are near each other, and grow as the logarithm of their ratio where
///   they are not. A resonance of little damping at another frequency would otherwise weigh by its
///   height, which says nothing of how far away it is.
void to_residuals(const Observations& observations, Eigen::VectorXd& errors);
Eigen::VectorXd to_errors(const Observations& observations, Eigen::VectorXd residuals);
inline constexpr double kResponseFloor = 3.0;

/// Standard deviations that weigh numbers in least squares: infinite for those left out.
Eigen::VectorXd weighing_deviations(const Observations& observations);

/// Errors (to_errors), with those of numbers left out as the others of their channel let expect:
/// what spectra of them need.
Eigen::VectorXd with_expected_errors(const Observations& observations, Eigen::VectorXd errors);
inline constexpr int kMostNoiseOrder = 40;  ///< of an autoregression of errors

/// Poles, or the zeros of one sensor, of a modal table: indices of its entries, in their order.
struct ModalGroup {
  std::optional<arm::Sensor> zeros_of;  ///< empty: poles, which are the same in every sensor
  std::vector<std::size_t> entries;
};
std::vector<ModalGroup> modal_groups(const measured::ModalTable& table);

/// Standard deviations are those that the data show by themselves, whatever the arm does:
/// diagnose/noise_floor.hpp.
Observations observe(const Experiment& experiment);

/// Returns the measured response of a channel of an `frf` run, `record`.
const measured::FrequencyChannel& response_of(const measured::FrequencyRecord& record,
                                              const ObservedChannel& channel);

/// The response whose real and imaginary parts these are, frequency by frequency.
std::vector<std::complex<double>> response_of_parts(const std::vector<double>& parts);

}  // namespace flexarm::diagnose
