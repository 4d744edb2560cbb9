#pragma once

#include "tests/trials/trial_case.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::trials {

/// Which trials to make: every combination of the lists, `trials` times.
struct TrialChoice {
  std::vector<std::string> kinds = {"time", "frf", "modal"};
  /// Names of causes, several joined by `+`, `single` for the vocabulary, `none`, `one`,
  /// drawn by chance, `pairs`, `triples`, `outside`, `outside-pairs`, `rig` (rig_case.hpp). A rig
  /// is of time runs without dirt, and has its own noise and sizes.
  std::vector<std::string> effects = {"single", "pairs", "none", "outside"};
  std::vector<std::string> strengths = {"weak", "middle", "strong"};
  std::vector<double> noises = {0.005, 0.03};
  int trials = 1;
  std::uint64_t seed = 1;
  std::string arm = {};
  std::optional<double> size = {};  ///< in place of the strengths
  /// Names of dirt (dirt.hpp), `all` of them, `none`; of time runs only.
  std::vector<std::string> dirts = {"none"};
  double dirt_size = 1.0;
};

/// Those that can be: a cause is hidden only in data that show it. Throws InputError for an unknown
/// word.
std::vector<TrialKey> list_trials(const TrialChoice& choice);

}  // namespace flexarm::trials
