#pragma once

#include "measured/spectra/response_estimate.hpp"

#include <optional>
#include <string>

namespace flexarm::measured {

/// What is known of a run before its responses are estimated.
struct EstimatorEvidence {
  std::optional<RecordedSignal> input = {};  ///< asked for; empty: chosen
  std::string torque_fault = {};             ///< why the torque cannot be used; empty where it can
};

/// The responses of a record by the estimator that the evidence is for, with the reason among the
/// settings:
///
/// - from the torque with the reference as instrument where there is one that excites the arm;
/// - from the torque by itself where there is none, or the reference does not;
/// - from the hub's motion where that is asked for, from the hub angle where the torque has a fault
///   (aliases of a velocity move the poles under torque steps): with the reference,
///   the torque or the other hub sensor as instrument, the first that excites the arm; by Hv where
///   none does.
///
/// A signal excites where it varies, where, of segments, half or more have a share in its power
/// (with p_i of each, (sum p)^2/sum p^2 is half their number or more: else deviations, which count
/// on a stationary signal, are too small), and where `is_excited` holds on kLeastExcitedLines or
/// more.
///
/// Throws InputError with `torque_fault` where only the torque could be the input, and as
/// `estimate_frequency_response` does.
FrequencyResponseEstimate estimate_by_evidence(const TimeRecord& record,
                                               const SpectrumSettings& settings,
                                               const EstimatorEvidence& evidence);
inline constexpr std::size_t kLeastExcitedLines = 16;

}  // namespace flexarm::measured
