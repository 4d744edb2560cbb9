#include "measured/files/arm_file.hpp"
#include "measured/files/file_kind.hpp"

#include <string>

namespace flexarm::measured {

arm::Arm read_arm_file(const std::filesystem::path& path, const arm::Vocabulary& vocabulary) {
  return read_file_as(FileKind::arm, path, kLargestArmFile_bytes,
                      [&](const std::string& text, const std::string& file_name) {
                        return parse_arm(text, file_name, vocabulary);
                      });
}

}  // namespace flexarm::measured
