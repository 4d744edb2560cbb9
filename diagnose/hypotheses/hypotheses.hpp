#pragma once

#include "diagnose/search/hypothesis.hpp"

#include <vector>

namespace flexarm::diagnose {

/// One function an effect, in the file of its name.
Hypothesis hub_inertia(const Scales& scales);
Hypothesis flexural_rigidity(const Scales& scales);
Hypothesis linear_density(const Scales& scales);
Hypothesis payload_mass(const Scales& scales);
Hypothesis payload_inertia(const Scales& scales);
Hypothesis payload_offset(const Scales& scales);
Hypothesis hub_radius(const Scales& scales);
Hypothesis root_compliance(const Scales& scales);
Hypothesis local_stiffness_loss(const Scales& scales);
Hypothesis hub_spring(const Scales& scales);
Hypothesis gravity(const Scales& scales);
Hypothesis shear_and_rotary_inertia(const Scales& scales);
Hypothesis hub_viscous_friction(const Scales& scales);
Hypothesis structural_damping(const Scales& scales);
Hypothesis air_damping(const Scales& scales);
Hypothesis quadratic_drag(const Scales& scales);
Hypothesis coulomb_friction(const Scales& scales);
Hypothesis stribeck_friction(const Scales& scales);
Hypothesis torque_gain(const Scales& scales);
Hypothesis torque_bias(const Scales& scales);
Hypothesis torque_saturation(const Scales& scales);
Hypothesis torque_dead_zone(const Scales& scales);
Hypothesis torque_ripple(const Scales& scales);
Hypothesis actuator_lag(const Scales& scales);
Hypothesis time_delay(const Scales& scales);
Hypothesis sensor_lag(const Scales& scales, const arm::Sensor& sensor);

/// Every cause that the experiment's arm may have and its data may show, in the vocabulary's
/// order: not effects that the arm file already has, nor those that show in no kind of its runs.
std::vector<Hypothesis> hypotheses(const Experiment& experiment);

}  // namespace flexarm::diagnose
