#pragma once

#include <filesystem>
#include <string_view>

namespace flexarm::fmu {

/// The folder of a location as FMI 2.0 gives it: "file:///tmp/a%20b/resources",
/// "file:/tmp/resources", "file://localhost/tmp/resources"; a path as it stands, too. Throws
/// InputError for other locations.
std::filesystem::path folder_of_location(std::string_view location);

}  // namespace flexarm::fmu
