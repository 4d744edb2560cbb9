#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace mu {
class ParserError;
}

namespace flexarm::arm {

// What the texts of formulas have in common, whichever names stand in them.

/// A number begins at `at`.
bool begins_number(std::string_view formula, std::size_t at);

/// The place behind the number that begins at `at`; "3e-2" is one, so that its e is no name.
std::size_t number_end(std::string_view formula, std::size_t at);

/// Why a formula cannot be parsed, where a name in it stands for `operand` ("a variable"); `place`
/// is that of the error in `formula`, or beyond its end.
std::string syntax_fault(const mu::ParserError& error, std::string_view operand,
                         std::string_view formula, std::size_t place);

}  // namespace flexarm::arm
