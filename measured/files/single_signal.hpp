#pragma once

#include "measured/files/foreign_table.hpp"
#include "measured/files/text_lines.hpp"

#include <optional>
#include <span>
#include <string_view>

namespace flexarm::measured {

/// The signal of a file of one number a row, and its times by the start and period in front of the
/// samples; nothing for a file of another kind, or one that tells no period. `sample` has the first
/// lines of `text`.
std::optional<ForeignTable> single_signal_table(std::span<const TextLine> sample,
                                                std::string_view text);

}  // namespace flexarm::measured
