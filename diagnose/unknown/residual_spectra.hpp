#pragma once

#include "diagnose/search/problem.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace flexarm::diagnose {

/// Fourier transforms of what a simulation leaves of one stretch of a `time` run, or what is left
/// of the frequency responses of a `frf` run, which are per unit of torque; all sensors at once, on
/// the lines where it is beyond noise.
struct ResidualSpectra {
  std::size_t run = 0;         ///< index of Experiment::runs
  bool is_per_torque = false;  ///< of a `frf` run
  std::vector<arm::Sensor> sensors;
  std::vector<double> frequency_Hz;  ///< of the lines, ascending
  /// Sensors x lines, in the sensors' units: |.|^2 is the line's part of the mean square. Of a
  /// `frf` run in these units per N m.
  Eigen::MatrixXcd errors;
  Eigen::MatrixXd noise;   ///< expected |.|^2 of the noise
  Eigen::MatrixXd excess;  ///< |errors|^2 - noise, mean of 2 kNeighbours + 1 lines, 0 or more
  /// Of the recorded torque, where its controller is stated: recorded less simulated.
  Eigen::VectorXcd torque_errors;
};

/// Of all `time` runs, in segments of up to `kLongestSegment` samples that overlap by half, behind
/// Hann's window. A sensor that shows the drift of the rigid arm is differenced before and divided
/// by the response of that behind (measured::Signal). Lines are those from `kLowestLine` to
/// `kHighestPart` of the Nyquist frequency on which the power of some sensor, mean of
/// 2 kNeighbours + 1 lines, is above `kBeyondNoise` times its noise: by chance in one of 10^4. Of
/// `frf` runs all lines but 0 Hz for which that holds, of the sensors that share their frequencies.
///
/// `errors` are those of `problem`, in standard deviations (to_errors). Segments that are not
/// finite are left out, and those without a line.
std::vector<ResidualSpectra> residual_spectra(const Problem& problem,
                                              const Eigen::VectorXd& errors);
inline constexpr std::size_t kLongestSegment = 16384;
inline constexpr std::size_t kLowestLine = 4;
inline constexpr double kHighestPart = 0.8;
inline constexpr Eigen::Index kNeighbours = 3;
inline constexpr double kBeyondNoise = 4.0;

}  // namespace flexarm::diagnose
