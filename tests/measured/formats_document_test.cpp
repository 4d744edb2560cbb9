#include "arm/arm_keys.hpp"
#include "effects/registry/vocabulary.hpp"
#include "measured/files/arm_file.hpp"
#include "measured/files/text_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::measured {
namespace {

using namespace arm;

constexpr std::size_t kLargestDocument_bytes = 1 << 20;

std::string document() {
  return read_text_file(FLEXARM_SOURCE_DIR "/docs/formats.md", kLargestDocument_bytes);
}

/// The lines of the first table under `heading`, without its two header lines.
std::vector<std::string> table_under(std::string_view heading) {
  const std::string text = document();
  std::vector<std::string> rows;
  for (auto at = text.find("\n| ", text.find(heading)); at != std::string::npos;) {
    const auto end = text.find('\n', at + 1);
    rows.push_back(text.substr(at + 1, end - at - 1));
    at = text.compare(end, 2, "\n|") == 0 ? end : std::string::npos;
  }
  if (rows.size() < 2) return {};
  rows.erase(rows.begin(), rows.begin() + 2);
  return rows;
}

std::string allowed(const Range& range) {
  if (std::isinf(range.minimum)) return "";
  return range.exclusive ? fmt::format("above {}", range.minimum)
                         : fmt::format("{} or more", range.minimum);
}

std::string row_of(const ArmKey& key) {
  const auto otherwise = key.default_value();
  return fmt::format("| `{}` | {} | {} | {} | {} | {} |", key.name(), key.symbol, key.unit,
                     allowed(key.range),
                     key.required ? "an error"
                     : otherwise  ? fmt::format("{}", *otherwise)
                                  : "unknown",
                     key.meaning);
}

TEST(FormatsDocument, ItsKeysAreThoseOfTheCode) {
  std::vector<std::string> expected;
  for (const auto& key : arm_keys()) expected.push_back(row_of(key));
  EXPECT_EQ(table_under("\n### Keys"), expected);
}

TEST(FormatsDocument, ItsArmFileIsReadAndWrittenBack) {
  const std::string text = document();
  const auto begin = text.find('\n', text.find("```toml")) + 1;
  const std::string example = text.substr(begin, text.find("```", begin) - begin);
  const Arm arm = parse_arm(example, "docs/formats.md", effects::vocabulary());
  EXPECT_EQ(arm.beam.length_m, 0.96);
  EXPECT_EQ(parse_arm(format_arm(arm), "again", effects::vocabulary()), arm);
}

}  // namespace
}  // namespace flexarm::measured
