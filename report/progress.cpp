#include "report/progress.hpp"

#include "report/terminal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <unistd.h>
#include <utility>

namespace flexarm::report {
namespace {

/// Best effort: a terminal that has gone away is no reason to stop the work.
void write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

/// Steps of work of which a fraction is known.
constexpr std::int64_t kFractionSteps = 10000;
constexpr std::int64_t kStepsPerCent = kFractionSteps / 100;

}  // namespace

Progress::Progress(std::string label, std::int64_t total, const ProgressOptions& options)
    : Progress(std::move(label), total, false, options) {}

Progress::Progress(std::string label, const ProgressOptions& options)
    : Progress(std::move(label), kFractionSteps, true, options) {}

Progress::Progress(std::string label, std::int64_t total, bool in_per_cent,
                   const ProgressOptions& options)
    : label_(std::move(label)),
      total_(total),
      in_per_cent_(in_per_cent),
      options_(options),
      on_terminal_(takes_escape_sequences(options.descriptor)),
      begun_(std::chrono::steady_clock::now()),
      next_(begun_ + options.quiet_for),
      time_left_(options.time_left) {
  if (!on_terminal_) return;
  ticker_ = std::thread([this] {
    std::unique_lock lock(ending_);
    while (!end_.wait_for(lock, options_.tick, [this] { return over_; })) draw();
  });
}

Progress::~Progress() {
  if (ticker_.joinable()) {
    {
      const std::scoped_lock lock(ending_);
      over_ = true;
    }
    end_.notify_one();
    ticker_.join();
  }
  if (drawn_) write_all(options_.descriptor, kWipeLine);
}

void Progress::advance(std::int64_t steps) {
  done_.fetch_add(steps, std::memory_order_relaxed);
  draw();
}

void Progress::reach(double fraction) {
  const auto steps = static_cast<std::int64_t>(std::floor(fraction * static_cast<double>(total_)));
  std::int64_t done = done_.load();
  while (steps > done && !done_.compare_exchange_weak(done, steps)) {
  }
  draw();
}

void Progress::draw() {
  if (!on_terminal_) return;
  // Whoever finds another thread drawing goes on with its work.
  const std::unique_lock lock(drawing_, std::try_to_lock);
  if (!lock) return;
  const auto now = std::chrono::steady_clock::now();
  if (now >= next_) draw_line(now);
}

void Progress::draw_line(std::chrono::steady_clock::time_point now) {
  next_ = now + options_.interval;
  drawn_ = true;
  const std::int64_t done = done_.load();
  const std::chrono::duration<double> elapsed = now - begun_;
  time_left_.update(elapsed.count(), static_cast<double>(done) /
                                         static_cast<double>(std::max<std::int64_t>(total_, 1)));
  std::string line = !in_per_cent_ ? fmt::format("{}  {} of {}", label_, done, total_)
                     : done == 0   ? fmt::format("{}  {:.0f} s", label_, elapsed.count())
                                   : fmt::format("{}  {} %", label_, done / kStepsPerCent);
  if (const auto seconds = time_left_.seconds()) line += ", " + time_left_text(*seconds);
  // A line that is longer than the terminal could not be wiped.
  if (line.size() >= output_width(options_.descriptor))
    line.resize(output_width(options_.descriptor) - 1);
  write_all(options_.descriptor, fmt::format("{}{}", kWipeLine, line));
}

}  // namespace flexarm::report
