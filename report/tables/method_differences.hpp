#pragma once

#include "report/tables/identified_root_tables.hpp"

#include <string>
#include <vector>

namespace flexarm::report {

/// A sentence for each pole at which another method differs from the rational fit by more than
/// kSureDifference standard errors of both: in frequency, if by kLeastFrequency of it as well, and
/// in damping ratio, if by kLeastDamping of it. The likely reason of a different damping is named
/// as far as the data speak for it: the window of the spectra, distortion, or residuals of the fit
/// that are no noise.
std::vector<std::string> method_differences(const IdentifiedData& data);
inline constexpr double kSureDifference = 3.0;
inline constexpr double kLeastFrequency = 0.005;
inline constexpr double kLeastDamping = 0.1;

}  // namespace flexarm::report
