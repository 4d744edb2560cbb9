#include "response/steady_state.hpp"

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
/// A drift counts this much less than the states: of two ways to close a period the one without a
/// drift is taken.
constexpr double kDriftWeight = 1e-3;
/// Newton's derivative is kept while it shortens its steps this much.
constexpr double kGoodStep = 0.2;

class Shooting {
 public:
  Shooting(DrivenArm& arm, const SteadyStateOptions& options) : arm_(&arm), options_(options) {}

  SteadyState find(const Eigen::VectorXd& guess, bool is_held) {
    found_.state = guess;
    found_.is_held = is_held;
    if (!newton()) {
      found_.state = guess;
      found_.is_held = is_held;
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
    return std::max(state.norm(), arm_->state_scale());
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

  /// (F' - 1) step - drift of (step) = -(F(X) - X - drift so far), the shortest of all.
  Eigen::VectorXd step_after(const Eigen::VectorXd& after) const {
    return slope_.solve(found_.state - after + drift_);
  }

  bool newton() {
    const double tolerance = arm_->is_linear() ? options_.linear_tolerance : options_.tolerance;
    const Index n = found_.state.size();
    double last = 0.0;
    bool is_new = false;
    for (int i = 0; i < options_.most_steps; ++i) {
      const Eigen::VectorXd after = after_a_period(found_.state, found_.is_held);
      const bool ends_held = arm_->is_held();
      if (i == 0) {
        differentiate(after);
        is_new = true;
      }
      Eigen::VectorXd steps = step_after(after);
      if (!arm_->is_linear() && steps.head(n).norm() > kGoodStep * last && !is_new) {
        differentiate(after);
        steps = step_after(after);
        is_new = true;
      } else {
        is_new = i == 0;
      }
      if (!steps.allFinite()) return false;
      const Eigen::VectorXd step = steps.head(n);
      // A linear arm is improved as long as rounding lets it be.
      found_.found = step.norm() <= tolerance * length(found_.state) ||
                     (arm_->is_linear() && i > 1 && step.norm() > 0.5 * last);
      if (found_.found) return true;
      found_.state += step;
      drift_ += drifts_ * steps.tail(drifts_.cols());
      found_.is_held = ends_held;
      last = step.norm();
    }
    return false;
  }

  void wait() {
    for (int i = 0; i < options_.most_periods; ++i) {
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
