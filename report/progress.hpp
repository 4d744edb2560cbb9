#pragma once

#include "report/time_left.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>

namespace flexarm::report {

struct ProgressOptions {
  int descriptor = 2;  ///< where to: standard error
  std::chrono::steady_clock::duration quiet_for = std::chrono::seconds(1);
  std::chrono::steady_clock::duration interval = std::chrono::milliseconds(100);
  /// The line is renewed so often while a long step tells nothing.
  std::chrono::steady_clock::duration tick = std::chrono::seconds(1);
  TimeLeftOptions time_left = {};
};

/// A line "label  12 of 40, 25 s left", or "label  30 %, 25 s left", that is rewritten while work
/// goes on, and wiped when it ends; "label  25 s" while nothing of it is known to be done. Nothing
/// at all is written where `descriptor` is not a terminal that can wipe a line, or before
/// `quiet_for` has passed.
class Progress {
 public:
  /// Work of `total` steps that mean something to a reader.
  Progress(std::string label, std::int64_t total, const ProgressOptions& options = {});
  /// Work of which a fraction is known, or nothing: `reach` alone is called.
  explicit Progress(std::string label, const ProgressOptions& options = {});
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Counts `steps` more as done. Safe from any thread.
  void advance(std::int64_t steps = 1);
  /// This fraction of all is done, 0 to 1; what is less than is known to be done changes nothing.
  /// Safe from any thread.
  void reach(double fraction);

 private:
  Progress(std::string label, std::int64_t total, bool in_per_cent, const ProgressOptions& options);
  void draw();
  void draw_line(std::chrono::steady_clock::time_point now);

  const std::string label_;
  const std::int64_t total_;
  const bool in_per_cent_;
  const ProgressOptions options_;
  const bool on_terminal_;
  const std::chrono::steady_clock::time_point begun_;
  std::atomic<std::int64_t> done_{0};
  std::mutex drawing_;
  // Guarded by `drawing_`:
  std::chrono::steady_clock::time_point next_;
  TimeLeft time_left_;
  bool drawn_ = false;
  std::mutex ending_;
  bool over_ = false;  ///< guarded by `ending_`
  std::condition_variable end_;
  std::thread ticker_;  ///< on a terminal
};

}  // namespace flexarm::report
