#pragma once

#include "measured/files/atomic_file.hpp"

#include <span>
#include <string>

namespace flexarm::fmu {

/// A ZIP archive of the files, in their order, deflated. The same files give the same bytes: times
/// are those of 1 January 1980, the first that ZIP has. Throws std::runtime_error where the library
/// fails.
std::string zip_archive(std::span<const measured::NamedContent> files);

}  // namespace flexarm::fmu
