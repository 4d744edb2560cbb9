#pragma once

#include "export/samples/parameter_posterior.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace flexarm::samples {

struct SampledNumber {
  std::string key;
  std::string unit;
};

struct ArmSample {
  std::size_t set = 0;  ///< of ParameterPosterior::sets
  arm::Arm arm;
  std::vector<double> values;  ///< one a number; not a number where its set does not have that one
};

struct ArmSamples {
  std::vector<SampledNumber> numbers;  ///< of all sets
  std::vector<ArmSample> samples;      ///< the nominal arm, then those drawn
  std::int64_t rejected = 0;           ///< draws that were not taken
};

/// `count` arms of the posterior behind the nominal one. For each, the set of effects is drawn by
/// its probability, then its numbers: normal, or their logarithms, with their correlation. Where
/// the arm does not allow them (a number out of its range, numbers that contradict each other) all
/// of its numbers are drawn anew: the distribution is truncated. The same seed gives the same
/// samples, the first ones of any count alike.
///
/// Throws InputError for a set of which the arm allows none in kMostDraws draws.
ArmSamples draw(const ParameterPosterior& posterior, std::size_t count, std::uint64_t seed);
inline constexpr int kMostDraws = 1000;

}  // namespace flexarm::samples
