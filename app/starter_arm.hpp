#pragma once

#include "arm/arm.hpp"

#include <string>

namespace flexarm::app {

/// The paper's arm by dimensions and material: a starter in which one number may be changed without
/// a second one that must agree.
arm::Arm starter_arm(const std::string& name);

/// An arm file of it that explains every key.
std::string starter_text(const std::string& name);

/// An arm file that explains every key and gives none: reading it fails with the first
/// required key, so that no command takes another arm for the one that was measured.
std::string unfilled_text();

}  // namespace flexarm::app
