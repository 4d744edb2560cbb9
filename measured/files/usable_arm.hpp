#pragma once

#include "arm/arm.hpp"

#include <filesystem>

namespace flexarm::measured {

/// Throws InputError for an arm that no formulation takes: one that is not computable, or without a
/// beam not valid.
void require_usable(const arm::Arm& arm);

/// Reads an arm file as read_arm_file. Throws InputError `FILE: ...` for an arm that is
/// not usable.
arm::Arm read_usable_arm(const std::filesystem::path& path, const arm::Vocabulary& vocabulary);

}  // namespace flexarm::measured
