#pragma once

#include "measured/files/run_data.hpp"

#include <filesystem>
#include <string>

namespace flexarm::app {

/// How a record is written to a file of its own.
enum class RecordFormat { csv, uff58, uff58b, mat };

/// The format that `word` (`--to`) names; of an empty word, that of the file's extension. Throws
/// InputError for any other.
RecordFormat record_format(const std::string& file, std::string word);

/// Throws InputError for a modal table in any format but CSV.
void write_record(const measured::RunData& data, const std::filesystem::path& path,
                  RecordFormat format);

}  // namespace flexarm::app
