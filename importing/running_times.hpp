#pragma once

#include "measured/files/foreign_table.hpp"

#include <string>
#include <vector>

namespace flexarm::importing {

/// Throws InputError for times that are all equal, or fall in most rows of `table`.
void require_running(const std::vector<double>& times_s, const measured::ForeignTable& table);

/// Sentences on columns among `not_used` that are a second time which runs beside the one that is
/// used, as that of a signal may.
std::vector<std::string> second_clocks(const measured::ForeignTable& table,
                                       const std::vector<double>& times_s,
                                       const std::vector<std::string>& not_used);

}  // namespace flexarm::importing
