#pragma once

#include "response/any_formulation.hpp"
#include "response/linear_chain.hpp"

#include <complex>
#include <span>
#include <vector>

namespace flexarm::response {

/// A response close to one damped pole, for a Nyquist diagram.
struct Resonance {
  int order = 0;  ///< of the pole: flexible ones from 1, the lowest 0
  std::complex<double> pole_rad_per_s;
  std::vector<double> frequency_Hz;
  std::vector<std::complex<double>> values;
  /// G at Im s, and at Im s -+ |Re s|: a quarter turn of the circle to either side.
  std::complex<double> at_pole;
  std::complex<double> below;
  std::complex<double> above;
};

/// The response of one sensor around each of the poles, lowest and flexible, whose frequency |Im s|
/// lies strictly between `from_Hz` and `to_Hz`. The frequencies stand at equal angles on the
/// circles that single poles would draw, Im s + |Re s| tan(angle/2) of each pole in the range. It
/// goes as far as the geometric mean with the neighbouring poles (an octave where none oscillates),
/// and at least two half-widths |Re s| to either side, downwards an octave at most. Poles on the
/// imaginary and on the real axis draw no circle and are left out.
std::vector<Resonance> resonances(const AnyFormulation& formulation, const LinearChain& chain,
                                  const arm::Sensor& sensor, const arm::DampedPoleSet& poles,
                                  double from_Hz, double to_Hz);

}  // namespace flexarm::response
