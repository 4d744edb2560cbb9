#pragma once

#include "arm/arm.hpp"

#include <nlohmann/json.hpp>

#include <complex>
#include <optional>

namespace flexarm::report {

/// The numbers that define an arm, its effects beside them, and total inertia and ratios, which
/// follow from both; units in the keys.
nlohmann::ordered_json arm_json(const arm::Arm& arm);

/// The number, or null.
nlohmann::ordered_json number_json(const std::optional<double>& value);

/// {"re": ..., "im": ...}, or null.
nlohmann::ordered_json complex_json(const std::optional<std::complex<double>>& value);

}  // namespace flexarm::report
