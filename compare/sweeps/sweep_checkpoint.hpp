#pragma once

#include "compare/sweeps/sweep.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace flexarm::compare {

/// What makes two sweeps the same, in words: name and value. A checkpoint holds them.
struct FingerprintLine {
  std::string name;  ///< "arm", "grid", "models", "questions", "version"
  std::string value;

  bool operator==(const FingerprintLine&) const = default;
};
std::vector<FingerprintLine> fingerprint(const SweepTask& task, const std::string& version);

/// A computed point as it is written.
struct CheckpointEntry {
  std::size_t model = 0;
  std::size_t point = 0;
  const SweepPoint* values = nullptr;
};

/// A computed point as it is read.
struct StoredPoint {
  std::size_t model = 0;
  std::size_t point = 0;
  SweepPoint values;
};

/// Writes `entries` to `path`, whole or not at all.
///
/// A line of JSON (schema, fingerprint, count, checksum), then the entries as doubles in this
/// machine's representation: a checkpoint is for going on where it was written.
/// Throws InputError as measured::write_atomically.
void write_checkpoint(const std::filesystem::path& path,
                      const std::vector<FingerprintLine>& fingerprint,
                      const std::vector<CheckpointEntry>& entries);

/// Throws InputError with the file's name when it cannot be read, is damaged, or is of another
/// sweep: with the first line of the fingerprint that differs.
std::vector<StoredPoint> read_checkpoint(const std::filesystem::path& path,
                                         const std::vector<FingerprintLine>& fingerprint);

}  // namespace flexarm::compare
