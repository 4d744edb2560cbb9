#pragma once

#include "measured/files/column_guess.hpp"

#include <span>
#include <string>
#include <vector>

namespace flexarm::importing {

/// A sentence on each mapping that reads a column in another unit than the file tells of it. A
/// scale that is the whole conversion into SI, or that of a unit which the quantity does not have,
/// contradicts nothing, nor does an expression with a number of its own.
std::vector<std::string> unit_contradictions(const measured::ColumnMappings& mappings,
                                             std::span<const measured::ColumnLabel> columns);

}  // namespace flexarm::importing
