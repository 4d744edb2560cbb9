#include "measured/files/labview_text.hpp"

#include "arm/input_error.hpp"
#include "measured/files/column_name.hpp"
#include "measured/files/column_words.hpp"
#include "measured/files/delimited_line.hpp"
#include "measured/files/labview_segment.hpp"
#include "measured/files/record_constants.hpp"
#include "measured/files/text_lines.hpp"
#include "measured/files/time_stamp.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace flexarm::measured {

namespace {

using arm::InputError;
using std::string_view;

constexpr string_view kMark = "LabVIEW Measurement";
constexpr string_view kEndOfHeader = "***End_of_Header***";
constexpr string_view kStartSpecial = "***Start_Special***";
constexpr string_view kEndSpecial = "***End_Special***";

/// Tags that begin a line of the head of a segment.
bool is_segment_tag(string_view cell) {
  constexpr std::array<string_view, 19> kTags = {"Channels",
                                                 "Samples",
                                                 "Date",
                                                 "Time",
                                                 "Notes",
                                                 "Test_Name",
                                                 "Test_Number",
                                                 "Test_Numbers",
                                                 "Test_Series",
                                                 "UUT_M/N",
                                                 "UUT_S/N",
                                                 "UUT_Name",
                                                 "Model_Number",
                                                 "Serial_Number",
                                                 "Y_Unit_Label",
                                                 "Y_Dimension",
                                                 "X_Unit_Label",
                                                 "X_Dimension",
                                                 "X0"};
  return cell == "Delta_X" || std::ranges::count(kTags, cell) > 0;
}

/// Numbers with a decimal point, or a comma where cells are separated by something else, whatever
/// Decimal_Separator tells: files of version 1 do not tell, and write both.
std::optional<double> number_in(string_view cell, char separator) {
  if (const auto value = parse_cell(cell, '.')) return value;
  return separator == ',' ? std::nullopt : parse_cell(cell, ',');
}

/// Reads the segments of a file line by line.
class SegmentReader {
 public:
  explicit SegmentReader(string_view text) : lines_(text) {
    const std::size_t at = text.find("\nSeparator");
    constexpr std::size_t kTagSize = 10;
    if (at != string_view::npos && at + kTagSize < text.size()) separator_ = text[at + kTagSize];
    if (separator_ == '\n' || separator_ == '\r') separator_ = '\t';
    splitter_ = LineSplitter(separator_);
  }

  /// The line that an error is about.
  int line() const { return line_.number; }

  std::vector<LabviewSegment> read() {
    bool is_special = false;
    while (lines_.next(line_)) {
      const string_view text = trimmed(line_.text);
      if (text.starts_with(kStartSpecial)) is_special = true;
      if (!is_special) read_line();
      if (text.starts_with(kEndSpecial)) is_special = false;
    }
    std::erase_if(segments_, [](const LabviewSegment& segment) { return segment.lines.empty(); });
    return std::move(segments_);
  }

 private:
  enum class Part { file_head, between, segment_head, names, rows };

  void read_line() {
    if (is_blank_line(line_.text)) return;
    cells_ = splitter_.split(line_.text);
    if (std::ranges::all_of(cells_, &string_view::empty)) return;
    const string_view first = cells_.front();
    if (first.starts_with(kMark)) {
      part_ = Part::file_head;
    } else if (first == kEndOfHeader) {
      part_ = part_ == Part::file_head ? Part::between : Part::names;
    } else if (part_ == Part::file_head) {
      if (cells_.size() > 1) file_tags_[std::string(first)] = cells_[1];
    } else if (part_ != Part::names && is_segment_tag(first)) {
      if (part_ != Part::segment_head) segments_.emplace_back();
      part_ = Part::segment_head;
      segments_.back().tags[std::string(first)] = {cells_.begin() + 1, cells_.end()};
    } else if (part_ == Part::rows) {
      read_row();
    } else if (part_ == Part::names || part_ == Part::between) {
      read_names();
    }
  }

  void read_names() {
    if (segments_.empty() || !segments_.back().channels.empty()) segments_.emplace_back();
    LabviewSegment& segment = segments_.back();
    part_ = Part::rows;
    cells_before_ = 0;
    const bool is_row = std::ranges::all_of(cells_, [&](string_view cell) {
      return cell.empty() || number_in(cell, separator_).has_value();
    });
    std::vector<std::string> names(cells_.begin(), cells_.end());
    while (!names.empty() && names.back().empty()) names.pop_back();
    if (is_row) {
      for (std::size_t i = 0; i < names.size(); ++i) {
        names[i] = i == 0 ? "X_Value" : fmt::format("column {}", i + 1);
      }
    }
    if (names.size() > kMostRecordColumns) {
      throw InputError(fmt::format("{} cells; a table has at most {} columns", names.size(),
                                   kMostRecordColumns));
    }
    const std::string mode = file_tags_.contains("X_Columns") ? file_tags_["X_Columns"] : "One";
    begin_labview_segment(segment, names, mode);
    if (is_row) read_row();
  }

  void read_row() {
    // A last line that is cut off.
    if (lines_.is_open() && cells_.size() < cells_before_) return;
    cells_before_ = cells_.size();
    LabviewSegment& segment = segments_.back();
    const std::size_t channels = segment.channels.size();
    // Without X_Value the separator in front may be missing.
    const auto is_cell_number = [&](string_view cell) {
      return number_in(cell, separator_).has_value();
    };
    const bool is_shifted =
        segment.is_without_x && !cells_.front().empty() &&
        static_cast<std::size_t>(std::ranges::count_if(cells_, is_cell_number)) <= channels;
    for (std::size_t i = 0; i < segment.cell_kinds.size(); ++i) {
      const std::size_t place = is_shifted ? i - 1 : i;
      const string_view cell = place < cells_.size() ? cells_[place] : string_view();
      if (segment.cell_kinds[i] == LabviewCell::other) continue;
      double value = std::numeric_limits<double>::quiet_NaN();
      if (const auto number = number_in(cell, separator_)) {
        value = *number;
      } else if (!is_missing_number(cell)) {
        throw InputError(fmt::format("column {} = {}: must be a number",
                                     arm::shown(segment.names[i]), arm::shown(cell)));
      }
      segment.cells_of(i).push_back(value);
    }
    segment.lines.push_back(line_.number);
  }

  LineReader lines_;
  TextLine line_;
  char separator_ = '\t';
  LineSplitter splitter_{'\t'};
  std::span<const string_view> cells_;
  std::size_t cells_before_ = 0;  ///< in the row before
  Part part_ = Part::file_head;
  std::map<std::string, std::string, std::less<>> file_tags_;
  std::vector<LabviewSegment> segments_;
};

}  // namespace

bool is_labview_text(string_view text) {
  return text.starts_with(kMark);
}

ForeignTable parse_labview_text(string_view text, const std::string& file_name) {
  SegmentReader reader(text);
  try {
    std::vector<LabviewSegment> segments = reader.read();
    if (segments.empty()) {
      throw InputError("LabVIEW measurement file without a row of samples behind its heads");
    }
    return joined_labview_segments(std::move(segments));
  } catch (const InputError& error) {
    throw arm::located(error, file_name, reader.line());
  }
}

}  // namespace flexarm::measured
