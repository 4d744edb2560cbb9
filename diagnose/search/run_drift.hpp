#pragma once

#include "diagnose/search/candidate.hpp"
#include "diagnose/search/problem.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::diagnose {

/// A parameter as one run by itself has it.
struct RunValue {
  std::string run;
  double value = 0.0;
  double std_error = 0.0;
};

/// One parameter refitted to each run by itself, validation runs too.
struct RunDrift {
  std::string effect;
  std::string parameter;
  std::string unit;
  std::vector<RunValue> values;  ///< of runs that show the effect
  double mean = 0.0;             ///< weighted by the squares of the errors
  double size = 0.0;             ///< of the mean, from the value where the effect does nothing
  double chi_squared = 0.0;      ///< of the spread, for one number less than there are values
  double probability = 1.0;      ///< of this spread or more from the errors alone

  /// Smallest and largest of the values.
  std::pair<RunValue, RunValue> range() const;
  /// Their difference over the size.
  double spread() const;
};

/// The parameter that gives the `effect`-th of `candidate`'s effects its size, or its first one
/// where none does, the others as they are, by Gauss-Newton steps in each run from where all runs
/// have it. Standard errors as those of causes: widened by the size of what is left and its
/// correlation. Runs whose standard error is the size of the effect or more do not show it: a
/// torque that never saturates says nothing of a limit. Empty where fewer than two do.
std::optional<RunDrift> run_drift(const Problem& problem, const Candidate& candidate,
                                  std::size_t effect);

}  // namespace flexarm::diagnose
