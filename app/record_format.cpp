#include "app/record_format.hpp"

#include "arm/input_error.hpp"
#include "measured/files/atomic_file.hpp"
#include "measured/files/record_export.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <utility>
#include <variant>
#include <vector>

namespace flexarm::app {

RecordFormat record_format(const std::string& file, std::string word) {
  const std::array<std::pair<const char*, RecordFormat>, 4> formats = {
      {{"csv", RecordFormat::csv},
       {"uff58", RecordFormat::uff58},
       {"uff58b", RecordFormat::uff58b},
       {"mat", RecordFormat::mat}}};
  const bool is_typed = !word.empty();
  const std::string typed = is_typed ? word : file;
  if (!is_typed) {
    const std::string extension = std::filesystem::path(file).extension().string();
    const bool is_universal = extension == ".uff" || extension == ".unv";
    word = is_universal ? "uff58" : extension.substr(extension.empty() ? 0 : 1);
  }
  std::vector<std::string> words;
  for (const auto& [name, format] : formats) {
    if (word == name) return format;
    words.emplace_back(name);
  }
  throw arm::InputError(fmt::format(
      "{} {}: must be {}{}", is_typed ? "--to" : "--save-as", arm::shown(typed),
      is_typed ? "" : "a .csv, .uff or .mat file, or used with --to ", fmt::join(words, " or ")));
}

void write_record(const measured::RunData& data, const std::filesystem::path& path,
                  RecordFormat format) {
  if (format == RecordFormat::csv) {
    measured::write_atomically(path, measured::format_run_data(data));
    return;
  }
  const auto* frequency = std::get_if<measured::FrequencyRecord>(&data);
  if (frequency != nullptr && frequency->input) {
    throw arm::InputError(fmt::format("--save-as: responses to {} are written as CSV only",
                                      arm::to_string(*frequency->input)));
  }
  const auto write = [&](const auto& record) {
    if (format == RecordFormat::mat) {
      measured::write_mat_file(measured::mat_variables(record), path);
    } else {
      measured::write_universal_file(measured::universal_functions(record), path,
                                     {.binary = format == RecordFormat::uff58b});
    }
  };
  if (const auto* time = std::get_if<measured::TimeRecord>(&data)) {
    write(*time);
  } else if (frequency != nullptr) {
    write(*frequency);
  } else {
    throw arm::InputError("--save-as: a modal table is written as CSV only");
  }
}

}  // namespace flexarm::app
