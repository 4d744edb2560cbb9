#pragma once

#include "arm/deadline.hpp"
#include "diagnose/parallel.hpp"

#include <atomic>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string_view>
#include <utility>

namespace flexarm::diagnose {

/// Called with what is done and the fraction done, also with the same once more before each
/// evaluation of a model in fits, scans and the advice on further runs, by one thread at a time;
/// false cancels.
using DiagnosisProgress = std::function<bool(std::string_view, double)>;

using arm::Cancelled;
using arm::Deadline;
using arm::halfway;
using arm::is_over;
using arm::require_time;

/// Work on all cores that tells how far it is. Throws Cancelled where the progress function
/// cancels, and after the deadline.
class ReportedWork {
 public:
  explicit ReportedWork(DiagnosisProgress progress, const Deadline& deadline = {})
      : progress_(std::move(progress)), deadline_(deadline) {}

  double done() const { return done_; }  ///< the fraction that was told last
  std::string_view what() const { return what_; }
  /// Where Cancelled ended it: the deadline did, and not the progress function. Evaluations that
  /// have the same deadline throw it as well.
  bool is_out_of_time() const { return !is_cancelled_; }
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
    is_cancelled_ = is_cancelled_ || (progress_ && !progress_(what_, done_));
    if (is_cancelled_ || is_over(deadline_)) throw Cancelled{};
  }

  const DiagnosisProgress progress_;
  Deadline deadline_;
  mutable std::atomic<bool> is_cancelled_ = false;
  mutable std::mutex telling_;
  std::string_view what_;
  std::atomic<double> done_ = 0.0;
};

}  // namespace flexarm::diagnose
