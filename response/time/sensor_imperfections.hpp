#pragma once

#include "response/time/random_numbers.hpp"

#include <span>

namespace flexarm::response {

/// What a real sensor adds to a signal. The defaults add nothing.
struct SensorImperfections {
  double relative_noise = 0.0;  ///< standard deviation of white normal noise over the signal's own
  double noise = 0.0;           ///< further such noise, in the sensor's unit
  double quantisation = 0.0;    ///< readings are whole multiples of this, in the sensor's unit

  bool operator==(const SensorImperfections&) const = default;
};

/// Standard deviation of the noise that `impair` would add to `signal`: both kinds together.
double noise_deviation(std::span<const double> signal, const SensorImperfections& imperfections);

/// Adds noise to `signal`, then quantises it. Throws InputError for a number below 0 or not finite.
void impair(std::span<double> signal, const SensorImperfections& imperfections,
            RandomNumbers& random);

}  // namespace flexarm::response
