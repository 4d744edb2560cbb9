#pragma once

#include "diagnose/search/candidate.hpp"
#include "diagnose/search/problem.hpp"
#include "diagnose/search/reported_work.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <vector>

namespace flexarm::diagnose {

/// More dimensions than this leave a grid too few places along an axis.
inline constexpr Eigen::Index kMostOfGrid = 2;

/// docs/numerics.md section 8 compares them.
enum class ScanMethod {
  by_dimension,  ///< grid of one or two coordinates, else DIRECT-L
  grid,          ///< middles of equal boxes, as many along each axis as the evaluations allow
  direct,        ///< DIRECT-L (Gablonsky & Kelley 2001)
};

struct ScanOptions {
  int evaluations = 40;
  int starts = 1;  ///< places returned <=
  ScanMethod method = ScanMethod::by_dimension;
  /// Range of the coordinates: the whole one of parameters; nuisances are in standard deviations.
  double lowest = 0.0;
  double highest = 1.0;
  const ReportedWork* work = nullptr;  ///< that the scan is part of; asked before each evaluation
};

/// Starts for fits: `start` with the `coordinates` (of Candidate::coordinates()) at those places of
/// their range at which the sum of squares of the estimation runs is smallest, the best
/// first. They differ by a tenth of a range in at least one coordinate. Where runs are simulated
/// the sum of squares has many minima, each as wide as a few parts in a hundred of a frequency.
/// Throws Cancelled where the work is cancelled.
std::vector<Candidate> scan(const Problem& problem, const Candidate& start,
                            const std::vector<Eigen::Index>& coordinates,
                            const ScanOptions& options);

/// The same for another sum of squares than that of a problem; infinite: no such candidate. It is
/// called concurrently.
using SumOfSquares = std::function<double(const Candidate&)>;
std::vector<Candidate> scan(const SumOfSquares& sum_of_squares, const Candidate& start,
                            const std::vector<Eigen::Index>& coordinates,
                            const ScanOptions& options);

/// The places of a grid in the unit cube of so many dimensions: the middles of equal boxes, as many
/// along each axis as the evaluations allow.
std::vector<Eigen::VectorXd> grid_places(Eigen::Index dimension, int evaluations);
/// Of `places` with these sums of squares the indices of the best <= `most`, the best first, that
/// differ by a tenth of a range in at least one coordinate.
std::vector<std::size_t> best_apart(const std::vector<Eigen::VectorXd>& places,
                                    const std::vector<double>& sums, int most);

/// The coordinates of the last effect of the candidate.
std::vector<Eigen::Index> last_coordinates(const Candidate& candidate);

/// The best place of the parameters of the last effect of `start`.
Candidate scan(const Problem& problem, const Candidate& start, int evaluations);

}  // namespace flexarm::diagnose
