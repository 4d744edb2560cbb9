#pragma once

#include "diagnose/search/problem.hpp"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace flexarm::diagnose {

/// Standard deviation of the white noise in a recorded torque [N m]: the smaller of two bounds. One
/// is of the quietest part of its spectrum (white_noise); the other, for a torque that is constant
/// between jumps, the median change from sample to sample. 0 where that is kMostTorqueNoise of the
/// torque's root mean square or more: a torque that fills the spectrum shows no noise.
double torque_noise_N_m(std::span<const double> torque_N_m);
inline constexpr double kMostTorqueNoise = 0.3;

/// The same of each run, 0 of those that have no torque.
std::vector<double> torque_noise_N_m(const Experiment& experiment);

/// What the noise of the recorded torques adds to simulations from them of the arm as filed: of
/// each channel the root mean square of kTorqueDraws draws, over the deviation of the measured
/// signal; 0 for an arm that cannot be computed.
std::vector<double> errors_of_torque(const Problem& problem);
inline constexpr int kTorqueDraws = 8;

/// A problem by output error with the noise of its recorded torques for the disturbance, where that
/// adds kLeastTorqueError of the noise of some channel or more to what is simulated; empty else.
/// Throws InputError where no Kalman filter can be formed.
std::optional<Problem> with_torque_noise(const Problem& problem);
inline constexpr double kLeastTorqueError = 0.5;

/// Of such a problem: whether the readings of the estimation runs are more likely with that noise
/// in the recorded torque than with none and with kOtherTorqueNoise times as much. What looks like
/// noise may have moved the arm, as it does in closed loop; and noise that takes up what the arm
/// lacks is of another size than the record shows. Throws InputError for an arm that cannot be
/// computed.
bool torque_noise_is_likely(const Problem& problem, const arm::Arm& arm);
/// Outside the scatter of torque_noise_N_m, of 10 %.
inline constexpr std::array kOtherTorqueNoise = {0.0, 0.75, 1.33};

}  // namespace flexarm::diagnose
