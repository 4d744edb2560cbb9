#pragma once

#include "measured/files/frequency_record.hpp"
#include "measured/modal/fitted_transfer.hpp"

#include <span>
#include <vector>

namespace flexarm::measured {

/// By how much the variance of fitted poles exceeds that of a fit, which takes the noise of lines
/// to have the deviations given and the noise of sensors to be independent. A force that nobody
/// recorded shows in all sensors on the same line, and most of all at resonances. With s_jk the
/// score of sensor j on line k for a parameter of the blocks, and I_jk its variance in the fit,
///
///     mean over parameters of  sum_k (sum_j s_jk)^2 / sum_k sum_j I_jk,
///
/// the cluster-robust over the fit's own [White1980]; 1 or more.
double common_noise_factor(const FrequencyRecord& record,
                           const std::vector<std::vector<double>>& deviation,
                           std::span<const FittedTransfer> transfers);

}  // namespace flexarm::measured
