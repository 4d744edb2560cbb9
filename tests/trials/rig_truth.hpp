#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace flexarm::trials {

/// Hidden causes of a rig that an answer has to name.
inline constexpr std::size_t kLeadingCauses = 3;

/// The part of a truth that rigs alone have.
struct RigTruth {
  /// The cost of the absence of each hidden cause, by its name: the mean NRMSE of a simulation that
  /// knows all the others, in data without noise. One that knows them all has none.
  std::map<std::string, double> costs;
  double counts_per_turn = 0.0;  ///< of the encoder; 0 where the hub angle is not recorded
  /// NRMSE that noise and counts make of the validation run, the mean of its channels.
  double validation_floor = 0.0;

  /// Names of the causes whose absence costs most, the first most.
  std::vector<std::string> leading() const;
};

}  // namespace flexarm::trials
