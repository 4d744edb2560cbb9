#pragma once

#include "arm/arm.hpp"

#include <map>
#include <string>
#include <vector>

namespace flexarm::trials {

/// Causes that the vocabulary of docs/formats.md has no name for, with their parameters:
///
/// - `hub_hysteresis` torque [N m], angle [rad]: Dahl's friction, of which the torque creeps up to
///   its final size over this angle;
/// - `tuned_mass` mass [kg], frequency [Hz], damping_ratio [1], position [m]: a mass on a spring
/// and
///   a damper on the beam;
/// - `disturbance_torque` rms [N m], lowest, highest [Hz]: a torque on the hub that is not
/// measured,
///   another noise in every run;
/// - `hub_hardening_spring` coefficient [N m/rad^3]: a torque -coefficient theta^3 on the hub.
using OutsideCauses = std::map<std::string, std::map<std::string, double>>;

/// Names of the causes above.
const std::vector<std::string>& outside_names();

/// An arm as it really is: all its effects, and what the vocabulary does not know.
struct World {
  arm::Arm arm;
  OutsideCauses outside = {};
};

/// The arm with the effects that are linear in the equations of the arm alone.
arm::Arm linear_part(const arm::Arm& arm);

/// A parameter of one of the arm's effects, or `otherwise` where it lacks the effect.
double effect_value(const arm::Arm& arm, const std::string& effect, const std::string& parameter,
                    double otherwise);

}  // namespace flexarm::trials
