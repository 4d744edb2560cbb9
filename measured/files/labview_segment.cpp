#include "measured/files/labview_segment.hpp"

#include "arm/input_error.hpp"
#include "measured/files/column_mapping.hpp"
#include "measured/files/column_name.hpp"
#include "measured/files/column_words.hpp"
#include "measured/files/delimited_line.hpp"
#include "measured/files/record_constants.hpp"
#include "measured/files/time_stamp.hpp"
#include "measured/files/universal_grid.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

namespace flexarm::measured {

namespace {

using arm::InputError;

constexpr double kNoSample = std::numeric_limits<double>::quiet_NaN();

bool is_x_name(const std::string& name) {
  return plain_letters(name) == "xvalue";
}

bool is_number(double value) {
  return !std::isnan(value);
}

/// The values of a tag, one a channel; behind those of X columns there may be empty cells.
class TagValues {
 public:
  TagValues(const LabviewSegment& segment, const char* tag) {
    const auto found = segment.tags.find(tag);
    if (found != segment.tags.end()) values_ = &found->second;
    const auto& first = segment.tags;
    const bool has_several_x =
        std::ranges::count(segment.cell_kinds, LabviewCell::x) > 1 && segment.channels.size() > 1;
    for (const char* full : {"Samples", "Delta_X", "X_Dimension"}) {
      const auto cells = first.find(full);
      if (cells == first.end()) continue;
      stride_ = has_several_x && cells->second.size() > 1 && cells->second[1].empty() ? 2 : 1;
      break;
    }
  }

  std::string at(std::size_t channel) const {
    const std::size_t place = channel * stride_;
    return values_ != nullptr && place < values_->size() ? (*values_)[place] : "";
  }

  std::optional<double> number_at(std::size_t channel) const {
    const std::string text = at(channel);
    const auto value = parse_cell(text, '.');
    const auto number = value ? value : parse_cell(text, ',');
    return number && std::isfinite(*number) ? number : std::nullopt;
  }

 private:
  const std::vector<std::string>* values_ = nullptr;
  std::size_t stride_ = 1;
};

/// The first channel that has samples.
std::size_t leading_channel(const LabviewSegment& segment) {
  const auto found = std::ranges::find_if(segment.channels, [](const LabviewChannel& channel) {
    return std::ranges::any_of(channel.values, is_number);
  });
  return found == segment.channels.end()
             ? 0
             : static_cast<std::size_t>(found - segment.channels.begin());
}

/// Whether the samples stand in the first rows, without a gap among them.
bool is_filled_from_top(const std::vector<double>& values) {
  const auto end = std::ranges::find_if_not(values, is_number);
  return std::none_of(end, values.end(), is_number);
}

/// Puts the segments behind each other.
class SegmentJoiner {
 public:
  ForeignTable join(std::vector<LabviewSegment> segments) {
    read_x_unit(segments);
    for (auto& segment : segments) add(segment);
    finish(segments);
    return std::move(table_);
  }

 private:
  static std::optional<TimeStamp> start_of(const LabviewSegment& segment) {
    return parse_time_stamp(TagValues(segment, "Date").at(0) + " " +
                            TagValues(segment, "Time").at(0));
  }

  /// The unit of X_Value, X0 and Delta_X, as X_Unit_Label tells; all numbers stay in it.
  void read_x_unit(const std::vector<LabviewSegment>& segments) {
    const std::string label = TagValues(segments.front(), "X_Unit_Label").at(0);
    for (const auto& segment : segments) {
      const TagValues labels(segment, "X_Unit_Label");
      for (std::size_t k = 0; k < segment.channels.size(); ++k) {
        const std::string other = labels.at(k);
        if (other.empty() || canonical_unit(other) == canonical_unit(label)) continue;
        throw InputError(fmt::format("X_Unit_Label = {} and {}; all channels must have one",
                                     arm::shown(label), arm::shown(other)));
      }
    }
    const TagValues dimensions(segments.front(), "X_Dimension");
    is_frequency_ = plain_letters(dimensions.at(0)).starts_with("freq");
    const std::string unit = canonical_unit(label);
    if (is_frequency_) {
      x_unit_ = unit.empty() ? "Hz" : unit;
    } else if (const auto unit_s = conversion_of(kTime, unit)) {
      x_unit_ = unit.empty() ? "s" : unit;
      x_unit_s_ = *unit_s;
    } else {
      say(fmt::format("X_Unit_Label = {} is no unit of time; s assumed", arm::shown(label)));
    }
  }

  void set_x(LabviewSegment& segment) {
    const TagValues starts(segment, "X0");
    const TagValues periods(segment, "Delta_X");
    const std::size_t leading = leading_channel(segment);
    period_ = periods.number_at(leading).value_or(0.0);
    const std::size_t rows = segment.lines.size();
    auto& shared = segment.channels[0].x;
    const bool has_x = std::ranges::any_of(shared, is_number);
    if (!has_x) {
      if (!(period_ > 0.0)) {
        throw InputError(
            "no X_Value and no Delta_X above 0 to tell the times; export X_Value, or write "
            "Delta_X");
      }
      shared = grid_points({starts.number_at(leading).value_or(0.0), period_}, rows);
      period_is_used_ = true;
    } else if (!(period_ > 0.0) && rows > 1) {
      period_ = shared[1] - shared[0];
    }
    for (std::size_t k = 1; k < segment.channels.size(); ++k) {
      auto& channel = segment.channels[k];
      if (!channel.x.empty() && !std::ranges::any_of(channel.x, is_number)) channel.x.clear();
      const double own_period = periods.number_at(k).value_or(period_);
      constexpr double kAlike = 1e-6;
      const bool is_other = std::abs(own_period - period_) > kAlike * period_;
      const bool is_empty = !std::ranges::any_of(channel.values, is_number);
      if (!channel.x.empty() || !is_other || is_empty || !(own_period > 0.0)) continue;
      if (!is_number(channel.values.back()) && is_filled_from_top(channel.values)) {
        channel.x = grid_points({starts.number_at(k).value_or(0.0), own_period}, rows);
      } else {
        say(fmt::format("Delta_X of {} is {} {}; its samples are taken at the times of their rows",
                        arm::shown(channel.name), own_period, x_unit_));
      }
    }
  }

  /// Returns the offset that is added to the times of a segment.
  double offset_of(const LabviewSegment& segment) {
    const auto& x = segment.channels[0].x;
    const auto start = start_of(segment);
    if (!is_begun_) first_start_ = start;
    if (!is_begun_ || !start || !first_start_ || x.empty()) return 0.0;
    const std::vector<std::optional<TimeStamp>> stamps = {first_start_, start};
    const double since = stamped_times(stamps).seconds.back() / x_unit_s_;
    const bool is_in_x = std::abs(x.front() - first_x_ - since) < period_;
    const double begin = x.front() + since;
    if (std::isnan(since) || is_in_x || begin <= last_) return 0.0;
    // Segments that follow without a pause, but for the clock's rounding.
    const double next = last_ + period_;
    return std::abs(begin - next) < 0.5 * period_ ? next - x.front() : since;
  }

  void add(LabviewSegment& segment) {
    set_x(segment);
    const double offset = offset_of(segment);
    const auto& shared = segment.channels[0].x;
    const bool is_shared = std::ranges::all_of(segment.channels, [&](const auto& channel) {
      return &channel == &segment.channels[0] || channel.x.empty() || is_alike(channel.x, shared);
    });
    const std::vector<std::size_t>& places = places_of(segment);
    if (is_shared) {
      for (std::size_t row = 0; row < segment.lines.size(); ++row) {
        begin_row(shared[row] + offset, segment.lines[row]);
        for (std::size_t k = 0; k < places.size(); ++k) {
          table_.columns[places[k]].values.back() = segment.channels[k].values[row];
        }
      }
    } else {
      add_merged(segment, places, offset);
    }
    if (!is_begun_) first_x_ = shared.empty() ? 0.0 : shared.front();
    if (!is_begun_ && first_start_ && first_start_->clock_ns) {
      table_.columns[0].start = stamped_times(std::span(&first_start_, 1)).start;
    }
    is_begun_ = true;
    for (const double time : table_.columns[0].values) {
      if (is_number(time)) last_ = time;
    }
  }

  static bool is_alike(const std::vector<double>& x, const std::vector<double>& shared) {
    for (std::size_t row = 0; row < x.size(); ++row) {
      if (is_number(x[row]) && x[row] != shared[row]) return false;
    }
    return true;
  }

  /// Rows at the times of all channels, in order, with empty cells where a channel has no sample.
  void add_merged(const LabviewSegment& segment, const std::vector<std::size_t>& places,
                  double offset) {
    say("channels have times of their own; rows are at the times of all");
    struct Sample {
      double x;
      std::size_t channel;
      std::size_t row;
    };
    std::vector<Sample> samples;
    const auto& shared = segment.channels[0].x;
    for (std::size_t k = 0; k < places.size(); ++k) {
      const auto& channel = segment.channels[k];
      const auto& x = channel.x.empty() ? shared : channel.x;
      for (std::size_t row = 0; row < channel.values.size(); ++row) {
        if (is_number(channel.values[row]) && std::isfinite(x[row])) {
          samples.push_back({x[row], k, row});
        }
      }
    }
    std::ranges::stable_sort(samples, {}, &Sample::x);
    constexpr double kSameRow_periods = 1e-3;
    double last = 0.0;
    for (const Sample& sample : samples) {
      const bool is_same = sample.x - last <= kSameRow_periods * period_;
      if (&sample == &samples.front() || !is_same) {
        begin_row(sample.x + offset, segment.lines[sample.row]);
        last = sample.x;
      }
      table_.columns[places[sample.channel]].values.back() =
          segment.channels[sample.channel].values[sample.row];
    }
  }

  void begin_row(double time, int line) {
    table_.columns[0].values.push_back(time);
    for (std::size_t i = 1; i < table_.columns.size(); ++i) {
      table_.columns[i].values.push_back(kNoSample);
    }
    table_.line_of_row.push_back(line);
  }

  /// The column of each channel, by its name; new ones are added.
  const std::vector<std::size_t>& places_of(const LabviewSegment& segment) {
    if (segment.names == names_) return places_;
    names_ = segment.names;
    if (table_.columns.empty()) {
      table_.columns.push_back({is_frequency_ ? "Frequency" : "X_Value", x_unit_, {}});
    }
    std::vector<std::size_t>& places = places_;
    places.clear();
    for (const auto& channel : segment.channels) {
      auto found = std::ranges::find_if(table_.columns, [&](const ForeignColumn& column) {
        const auto place = static_cast<std::size_t>(&column - table_.columns.data());
        return place > 0 && column.name == channel.name && std::ranges::count(places, place) == 0;
      });
      if (found == table_.columns.end()) {
        table_.columns.push_back({channel.name, channel.unit,
                                  std::vector<double>(table_.line_of_row.size(), kNoSample)});
        found = table_.columns.end() - 1;
      }
      places.push_back(static_cast<std::size_t>(found - table_.columns.begin()));
    }
    return places;
  }

  void finish(const std::vector<LabviewSegment>& segments) {
    const std::size_t rows = table_.line_of_row.size();
    table_.assumptions.insert(table_.assumptions.begin(),
                              fmt::format("LabVIEW measurement file, {} segment{}", segments.size(),
                                          segments.size() == 1 ? "" : "s"));
    if (!period_is_used_) return;
    const auto told = TagValues(segments.front(), "Samples").number_at(0);
    say(fmt::format("no X_Value; times are those of X0 and Delta_X, {} {}", period_, x_unit_));
    if (segments.size() == 1 && told && *told > 1.0 && *told < static_cast<double>(rows)) {
      say(
          fmt::format("the head tells {} samples, {} rows follow; they are taken as one stretch "
                      "without a pause",
                      *told, rows));
    }
    say_rounding();
  }

  /// A period of few digits may stand for a whole number of samples a second.
  void say_rounding() {
    const double rate_Hz = 1.0 / (period_ * x_unit_s_);
    constexpr double kWhole = 1e-6;
    constexpr double kDigits = 1e6;  // Delta_X has six behind the point
    if (std::abs(rate_Hz - std::round(rate_Hz)) < kWhole * rate_Hz) return;
    for (const double rate : {std::exp2(std::round(std::log2(rate_Hz))), std::round(rate_Hz)}) {
      const double told = 1.0 / (rate * x_unit_s_);
      if (std::round(kDigits * told) != std::round(kDigits * period_) || period_ < 1e-4) continue;
      say(fmt::format("Delta_X = {} {} may be a rounded 1/{} s; if so, state --period {:.9g}",
                      period_, x_unit_, rate, 1.0 / rate));
      return;
    }
  }

  void say(std::string sentence) {
    if (std::ranges::count(table_.assumptions, sentence) > 0) return;
    table_.assumptions.push_back(std::move(sentence));
  }

  ForeignTable table_;
  std::vector<std::string> names_;   ///< of the segment added last,
  std::vector<std::size_t> places_;  ///< and the columns of its channels
  bool is_frequency_ = false;        ///< X, in
  std::string x_unit_ = "s";         ///< this unit
  double x_unit_s_ = 1.0;            ///< of so many s
  double period_ = 0.0;
  bool period_is_used_ = false;
  bool is_begun_ = false;
  double first_x_ = 0.0;
  double last_ = 0.0;
  std::optional<TimeStamp> first_start_;
};

}  // namespace

void begin_labview_segment(LabviewSegment& segment, const std::vector<std::string>& names,
                           const std::string& x_columns) {
  segment.names = names;
  segment.is_without_x = x_columns == "No";
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool is_comment = i + 1 == names.size() && plain_letters(names[i]) == "comment";
    if (is_comment) {
      segment.cell_kinds.push_back(LabviewCell::other);
      segment.channel_of_cell.push_back(0);
    } else if (is_x_name(names[i])) {
      segment.cell_kinds.push_back(LabviewCell::x);
      segment.channel_of_cell.push_back(segment.channels.size());
    } else {
      segment.cell_kinds.push_back(LabviewCell::channel);
      segment.channel_of_cell.push_back(segment.channels.size());
      segment.channels.push_back({names[i], ""});
    }
  }
  const std::size_t channels = segment.channels.size();
  if (channels == 0) {
    throw InputError("no channel in the line of names; must be X_Value and the channels");
  }
  // An X column without a channel of its own behind it.
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool is_followed =
        i + 1 < names.size() && segment.cell_kinds[i + 1] == LabviewCell::channel;
    if (segment.cell_kinds[i] != LabviewCell::x || is_followed) continue;
    segment.cell_kinds[i] = LabviewCell::other;
    segment.channel_of_cell[i] = 0;
  }
  const TagValues units(segment, "Y_Unit_Label");
  for (std::size_t k = 0; k < channels; ++k) {
    auto& channel = segment.channels[k];
    channel.unit = canonical_unit(units.at(k));
    if (channel.unit.empty()) channel.unit = split_column_name(channel.name).unit;
  }
}

ForeignTable joined_labview_segments(std::vector<LabviewSegment> segments) {
  return SegmentJoiner().join(std::move(segments));
}

}  // namespace flexarm::measured
