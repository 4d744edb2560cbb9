#pragma once

#include "diagnose/diagnosis.hpp"

#include <filesystem>
#include <string>

namespace flexarm::report {

/// The document of `diagnose --json` (docs/json.md); `extended_arm` as in `diagnosis_json`.
std::string diagnosis_document(const diagnose::Diagnosis& diagnosis,
                               const std::string& extended_arm);

/// The file beside `json_file` that its extended arm is written to: out.json, out.extended.toml.
std::filesystem::path extended_arm_beside(const std::filesystem::path& json_file);

/// Writes the document and, where there is one, the extended arm beside it, each whole or not at
/// all. Throws InputError where they cannot be written.
void write_diagnosis(const diagnose::Diagnosis& diagnosis, const std::filesystem::path& json_file);

}  // namespace flexarm::report
