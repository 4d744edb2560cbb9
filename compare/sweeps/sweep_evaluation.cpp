#include "arm/input_error.hpp"
#include "compare/sweeps/sweep.hpp"
#include "compare/sweeps/sweep_checkpoint.hpp"

#include <fmt/format.h>

#include <chrono>
#include <limits>
#include <mutex>
#include <optional>
#include <tbb/parallel_for.h>

namespace flexarm::compare {

namespace {

using Clock = std::chrono::steady_clock;

/// Writing a checkpoint may take this part of the time, no more.
constexpr double kWritingShare = 0.05;

/// The grid while it is computed: each point by one thread, looked at by whichever thread writes
/// the checkpoint.
class Evaluation {
 public:
  Evaluation(const SweepTask& task, const SweepRun& run)
      : task_(task),
        run_(run),
        values_{std::vector(task.models.size(), std::vector<SweepPoint>(task.points())), 0},
        done_(task.points()) {
    if (run.checkpoint.empty()) return;
    fingerprint_ = fingerprint(task, run.program_version);
    next_writing_ = Clock::now() + seconds(run.checkpoint_interval_s);
    if (run.resume) take_up(read_checkpoint(run.checkpoint, fingerprint_));
  }

  SweepValues run() {
    tbb::parallel_for(std::size_t{0}, task_.points(), [this](std::size_t point) {
      if (is_wanted(point)) compute(point);
    });
    if (failure_) throw arm::InputError(failure_->what(), failure_->key());
    if (count_done() < task_.points()) {
      if (!run_.checkpoint.empty()) write();
      throw SweepInterrupted(count_done(), task_.points());
    }
    // What comes after may be interrupted too.
    if (has_written_) write();
    return std::move(values_);
  }

 private:
  static Clock::duration seconds(double s) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(s));
  }

  bool is_wanted(std::size_t point) const {
    return !done_[point].load(std::memory_order_relaxed) && point < first_failed_.load() &&
           !(run_.stop != nullptr && run_.stop->load());
  }

  void compute(std::size_t point) {
    try {
      const auto arm = task_.arm_of(point);
      for (std::size_t m = 0; m < task_.models.size(); ++m) {
        values_.points[m][point] = evaluate_point(task_.models[m], arm, task_.questions);
      }
    } catch (const arm::InputError& error) {
      note_failure(point, error);
      return;
    }
    done_[point].store(true, std::memory_order_release);
    if (run_.progress) run_.progress();
    write_when_due();
  }

  /// Points before the first one that failed are still computed, so that it is the same one
  /// whatever the number of threads.
  void note_failure(std::size_t point, const arm::InputError& error) {
    const std::lock_guard lock(failing_);
    if (point >= first_failed_.load()) return;
    first_failed_ = point;
    failure_.emplace(fmt::format("at {}: {}", task_.describe(point), error.what()), error.key());
  }

  void write_when_due() {
    if (run_.checkpoint.empty()) return;
    const std::unique_lock lock(writing_, std::try_to_lock);
    if (!lock || Clock::now() < next_writing_) return;
    const auto begin = Clock::now();
    write();
    const auto end = Clock::now();
    const std::chrono::duration<double> took = end - begin;
    next_writing_ =
        end + seconds(std::max(run_.checkpoint_interval_s, took.count() / kWritingShare));
  }

  void write() {
    std::vector<CheckpointEntry> entries;
    for (std::size_t point = 0; point < done_.size(); ++point) {
      if (!done_[point].load(std::memory_order_acquire)) continue;
      for (std::size_t m = 0; m < task_.models.size(); ++m) {
        entries.push_back({m, point, &values_.points[m][point]});
      }
    }
    write_checkpoint(run_.checkpoint, fingerprint_, entries);
    has_written_ = true;
  }

  void take_up(std::vector<StoredPoint> stored) {
    std::vector<std::size_t> models_there(task_.points(), 0);
    for (auto& [model, point, values] : stored) {
      if (model >= task_.models.size() || point >= task_.points()) continue;
      values_.points[model][point] = std::move(values);
      if (++models_there[point] < task_.models.size()) continue;
      done_[point] = true;
      ++values_.resumed;
      if (run_.progress) run_.progress();
    }
    has_written_ = true;
  }

  std::size_t count_done() const {
    std::size_t count = 0;
    for (const auto& done : done_) count += done.load() ? std::size_t{1} : std::size_t{0};
    return count;
  }

  const SweepTask& task_;
  const SweepRun& run_;
  SweepValues values_;
  std::vector<std::atomic<bool>> done_;  ///< [point], by every model
  std::vector<FingerprintLine> fingerprint_;
  std::mutex writing_;
  Clock::time_point next_writing_;  ///< guarded by `writing_`, as is `has_written_`
  bool has_written_ = false;
  std::mutex failing_;
  std::optional<arm::InputError> failure_;  ///< guarded by `failing_`
  std::atomic<std::size_t> first_failed_ = std::numeric_limits<std::size_t>::max();
};

}  // namespace

SweepValues evaluate(const SweepTask& task, const SweepRun& run) {
  require_valid(task);
  return Evaluation(task, run).run();
}

}  // namespace flexarm::compare
