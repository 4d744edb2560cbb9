#pragma once

#include "diagnose/experiment.hpp"
#include "diagnose/observations.hpp"
#include "diagnose/search/hypothesis.hpp"

#include <string>
#include <vector>

namespace flexarm::diagnose {

/// The experiment with the hub's motion, by its angle or else its velocity, as the input of each
/// run in the place of the torque, and without the readings of the hub's sensors. Gain and offset
/// of the hub's sensor are those of the arm file. Throws InputError by the run's name for one that
/// is not a `time` run, or has no hub sensor or no other; for an arm without a beam, and for a hub
/// sensor that the arm file has with a delay or a lag.
Experiment driven_by_motion(const Experiment& experiment);

/// The experiment with the hub's motion as the input of each run, whose torque is then judged by
/// the recorded one (Experiment::judges_torque), beside the sensors that are not the hub's. Throws
/// InputError as driven_by_motion; an arm without a beam, and a run with sensors of the hub alone,
/// are none of its reasons.
Experiment balanced_at_hub(const Experiment& experiment);

/// Whether a hypothesis changes what the arm shows at a given motion of its hub: not one that acts
/// on the hub or its torque alone, or on a sensor of the hub.
bool acts_beside_motion(const Hypothesis& hypothesis);

/// A notice, of an experiment that is driven by motion, of how well that is known: the noise of the
/// hub's sensor, and what it adds to the noise of the readings that are judged.
std::string motion_notice(const Experiment& experiment, const Observations& observations);

}  // namespace flexarm::diagnose
