#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string_view>
#include <tbb/parallel_for.h>

namespace flexarm::diagnose {

/// Called with what is done and the fraction done; false cancels.
using DiagnosisProgress = std::function<bool(std::string_view, double)>;

/// Work on all cores that tells how far it is, and stops beginning when it is cancelled.
class ReportedWork {
 public:
  /// `progress` must outlive the object.
  explicit ReportedWork(const DiagnosisProgress& progress) : progress_(progress) {}

  bool is_cancelled() const { return cancelled_; }
  double done() const { return done_; }  ///< the fraction that was told last

  /// False when the work was cancelled, now or before.
  bool tell(std::string_view what, double fraction) {
    done_ = fraction;
    if (progress_ && !progress_(what, fraction)) cancelled_ = true;
    return !cancelled_;
  }

  /// `work(i)` for i from 0 to before `count`, which takes the fraction done `from` .. `to`.
  template <class Work>
  void in_parallel(std::size_t count, std::string_view what, double from, double to, Work work) {
    std::atomic<std::size_t> done = 0;
    std::mutex told;
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      if (cancelled_) return;
      work(i);
      const double part = static_cast<double>(++done) / static_cast<double>(count);
      const std::scoped_lock lock(told);
      tell(what, from + part * (to - from));
    });
  }

 private:
  const DiagnosisProgress& progress_;
  std::atomic<bool> cancelled_ = false;
  double done_ = 0.0;
};

}  // namespace flexarm::diagnose
