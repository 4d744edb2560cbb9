#include "diagnose/search/least_squares.hpp"

#include "diagnose/parallel.hpp"

#include <Eigen/QR>
#include <unsupported/Eigen/NonLinearOptimization>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;
namespace status = Eigen::LevenbergMarquardtSpace;

/// Step in a place of a difference quotient: beside it the rounding of a simulation, 1e-12, and
/// its curvature are both small.
constexpr double kStep = 1e-5;
/// A Jacobian is updated where it predicted the change of the residuals to this part of that.
constexpr double kPredicted = 0.3;
/// A step that lowers the sum of squares by so many times what the Jacobian expected is too short:
/// residuals that jump, as where friction reverses, have larger derivatives than changes.
constexpr double kBeyondExpected = 1.5;
/// It is lengthened to at most so many times.
constexpr double kMostTimes = 1024.0;
/// Part of the sum of squares that a Gauss-Newton step takes away.
double explained(const Eigen::VectorXd& residuals, const Eigen::MatrixXd& jacobian) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> factors(jacobian);
  const Eigen::VectorXd turned = factors.householderQ().adjoint() * residuals;
  const auto rank = std::min(jacobian.rows(), jacobian.cols());
  return turned.head(rank).squaredNorm();
}

/// Residuals by places, as the minimiser wants them.
class DifferencedResiduals {
 public:
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  DifferencedResiduals(const ResidualsAt& residuals_at, const Eigen::VectorXd& start)
      : residuals_at_(residuals_at), here_(evaluated(start)) {}

  Index inputs() const { return here_.places.size(); }
  Index values() const { return here_.residuals.size(); }
  int evaluations() const { return evaluations_; }

  /// Negative, which ends the minimisation, where an updated Jacobian misled it.
  int operator()(const Eigen::VectorXd& places, Eigen::VectorXd& residuals) {
    if (places != here_.places) {
      Evaluated there = evaluated(places);
      if (is_updated() && !(there.residuals.norm() < jacobian_->at.residuals.norm())) {
        updates_ = false;
        return -1;
      }
      here_ = std::move(there);
    }
    residuals = here_.residuals;
    return 0;
  }

  /// By Broyden's update [Broyden1965] of the last one where that predicted the step well, by
  /// difference quotients at first and else.
  int df(const Eigen::VectorXd& places, Eigen::MatrixXd& jacobian) {
    if (!try_update(at(places))) difference(places);
    jacobian = jacobian_->values;
    return 0;
  }

  /// By difference quotients.
  const Eigen::MatrixXd& differenced(const Eigen::VectorXd& places) {
    if (!jacobian_ || jacobian_->is_updated || jacobian_->at.places != places) difference(places);
    return jacobian_->values;
  }

  const Eigen::VectorXd& residuals(const Eigen::VectorXd& places) { return at(places).residuals; }

  /// Goes on along the step that the last Jacobian led to, to `places`, twice as far each time
  /// while the sum of squares falls, if in this step and in the last one it fell by more than
  /// expected. Returns whether it did.
  bool go_further(Eigen::VectorXd& places) {
    if (!jacobian_ || jacobian_->at.places == places) return false;
    const auto& [begin, left] = jacobian_->at;
    const Eigen::VectorXd step = places - begin;
    const double before = left.squaredNorm();
    const double expected = before - (left + jacobian_->values * step).squaredNorm();
    double least = at(places).residuals.squaredNorm();
    const bool fell_further = before - least > kBeyondExpected * expected;
    if (!std::exchange(fell_further_, fell_further) || !fell_further) return false;
    double times = 1.0;
    while (times < kMostTimes) {
      Evaluated further = evaluated(begin + 2.0 * times * step);
      const double sum = further.residuals.squaredNorm();
      if (!(sum < least)) break;
      least = sum;
      places = further.places;
      here_ = std::move(further);
      times *= 2.0;
    }
    return times > 1.0;
  }

  /// The last Jacobian is no quotient of differences.
  bool is_updated() const { return jacobian_ && jacobian_->is_updated; }
  /// A step by an updated Jacobian led up.
  bool was_misled() const { return !updates_; }

 private:
  struct Evaluated {
    Eigen::VectorXd places;
    Eigen::VectorXd residuals;
  };
  struct Jacobian {
    Evaluated at;
    Eigen::MatrixXd values;
    bool is_updated = false;
  };

  Evaluated evaluated(const Eigen::VectorXd& places) {
    ++evaluations_;
    return {places, residuals_at_(places)};
  }

  /// The minimiser asks for a place's derivatives when it has just had its residuals, unless it
  /// went back from another.
  const Evaluated& at(const Eigen::VectorXd& places) {
    if (places != here_.places) {
      here_ = jacobian_ && jacobian_->at.places == places ? jacobian_->at : evaluated(places);
    }
    return here_;
  }

  void difference(const Eigen::VectorXd& places) {
    Jacobian made{.at = at(places), .values = Eigen::MatrixXd(values(), inputs())};
    in_parallel(static_cast<std::size_t>(inputs()), [&](std::size_t k) {
      const auto i = static_cast<Index>(k);
      Eigen::VectorXd beside = places;
      const double step = places(i) < 0.5 ? kStep : -kStep;
      beside(i) += step;
      made.values.col(i) = (residuals_at_(beside) - made.at.residuals) / step;
    });
    evaluations_ += static_cast<int>(inputs());
    jacobian_ = std::move(made);
  }

  bool try_update(const Evaluated& there) {
    if (!updates_ || !jacobian_) return false;
    const Eigen::VectorXd step = there.places - jacobian_->at.places;
    const double length = step.squaredNorm();
    if (length == 0.0) return true;
    const Eigen::VectorXd change = there.residuals - jacobian_->at.residuals;
    const Eigen::VectorXd unpredicted = change - jacobian_->values * step;
    if (!(unpredicted.norm() <= kPredicted * change.norm())) return false;
    jacobian_->values.noalias() += unpredicted * (step / length).transpose();
    jacobian_->at = there;
    jacobian_->is_updated = true;
    return true;
  }

  const ResidualsAt& residuals_at_;
  int evaluations_ = 0;
  Evaluated here_;
  std::optional<Jacobian> jacobian_;
  bool updates_ = true;
  bool fell_further_ = false;  // in the last step, than its Jacobian expected
};

/// Whether a Gauss-Newton step would lower the sum of squares by no more than this part of it.
bool is_least(const Eigen::VectorXd& residuals, const Eigen::MatrixXd& jacobian, double tolerance) {
  return explained(residuals, jacobian) <= tolerance * residuals.squaredNorm();
}

}  // namespace

LeastSquares least_squares(const ResidualsAt& residuals, const Eigen::VectorXd& start,
                           const LeastSquaresOptions& options) {
  DifferencedResiduals differenced(residuals, start);
  LeastSquares made{.places = start, .converged = start.size() == 0};
  Eigen::LevenbergMarquardt<DifferencedResiduals> minimiser(differenced);
  minimiser.parameters.ftol = options.tolerance;
  minimiser.parameters.xtol = options.tolerance;
  int steps = 0;
  while (start.size() > 0) {
    auto ended = minimiser.minimizeInit(made.places);
    while ((ended == status::Running || ended == status::NotStarted) &&
           steps < options.most_steps) {
      ++steps;
      ended = minimiser.minimizeOneStep(made.places);
      if (ended == status::Running && differenced.go_further(made.places)) {
        ended = minimiser.minimizeInit(made.places);
      }
    }
    made.converged = ended != status::Running && ended != status::ImproperInputParameters;
    if (!differenced.is_updated()) break;
    if (!options.is_differenced_at_end && !differenced.was_misled()) break;
    // What an updated Jacobian takes for the minimum need not be one.
    made.converged = is_least(differenced.residuals(made.places),
                              differenced.differenced(made.places), options.tolerance);
    if (made.converged || steps == options.most_steps) break;
  }
  made.residuals = differenced.residuals(made.places);
  if (options.is_differenced_at_end) {
    made.jacobian = differenced.differenced(made.places);
  } else {
    differenced.df(made.places, made.jacobian);
  }
  made.evaluations = differenced.evaluations();
  return made;
}

}  // namespace flexarm::diagnose
