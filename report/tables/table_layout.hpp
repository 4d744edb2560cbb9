#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace flexarm::report {

/// A column of a table that is too wide for one block.
struct LayoutColumn {
  std::size_t width = 0;
  bool joined = false;  ///< belongs to the column before it
};

/// Parts consecutive columns into blocks of at most `room` characters, with `gap` characters
/// between columns; a column wider than `room` gets a block of its own. Of all partitions the one
/// with the fewest blocks of a single column is taken; among these the one that parts the fewest
/// joined columns, then the one with the fewest blocks, then the one with the most even widths.
/// Returns the number of columns of each block.
std::vector<std::size_t> balanced_blocks(std::span<const LayoutColumn> columns, std::size_t room,
                                         std::size_t gap);

}  // namespace flexarm::report
