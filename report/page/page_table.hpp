#pragma once

#include "report/page/page_document.hpp"
#include "report/tables/table.hpp"

#include <string>

namespace flexarm::report::page {

/// A table of the text report as a block: cells with the digits of the text, and in words.
/// Columns without any value are left out.
TableBlock table_block(const Table& table, const std::string& id, const std::string& caption = "");

/// The same added to a section, unless the table has no rows.
void add_table(Section& section, const Table& table, const std::string& id,
               const std::string& caption = "");

}  // namespace flexarm::report::page
