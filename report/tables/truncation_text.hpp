#pragma once

#include "arm/sensor.hpp"
#include "response/truncation.hpp"

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>

namespace flexarm::report {

/// "Truncation: 24 flexible modes chosen; estimated error 8.1e-05 of tip_acceleration (tolerance
/// 1e-04 of each sensor's signal)." The sensor is the one with the largest error.
std::string truncation_sentence(const response::Truncation& truncation,
                                std::span<const arm::Sensor> sensors);

/// "truncation" of docs/json.md.
nlohmann::ordered_json truncation_json(const response::Truncation& truncation,
                                       std::span<const arm::Sensor> sensors);

}  // namespace flexarm::report
