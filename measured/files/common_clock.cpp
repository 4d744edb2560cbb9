#include "measured/files/common_clock.hpp"

#include "arm/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace flexarm::measured {

namespace {

using arm::InputError;

constexpr double kDay_s = 86400.0;
constexpr double kHour_s = 3600.0;
/// Seconds since 1970 are above this, those since the start of a record below.
constexpr double kFirstEpoch_s = 1e8;

/// The time from one moment to another; whole seconds apart, whose nanoseconds may not fit.
double seconds_between(const ClockStart& from, const ClockStart& to) {
  return static_cast<double>(to.ns / kSecond_ns - from.ns / kSecond_ns) +
         static_cast<double>(to.ns % kSecond_ns - from.ns % kSecond_ns) / kSecond_ns;
}

bool is_within_turn(const ClockStart& start, double turn_s) {
  return start.ns >= 0 && static_cast<double>(start.ns) < turn_s * kSecond_ns;
}

class CommonClock {
 public:
  explicit CommonClock(std::vector<TimedSignals>& files) : files_(files) {}

  std::vector<std::string> put() {
    const auto stamped = std::ranges::find_if(files_, &TimedSignals::is_stamped);
    if (stamped != files_.end()) {
      base_ = static_cast<std::size_t>(stamped - files_.begin());
      find_missing_starts();
    } else if (!std::ranges::all_of(files_, [](const auto& file) { return !!file.start; })) {
      return {};
    }
    find_offsets();
    if (stamped == files_.end()) {
      if (are_in_times()) return {};
      note_whole_seconds();
    }
    for (std::size_t i = 0; i < files_.size(); ++i) {
      if (offsets_s_[i] == 0.0) continue;
      for (double& time_s : files_[i].times_s) time_s += offsets_s_[i];
      notes_.push_back(fmt::format("the times of {} start {:.10g} s {} those of {}", files_[i].file,
                                   std::abs(offsets_s_[i]),
                                   offsets_s_[i] > 0.0 ? "after" : "before", files_[base_].file));
    }
    return std::move(notes_);
  }

 private:
  void find_missing_starts() {
    const bool are_dated = std::ranges::all_of(
        files_, [](const auto& file) { return !file.start || file.start->has_date; });
    for (auto& file : files_) {
      if (file.start) continue;
      if (!are_dated || file.times_s.front() < kFirstEpoch_s) {
        throw InputError(fmt::format(
            "--join: {} has time stamps and {} seconds from {:.10g} s, of which no "
            "time of day is known; write both with time stamps, or both in seconds of one clock",
            files_[base_].file, file.file, file.times_s.front()));
      }
      file.start = ClockStart{0, true, true, files_[base_].start->has_zone};
      notes_.push_back(fmt::format("the times of {} are taken as seconds since 1970", file.file));
    }
  }

  /// Local time of one file beside a known zone of another may be hours off.
  void require_same_zone(const TimedSignals& file) const {
    if (file.start->has_zone == files_[base_].start->has_zone) return;
    const bool is_base = files_[base_].start->has_zone;
    throw InputError(fmt::format(
        "--join: the times of {} have a time zone, those of {} have none; must be told in both, "
        "12:00:00Z or 12:00:00+01:00, or in neither",
        (is_base ? files_[base_] : file).file, (is_base ? file : files_[base_]).file));
  }

  void find_offsets() {
    const auto dated =
        std::ranges::count_if(files_, [](const auto& file) { return file.start->has_date; });
    const auto with_hours =
        std::ranges::count_if(files_, [](const auto& file) { return file.start->has_hours; });
    const auto all = std::ranges::ssize(files_);
    const double turn_s = with_hours == all ? kDay_s : kHour_s;
    const bool are_of_one_kind =
        (dated == 0 || dated == all) && (with_hours == 0 || with_hours == all);
    if (!are_of_one_kind) {
      notes_.push_back(fmt::format("not all files tell {}; their times are compared by {} alone",
                                   with_hours == all ? "a date" : "hours",
                                   with_hours == all ? "clock" : "minutes and seconds"));
    }
    const ClockStart& base = *files_[base_].start;
    for (const auto& file : files_) {
      require_same_zone(file);
      double offset_s = seconds_between(base, *file.start);
      const bool is_clock =
          dated == 0 && is_within_turn(base, turn_s) && is_within_turn(*file.start, turn_s);
      if (is_clock || !are_of_one_kind) offset_s = std::remainder(offset_s, turn_s);
      offsets_s_.push_back(offset_s);
    }
  }

  /// Whether the first numbers differ as the starts do: they count from one moment.
  bool are_in_times() const {
    const auto& base = files_[base_].times_s;
    for (std::size_t i = 0; i < files_.size(); ++i) {
      const double later_s = files_[i].times_s.front() - base.front();
      if (std::abs(later_s - offsets_s_[i]) >= base[1] - base[0]) return false;
    }
    return true;
  }

  void note_whole_seconds() {
    const bool are_whole = std::ranges::all_of(
        files_, [](const auto& file) { return file.start->ns % kSecond_ns == 0; });
    if (!are_whole) return;
    notes_.emplace_back("the heads tell the starts of the files in whole seconds alone");
  }

  std::vector<TimedSignals>& files_;
  std::size_t base_ = 0;
  std::vector<double> offsets_s_;
  std::vector<std::string> notes_;
};

}  // namespace

std::vector<std::string> put_on_one_clock(std::vector<TimedSignals>& files) {
  return CommonClock(files).put();
}

}  // namespace flexarm::measured
