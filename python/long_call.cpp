#include "python/long_call.hpp"

#include "report/time_left.hpp"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

namespace flexarm::python {

namespace py = pybind11;

namespace {

constexpr std::chrono::milliseconds kLook{50};

/// Work that goes on in another thread.
class Worker {
 public:
  Worker(const std::function<void(CallState&)>& work, CallState& state)
      : thread_([this, &work, &state] {
          try {
            work(state);
          } catch (...) {
            failure_ = std::current_exception();
          }
          const std::scoped_lock lock(mutex_);
          has_ended_ = true;
          ended_.notify_one();
        }) {}
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  ~Worker() {
    const py::gil_scoped_release without_lock;
    thread_.join();
  }

  /// Whether it has ended within the time.
  bool ends_within(std::chrono::milliseconds time) {
    const py::gil_scoped_release without_lock;
    std::unique_lock lock(mutex_);
    return ended_.wait_for(lock, time, [this] { return has_ended_; });
  }

  /// Throws what the work threw. Once it has ended.
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::mutex mutex_;
  std::condition_variable ended_;
  bool has_ended_ = false;
  std::exception_ptr failure_;
  std::thread thread_;  // last: it uses the others
};

/// Where progress is shown; wiped at the end.
class Shown {
 public:
  Shown(const std::string& what, const py::object& progress) : callback_(progress) {
    is_line_ = progress.is_none();
    if (is_line_) callback_ = py::module_::import("flexarm._progress").attr("line_of")(what);
    if (callback_.is(py::bool_(false))) callback_ = py::none();
  }

  void show(double fraction) {
    if (callback_.is_none()) return;
    if (!is_line_) {
      callback_(fraction);
      return;
    }
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begun_;
    time_left_.update(elapsed.count(), fraction);
    const auto left_s = time_left_.seconds();
    callback_(fraction, left_s ? report::time_left_text(*left_s) : "");
  }
  /// A callback hears of the end; a line is wiped.
  void show_end() {
    if (!is_line_) show(1.0);
  }
  void close() const {
    if (is_line_ && !callback_.is_none()) callback_.attr("close")();
  }

 private:
  py::object callback_;
  bool is_line_ = false;
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  report::TimeLeft time_left_;
};

}  // namespace

void run_long_call(const std::string& what, const py::object& progress,
                   const std::function<void(CallState&)>& work) {
  Shown shown(what, progress);
  CallState state;
  std::optional<py::error_already_set> raised;
  {
    Worker worker(work, state);
    while (!worker.ends_within(kLook)) {
      if (raised) continue;
      try {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        shown.show(state.fraction());
      } catch (py::error_already_set& error) {
        raised.emplace(error);
        state.cancel();
        shown.close();
      }
    }
    if (!raised) {
      shown.close();
      worker.rethrow();
      shown.show_end();
    }
  }
  if (raised) throw py::error_already_set(*raised);
}

}  // namespace flexarm::python
