#pragma once

#include "arm/arm.hpp"

#include <string>
#include <vector>

namespace flexarm::arm {

/// Numbers of a valid arm that no beam or material has, a sentence each without a full stop: most
/// are in another unit than the file's. The ranges are those of docs/formats.md, "Plausibility".
/// None is an error.
std::vector<std::string> plausibility_notes(const Arm& arm);

}  // namespace flexarm::arm
