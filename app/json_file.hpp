#pragma once

#include <string>

namespace flexarm::app {

/// Whether `--json FILE` stands for standard output: `-`. A file of that name is `./-`.
bool is_standard_output(const std::string& json_file);

/// Writes a `--json` file; nothing for an empty name. On standard output the document stands
/// alone: app/main.cpp has taken the text away (`reserve_standard_output`).
void write_json(const std::string& json_file, const std::string& json);

}  // namespace flexarm::app
