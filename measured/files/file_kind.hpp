#pragma once

#include "arm/input_error.hpp"
#include "measured/files/text_file.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace flexarm::measured {

/// What a reader takes.
enum class FileKind {
  arm,
  measurement,
  plan,
  campaign,
  controller,
  time_record,
  frequency_record,
  modal_table,
  log,     ///< a table of numbers of another program, in any format that `flexarm import` reads
  result,  ///< JSON of a command
  other    ///< what no command reads
};

/// A file by what it holds.
struct RecognisedFile {
  FileKind kind = FileKind::other;
  std::string is;   ///< "is a measurement"
  std::string way;  ///< what to do with it, a clause: "flexarm diagnose takes it"
};

/// Recognises a file of flexarm, a log, or a format of another program by its bytes; nothing where
/// it may be anything.
std::optional<RecognisedFile> recognise_file(std::string_view bytes);

/// "must be an arm file", of what a reader takes.
std::string requirement(FileKind due);

/// The error in place of `error` where the bytes are those of a file of another kind than is due:
/// "FILE: is a measurement; must be an arm file; flexarm diagnose takes it". `required` stands in
/// the place of `requirement(due)` where it is given: other kinds are taken as well.
arm::InputError wrong_file(std::string_view bytes, const std::string& file_name, FileKind due,
                           const arm::InputError& error, const std::string& required = {});

/// Reads a file as `parse(text, file_name)` does. Throws InputError as it and `read_text_file` do,
/// or `wrong_file`.
template <class Parse>
auto read_file_as(FileKind due, const std::filesystem::path& path, std::size_t largest_bytes,
                  const Parse& parse, const std::string& required = {}) {
  const std::string text = read_text_file(path, largest_bytes);
  const std::string file_name = arm::shown(path.string());
  try {
    return parse(text, file_name);
  } catch (const arm::InputError& error) {
    throw wrong_file(text, file_name, due, error, required);
  }
}

}  // namespace flexarm::measured
