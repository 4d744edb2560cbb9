#include "diagnose/search/least_squares.hpp"

#include <unsupported/Eigen/NonLinearOptimization>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;

/// Step in a place of a difference quotient: beside it the rounding of a simulation, 1e-12, and
/// its curvature are both small.
constexpr double kStep = 1e-5;

/// Residuals by places, as the minimiser wants them.
struct DifferencedResiduals {
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  const ResidualsAt& residuals_at;
  int evaluations = 0;
  Eigen::VectorXd last_places = {};
  Eigen::VectorXd last = {};

  Index inputs() const { return last_places.size(); }
  Index values() const { return last.size(); }

  Eigen::VectorXd evaluate(const Eigen::VectorXd& places) {
    ++evaluations;
    return residuals_at(places);
  }
  /// The same; the minimiser asks for a place's derivatives when it has just had its residuals.
  const Eigen::VectorXd& at(const Eigen::VectorXd& places) {
    if (last_places.size() != places.size() || last_places != places || last.size() == 0) {
      last = evaluate(places);
      last_places = places;
    }
    return last;
  }
  int operator()(const Eigen::VectorXd& places, Eigen::VectorXd& residuals) {
    residuals = at(places);
    return 0;
  }
  int df(const Eigen::VectorXd& places, Eigen::MatrixXd& jacobian) {
    const Eigen::VectorXd& here = at(places);
    for (Index i = 0; i < inputs(); ++i) {
      Eigen::VectorXd beside = places;
      const double step = places(i) < 0.5 ? kStep : -kStep;
      beside(i) += step;
      jacobian.col(i) = (evaluate(beside) - here) / step;
    }
    return 0;
  }
};

}  // namespace

LeastSquares least_squares(const ResidualsAt& residuals, const Eigen::VectorXd& start,
                           const LeastSquaresOptions& options) {
  DifferencedResiduals differenced{residuals};
  LeastSquares made{.places = start, .converged = start.size() == 0};
  differenced.at(start);
  if (start.size() > 0) {
    Eigen::LevenbergMarquardt<DifferencedResiduals> minimiser(differenced);
    minimiser.parameters.ftol = options.tolerance;
    minimiser.parameters.xtol = options.tolerance;
    auto status = minimiser.minimizeInit(made.places);
    int steps = 0;
    while (status == Eigen::LevenbergMarquardtSpace::Running ||
           status == Eigen::LevenbergMarquardtSpace::NotStarted) {
      if (steps++ == options.most_steps) break;
      status = minimiser.minimizeOneStep(made.places);
    }
    made.converged = status != Eigen::LevenbergMarquardtSpace::Running &&
                     status != Eigen::LevenbergMarquardtSpace::ImproperInputParameters;
  }
  made.jacobian.resize(differenced.values(), differenced.inputs());
  differenced.df(made.places, made.jacobian);
  made.residuals = differenced.at(made.places);
  made.evaluations = differenced.evaluations;
  return made;
}

}  // namespace flexarm::diagnose
