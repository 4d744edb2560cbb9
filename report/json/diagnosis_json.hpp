#pragma once

#include "diagnose/diagnosis.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace flexarm::report {

/// The content of `diagnose --json` (docs/formats.md); `extended_arm` is the file that holds the
/// extended arm, as seen from the JSON file, empty where none is written.
nlohmann::ordered_json diagnosis_json(const diagnose::Diagnosis& diagnosis,
                                      const std::string& extended_arm);

}  // namespace flexarm::report
