#pragma once

#include "export/fmu/fmu_export.hpp"
#include "export/samples/sample_files.hpp"
#include "report/tables/text_table.hpp"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <string>

namespace flexarm::app {

/// The variables of an FMU.
report::Table fmu_table(const fmu::FmuDescription& description);
nlohmann::ordered_json fmu_json(const fmu::FmuDescription& description, int fmi,
                                const std::string& file);

/// Throws arm::InputError for an extension other than .json and .mat, and for a file that cannot be
/// written: before the work, not after it.
void require_samples_file(const std::filesystem::path& path);

/// Draws the samples and computes their state spaces, with a line of progress.
samples::SampleExport sample_state_spaces(const samples::ParameterPosterior& posterior,
                                          const samples::StateSpaceSettings& settings, int count,
                                          std::uint64_t seed);

/// In the format that the extension names.
void write_samples(const samples::SampleExport& made, const std::filesystem::path& path);

/// Tables of the sets of effects and the numbers sampled, and notes of what is left out.
std::string samples_text(const samples::SampleExport& made);
nlohmann::ordered_json samples_summary_json(const samples::SampleExport& made,
                                            const std::string& file);

}  // namespace flexarm::app
