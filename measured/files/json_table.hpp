#pragma once

#include "measured/files/foreign_table.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace flexarm::measured {

/// What a JSON file holds: the columns, and names of what is none.
struct JsonTable {
  ForeignTable table;
  std::vector<std::string> left_out;  ///< "NAME: what it is"
};

/// Whether a text is JSON: it begins with { or [ .
bool is_json(std::string_view bytes);

/// Reads the tables that programs write as JSON:
///
/// - a list of objects, one a sample, `[{"time": 0, "torque": 0.1}, ...]`, or an object a line;
/// - an object of lists, `{"time": [0, ...], "torque": [0.1, ...]}`;
/// - what pandas writes: `columns` and `data`, `{"time": {"0": 0, ...}, ...}`,
///   `{"0": {"time": 0, ...}, ...}`;
/// - a list of lists, of which the first may hold the names;
/// - a list of named signals (measured/files/json_signals.hpp).
///
/// Without times, a period and a start among the single values make them: `dt`, `fs`, `t0`.
/// What is in objects within objects is named "run.time". null, NaN and what a sample does not have
/// are empty cells. Throws InputError `FILE: what is wrong` for a text that is no JSON, and for one
/// without a list of numbers.
JsonTable parse_json_table(std::string_view text, const std::string& file_name);

}  // namespace flexarm::measured
