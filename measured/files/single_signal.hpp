#pragma once

#include "measured/files/foreign_table.hpp"
#include "measured/files/text_lines.hpp"

#include <optional>
#include <span>
#include <string_view>

namespace flexarm::measured {

/// The signal of a file of one number in each of ten rows or more, and its times where the lines in
/// front of them tell a period; nothing for a file of another kind. `sample` has the first lines of
/// `text`.
std::optional<ForeignTable> single_signal_table(std::span<const TextLine> sample,
                                                std::string_view text);

}  // namespace flexarm::measured
