#pragma once

#include "arm/range.hpp"

#include <toml++/toml.h>

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace flexarm::measured {

/// Gathers the faults of a TOML document that is walked once, so that the first in the file is
/// reported, and what is missing after what is wrong.
class TomlFaults {
 public:
  explicit TomlFaults(std::string file_name) : file_name_(std::move(file_name)) {}

  static int line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

  void fault(int line, const std::string& what) { faults_.emplace(line, what); }
  /// "KEY = VALUE: a number; must be ALLOWED": for a value of the wrong type.
  void wrong(const std::string& key, const toml::node& node, const std::string& allowed);
  /// "PREFIXKEY = VALUE: unknown key (did you mean ...?); allowed: ..."
  void unknown(const std::string& prefix, const std::string& key, const toml::node& node,
               const std::vector<std::string>& allowed);
  /// A fault at `line` unless `table` has `leaf`. A key that is misspelt is reported as that, and
  /// not as missing.
  void require(const toml::table& table, int line, const char* key, const char* leaf,
               const char* what);

  /// A text that is not empty; `what` it must be: "a name in quotes".
  void read_text(const std::string& key, const toml::node& node, const char* what,
                 std::string& text);
  /// Which of `words` stands there; nothing, with a fault, where none does.
  std::optional<std::size_t> read_word(const std::string& key, const toml::node& node,
                                       std::span<const std::string> words);
  void read_number(const std::string& key, const toml::node& node, const char* unit,
                   const arm::Range& range, double& number);

  /// Throws InputError `FILE:LINE: ...` with the first fault, where there is one.
  void throw_first() const;

 private:
  using Faults = std::multimap<int, std::string>;  // by line; equal lines in the order found

  std::string file_name_;
  Faults faults_;
  Faults missing_;
};

}  // namespace flexarm::measured
