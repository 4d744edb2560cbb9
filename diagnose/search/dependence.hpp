#pragma once

#include "diagnose/search/candidate.hpp"
#include "diagnose/search/problem.hpp"
#include "diagnose/search/reported_work.hpp"

#include <vector>

namespace flexarm::diagnose {

/// Returns the p-value of the hypothesis that the residuals of a fitted candidate, independent with
/// unit variance, do not depend on what the arm does. A coloured noise model makes the residuals of
/// any candidate white: this is what tells noise from a model error.
///
/// Score tests [Rao1948] of every hypothesis of the library that the candidate has not, whatever is
/// searched for: where d is what it changes of the residuals r at some value, beyond what refitting
/// the candidate takes of that change, z = d^T r/|d| is standard normal. So it is for d times the
/// time from the middle of each run, about what a number that drifts makes. For what no hypothesis
/// describes, the same tests of laws of hub torque of any shape (hub_torque_probes.hpp), and by
/// output error a regression on the recorded torque up to the sample, sensor by sensor, whose sum
/// of squares over the runs is chi-squared. Where the recorded torque drives the arm, the sensors
/// are also tested for independence of each other (channel_independence.hpp): the residuals that a
/// force nobody recorded leaves need not depend on what the arm was told to do. A dependence of
/// `kNegligibleDependence` of the signal, by motion `kNegligibleByMotion`, counts as none.
///
/// The p-value is the least of all tests, of the estimation and of the validation runs, after
/// Bonferroni. After a rejection at `level` it
/// ends: the rest is not computed. Throws Cancelled where the work is cancelled.
double dependence_p_value(const Problem& problem, const Candidate& fitted, ReportedWork& work,
                          double level = 0.0);

/// p-value of five standard deviations of a normal number, for noise that is not of the kind of the
/// noise model: an amplifier that warms makes a ramp, of whose power few numbers tell.
inline constexpr double kCertainDependence = 5.7e-7;

/// Root mean square, relative to the signal: the errors of two simulations are less alike than they
/// are large (kSimulationError).
inline constexpr double kNegligibleDependence = 0.0015;
/// The same of an arm that is driven by motion: all sensors share the error of the measured motion,
/// which depends on the motion. With nothing hidden and encoder counts of the hub it is up to 0.6 %
/// along one direction.
inline constexpr double kNegligibleByMotion = 0.01;
/// Of the two the one that holds for a problem.
double negligible_dependence(const Problem& problem);

}  // namespace flexarm::diagnose
