#include "compare/convergence.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace flexarm::compare {

namespace {

/// A refinement that does not at least halve the error, at errors this small, gains nothing: all
/// orders met here divide it by 3 or more.
constexpr double kFloorMayStartBelow = 1e-9;
constexpr double kLeastGain = 2.0;
/// Points nearer to the floor than this factor carry rounding in their digits.
constexpr double kAboveFloor = 30.0;
/// Rounding of the root itself: no slope is read below a hundred times epsilon.
constexpr double kRootRounding = 100.0 * std::numeric_limits<double>::epsilon();

/// Index of the first point after which the error stops falling, or size().
std::size_t rounding_onset(std::span<const RefinementPoint> series) {
  for (std::size_t i = 0; i + 1 < series.size(); ++i) {
    const double error = series[i].relative_error;
    if (error < kFloorMayStartBelow && series[i + 1].relative_error * kLeastGain > error) return i;
  }
  return series.size();
}

/// Least-squares slope of y over x.
double fitted_slope(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<Eigen::Index>(x.size());
  Eigen::MatrixX2d design(n, 2);
  design.col(0).setOnes();
  design.col(1) = Eigen::Map<const Eigen::VectorXd>(x.data(), n);
  const Eigen::Vector2d line =
      design.colPivHouseholderQr().solve(Eigen::Map<const Eigen::VectorXd>(y.data(), n));
  return line[1];
}

}  // namespace

Convergence observe_convergence(std::span<const RefinementPoint> series, Decay decay,
                                double wanted_accuracy) {
  Convergence result;
  result.smallest_error = std::numeric_limits<double>::infinity();
  for (const auto& point : series) {
    if (point.relative_error < result.smallest_error) result.smallest_error = point.relative_error;
  }

  const std::size_t onset = rounding_onset(series);
  double floor = kRootRounding;
  if (onset < series.size()) {
    result.rounding_onset = series[onset];
    for (const auto& point : series.subspan(onset)) {
      floor = std::max(floor, kAboveFloor * point.relative_error);
    }
  }

  std::vector<double> abscissa;
  std::vector<double> log_error;
  for (const auto& point : series.first(onset)) {
    if (!(point.relative_error > floor && point.relative_error < kPreAsymptotic)) continue;
    abscissa.push_back(decay == Decay::algebraic ? std::log10(point.setting)
                                                 : point.degrees_of_freedom);
    log_error.push_back(std::log10(point.relative_error));
  }
  if (decay == Decay::algebraic && abscissa.size() > kMostAlgebraicPoints) {
    abscissa.erase(abscissa.begin(), abscissa.end() - kMostAlgebraicPoints);
    log_error.erase(log_error.begin(), log_error.end() - kMostAlgebraicPoints);
  }
  result.points_fitted = static_cast<int>(abscissa.size());
  if (result.points_fitted >= kFewestPoints) result.rate = -fitted_slope(abscissa, log_error);

  for (auto point = series.rbegin(); point != series.rend(); ++point) {
    if (!(point->relative_error <= wanted_accuracy)) break;
    result.cheapest = *point;
  }
  return result;
}

}  // namespace flexarm::compare
