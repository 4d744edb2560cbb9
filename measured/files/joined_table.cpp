#include "measured/files/joined_table.hpp"

#include "arm/input_error.hpp"
#include "measured/files/column_name.hpp"
#include "measured/files/column_words.hpp"
#include "measured/files/missing_signs.hpp"
#include "measured/files/record_constants.hpp"
#include "measured/files/resampling.hpp"
#include "measured/files/sample_clock.hpp"
#include "measured/files/time_record.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

namespace flexarm::measured {

namespace {

using arm::InputError;

/// Where files have less than this of the shortest of them in common, it is said as a doubt.
constexpr double kLittleInCommon = 0.5;

/// Samples of one grid that the files do not share are as far apart, or farther.
constexpr double kApart_periods = 0.75;

bool says_nothing(const std::string& name) {
  constexpr std::array<std::string_view, 5> kWords = {"value", "values", "data", "signal",
                                                      "column"};
  const std::string letters = plain_letters(split_column_name(name).base);
  return std::ranges::count(kWords, std::string_view(letters)) > 0;
}

/// Samples [first, last) of a file that lie in the time that all files share.
struct CommonPart {
  std::size_t first = 0;
  std::size_t last = 0;
};

CommonPart common_part(const std::vector<double>& times_s, double from_s, double to_s,
                       double tolerance_s) {
  const auto first = std::ranges::lower_bound(times_s, from_s - tolerance_s);
  const auto last = std::ranges::upper_bound(times_s, to_s + tolerance_s);
  return {static_cast<std::size_t>(first - times_s.begin()),
          static_cast<std::size_t>(last - times_s.begin())};
}

std::vector<double> cut(const std::vector<double>& values, const CommonPart& part) {
  return {values.begin() + static_cast<std::ptrdiff_t>(part.first),
          values.begin() + static_cast<std::ptrdiff_t>(part.last)};
}

/// The largest distance of the samples from those of the grid; infinite for another number.
double distance_s(const std::vector<double>& times_s, const std::vector<double>& grid_s) {
  if (times_s.size() != grid_s.size()) return HUGE_VAL;
  double largest_s = 0.0;
  for (std::size_t k = 0; k < times_s.size(); ++k) {
    largest_s = std::max(largest_s, std::abs(times_s[k] - grid_s[k]));
  }
  return largest_s;
}

class Joiner {
 public:
  explicit Joiner(std::vector<TimedSignals> files) : files_(std::move(files)) {
    for (const auto& file : files_) periods_s_.push_back(clock_steps(file.times_s).period_s);
  }

  ForeignTable join(JoinGrid grid, const std::function<bool(const std::string&)>& is_held) {
    find_common_time();
    if (const auto times_s = grid == JoinGrid::same ? shared_times() : std::nullopt) {
      table_.columns.push_back({"time [s]", "s", *times_s});
      for (std::size_t i = 0; i < files_.size(); ++i) place_file(i, *times_s);
      return std::move(table_);
    }
    const std::size_t base = base_of(grid);
    const std::vector<double> grid_s = cut(files_[base].times_s, parts_[base]);
    table_.columns.push_back({"time [s]", "s", grid_s});
    for (std::size_t i = 0; i < files_.size(); ++i) add_file(i, base, grid, grid_s, is_held);
    return std::move(table_);
  }

 private:
  void assume(std::string sentence) { table_.assumptions.push_back(std::move(sentence)); }

  void find_common_time() {
    const double tolerance_s = kMostJitter_periods * *std::ranges::min_element(periods_s_);
    double from_s = -HUGE_VAL;
    double to_s = HUGE_VAL;
    double shortest_s = HUGE_VAL;
    for (const auto& file : files_) {
      from_s = std::max(from_s, file.times_s.front());
      to_s = std::min(to_s, file.times_s.back());
      shortest_s = std::min(shortest_s, file.times_s.back() - file.times_s.front());
    }
    std::vector<std::string> ranges;
    std::size_t left_out = 0;
    std::size_t fewest = static_cast<std::size_t>(-1);
    for (const auto& file : files_) {
      ranges.push_back(fmt::format("{} from {:.10g} s to {:.10g} s", file.file,
                                   file.times_s.front(), file.times_s.back()));
      parts_.push_back(common_part(file.times_s, from_s, to_s, tolerance_s));
      const std::size_t samples = parts_.back().last - parts_.back().first;
      left_out += file.times_s.size() - samples;
      fewest = std::min(fewest, samples);
    }
    const std::string listed = fmt::format("{}", fmt::join(ranges, ", "));
    if (from_s >= to_s || fewest < 2) {
      throw InputError(fmt::format(
          "--join: no time in which all files have samples ({}); their clocks differ, or begin at "
          "other moments; write them with the times of one clock",
          listed));
    }
    assume(fmt::format(
        "joined by time over {:.10g} s to {:.10g} s, where all files have samples ({}); {} "
        "sample{} outside left out",
        from_s, to_s, listed, left_out, left_out == 1 ? "" : "s"));
    if (to_s - from_s < kLittleInCommon * shortest_s) {
      assume(fmt::format(
          "the files have {:.3g} s in common, less than half of the shortest: are the times of one "
          "clock?",
          to_s - from_s));
    }
  }

  double same_time_s(std::size_t i, std::size_t base) const {
    return kMostJitter_periods * std::min(periods_s_[i], periods_s_[base]);
  }

  /// The times at which any file has a sample; empty where those of one lie between those of
  /// another, or come at another rate.
  std::optional<std::vector<double>> shared_times() const {
    std::vector<double> all_s = cut(files_[0].times_s, parts_[0]);
    bool are_same = true;
    for (std::size_t i = 1; i < files_.size(); ++i) {
      const std::vector<double> own_s = cut(files_[i].times_s, parts_[i]);
      std::vector<double> merged_s;
      std::size_t at = 0;
      for (const double time_s : own_s) {
        while (at < all_s.size() && all_s[at] < time_s - same_time_s(i, 0)) {
          merged_s.push_back(all_s[at++]);
        }
        const bool is_there = at < all_s.size() && all_s[at] <= time_s + same_time_s(i, 0);
        if (is_there) {
          merged_s.push_back(all_s[at++]);
          continue;
        }
        const double least_s = kApart_periods * periods_s_[0];
        const bool is_apart = (merged_s.empty() || time_s - merged_s.back() >= least_s) &&
                              (at == all_s.size() || all_s[at] - time_s >= least_s);
        if (!is_apart) return std::nullopt;
        merged_s.push_back(time_s);
      }
      merged_s.insert(merged_s.end(), all_s.begin() + static_cast<std::ptrdiff_t>(at), all_s.end());
      const bool is_alike = !is_other_rate(i);
      are_same &= merged_s.size() == all_s.size() && own_s.size() == all_s.size();
      if (!are_same && !is_alike) return std::nullopt;
      all_s = std::move(merged_s);
    }
    return all_s;
  }

  /// Adds the signals of a file at the times of all, NaN where it has no sample.
  void place_file(std::size_t i, const std::vector<double>& times_s) {
    TimedSignals& file = files_[i];
    std::vector<std::size_t> rows(times_s.size(), file.times_s.size());
    std::size_t at = parts_[i].first;
    for (std::size_t k = 0; k < times_s.size() && at < parts_[i].last; ++k) {
      if (std::abs(file.times_s[at] - times_s[k]) <= same_time_s(i, 0)) rows[k] = at++;
    }
    const auto missing = std::ranges::count(rows, file.times_s.size());
    if (missing > 0) {
      assume(fmt::format("{} has no sample at {} of {} times of the other files", file.file,
                         missing, times_s.size()));
    }
    for (auto& column : file.columns) {
      std::vector<double> placed;
      for (const std::size_t row : rows) {
        placed.push_back(row < column.values.size() ? column.values[row] : kUnknown);
      }
      column.values = std::move(placed);
      table_.columns.push_back(std::move(column));
    }
  }

  bool is_other_rate(std::size_t i) const {
    constexpr double kAlike = 1e-3;
    return std::abs(periods_s_[i] - periods_s_[0]) >
           kAlike * std::min(periods_s_[i], periods_s_[0]);
  }

  std::size_t base_of(JoinGrid grid) const {
    if (grid != JoinGrid::coarsest) return 0;
    return static_cast<std::size_t>(std::ranges::max_element(periods_s_) - periods_s_.begin());
  }

  void add_file(std::size_t i, std::size_t base, JoinGrid grid, const std::vector<double>& grid_s,
                const std::function<bool(const std::string&)>& is_held) {
    TimedSignals& file = files_[i];
    const std::vector<double> own_s = cut(file.times_s, parts_[i]);
    const bool are_same = distance_s(own_s, grid_s) <= same_time_s(i, base);
    if (!are_same && grid == JoinGrid::same) refuse_other_times(i);
    if (!are_same) note_resampled(i, base);
    for (auto& column : file.columns) {
      if (are_same) {
        column.values = cut(column.values, parts_[i]);
      } else {
        std::ranges::for_each(doubtful_signs(column.values, column.name, file.file),
                              [&](const std::string& doubt) { assume(doubt); });
        column.values = resampled(file.times_s, column.values, grid_s,
                                  is_held(column.name) ? periods_s_[base] : 0.0);
      }
      table_.columns.push_back(std::move(column));
    }
  }

  /// Returns the values at other times by the samples that have a number; `step_s` is the step that
  /// a mean of held values is over, 0 for a cubic. Where samples are missing, so are these values.
  static std::vector<double> resampled(const std::vector<double>& times_s,
                                       const std::vector<double>& values,
                                       const std::vector<double>& grid_s, double step_s) {
    std::vector<double> own_s;
    std::vector<double> own;
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (std::isnan(values[k])) continue;
      own_s.push_back(times_s[k]);
      own.push_back(values[k]);
    }
    if (own.size() < 2) return std::vector<double>(grid_s.size(), kUnknown);
    const double period_s = clock_steps(own_s).period_s;
    std::vector<double> made = step_s > 0.0 ? held_means(own_s, own, grid_s, step_s)
                                            : cubic_values(own_s, own, grid_s, period_s);
    const double tolerance_s = kMostJitter_periods * period_s;
    const double held_s = step_s > 0.0 ? period_s : 0.0;
    constexpr double kGap_periods = 1.5;
    for (std::size_t i = 0, k = 0; i < grid_s.size(); ++i) {
      if (grid_s[i] < own_s.front() - tolerance_s || grid_s[i] > own_s.back() + tolerance_s) {
        made[i] = kUnknown;
      }
      while (k + 2 < own_s.size() && own_s[k + 1] <= grid_s[i] + tolerance_s) ++k;
      // The step that begins here may reach into several gaps.
      for (std::size_t j = k; j + 1 < own_s.size() && own_s[j] <= grid_s[i] + step_s; ++j) {
        const bool is_gap = own_s[j + 1] - own_s[j] > kGap_periods * period_s;
        const bool is_within = grid_s[i] + step_s > own_s[j] + held_s + tolerance_s &&
                               grid_s[i] < own_s[j + 1] - tolerance_s;
        if (is_gap && is_within) made[i] = kUnknown;
      }
    }
    return made;
  }

  [[noreturn]] void refuse_other_times(std::size_t i) const {
    throw InputError(fmt::format(
        "--join: {} has samples at other times than {} ({}); say onto which times they are "
        "resampled: --join-grid first or --join-grid coarsest",
        files_[i].file, files_[0].file,
        is_other_rate(i)
            ? fmt::format("one every {:.6g} s, and every {:.6g} s", periods_s_[i], periods_s_[0])
            : fmt::format("the period of both is {:.6g} s, but the samples lie between each "
                          "other",
                          periods_s_[0])));
  }

  void note_resampled(std::size_t i, std::size_t base) {
    const double from_s = periods_s_[i];
    const double to_s = periods_s_[base];
    std::string sentence = fmt::format(
        "{}, sampled every {:.6g} s, is taken at the times of {}, every {:.6g} s: a torque "
        "by its mean over each step, other signals by cubic interpolation",
        files_[i].file, from_s, files_[base].file, to_s);
    constexpr double kCoarser = 1.5;
    if (to_s > kCoarser * from_s) {
      sentence += fmt::format(
          "; without a low-pass, so that what they have above {:.4g} Hz is folded below it",
          0.5 / to_s);
    }
    assume(sentence);
  }

  std::vector<TimedSignals> files_;
  std::vector<double> periods_s_;
  std::vector<CommonPart> parts_;
  ForeignTable table_;
};

}  // namespace

std::string_view to_string(JoinGrid grid) {
  return grid == JoinGrid::same ? "same" : grid == JoinGrid::first ? "first" : "coarsest";
}

void name_joined_columns(std::vector<TimedSignals>& files) {
  std::map<std::string, std::size_t> counts;
  for (const auto& file : files) {
    for (const auto& column : file.columns) ++counts[column.name];
  }
  for (auto& file : files) {
    const std::string stem = std::filesystem::path(file.file).stem().string();
    for (auto& column : file.columns) {
      if (counts[column.name] > 1 || says_nothing(column.name)) {
        column.name = fmt::format("{}.{}", stem, column.name);
      }
    }
  }
}

ForeignTable joined_table(std::vector<TimedSignals> files, JoinGrid grid,
                          const std::function<bool(const std::string& column)>& is_held) {
  return Joiner(std::move(files)).join(grid, is_held);
}

}  // namespace flexarm::measured
