#pragma once

#include "diagnose/experiment.hpp"

#include <cstddef>

namespace flexarm::diagnose {

/// The estimation runs of an experiment with less in them, for a first look at many values: of
/// `time` runs the first `samples`, whose simulation goes less out of step with another frequency;
/// of `frf` runs every few lines; `modal` runs as they are.
Experiment coarse(const Experiment& experiment, std::size_t samples);
inline constexpr std::size_t kCoarseLines = 100;

/// Returns the experiment with its `time` runs whole, decimated to about `samples`
/// (measured::decimated) where they are long enough for it.
Experiment decimated_whole(Experiment experiment, std::size_t samples);

}  // namespace flexarm::diagnose
