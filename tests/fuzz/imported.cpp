#include "tests/fuzz/imported.hpp"

#include "measured/files/column_guess.hpp"
#include "measured/files/column_mapping.hpp"
#include "measured/files/complete_rows.hpp"
#include "measured/files/even_record.hpp"
#include "measured/files/frequency_record.hpp"
#include "measured/files/time_record.hpp"
#include "tests/fuzz/contract.hpp"

#include <string>
#include <vector>

namespace flexarm::fuzz {

namespace {

using measured::ColumnLabel;
using measured::ForeignFile;

constexpr const char* kFile = "file";

void import_signals(const ForeignFile& file) {
  measured::ForeignTable table = file.table;
  const measured::ColumnGuess guess = measured::guess_columns(measured::labels_of(table), {});
  for (const auto& note : guess.notes) require_clean_line(note);
  for (const auto& question : guess.questions) require_clean_line(question.sentence);
  const auto kept = measured::keep_complete_rows(table, guess.mappings, nullptr, {});
  for (const auto& note : kept.notes) require_clean_line(note);
  const measured::TimeRecord uneven = measured::uneven_record_of(table, guess.mappings, kFile);
  for (const auto& record : measured::make_even(uneven).stretches) {
    require(measured::parse_time_record(measured::format_time_record(record), kFile) == record,
            "a time record is not read back as it was written");
  }
}

void import_responses(const ForeignFile& file) {
  std::vector<ColumnLabel> labels;
  for (const auto& response : file.responses) labels.push_back({response.name, response.unit});
  const measured::ColumnGuess guess = measured::guess_columns(labels, {});
  for (const auto& note : guess.notes) require_clean_line(note);
  const measured::FrequencyRecord record =
      measured::frequency_record_of(file, guess.mappings, kFile);
  require(
      measured::parse_frequency_record(measured::format_frequency_record(record), kFile) == record,
      "a frequency record is not read back as it was written");
}

}  // namespace

void import_contents(const ForeignFile& file) {
  for (const auto& sentence : file.table.assumptions) require_clean_line(sentence);
  returns_or_refuses([&] { import_signals(file); });
  if (!file.responses.empty()) returns_or_refuses([&] { import_responses(file); });
}

}  // namespace flexarm::fuzz
