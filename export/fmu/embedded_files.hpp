#pragma once

#include <string_view>
#include <vector>

namespace flexarm::fmu {

/// A file that the build has put into the program.
struct EmbeddedFile {
  std::string_view name;  ///< where it goes in an FMU
  std::string_view content;
};

/// The shared library that every FMU of this platform has, and is the same in all.
std::string_view fmu_library();

/// Sources of that library, below sources/, with what builds them against an installed flexarm; and
/// the licence.
std::vector<EmbeddedFile> fmu_files();

/// The folder of the library in an FMU: "binaries/linux64" in FMI 2.0, "binaries/x86_64-linux" in
/// FMI 3.0.
inline constexpr std::string_view kFmi2Platform = FLEXARM_FMI2_PLATFORM;
inline constexpr std::string_view kFmi3Platform = FLEXARM_FMI3_PLATFORM;

}  // namespace flexarm::fmu
