#pragma once

#include "diagnose/search/hypothesis.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace flexarm::diagnose {

/// The paper's arm with the damping of a real one, as its file would have it.
arm::Arm trial_arm();

/// What `simulated_experiment` makes.
struct SimulatedRuns {
  double duration_s = 4.0;
  double relative_noise = 0.005;
  double acting_noise = 0.0;  ///< white noise of the torque that acts and is recorded, over its rms
  std::uint64_t seed = 1;
};

/// `time` runs of `trial_arm` with hidden effects: random torque, low and high, with and without a
/// payload for estimation, a multisine for validation. By finite elements, response::simulate and
/// seeded noise: another formulation and integrator than those that are fitted.
Experiment simulated_experiment(const arm::Effects& hidden, const SimulatedRuns& runs = {});

/// The hypotheses of an experiment with one of these effects.
std::vector<Hypothesis> named(const Experiment& experiment, const std::vector<std::string>& names);

}  // namespace flexarm::diagnose
