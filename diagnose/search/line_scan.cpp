#include "diagnose/search/line_scan.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <queue>
#include <vector>

namespace flexarm::diagnose {

namespace {

using Eigen::VectorXd;

/// Of e, that the course in a half may be from its chord.
constexpr double kOfHalf = 0.5;
/// e over the chord, of a course that is resolved.
constexpr double kResolved = 0.25;
constexpr double kUnknown = std::numeric_limits<double>::infinity();

/// Distance of `point` from the chord from `a` to `b`.
double distance(const VectorXd& point, const VectorXd& a, const VectorXd& b) {
  const VectorXd chord = b - a;
  const double square = chord.squaredNorm();
  const double along = square > 0.0 ? std::clamp(chord.dot(point - a) / square, 0.0, 1.0) : 0.0;
  return (point - a - along * chord).norm();
}

/// Values with others between them that have not been looked at.
struct Interval {
  double least = 0.0;  ///< bound of |r|
  int from = 0;
  int to = 0;

  // The lowest bound is looked at first.
  bool operator<(const Interval& other) const { return least > other.least; }
};

class LineScan {
 public:
  LineScan(const ResidualsAtValue& residuals, int count)
      : residuals_(residuals), known_(static_cast<std::size_t>(count)) {}

  int least() {
    const int last = static_cast<int>(known_.size()) - 1;
    look(0);
    if (last > 0) look(last);
    push(0, last, kUnknown);
    while (!intervals_.empty() && intervals_.top().least < least_) {
      const auto [bound, from, to] = intervals_.top();
      intervals_.pop();
      const int middle = std::midpoint(from, to);
      look(middle);
      const double most = most_departure(from, middle, to);
      push(from, middle, most);
      push(middle, to, most);
    }
    return best_;
  }

 private:
  const std::optional<VectorXd>& at(int value) const {
    return known_[static_cast<std::size_t>(value)];
  }

  void look(int value) {
    auto& known = known_[static_cast<std::size_t>(value)];
    known = residuals_(value);
    const double left = known ? known->norm() : kUnknown;
    if (!(left < least_)) return;
    least_ = left;
    best_ = value;
  }

  /// Of the course in the halves of an interval from their chords.
  double most_departure(int from, int middle, int to) const {
    if (!at(from) || !at(middle) || !at(to)) return kUnknown;
    const double off = distance(*at(middle), *at(from), *at(to));
    return off <= kResolved * (*at(to) - *at(from)).norm() ? kOfHalf * off : kUnknown;
  }

  void push(int from, int to, double most_departure) {
    if (to - from < 2) return;
    const bool is_known = std::isfinite(most_departure) && at(from) && at(to);
    const double chord =
        is_known ? distance(VectorXd::Zero(at(from)->size()), *at(from), *at(to)) : 0.0;
    intervals_.push({std::max(0.0, chord - (is_known ? most_departure : 0.0)), from, to});
  }

  const ResidualsAtValue& residuals_;
  std::vector<std::optional<VectorXd>> known_;
  std::priority_queue<Interval> intervals_;
  double least_ = std::numeric_limits<double>::infinity();
  int best_ = 0;
};

}  // namespace

int least_on_line(const ResidualsAtValue& residuals, int count) {
  return LineScan(residuals, count).least();
}

}  // namespace flexarm::diagnose
