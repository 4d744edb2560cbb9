#pragma once

#include "measured/files/foreign_table.hpp"
#include "measured/files/keyed_units.hpp"

#include <span>
#include <string>
#include <vector>

namespace flexarm::measured {

/// A single number of a JSON or MATLAB file.
struct JsonNumber {
  std::string key;
  std::string text;      ///< "500", "500 Hz", or no number
  std::string left_out;  ///< the phrase on it among those of what is no column
};

/// Adds times by a period or rate and a start among the numbers, `dt`, `fs`, `t0`, to a table
/// without any, and takes the phrases on those from `left_out`. Where they tell several periods,
/// there are no times, and a sentence says so.
void add_json_times(ForeignTable& table, std::span<const JsonNumber> numbers,
                    std::span<const KeyedUnit> units, std::vector<std::string>& left_out);

}  // namespace flexarm::measured
