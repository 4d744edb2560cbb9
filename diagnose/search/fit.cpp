#include "diagnose/search/fit.hpp"

#include <unsupported/Eigen/NonLinearOptimization>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlopt.hpp>
#include <numeric>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;

/// Step in a place of a difference quotient: beside it the rounding of a simulation, 1e-12, and
/// its curvature are both small.
constexpr double kStep = 1e-5;
/// Places nearer to each other than this in every coordinate are taken to be of one minimum.
constexpr double kApart = 0.1;
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
  int evaluations = 0;
  Eigen::VectorXd last_places = {};
  Eigen::VectorXd last = {};

  Index inputs() const {
    return static_cast<Index>(candidate.nuisances.size() + candidate.values.size());
  }
  Index values() const { return problem.residual_count(); }

  Eigen::VectorXd evaluate(const Eigen::VectorXd& places) {
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
  Residuals residuals{problem, start};
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

Candidate scan(const Problem& problem, const Candidate& start, int evaluations) {
  const auto all = start.coordinates().size();
  const auto last = static_cast<Index>(start.effects.back().parameters.size());
  std::vector<Index> coordinates(static_cast<std::size_t>(last));
  std::iota(coordinates.begin(), coordinates.end(), all - last);
  return scan(problem, start, coordinates, evaluations);
}

Candidate scan(const Problem& problem, const Candidate& start,
               const std::vector<Index>& coordinates, int evaluations) {
  return scan_for_several(problem, start, coordinates, evaluations, 1).front();
}

std::vector<Candidate> scan_for_several(const Problem& problem, const Candidate& start,
                                        const std::vector<Index>& coordinates, int evaluations,
                                        std::size_t most) {
  struct Place {
    double sum;
    Eigen::VectorXd coordinates;
  };
  Residuals residuals{problem, start};
  std::vector<Place> places;
  const nlopt::vfunc cost = [](const std::vector<double>& x, std::vector<double>&, void* data) {
    return (*static_cast<std::function<double(const std::vector<double>&)>*>(data))(x);
  };
  const auto scanned = static_cast<Index>(coordinates.size());
  std::function<double(const std::vector<double>&)> evaluate = [&](const std::vector<double>& x) {
    Eigen::VectorXd place = start.coordinates();
    place(coordinates) = Eigen::VectorXd::Map(x.data(), scanned);
    const double sum = residuals.evaluate(place).squaredNorm();
    places.push_back({sum, std::move(place)});
    return std::log(sum);
  };
  nlopt::opt search(nlopt::GN_DIRECT_L, static_cast<unsigned>(scanned));
  search.set_min_objective(cost, &evaluate);
  search.set_lower_bounds(0.0);
  search.set_upper_bounds(1.0);
  search.set_maxeval(evaluations);
  std::vector<double> x(coordinates.size(), 0.5);
  double value = 0.0;
  search.optimize(x, value);

  std::ranges::stable_sort(places, {}, &Place::sum);
  std::vector<Place> kept;
  for (const Place& place : places) {
    const bool is_apart = std::ranges::all_of(kept, [&](const Place& other) {
      return (place.coordinates - other.coordinates).lpNorm<Eigen::Infinity>() >= kApart;
    });
    if (kept.size() < most && is_apart) kept.push_back(place);
  }
  std::vector<Candidate> found;
  for (const Place& place : kept) {
    found.push_back(start);
    found.back().put(place.coordinates);
  }
  return found;
}

}  // namespace flexarm::diagnose
