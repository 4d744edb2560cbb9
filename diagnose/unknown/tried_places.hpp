#pragma once

#include "diagnose/search/problem.hpp"
#include "diagnose/unknown/port_responses.hpp"
#include "diagnose/unknown/residual_spectra.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace flexarm::diagnose {

/// A band of a segment: what forces leave of how much.
struct TriedPart {
  std::size_t run = 0;
  double total = 0.0;
  std::vector<double> left;  ///< a place each, adjusted
};

/// A segment with the forces that places would have.
struct TriedSegment {
  std::vector<double> frequency_Hz;
  std::vector<Eigen::ArrayXd> power;  ///< |F|^2 of each line less that of noise, a place each
};

/// What one force at each place leaves of residuals, one place at a time.
struct TriedPlaces {
  std::vector<ForcePlace> places;
  std::vector<TriedPart> parts;
  std::vector<TriedSegment> segments;  ///< of `time` runs
};

/// On each line f of a segment (residual_spectra.hpp) the residuals of the sensors are a vector E,
/// and a force F at a place p makes h_p(f) F of them (port_responses.hpp). F is free on every line.
/// With the weights
///
///     W_j = 1/(N_j + kRelativeError^2 X_j),
///
/// N_j the power of sensor j's noise and X_j that of its residual beyond noise, the best F leaves
///
///     U = E^H W E - |h^H W E|^2/(h^H W h),
///
/// less what it leaves of the noise, sum W_j N_j - h^H W^2 N h/(h^H W h). X_j stands for the error
/// of h itself. It makes every line with a clear residual count alike, and so do the sensors,
/// whatever their noise. One complex number explains 1/n of any n sensors' residuals. A part is one
/// of `kBands` bands of equally many lines of a segment, with the sums over its lines
///
///     total = T = E^H W E - sum W_j N_j,     left = n/(n - 1) U.
///
/// `segments` have two sensors or more; of `problem`, by `arm`. In closed loop the part of E that
/// the error of the simulated torque makes is taken off. Throws arm::Cancelled after the deadline.
TriedPlaces try_places(const Problem& problem, const arm::Arm& arm,
                       const std::vector<ResidualSpectra>& segments, const arm::Deadline& deadline);
inline constexpr double kRelativeError = 0.3;
inline constexpr std::size_t kBands = 4;

}  // namespace flexarm::diagnose
