#pragma once

#include "export/samples/sampled_state_space.hpp"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace flexarm::samples {

/// What a file of samples holds.
struct SampleExport {
  ParameterPosterior posterior;
  ArmSamples samples;
  SampledStateSpace state_space;
  std::uint64_t seed = 1;
  std::vector<std::string> left_out_effects = {};  ///< of all sets, those that are not linear
};

/// `flexarm.state_space_samples/1` without its schema (docs/json.md).
nlohmann::ordered_json samples_json(const SampleExport& exported);

/// A MATLAB 5 file of the same, written whole or not at all (docs/export.md): A, B, C and D are
/// arrays of three dimensions, sample after sample along the last. The same samples give the same
/// bytes. Throws InputError where it cannot be written.
void write_samples_mat(const SampleExport& exported, const std::filesystem::path& path);

}  // namespace flexarm::samples
