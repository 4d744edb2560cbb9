#pragma once

#include "diagnose/parallel.hpp"

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <mutex>
#include <optional>
#include <string_view>
#include <utility>

namespace flexarm::diagnose {

/// Called with what is done and the fraction done, also with the same once more before each
/// evaluation of a model in fits, scans and the advice on further runs, by one thread at a time;
/// false cancels.
using DiagnosisProgress = std::function<bool(std::string_view, double)>;

/// When work must end with what it has; none: whenever it is done.
using Deadline = std::optional<std::chrono::steady_clock::time_point>;

inline bool is_over(const Deadline& deadline) {
  return deadline && std::chrono::steady_clock::now() >= *deadline;
}

/// Of the first of two pieces of work: after this part of the time that is left.
inline Deadline after_part(const Deadline& deadline, double part) {
  if (!deadline) return deadline;
  using Clock = std::chrono::steady_clock;
  const auto now = Clock::now();
  return now + std::chrono::duration_cast<Clock::duration>(part * (*deadline - now));
}
inline Deadline halfway(const Deadline& deadline) {
  return after_part(deadline, 0.5);
}

/// Thrown out of work that was cancelled, or whose time is over.
struct Cancelled {};

/// Work on all cores that tells how far it is. Throws Cancelled where the progress function
/// cancels, and after the deadline.
class ReportedWork {
 public:
  explicit ReportedWork(DiagnosisProgress progress, const Deadline& deadline = {})
      : progress_(std::move(progress)), deadline_(deadline) {}

  double done() const { return done_; }  ///< the fraction that was told last
  std::string_view what() const { return what_; }
  /// The deadline, and not the progress function, ended it.
  bool is_out_of_time() const { return is_out_of_time_; }
  /// For what must still be done after it.
  void lift_deadline() { deadline_.reset(); }

  /// `what` must outlive the object. Concurrent calls are safe.
  void tell(std::string_view what, double fraction) {
    const std::scoped_lock lock(telling_);
    what_ = what;
    done_ = fraction;
    ask();
  }
  /// Tells the same once more in the midst of a step. Concurrent calls are safe.
  void go_on() const {
    const std::scoped_lock lock(telling_);
    ask();
  }

  /// `work(i)` for i from 0 to before `count`, which takes the fraction done `from` .. `to`.
  template <class Work>
  void in_parallel(std::size_t count, std::string_view what, double from, double to, Work work) {
    tell(what, from);
    std::atomic<std::size_t> done = 0;
    diagnose::in_parallel(count, [&](std::size_t i) {
      work(i);
      const double part = static_cast<double>(++done) / static_cast<double>(count);
      tell(what, from + part * (to - from));
    });
  }

 private:
  void ask() const {
    if (progress_ && !progress_(what_, done_)) throw Cancelled{};
    if (!is_over(deadline_)) return;
    is_out_of_time_ = true;
    throw Cancelled{};
  }

  const DiagnosisProgress progress_;
  Deadline deadline_;
  mutable std::atomic<bool> is_out_of_time_ = false;
  mutable std::mutex telling_;
  std::string_view what_;
  std::atomic<double> done_ = 0.0;
};

}  // namespace flexarm::diagnose
