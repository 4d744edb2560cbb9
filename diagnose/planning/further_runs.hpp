#pragma once

#include "arm/arm.hpp"
#include "diagnose/planning/measurement_plan.hpp"
#include "diagnose/search/problem.hpp"

#include <string>
#include <vector>

namespace flexarm::diagnose {

/// A run that may be added to others.
struct FurtherRun {
  PlannedRun run;
  std::string like;    ///< id of the run that it is made of; empty where it is of another kind
  std::string change;  ///< against that run: "0.16 kg more payload, weighed"
};

/// Runs that an experimenter could add to `runs`: the first of each kind again, with other
/// amplitudes, payloads, sensors, inputs, twice as fast sampling, longer; and a frequency response
/// where there is none. Noise is as in the run that they are made of, relative to the signal, so
/// that a larger torque is not better by its size alone. All are for estimation, with ids that
/// `runs` do not have.
std::vector<FurtherRun> further_runs(const arm::Arm& arm, const std::vector<PlannedRun>& runs);

/// The runs of a measurement that were fitted, as if they were planned; torques are as recorded, of
/// long records the beginning. Modal runs are passed over: they do not say what was measured.
std::vector<PlannedRun> planned_as_measured(const Problem& problem);
inline constexpr std::size_t kMostFurtherSamples = 2000;

/// "multisine", "recorded torque", "frequency response".
std::string input_of(const PlannedRun& run);

}  // namespace flexarm::diagnose
