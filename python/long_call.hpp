#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <pybind11/pybind11.h>
#include <string>
#include <utility>

namespace flexarm::python {

/// How far long work is, and whether it is to end. Its functions may be called from any thread, and
/// never touch Python.
class CallState {
 public:
  /// Tells the fraction done, 0 to 1; less than before changes nothing. False: the work is to end.
  bool reach(double fraction) {
    double done = fraction_;
    while (fraction > done && !fraction_.compare_exchange_weak(done, fraction)) {
    }
    return !cancelled_;
  }
  double fraction() const { return fraction_; }
  void cancel() { cancelled_ = true; }

 private:
  std::atomic<double> fraction_ = 0.0;
  std::atomic<bool> cancelled_ = false;
};

/// Runs `work` in a thread of its own, without the interpreter's lock, and returns when it has
/// ended. The calling thread meanwhile looks for signals and shows progress, some twenty times a
/// second: where Ctrl-C comes, or `progress` raises, it cancels the work, waits for its end and
/// raises that. So a callback is called by the thread that called, and a signal is seen however
/// seldom, and from whichever thread, the work tells of itself.
///
/// `progress` is a callable of the fraction done, None for a line on standard error where somebody
/// sees it (python/flexarm/_progress.py), False for none; `what` stands in that line.
void run_long_call(const std::string& what, const pybind11::object& progress,
                   const std::function<void(CallState&)>& work);

/// The same for work that returns something.
template <class Work>
auto long_call(const std::string& what, const pybind11::object& progress, const Work& work) {
  std::optional<decltype(work(std::declval<CallState&>()))> result;
  run_long_call(what, progress, [&](CallState& state) { result.emplace(work(state)); });
  return std::move(*result);
}

}  // namespace flexarm::python
