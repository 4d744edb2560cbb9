#pragma once

#include "arm/deadline.hpp"
#include "arm/option_name.hpp"

#include <chrono>
#include <optional>

namespace flexarm::arm {

/// The end of work that began then and may take so many seconds: none without a limit, or with one
/// of decades. Throws InputError for a limit that is not above 0.
Deadline deadline_of(const std::optional<double>& limit_s,
                     std::chrono::steady_clock::time_point begun, const OptionSpelling& spelled);

}  // namespace flexarm::arm
