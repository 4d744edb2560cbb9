#pragma once

#include "response/frequency/response_study.hpp"

#include <filesystem>

namespace flexarm::app {

/// Throws arm::InputError for an extension other than .json, .csv and .mat, and for a file that
/// cannot be written: before the work, not after it.
void require_state_space_file(const std::filesystem::path& path);

/// The state space of a study that has one, in the format that the extension names.
void write_state_space(const response::ResponseStudy& study, const std::filesystem::path& path);

}  // namespace flexarm::app
