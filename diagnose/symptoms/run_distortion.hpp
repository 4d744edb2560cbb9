#pragma once

#include "diagnose/symptoms/symptom.hpp"
#include "diagnose/symptoms/symptoms_input.hpp"
#include "measured/spectra/distortion.hpp"

#include <string>
#include <vector>

namespace flexarm::diagnose {

/// What the sensors of a run show at lines that its torque does not drive.
struct RunDistortion {
  std::string run;
  std::vector<arm::Sensor> sensors;
  measured::Distortion distortion;  ///< channel by channel as `sensors`
};

/// Of the runs in time whose torque is a periodic multisine with free lines
/// (measured/spectra/distortion.hpp).
std::vector<RunDistortion> run_distortions(const Experiment& experiment);

/// A statement a run: the largest odd and even distortion, or that there is none.
std::vector<Symptom> distortion_symptoms(const std::vector<RunDistortion>& runs);

}  // namespace flexarm::diagnose
