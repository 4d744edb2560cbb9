#include "report/progress.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <unistd.h>
#include <utility>

namespace flexarm::report {
namespace {

constexpr std::string_view kWipeLine = "\r\x1b[K";

/// Best effort: a terminal that has gone away is no reason to stop the work.
void write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

}  // namespace

Progress::Progress(std::string label, std::int64_t total, const ProgressOptions& options)
    : label_(std::move(label)),
      total_(total),
      options_(options),
      on_terminal_(::isatty(options.descriptor) == 1),
      next_(std::chrono::steady_clock::now() + options.quiet_for) {}

Progress::~Progress() {
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
  if (now < next_) return;
  next_ = now + options_.interval;
  drawn_ = true;
  write_all(options_.descriptor,
            fmt::format("{}{}  {} of {}", kWipeLine, label_, done_.load(), total_));
}

}  // namespace flexarm::report
