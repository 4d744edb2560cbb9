#pragma once

#include "app/option_tree.hpp"

#include <string>
#include <vector>

namespace flexarm::app {

/// What a shell offers for the value of an option or for a positional argument.
struct OptionValues {
  enum class Kind { none, words, file, folder };
  Kind kind = Kind::none;
  std::vector<std::string> words = {};
};

/// CLI11's type name of an option that takes a file, where its name says otherwise.
inline constexpr const char* kFileType = "FILE";

/// By the option's name: the words that it takes; a folder for `--out`, unless it is declared as a
/// file; a file for any other text; nothing for a number, a flag, and text of the user's own.
OptionValues values_of(const OptionDescription& option);

/// What help and manual call its value: "FILE", "NUMBER,..."; empty for a flag.
std::string value_name(const OptionDescription& option);
/// Its text with the default behind it, where the text does not say it.
std::string text_with_default(const OptionDescription& option);

}  // namespace flexarm::app
