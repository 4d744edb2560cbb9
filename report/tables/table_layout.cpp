#include "report/tables/table_layout.hpp"

#include <algorithm>
#include <compare>
#include <optional>

namespace flexarm::report {
namespace {

/// What a partition is judged by, in this order.
struct PartitionCost {
  std::size_t single_columns = 0;
  std::size_t parted = 0;
  std::size_t blocks = 0;
  std::size_t squared_widths = 0;  ///< smallest where the widths are even

  auto operator<=>(const PartitionCost&) const = default;
};

/// The best partition of the columns in front of one.
struct BestPartition {
  PartitionCost cost;
  std::size_t last_block = 0;  ///< its columns
};

}  // namespace

std::vector<std::size_t> balanced_blocks(std::span<const LayoutColumn> columns, std::size_t room,
                                         std::size_t gap) {
  // best[n] is that of the first n columns; each is made of a shorter one and a last block.
  std::vector<std::optional<BestPartition>> best(columns.size() + 1);
  best[0] = BestPartition{};
  for (std::size_t end = 1; end <= columns.size(); ++end) {
    std::size_t width = 0;
    for (std::size_t count = 1; count <= end; ++count) {
      const std::size_t begin = end - count;
      width += columns[begin].width + (count > 1 ? gap : 0);
      if (width > room && count > 1) break;
      PartitionCost cost = best[begin]->cost;
      cost.single_columns += count == 1 ? 1U : 0U;
      cost.parted += columns[begin].joined && begin > 0 ? 1U : 0U;
      cost.blocks += 1;
      cost.squared_widths += width * width;
      if (!best[end] || cost < best[end]->cost) best[end] = BestPartition{cost, count};
    }
  }
  std::vector<std::size_t> blocks;
  for (std::size_t end = columns.size(); end > 0; end -= blocks.back()) {
    blocks.push_back(best[end]->last_block);
  }
  std::ranges::reverse(blocks);
  return blocks;
}

}  // namespace flexarm::report
