#pragma once

#include "arm/input_error.hpp"

#include <cstddef>
#include <optional>
#include <span>

namespace flexarm::measured {

/// What is wrong with the times of a record, and at which sample.
struct GridFault {
  std::size_t sample = 0;
  arm::InputError error;
};

/// The first fault of times that should be evenly spaced, or none: a time that is not later than
/// the one before; samples that are missing (`clock_steps`); |t_k - (t_0 + k period)| >
/// kMostJitter_periods period. `times_s` holds two samples or more, all finite.
std::optional<GridFault> grid_fault(std::span<const double> times_s);

}  // namespace flexarm::measured
