#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace flexarm::measured {

/// Characters of a unit: a longer text is none.
inline constexpr std::size_t kLongestUnit = 64;

/// The canonical name of a unit in any usual spelling; empty for one that is not known.
///
/// A unit is a word of the table ("rad", "radians", "dps", "Nm", ...), or words multiplied (blank,
/// * . - _ or a middle dot), divided (/ or per) and raised (^2, **2, 2, s-1): "rads/s",
/// "deg.s^-1", "m s-2", "N-m", "degrees per second". Case counts where it tells units apart (mN and
/// MN); otherwise words of more than one letter may be in capitals.
std::string find_unit(std::string_view text);

/// The text with signs beyond ASCII written in plain ones: "*" for a multiplication sign, "^2" for
/// a superscript, "deg" for a degree sign.
std::string in_plain_signs(std::string_view text);

/// Whether the unit is a canonical one.
bool is_canonical_unit(std::string_view unit);

}  // namespace flexarm::measured
