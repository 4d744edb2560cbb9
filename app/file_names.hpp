#pragma once

#include "measured/files/atomic_file.hpp"

#include <string>
#include <vector>

namespace flexarm::app {

/// Adds a file whose name is made of names of the user's: what a file's name may not have, or not
/// well, becomes '_', a long one is cut, and one that is taken gets -2, -3, ... before its ending.
/// `name` has an ending.
void add_file(const std::string& name, std::string content,
              std::vector<measured::NamedContent>& files);

}  // namespace flexarm::app
