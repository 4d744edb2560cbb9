#include "diagnose/search/fit.hpp"

#include <unsupported/Eigen/NonLinearOptimization>

#include <cmath>
#include <limits>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;

/// Step in a place of a difference quotient: beside it the rounding of a simulation, 1e-12, and
/// its curvature are both small.
constexpr double kStep = 1e-5;
/// Residual that stands for a candidate that cannot be computed.
constexpr double kImpossible = 1e8;

/// Residuals by places, as the minimiser wants them.
struct Residuals {
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  const Problem& problem;
  Candidate candidate;
  const ReportedWork* work = nullptr;
  int evaluations = 0;
  Eigen::VectorXd last_places = {};
  Eigen::VectorXd last = {};

  Index inputs() const {
    return static_cast<Index>(candidate.nuisances.size() + candidate.values.size());
  }
  Index values() const { return problem.residual_count(); }

  Eigen::VectorXd evaluate(const Eigen::VectorXd& places) {
    if (work != nullptr) work->go_on();
    candidate.put(places);
    ++evaluations;
    const auto made = problem.residuals(candidate, problem.estimation_runs());
    return made ? *made : Eigen::VectorXd::Constant(values(), kImpossible);
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

Fit fit(const Problem& problem, const Candidate& start, const FitOptions& options) {
  Residuals residuals{problem, start, options.work};
  Fit made;
  Eigen::VectorXd places = start.coordinates();
  made.converged = places.size() == 0;
  if (places.size() > 0) {
    Eigen::LevenbergMarquardt<Residuals> minimiser(residuals);
    minimiser.parameters.ftol = options.tolerance;
    minimiser.parameters.xtol = options.tolerance;
    auto status = minimiser.minimizeInit(places);
    int steps = 0;
    while (status == Eigen::LevenbergMarquardtSpace::Running ||
           status == Eigen::LevenbergMarquardtSpace::NotStarted) {
      if (steps++ == options.most_steps) break;
      status = minimiser.minimizeOneStep(places);
    }
    made.converged = status != Eigen::LevenbergMarquardtSpace::Running &&
                     status != Eigen::LevenbergMarquardtSpace::ImproperInputParameters;
  }
  made.jacobian.resize(residuals.values(), residuals.inputs());
  residuals.df(places, made.jacobian);
  made.residuals = residuals.at(places);
  made.candidate = start;
  made.candidate.put(places);
  made.sum_of_squares = made.residuals.squaredNorm();
  made.evaluations = residuals.evaluations;
  return made;
}

}  // namespace flexarm::diagnose
