#pragma once

#include "measured/files/measurement.hpp"

#include <span>
#include <vector>

namespace flexarm::measured {

/// How a response was sampled: nothing folds back without a period.
struct SampledResponse {
  arm::Sensor sensor;
  TorqueHold hold = TorqueHold::zero;
  double period_s = 0.0;
};

/// What moves the valleys of a spectrum of power away from the zeros of the arm, beside the noise
/// of the levels around them:
///
/// - Images. Sampling adds sum_{m != 0} (f/(f + m fs))^(1 or 2) G(f + m fs)
///   (measured/spectra/frequency_response.hpp), which is not zero where G is. An image is taken to
///   be as large as G in the upper half of the band, falling as that of a free hub, f^-2 of a
///   displacement, or of strain beside it, f^-1.5. With the slope of |G| beside the valley it moves
///   the valley by image/slope.
/// - Filling. Where noise fills a valley it may be anywhere among the lines that are not above the
///   lowest by kSureRise standard deviations, two in a row ending them.
class ValleyErrors {
 public:
  /// `relative_std` is that of power. The band ends at `to_Hz` or with the lines.
  ValleyErrors(std::span<const double> frequency_Hz, std::span<const double> power,
               std::span<const double> relative_std, double to_Hz, const SampledResponse& sampled);

  /// Standard deviation of the place of the valley at a line; 0 at the ends.
  double standard_deviation_Hz(double line_Hz) const;

 private:
  double image_at(double frequency_Hz) const;
  double slope_at(std::size_t lowest) const;
  double filled_width_Hz(std::size_t lowest) const;

  std::vector<double> frequency_Hz_;
  std::vector<double> amplitude_;
  std::vector<double> amplitude_std_;
  SampledResponse sampled_;
  double level_ = 0.0;  ///< of |G| over f^exponent
};
inline constexpr double kSureRise = 3.0;

}  // namespace flexarm::measured
