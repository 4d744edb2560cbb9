#pragma once

#include "arm/range.hpp"

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

namespace flexarm::arm {

/// Bad input: a file, a command line or a parameter that cannot be used.
///
/// `what()` is the one line shown to the user; programs end with exit status 2 on it. A file's
/// reader puts `FILE:LINE: ` in front with `located`.
class InputError : public std::runtime_error {
 public:
  /// `key` is the dotted key that the line is about, where there is one.
  explicit InputError(const std::string& line, std::string key = "");

  /// The dotted key by which a file's reader finds the line: `beam.length`; may be empty.
  const std::string& key() const noexcept { return key_; }

 private:
  std::string key_;
};

/// "KEY = VALUE UNIT: must be ALLOWED", the line for a number out of its range.
/// `key` is dotted as in the arm file (`beam.length`); `unit` may be empty.
InputError out_of_range(const std::string& key, double value, const std::string& unit,
                        const std::string& allowed);

/// Throws `out_of_range` unless `range` contains `value`.
void require_in_range(const std::string& key, double value, const std::string& unit,
                      const Range& range);

/// The same error with "FILE:LINE: " in front; `line` 0 means the file as a whole.
InputError located(const InputError& error, const std::string& file, int line);

/// Text from a file as it may stand in an error: control characters and bytes outside ASCII that
/// are not UTF-8 as \xNN, cut off with "..." after about `longest` bytes.
std::string shown(std::string_view text, std::size_t longest = 60);

}  // namespace flexarm::arm
