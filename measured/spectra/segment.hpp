#pragma once

#include "measured/spectra/spectra.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace flexarm::measured {

/// `to.size()` values of the signal's differences, the first at sample `first`, which is not less
/// than the number of differences.
void copy_differenced(const Signal& signal, std::size_t first, std::span<double> to);

/// Takes the mean or the line of least squares off.
void take_off(Detrend detrend, std::span<double> values);

}  // namespace flexarm::measured
