#pragma once

#include "compare/identification.hpp"
#include "measured/run_identification.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace flexarm::report {

/// The content of `identify --json` but for the arm: runs, conditions, readings, fits
/// (docs/json.md).
nlohmann::ordered_json identification_json(
    const measured::Identification& identification,
    const std::vector<compare::IdentifiedCondition>& conditions);

/// The document of `identify --json` (docs/json.md): of a measurement by its name, on an arm.
std::string identification_document(const std::string& measurement,
                                    const std::optional<arm::Arm>& arm,
                                    const measured::Identification& identification,
                                    const std::vector<compare::IdentifiedCondition>& conditions);

}  // namespace flexarm::report
