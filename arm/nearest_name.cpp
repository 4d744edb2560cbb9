#include "arm/nearest_name.hpp"

#include "arm/input_error.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace flexarm::arm {

namespace {

/// A longer name is not looked for: the distance takes time and memory of the product of lengths.
constexpr std::size_t kLongestName_bytes = 256;

/// Optimal string alignment distance (Damerau-Levenshtein without overlapping swaps).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitution = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + substitution});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
      }
    }
  }
  return d[a.size()][b.size()];
}

/// Whether `name` is of several words, joined by "_", and `typed` the first or the last.
bool is_end_word(std::string_view typed, std::string_view name) {
  if (typed.empty() || typed.size() >= name.size()) return false;
  return (name.starts_with(typed) && name[typed.size()] == '_') ||
         (name.ends_with(typed) && name[name.size() - typed.size() - 1] == '_');
}

}  // namespace

std::optional<std::string> nearest_name(std::string_view typed,
                                        std::span<const std::string> names) {
  std::optional<std::string> nearest;
  std::size_t smallest = 0;
  for (const auto& name : names) {
    // The distance is at least the difference in length, which spares the table for long input.
    const auto [shorter, longer] = std::minmax({typed.size(), name.size()});
    if (3 * (longer - shorter) > longer || longer > kLongestName_bytes) continue;
    const std::size_t distance = edit_distance(typed, name);
    if (3 * distance > longer) continue;
    if (!nearest || distance < smallest) {
      nearest = name;
      smallest = distance;
    }
  }
  if (nearest) return nearest;
  for (const auto& name : names) {
    if (!is_end_word(typed, name)) continue;
    if (nearest) return std::nullopt;
    nearest = name;
  }
  return nearest;
}

std::string did_you_mean(std::string_view typed, std::span<const std::string> names) {
  const auto nearest = nearest_name(typed, names);
  return nearest ? " (did you mean " + shown(*nearest) + "?)" : "";
}

}  // namespace flexarm::arm
