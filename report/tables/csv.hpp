#pragma once

#include "report/tables/table.hpp"

#include <string>

namespace flexarm::report {

/// The table as CSV (RFC 4180 with '\n' line ends): one header line `name [unit]`, then the rows.
/// Doubles are the shortest text that reads back to the same bits; what is missing, NaN included,
/// is an empty cell; infinities are `inf` and `-inf`. Fields that hold a comma, a quote or a line
/// end are quoted. The caption is not written.
std::string to_csv(const Table& table);

}  // namespace flexarm::report
