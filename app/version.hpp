#pragma once

#include <string>

namespace flexarm::app {

/// What `flexarm --version` prints: name and version, build, libraries; one a line.
std::string version_text();

}  // namespace flexarm::app
