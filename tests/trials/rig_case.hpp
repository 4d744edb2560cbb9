#pragma once

#include "tests/trials/trial_case.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace flexarm::trials {

/// Noise of a rig's recordings, over the deviation of the signal.
inline constexpr double kRigNoise = 0.01;
/// NRMSE that each cause of a rig makes by itself, each ratio as likely; TrialKey::size is the most
/// where it is given. A cause whose largest size in a laboratory makes less has that size.
inline constexpr double kRigErrorLeast = 0.02;
inline constexpr double kRigErrorMost = 0.3;
/// Counts of an encoder a turn, each ratio as likely; in each run the hub angle ranges over
/// kEncoderSignal_counts or more.
inline constexpr double kEncoderLeast = 1000.0;
inline constexpr double kEncoderMost = 10000.0;
inline constexpr double kEncoderSignal_counts = 50.0;

/// Names of the causes of a rig: viscous and Coulomb friction, inertia of the hub, rigidity, and
/// one to four others.
std::vector<std::string> draw_rig_causes(Random& random);

/// An experiment on a rig before it is recorded.
struct RigDraw {
  const TrialArm& of;
  std::vector<arm::Sensor> sensors;  ///< one of the hub, and one of the tip or a strain gauge
  std::vector<PlannedRun> runs;      ///< two for estimation, one for validation, all from rest
  World world;
  std::vector<double> sizes;   ///< one a hidden cause
  std::vector<double> errors;  ///< that each makes by itself
};

/// The experiment of a key with `rig`, by its name and seed.
RigDraw draw_rig(const TrialKey& key);

/// `write_case` of a key with `rig`. Throws std::runtime_error where the hub turns by less than
/// kEncoderSignal_counts of the finest encoder.
Truth write_rig_case(const TrialKey& key, const std::filesystem::path& folder);

}  // namespace flexarm::trials
