#pragma once

#include "arm/formulation.hpp"
#include "assumed_modes/quadratic_pencil.hpp"

namespace flexarm::assumed_modes {

/// The damped poles of the lowest mode and of the first `flexible` others, in units of
/// `omega_scale_rad_per_s`.
///
/// Each mode's pair of roots is followed as the damping grows from 0 to its value: at every step
/// all roots are computed, and a mode takes the two (conjugates, or two real ones) that lie nearest
/// to its former two, none taken twice. A step is halved, down to 1/64, until for every mode the
/// pair taken is nearer than a third of the distance to the next best. The first step compares with
/// the roots of mass s^2 + damping_kk s + stiffness, and most arms need no other. Where real roots
/// of two modes meet and leave the axis as conjugates no continuation tells whose they are: the
/// higher mode has them, and the lower one the two that are left.
///
/// 1 <= flexible < pencil.mass.size().
arm::DampedPoleSet damped_poles(const QuadraticPencil& pencil, int flexible,
                                double omega_scale_rad_per_s);

}  // namespace flexarm::assumed_modes
