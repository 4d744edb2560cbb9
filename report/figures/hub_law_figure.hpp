#pragma once

#include "diagnose/unknown/empirical_law.hpp"
#include "report/figures/figure.hpp"

namespace flexarm::report {

/// The torques of an empirical law over hub velocity or hub angle with two standard errors, and the
/// means of the residual hub torque that it describes. A law over both has a panel over the angle
/// for each of its velocities.
Figure hub_law_figure(const diagnose::EmpiricalLaw& law);

}  // namespace flexarm::report
