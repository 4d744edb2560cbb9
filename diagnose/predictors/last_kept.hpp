#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace flexarm::diagnose {

/// Values that are computed of keys: those of the last `most` keys that were asked for are kept.
/// Concurrent calls are safe, and give what a computation would; of the same key they may both
/// compute it.
template <class Key, class Value>
class LastKept {
 public:
  explicit LastKept(std::size_t most) : most_(most) {}

  /// compute(key) where the key is not kept; its exceptions pass through.
  template <class Compute>
  std::shared_ptr<const Value> of(Key key, const Compute& compute) {
    {
      const std::lock_guard lock(mutex_);
      const auto found = std::ranges::find(entries_, key, &Entry::key);
      if (found != entries_.end()) {
        std::rotate(found, found + 1, entries_.end());
        return entries_.back().value;
      }
    }
    auto value = std::make_shared<const Value>(compute(std::as_const(key)));
    const std::lock_guard lock(mutex_);
    if (entries_.size() == most_) entries_.erase(entries_.begin());
    entries_.push_back({std::move(key), value});
    return value;
  }

 private:
  struct Entry {
    Key key;
    std::shared_ptr<const Value> value;
  };

  std::size_t most_;
  std::mutex mutex_;            // of what follows
  std::vector<Entry> entries_;  // the last used at the end
};

}  // namespace flexarm::diagnose
