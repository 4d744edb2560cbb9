#include "diagnose/search/minimise.hpp"

#include "diagnose/parallel.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace flexarm::diagnose {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Step of the difference quotient of a place.
constexpr double kFitStep = 1e-5;
/// Step for a law that shows in time alone, such as dry friction, which switches: over a small step
/// a switch more or less is chance.
constexpr double kSwitchedStep = 1e-3;
/// The longest step of a place.
constexpr double kLongestStep = 0.35;
constexpr double kFirstDamping = 1e-3;
constexpr double kMostDamping = 1e6;
/// A step that gains less than this part of what it promises has derivatives that are too old.
constexpr double kPoorGain = 0.25;

/// The places of a candidate, and which of them end at 0 and 1.
class Places {
 public:
  explicit Places(const Candidate& start) : start_(start), unbounded_(std::ssize(start.nuisances)) {
    steps_.assign(start.nuisances.size(), kFitStep);
    for (const Hypothesis& effect : start.effects) {
      const bool is_smooth = effect.entry->shows != effects::Shows::in_time;
      for (const SearchedParameter& one : effect.parameters) {
        is_periodic_.push_back(one.periodic);
        steps_.push_back(is_smooth ? kFitStep : kSwitchedStep);
      }
    }
  }

  Candidate at(const VectorXd& places) const {
    Candidate made = start_;
    made.put(places);
    return made;
  }
  bool is_bounded(Index i) const {
    return i >= unbounded_ && !is_periodic_[static_cast<std::size_t>(i - unbounded_)];
  }
  VectorXd bounded(VectorXd places) const {
    for (Index i = 0; i < places.size(); ++i) {
      if (is_bounded(i)) places(i) = std::clamp(places(i), 0.0, 1.0);
    }
    return places;
  }
  /// Returns the step of the difference quotient of a place.
  double step(Index i) const { return steps_[static_cast<std::size_t>(i)]; }

 private:
  const Candidate& start_;
  Index unbounded_;
  std::vector<bool> is_periodic_;
  std::vector<double> steps_;
};

/// The derivatives of the lines by the places of a candidate: difference quotients, and between
/// these the secant update of [Broyden1965].
class Derivatives {
 public:
  Derivatives(const Objective& objective, const Places& places, const ReportedWork& work)
      : objective_(objective), places_(places), work_(work) {}

  const MatrixXd& matrix() const { return matrix_; }
  bool are_exact() const { return are_exact_; }
  int evaluations() const { return evaluations_; }

  /// Computes the derivatives at `here`, where the lines are `lines`. Those by nuisances and by the
  /// effects that `base` has as well are taken from it, where it is given.
  void compute(const VectorXd& here, const VectorXd& lines, const Minimum* base = nullptr) {
    matrix_ = MatrixXd::Zero(lines.size(), here.size());
    std::vector<Index> unknown;
    std::vector<Index> known(static_cast<std::size_t>(here.size()), -1);
    if (base != nullptr) known = columns_in(base->candidate, places_.at(here));
    for (Index i = 0; i < here.size(); ++i) {
      const Index column = known[static_cast<std::size_t>(i)];
      if (column < 0) {
        unknown.push_back(i);
      } else {
        matrix_.col(i) = base->jacobian.col(column);
      }
    }
    difference(unknown, here, lines);
    are_exact_ = base == nullptr;
  }

  void update(const VectorXd& step, const VectorXd& change) {
    const VectorXd missed = change - matrix_ * step;
    matrix_ += missed * step.transpose() / step.squaredNorm();
    are_exact_ = false;
  }

 private:
  /// Computes these columns by difference quotients inwards; one that cannot be computed stays 0.
  void difference(const std::vector<Index>& columns, const VectorXd& here, const VectorXd& lines) {
    evaluations_ += static_cast<int>(columns.size());
    in_parallel(columns.size(), [&](std::size_t k) {
      work_.go_on();
      const Index i = columns[k];
      VectorXd beside = here;
      const double step = here(i) < 0.5 ? places_.step(i) : -places_.step(i);
      beside(i) += step;
      if (const auto moved = objective_.lines_of(places_.at(beside))) {
        matrix_.col(i) = (*moved - lines) / step;
      }
    });
  }

  /// Returns the column of `base` of each coordinate of `start`; -1 without one.
  static std::vector<Index> columns_in(const Candidate& base, const Candidate& start) {
    std::vector<Index> columns(start.nuisances.size());
    std::iota(columns.begin(), columns.end(), Index{0});
    for (const Hypothesis& effect : start.effects) {
      const auto own = std::ranges::find(base.effects, effect.label(), &Hypothesis::label);
      const auto index = static_cast<std::size_t>(own - base.effects.begin());
      auto column = static_cast<Index>(base.nuisances.size() + base.values_before(index));
      for (std::size_t i = 0; i < effect.parameters.size(); ++i) {
        columns.push_back(own == base.effects.end() ? -1 : column++);
      }
    }
    return columns;
  }

  const Objective& objective_;
  const Places& places_;
  const ReportedWork& work_;
  MatrixXd matrix_;
  bool are_exact_ = false;
  int evaluations_ = 0;
};

/// Returns the damped Gauss-Newton step of the cost, places at a bound that it would leave held
/// there.
VectorXd damped_step(const MatrixXd& normal, const VectorXd& gradient, const VectorXd& here,
                     const Places& places, double damping) {
  std::vector<bool> is_held(static_cast<std::size_t>(here.size()), false);
  VectorXd step = VectorXd::Zero(here.size());
  for (Index pass = 0; pass <= here.size(); ++pass) {
    MatrixXd damped = normal;
    VectorXd downhill = -gradient;
    for (Index i = 0; i < here.size(); ++i) {
      damped(i, i) += damping * normal(i, i) + 1e-12 * (1.0 + normal.trace());
      if (!is_held[static_cast<std::size_t>(i)]) continue;
      damped.row(i).setZero();
      damped.col(i).setZero();
      damped(i, i) = 1.0;
      downhill(i) = 0.0;
    }
    step = damped.ldlt().solve(downhill);
    bool is_inside = true;
    for (Index i = 0; i < here.size(); ++i) {
      const bool at_bound = places.is_bounded(i) && ((here(i) <= 0.0 && step(i) < 0.0) ||
                                                     (here(i) >= 1.0 && step(i) > 0.0));
      if (!at_bound) continue;
      is_held[static_cast<std::size_t>(i)] = true;
      is_inside = false;
    }
    if (is_inside) break;
  }
  const double longest = step.size() > 0 ? step.cwiseAbs().maxCoeff() : 0.0;
  if (longest > kLongestStep) step *= kLongestStep / longest;
  return step;
}

}  // namespace

Minimum minimise(const Objective& objective, const Candidate& start, const ReportedWork& work,
                 const MinimiseOptions& options, const Minimum* base) {
  const Places places(start);
  Minimum made{.candidate = start};
  VectorXd here = places.bounded(start.coordinates());
  made.candidate.put(here);
  work.go_on();
  auto start_lines = objective.lines_of(made.candidate);
  if (!start_lines) return made;
  made.lines = *std::move(start_lines);
  made.cost = objective.cost(made.lines);
  made.evaluations = 1;
  Derivatives derivatives(objective, places, work);
  derivatives.compute(here, made.lines, base);
  double damping = kFirstDamping;
  for (int steps = 0; here.size() > 0 && steps < options.most_steps && !made.converged;) {
    const MatrixXd weighted = objective.weights(made.lines).asDiagonal() * derivatives.matrix();
    const MatrixXd normal = derivatives.matrix().transpose() * weighted;
    const VectorXd gradient = weighted.transpose() * made.lines;
    const VectorXd step = damped_step(normal, gradient, here, places, damping);
    const double expected = -(2.0 * gradient + normal * step).dot(step);
    const double least = std::max(options.tolerance, options.relative_tolerance * made.cost);
    if (!(expected > least) || damping > kMostDamping) {
      made.converged = derivatives.are_exact() || options.takes_secants;
      if (!made.converged) derivatives.compute(here, made.lines);
      continue;
    }
    ++steps;
    const VectorXd there = places.bounded(here + step);
    work.go_on();
    const Candidate tried = places.at(there);
    auto lines = objective.lines_of(tried);
    ++made.evaluations;
    const double cost = lines ? objective.cost(*lines) : made.cost;
    if (!(cost < made.cost)) {
      damping *= 8.0;
      if (!derivatives.are_exact() && !options.takes_secants) {
        derivatives.compute(here, made.lines);
      }
      continue;
    }
    damping /= 5.0;
    const bool is_poor = made.cost - cost < kPoorGain * expected;
    if (is_poor) {
      derivatives.compute(there, *lines);
    } else {
      derivatives.update(there - here, *lines - made.lines);
    }
    here = there;
    made.candidate = tried;
    made.lines = *std::move(lines);
    made.cost = cost;
  }
  if (!derivatives.are_exact() && !options.takes_secants) {
    derivatives.compute(here, made.lines);
  }
  made.converged = made.converged || here.size() == 0;
  made.jacobian = derivatives.matrix();
  made.evaluations += derivatives.evaluations();
  return made;
}

}  // namespace flexarm::diagnose
