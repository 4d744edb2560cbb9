#pragma once

#include <span>
#include <string>
#include <string_view>

namespace flexarm::measured {

/// Words in use for a quantity in the headers of logs: English, German, French. As `plain_letters`
/// has them, none twice.
struct QuantityWords {
  std::string_view quantity;  ///< standard name
  std::span<const std::string_view> words;
  /// Of words that are the quantity only in a unit of it, and where no other column is.
  bool needs_unit = false;
};

/// The words of names that tell a quantity, whatever else the file says.
std::span<const QuantityWords> quantity_words();

/// Words that tell what was measured, but not as which quantity it is to be read.
struct OpenWords {
  std::span<const std::string_view> words;
  std::span<const std::string_view> units;  ///< canonical; a column in another is none of these
  std::string_view meaning;                 ///< "a motor current"
  std::string_view option;                  ///< that states what it is; {0} is the column's name
  bool may_be_torque = false;
};

std::span<const OpenWords> open_words();

/// The word of a name that says that a torque is not that of the motor, "limit" of "torque limit";
/// empty in a name without.
std::string other_torque_word(std::string_view name);

/// Whether a field holds a signal and says nothing of it: "torque.signals.values" is "torque".
bool is_holder(std::string_view field);

/// The letters of a name in lower case, without anything else: umlauts as two letters (ae, ss),
/// other accents taken off.
std::string plain_letters(std::string_view name);

}  // namespace flexarm::measured
