#include "response/time/steady_state.hpp"

#include <Eigen/SVD>

#include <algorithm>

namespace flexarm::response {

namespace {

using Eigen::Index;

/// Singular values of F' - 1 below this of the largest: the state drifts there. A transient of
/// damping ratio zeta has 2 pi zeta or more; a linear arm's differences are exact to rounding.
constexpr double kDriftLinear = 1e-9;
constexpr double kDrift = 1e-6;
/// Length of differences over that of the state: the root of the error of F is 1e-6.
constexpr double kDifference = 1e-6;
/// Multiples of drifts beside the states: large enough that a slow decay of the drift's speed, 1e-5
/// a period, is not taken for none.
constexpr double kDriftWeight = 1.0;
/// Newton's derivative is kept while it shortens its steps this much.
constexpr double kGoodStep = 0.2;

/// Steps that shrink no more than this are rounding's.
constexpr double kStandingStep = 0.5;
constexpr double kLastDigit = 1e-16;
constexpr double kSmallestPart = 1.0 / 64.0;

class Shooting {
 public:
  Shooting(DrivenArm& arm, const SteadyStateOptions& options) : arm_(&arm), options_(options) {}

  SteadyState find(const Eigen::VectorXd& guess, bool is_held) {
    found_.state = guess;
    found_.is_held = is_held;
    for (int i = 0; i < options_.most_attempts; ++i) {
      const Eigen::VectorXd state = found_.state;
      const bool was_held = found_.is_held;
      if (newton()) break;
      found_.state = state;
      found_.is_held = was_held;
      wait();
    }
    arm_->put(found_.state, found_.is_held);
    return found_;
  }

 private:
  Eigen::VectorXd after_a_period(const Eigen::VectorXd& state, bool is_held) {
    arm_->put(state, is_held);
    arm_->drive_period(nullptr);
    ++found_.periods;
    return arm_->state();
  }

  double length(const Eigen::VectorXd& state) const {
    return std::max(state.stableNorm(), arm_->state_scale());
  }

  void differentiate(const Eigen::VectorXd& after) {
    const Index n = after.size();
    const double step = (arm_->is_linear() ? 1.0 : kDifference) * length(found_.state);
    Eigen::MatrixXd slope(n, n);
    for (Index j = 0; j < n; ++j) {
      Eigen::VectorXd beside = found_.state;
      beside(j) += step;
      slope.col(j) = (after_a_period(beside, found_.is_held) - after) / step;
      slope(j, j) -= 1.0;
    }
    const double threshold = arm_->is_linear() ? kDriftLinear : kDrift;
    Eigen::JacobiSVD<Eigen::MatrixXd> plain(slope, Eigen::ComputeFullV);
    plain.setThreshold(threshold);
    const Index drifts = n - plain.rank();
    drift_.setZero(n);
    drifts_ = kDriftWeight * plain.matrixV().rightCols(drifts);
    Eigen::MatrixXd drifting(n, n + drifts);
    drifting << slope, -drifts_;
    slope_.compute(drifting, Eigen::ComputeThinU | Eigen::ComputeThinV);
    slope_.setThreshold(threshold);
  }

  /// (F' - 1) step - drift of (step) = -(F(X) - X - drift so far), the shortest of all: states,
  /// then multiples of the drifts.
  Eigen::VectorXd step_at(const Eigen::VectorXd& state, const Eigen::VectorXd& after,
                          const Eigen::VectorXd& drift) const {
    return slope_.solve(state - after + drift);
  }

  /// Newton's method, damped by the natural monotonicity test
  /// ([Deuflhard2004], section 3.3): a step is halved until the next one with the same
  /// derivative is shorter.
  bool newton() {
    const Index n = found_.state.size();
    Eigen::VectorXd after = after_a_period(found_.state, found_.is_held);
    differentiate(after);
    Eigen::VectorXd step = step_at(found_.state, after, drift_);
    for (int i = 0; i < options_.most_steps; ++i) {
      if (!step.allFinite()) return false;
      const double size = length(found_.state);
      const double now = step.head(n).stableNorm();
      bool is_shorter = false;
      double part = 1.0;
      Eigen::VectorXd trial;
      Eigen::VectorXd drift;
      Eigen::VectorXd next;
      bool ends_held = false;
      for (; part >= kSmallestPart && !is_shorter; part *= is_shorter ? 1.0 : 0.5) {
        trial = found_.state + part * step.head(n);
        drift = drift_ + drifts_ * (part * step.tail(drifts_.cols()));
        after = after_a_period(trial, found_.is_held);
        ends_held = arm_->is_held();
        next = step_at(trial, after, drift);
        const bool stands =
            now <= kLastDigit * size || next.head(n).stableNorm() > kStandingStep * now;
        found_.found = stands && i > 0 && (arm_->is_linear() || now <= options_.tolerance * size);
        if (found_.found) return true;
        is_shorter = arm_->is_linear() || next.head(n).stableNorm() <= (1.0 - 0.25 * part) * now;
      }
      if (!is_shorter) return false;
      found_.state = trial;
      found_.is_held = ends_held;
      drift_ = drift;
      const bool is_good = part == 1.0 && next.head(n).stableNorm() <= kGoodStep * now;
      if (!is_good && !arm_->is_linear()) {
        differentiate(after);
        next = step_at(found_.state, after, drift_);
      }
      step = next;
    }
    return false;
  }

  void wait() {
    for (int i = 0; i < options_.periods_between; ++i) {
      found_.state = after_a_period(found_.state, found_.is_held);
      found_.is_held = arm_->is_held();
    }
  }

  DrivenArm* arm_;
  SteadyStateOptions options_;
  SteadyState found_;
  Eigen::JacobiSVD<Eigen::MatrixXd> slope_;  // F' - 1, and the drifts that are left alone
  Eigen::MatrixXd drifts_;
  Eigen::VectorXd drift_;  // F(X) - X of the steady state
};

}  // namespace

SteadyState find_steady_state(DrivenArm& arm, const Eigen::VectorXd& guess, bool is_held,
                              const SteadyStateOptions& options) {
  return Shooting(arm, options).find(guess, is_held);
}

}  // namespace flexarm::response
