#pragma once

#include <stdexcept>
#include <string>

namespace flexarm::arm {

/// Bad input: a file, a command line or a parameter that cannot be used.
///
/// `what()` is the one line shown to the user; programs end with exit status 2 on it. A file's
/// reader puts `FILE:LINE: ` in front with `located`.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// "KEY = VALUE UNIT: must be ALLOWED", the line for a number out of its range.
/// `key` is dotted as in the arm file (`beam.length`); `unit` may be empty.
InputError out_of_range(const std::string& key, double value, const std::string& unit,
                        const std::string& allowed);

/// The same error with "FILE:LINE: " in front; `line` 0 means the file as a whole.
InputError located(const InputError& error, const std::string& file, int line);

}  // namespace flexarm::arm
