#pragma once

#include "measured/files/foreign_table.hpp"

#include <span>
#include <string>
#include <vector>

namespace flexarm::measured {

/// Makes unknown the numbers that instruments write for what they could not measure
/// (`is_over_range`), and infinite ones. Returns a sentence on them that begins with `what`; empty
/// where there is none.
std::string take_out_over_range(ForeignColumn& column, const std::string& what);

/// A sentence on each usual sign of a missing sample, -9999 or -32768, that lies farther from the
/// other numbers of the column `name` than these from each other. Each begins with `what`.
std::vector<std::string> doubtful_signs(std::span<const double> values, const std::string& name,
                                        const std::string& what);

}  // namespace flexarm::measured
