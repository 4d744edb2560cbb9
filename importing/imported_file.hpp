#pragma once

#include "arm/controller.hpp"
#include "importing/column_choice.hpp"
#include "measured/files/foreign_file.hpp"
#include "measured/files/run_data.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::importing {

/// How a foreign file is read.
struct FileChoice {
  std::optional<measured::RunKind> kind;  ///< empty: that of what the file holds
  ColumnChoice columns;
  std::optional<arm::Controller> controller;  ///< given if and only if the reference is typed
  std::optional<double> period_s;             ///< makes the times of a file without any
  std::optional<std::size_t> raw_columns;     ///< of a file of doubles
  bool is_one_of_several = false;             ///< files, which may be of one run
};

/// What a foreign file was read as, and how.
struct ImportedFile {
  std::string file;
  std::string format;  ///< "delimited text", ...
  measured::RunKind kind = measured::RunKind::time;
  measured::RunData data;                    ///< a time record may be uneven
  std::vector<std::size_t> rows;             ///< of its samples in the file, from 0; empty: all
  std::optional<double> start_s;             ///< of the file, where its first row is incomplete
  std::optional<double> period_s;            ///< of the file's grid, where rows are left out of it
  bool is_driven_before = false;             ///< a torque acts in the file before the first sample
  measured::ColumnMappings columns;          ///< that were used
  std::optional<ReferenceColumn> reference;  ///< of a time record in closed loop
  std::vector<std::string> assumptions;      ///< a sentence each
  std::vector<std::string> warnings;         ///< a sentence each
  std::vector<std::string> not_used;         ///< columns and what else the file holds
};

/// A foreign file as it stands.
struct ReadFile {
  std::string file;
  std::string format;  ///< "delimited text", ...
  measured::ForeignFile contents;
};

/// Reads a file. Throws InputError with one line, as the readers do.
ReadFile read_file(const std::string& file, const FileChoice& choice);

/// Adds times from 0 s on, in place of those that a head tells. Throws InputError for a period that
/// is not above 0.
void add_times(measured::ForeignTable& table, double period_s);

/// Takes columns for quantities. Throws InputError with one line for a file of two kinds, and, with
/// the columns found, where time or torque cannot be told or nothing is a sensor.
ImportedFile import_file(ReadFile read, const FileChoice& choice);

}  // namespace flexarm::importing
