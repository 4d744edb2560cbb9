#pragma once

#include "measured/modal/modal_fit.hpp"
#include "measured/spectra/response_estimate.hpp"

namespace flexarm::measured {

/// Share of noise in the power of a periodic torque above which samples of it are no input to a
/// fit in time: it would bias that by as much.
inline constexpr double kMostTorqueNoise = 1e-3;

/// Whether a run is fitted by its estimated responses, not sample by sample: a simulation of
/// recorded torque is biased by what an instrument, or the mean over periods, keeps out, and a
/// hub motion has no hold.
bool is_fitted_by_responses(const FrequencyResponseEstimate& estimate);

/// The rational fit of estimated responses with their standard deviations, on lines far enough
/// apart to be independent. From the hub's motion it is of responses per hub acceleration,
///
///     y/theta'' = s^k [sum (b1 s + b0)/(s^2 + a1 s + a0) + d],
///
/// whose poles are those with the hub held; the rigid body's block stands for the part of the tip
/// that follows the hub. Aliases that sampling folds back are in the response and not in the model.
/// Throws InputError as `fit_modes` does.
ModalFit fit_responses(const FrequencyResponseEstimate& estimate, ModalFitOptions options);

/// Returns the rational fit of responses that were given (fit_modes), those from the hub's motion
/// per hub acceleration, without a line at 0 Hz. Throws InputError as `fit_modes` does.
ModalFit fit_responses(const FrequencyRecord& record, ModalFitOptions options);

}  // namespace flexarm::measured
