#pragma once

#include "measured/files/time_record.hpp"

#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::measured {

/// A part of a record: by rows, counted from 1, or by times in seconds as the record has them; both
/// ends included.
struct RecordRange {
  bool by_rows = false;
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();
};

/// "2:10", "2:" and ":10" as a range of times, or of rows. Throws InputError for any other text,
/// and for an end before its beginning.
RecordRange parse_range(std::string_view text, bool by_rows);

/// The samples [first, last) of the record.
TimeRecord samples_of(const TimeRecord& record, std::size_t first, std::size_t last);

/// The samples in the range, from the first to the last whose row or time is in it; `first` is set
/// to the first one. `rows` has the row of each sample in its file, from 0; empty: every row is
/// one. Throws InputError, with what the record has, where the samples are fewer than two.
TimeRecord part_of(const TimeRecord& record, const RecordRange& range, std::size_t& first,
                   std::span<const std::size_t> rows = {});

}  // namespace flexarm::measured
