#pragma once

#include <string_view>

namespace flexarm::compare::paper {

/// The text of data/paper/table_1.csv to table_7.csv, built into the program.
extern const std::string_view kTable1Csv;
extern const std::string_view kTable2Csv;
extern const std::string_view kTable3Csv;
extern const std::string_view kTable4Csv;
extern const std::string_view kTable5Csv;
extern const std::string_view kTable6Csv;
extern const std::string_view kTable7Csv;

}  // namespace flexarm::compare::paper
