#include "measured/files/arm_file.hpp"
#include "measured/files/file_kind.hpp"
#include "measured/files/toml_document.hpp"

#include <algorithm>
#include <string>

namespace flexarm::measured {

arm::Arm read_arm_file(const std::filesystem::path& path, const arm::Vocabulary& vocabulary) {
  return read_file_as(FileKind::arm, path, kLargestArmFile_bytes,
                      [&](const std::string& text, const std::string& file_name) {
                        return parse_arm(text, file_name, vocabulary);
                      });
}

bool is_unfilled_arm_file(const std::filesystem::path& path) {
  const toml::table document = read_file_as(FileKind::arm, path, kLargestArmFile_bytes, parse_toml);
  return std::ranges::all_of(document, [](const auto& entry) {
    const toml::table* table = entry.second.as_table();
    return entry.first == "name" || (table != nullptr && table->empty());
  });
}

}  // namespace flexarm::measured
