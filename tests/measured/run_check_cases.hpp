#pragma once

#include "measured/checks/run_check.hpp"
#include "tests/measured/data_check_cases.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace flexarm::measured {

/// A run of several with the same arm.
struct RecordedRun {
  TimeRecord record;
  arm::Payload payload;  ///< as stated
  std::string description;

  CheckedRun as_checked() const { return {description, &record, payload, true, {}}; }
};

/// Two to four runs of an arm, with the same noise of a sensor in all.
struct RecordedRuns {
  std::vector<RecordedRun> runs;
  DescribedArms arms;
  std::size_t run = 0;       ///< the odd one
  double mass_kg = 0.0;      ///< that it carries
  std::string channel = {};  ///< that is noisier in it
};

/// Runs with payloads of their own or the same one; where one is `odd`, it carries another than it
/// states.
RecordedRuns plant_wrong_payload(std::uint64_t seed, bool odd);

/// Runs of one arm, torque and sampling of their own; where one is `odd`, a channel of it has 5 to
/// 20 times the noise of the others.
RecordedRuns plant_uneven_noise(std::uint64_t seed, bool odd);

}  // namespace flexarm::measured
