#include "diagnose/search/scan.hpp"

#include "diagnose/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <nlopt.hpp>
#include <numeric>
#include <utility>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;

constexpr double kApart = 0.1;
/// log of the sum of squares of what cannot be computed.
constexpr double kImpossibleLog = 40.0;

/// The sum of squares over the scanned coordinates, and every place at which it was asked for.
class ScannedSum {
 public:
  ScannedSum(const SumOfSquares& sum, const Candidate& start, const std::vector<Index>& coordinates,
             const ScanOptions& options)
      : sum_(sum),
        candidate_(start),
        all_(start.coordinates()),
        coordinates_(coordinates),
        options_(options) {}

  /// `scanned` from 0 to 1.
  Candidate candidate_at(const Eigen::VectorXd& scanned) const {
    Candidate made = candidate_;
    Eigen::VectorXd all = all_;
    all(coordinates_) = options_.lowest + (options_.highest - options_.lowest) * scanned.array();
    made.put(all);
    return made;
  }

  /// The logarithm, which DIRECT-L compares between boxes of different size.
  double log_at(const Eigen::VectorXd& scanned) {
    const double sum = sum_at(scanned);
    places_.push_back(scanned);
    sums_.push_back(sum);
    return std::isfinite(sum) ? std::log(sum) : kImpossibleLog;
  }

  /// Many at a time.
  void try_all(std::vector<Eigen::VectorXd> places) {
    std::vector<double> sums(places.size());
    in_parallel(places.size(), [&](std::size_t i) { sums[i] = sum_at(places[i]); });
    std::ranges::move(places, std::back_inserter(places_));
    std::ranges::copy(sums, std::back_inserter(sums_));
  }

  /// The best of the places that are apart.
  std::vector<Candidate> best(int most) const {
    std::vector<Candidate> found;
    for (const std::size_t i : best_apart(places_, sums_, most)) {
      found.push_back(candidate_at(places_[i]));
    }
    return found;
  }

 private:
  double sum_at(const Eigen::VectorXd& scanned) const {
    if (options_.work != nullptr) options_.work->go_on();
    return sum_(candidate_at(scanned));
  }

  const SumOfSquares& sum_;
  const Candidate& candidate_;
  Eigen::VectorXd all_;
  const std::vector<Index>& coordinates_;
  const ScanOptions& options_;
  std::vector<Eigen::VectorXd> places_;
  std::vector<double> sums_;  ///< one a place
};

void try_direct(ScannedSum& sum, Index dimension, int evaluations) {
  nlopt::opt search(nlopt::GN_DIRECT_L, static_cast<unsigned>(dimension));
  // NLopt passes no exception on but its own.
  const nlopt::vfunc cost = [](const std::vector<double>& x, std::vector<double>&, void* data) {
    try {
      return static_cast<ScannedSum*>(data)->log_at(
          Eigen::VectorXd::Map(x.data(), static_cast<Index>(x.size())));
    } catch (const Cancelled&) {
      throw nlopt::forced_stop();
    }
  };
  search.set_min_objective(cost, &sum);
  search.set_lower_bounds(0.0);
  search.set_upper_bounds(1.0);
  search.set_maxeval(evaluations);
  std::vector<double> x(static_cast<std::size_t>(dimension), 0.5);
  double value = 0.0;
  try {
    search.optimize(x, value);
  } catch (const nlopt::forced_stop&) {
    throw Cancelled{};
  }
}

}  // namespace

std::vector<Candidate> scan(const Problem& problem, const Candidate& start,
                            const std::vector<Index>& coordinates, const ScanOptions& options) {
  const auto sum = [&](const Candidate& candidate) {
    const auto residuals = problem.residuals(candidate, problem.estimation_runs());
    return residuals ? residuals->squaredNorm() : std::numeric_limits<double>::infinity();
  };
  return scan(sum, start, coordinates, options);
}

std::vector<Candidate> scan(const SumOfSquares& sum_of_squares, const Candidate& start,
                            const std::vector<Index>& coordinates, const ScanOptions& options) {
  const auto dimension = static_cast<Index>(coordinates.size());
  const bool by_grid = options.method == ScanMethod::grid ||
                       (options.method == ScanMethod::by_dimension && dimension <= kMostOfGrid);
  ScannedSum sum(sum_of_squares, start, coordinates, options);
  if (by_grid) {
    sum.try_all(grid_places(dimension, options.evaluations));
  } else {
    try_direct(sum, dimension, options.evaluations);
  }
  return sum.best(options.starts);
}

std::vector<Eigen::VectorXd> grid_places(Index dimension, int evaluations) {
  constexpr double kRounding = 1e-9;
  const int along_axis = static_cast<int>(
      std::floor(std::pow(evaluations, 1.0 / static_cast<double>(dimension)) + kRounding));
  const auto count = std::lround(std::pow(along_axis, dimension));
  std::vector<Eigen::VectorXd> places;
  for (long k = 0; k < count; ++k) {
    Eigen::VectorXd& place = places.emplace_back(dimension);
    long rest = k;
    for (double& coordinate : place) {
      coordinate = (static_cast<double>(rest % along_axis) + 0.5) / along_axis;
      rest /= along_axis;
    }
  }
  return places;
}

std::vector<std::size_t> best_apart(const std::vector<Eigen::VectorXd>& places,
                                    const std::vector<double>& sums, int most) {
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return sums[i]; });
  std::vector<std::size_t> kept;
  for (const std::size_t i : order) {
    if (std::ssize(kept) == most) break;
    const bool is_apart = std::ranges::all_of(kept, [&](std::size_t other) {
      return (places[i] - places[other]).lpNorm<Eigen::Infinity>() >= kApart;
    });
    if (is_apart) kept.push_back(i);
  }
  return kept;
}

std::vector<Index> last_coordinates(const Candidate& candidate) {
  std::vector<Index> last(candidate.effects.back().parameters.size());
  std::iota(last.begin(), last.end(), candidate.coordinates().size() - std::ssize(last));
  return last;
}

Candidate scan(const Problem& problem, const Candidate& start, int evaluations) {
  return scan(problem, start, last_coordinates(start), {.evaluations = evaluations}).front();
}

}  // namespace flexarm::diagnose
