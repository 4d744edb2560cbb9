#pragma once

#include "measured/files/foreign_table.hpp"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace flexarm::measured {

/// Kinds of cells in a column of a segment; other is a comment.
enum class LabviewCell { x, channel, other };

/// A channel of a segment: its samples, and its X values, empty where it shares those of the first.
struct LabviewChannel {
  std::string name;
  std::string unit;  ///< canonical; empty: not told
  std::vector<double> values = {};
  std::vector<double> x = {};
};

/// Head, names and rows that one call of LabVIEW's "Write To Measurement File" wrote.
struct LabviewSegment {
  std::map<std::string, std::vector<std::string>, std::less<>> tags;  ///< of the head
  std::vector<std::string> names;                                     ///< of the columns
  std::vector<LabviewCell> cell_kinds;                                ///< of the columns
  std::vector<std::size_t> channel_of_cell;  ///< x: of the channel that it belongs to
  bool is_without_x = false;                 ///< X_Columns No
  std::vector<LabviewChannel> channels;
  std::vector<int> lines;  ///< a row each

  std::vector<double>& cells_of(std::size_t column) {
    LabviewChannel& channel = channels[channel_of_cell[column]];
    return cell_kinds[column] == LabviewCell::x ? channel.x : channel.values;
  }
};

/// Lays out the columns of a segment by the line of names below its head; `x_columns` is the tag of
/// that name, "No", "One" or "Multi". Throws InputError for a line without a channel.
void begin_labview_segment(LabviewSegment& segment, const std::vector<std::string>& names,
                           const std::string& x_columns);

/// The segments in one table, as `parse_labview_text` says; each has a row or more.
ForeignTable joined_labview_segments(std::vector<LabviewSegment> segments);

}  // namespace flexarm::measured
