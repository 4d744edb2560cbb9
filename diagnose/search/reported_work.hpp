#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string_view>
#include <tbb/parallel_for.h>

namespace flexarm::diagnose {

/// Called with what is done and the fraction done, also with the same once more before each
/// evaluation of a model in fits, scans and the advice on further runs, by one thread at a time;
/// false cancels.
using DiagnosisProgress = std::function<bool(std::string_view, double)>;

/// Thrown out of work that was cancelled.
struct Cancelled {};

/// Work on all cores that tells how far it is. Throws Cancelled where the progress function
/// cancels.
class ReportedWork {
 public:
  /// `progress` must outlive the object.
  explicit ReportedWork(const DiagnosisProgress& progress) : progress_(progress) {}

  double done() const { return done_; }  ///< the fraction that was told last

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
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      work(i);
      const double part = static_cast<double>(++done) / static_cast<double>(count);
      tell(what, from + part * (to - from));
    });
  }

 private:
  void ask() const {
    if (progress_ && !progress_(what_, done_)) throw Cancelled{};
  }

  const DiagnosisProgress& progress_;
  mutable std::mutex telling_;
  std::string_view what_;
  std::atomic<double> done_ = 0.0;
};

}  // namespace flexarm::diagnose
