#pragma once

#include "tests/trials/rig_truth.hpp"
#include "tests/trials/strength.hpp"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::trials {

/// A modal test knows frequencies to this part of the noise of its signals.
inline constexpr double kFrequencyNoise = 0.2;

/// Which trial: everything else follows from it and the seed.
struct TrialKey {
  measured::RunKind kind = measured::RunKind::time;
  std::vector<std::string> hidden = {};  ///< causes; empty: nothing is hidden
  Strength strength = Strength::middle;
  double noise = 0.005;  ///< standard deviation over that of the signal
  int number = 1;        ///< of its cell
  std::uint64_t seed = 1;
  std::string arm = {};  ///< empty: by chance
  /// Size of each cause; else that of the strength. Of a rig the largest NRMSE that one makes.
  std::optional<double> size = {};
  std::string dirt = {};  ///< of time runs (dirt.hpp); empty: none
  double dirt_size = 1.0;
  bool rig = false;  ///< hidden at sizes of laboratories, by chance (rig_case.hpp)

  /// "time-coulomb_friction-middle-0.5-1": noise in per cent; a given size in place of the
  /// strength, and "-drift" behind it of a recording with dirt. "time-rig-1-1" of a rig.
  std::string name() const;
  /// The name of the same case without dirt, which has the same runs, causes and noise.
  std::string clean_name() const;
  /// "middle", the size that is given, or "rig".
  std::string strength_name() const;
  /// The name with the seed behind it, "...@1".
  std::string id() const;
  /// The name of its folder, which does not tell what is hidden.
  std::string folder_name() const;
};

/// What was hidden, for the scorer alone.
struct Truth {
  TrialKey key;
  std::string arm;
  World world;                 ///< without payload
  std::vector<double> sizes;   ///< one a hidden cause
  std::vector<double> errors;  ///< that each makes by itself
  std::optional<RigTruth> rig = {};
};

/// Makes the case and writes measurement.toml, arm.toml and the runs' files into `folder`, which is
/// made. Returns what was hidden.
Truth write_case(const TrialKey& key, const std::filesystem::path& folder);

nlohmann::ordered_json truth_json(const Truth& truth);

}  // namespace flexarm::trials
