#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace flexarm::arm {

/// The items of a typed list A,B,C, as they stand; at least one, perhaps empty.
///
/// The comma separates items and is never a decimal comma. Throws InputError where it may be meant
/// as one: an item of digits continues a number of the item before it, and
/// - begins with 0 (0,05), or stands behind = or @ (strain@0,05, hub_angle=0,001), or
/// - the list consists of these two items (0,5 is 0.5 or two numbers; 0.0,5.0 and 0,5,10 are
///   lists).
/// The line names both readings and how to write each.
std::vector<std::string> list_items(std::string_view text);

/// The numbers of a typed list. Throws InputError as `list_items`, and for an item that is no
/// finite number.
std::vector<double> number_list(std::string_view text);

/// "; numbers have a decimal point: 8.925" for 8,925; empty for a text without a decimal comma.
std::string decimal_comma_hint(std::string_view text);

/// Whether `next`, which stands behind a comma, may be the digits behind a decimal comma of a
/// number that `before` ends with: "rms=0" and "05", "bands=2" and "5:3".
bool may_be_decimals(std::string_view before, std::string_view next);

}  // namespace flexarm::arm
