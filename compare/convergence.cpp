#include "compare/convergence.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <vector>

namespace flexarm::compare {

namespace {

/// Rounding of the root itself: errors below ten times epsilon are the same to us. What a model
/// sums over its degrees of freedom may round as often: no slope is read below a hundred times
/// epsilon times their number.
constexpr double kSameError = 10.0 * std::numeric_limits<double>::epsilon();
constexpr double kSumRounding = 100.0 * std::numeric_limits<double>::epsilon();
/// A stall at larger errors is not rounding.
constexpr double kFloorMayStartBelow = 1e-9;
/// Refinement has stalled when it gains less than the first factor all told where the decay seen so
/// far promises the second.
constexpr double kLeastGain = 2.0;
constexpr double kPromisedGain = 4.0;
/// Points nearer to the floor than this factor carry rounding in their digits.
constexpr double kAboveFloor = 30.0;
/// Points that do not lie on a line have no slope: r^2 of the fit is at least this.
constexpr double kStraight = 0.9;

double abscissa_of(const RefinementPoint& point, Decay decay) {
  return decay == Decay::algebraic ? std::log10(point.setting) : point.degrees_of_freedom;
}

/// Points as (abscissa, log10 error).
struct Line {
  std::vector<double> x;
  std::vector<double> y;

  void add(const RefinementPoint& point, Decay decay) {
    x.push_back(abscissa_of(point, decay));
    y.push_back(std::log10(point.relative_error));
  }
};

struct LineFit {
  double slope = 0.0;
  double r_squared = 0.0;
};

/// Least squares through two points or more.
LineFit fit(const Line& line) {
  const auto n = static_cast<Eigen::Index>(line.x.size());
  const Eigen::Map<const Eigen::ArrayXd> x(line.x.data(), n);
  const Eigen::Map<const Eigen::ArrayXd> y(line.y.data(), n);
  const Eigen::ArrayXd dx = x - x.mean();
  const Eigen::ArrayXd dy = y - y.mean();
  const double covariance = (dx * dy).sum();
  return {covariance / dx.square().sum(),
          covariance * covariance / (dx.square().sum() * dy.square().sum())};
}

bool is_asymptotic(const RefinementPoint& point, double floor) {
  return point.relative_error > floor && point.relative_error < kPreAsymptotic;
}

/// Whether refinement beyond point `i` no longer lowers the error, although it should.
bool is_stalled(std::span<const RefinementPoint> series, std::size_t i, Decay decay) {
  const double error = std::max(series[i].relative_error, kSameError);
  if (!(error < kFloorMayStartBelow)) return false;
  bool rises = false;
  bool ends = true;
  for (const auto& later : series.subspan(i + 1)) {
    if (std::isnan(later.relative_error)) continue;
    const double after = std::max(later.relative_error, kSameError);
    if (kLeastGain * after <= error) return false;
    rises = rises || after >= error;
    ends = false;
  }
  if (ends) return false;
  if (rises) return true;
  Line before;
  for (const auto& point : series.first(i + 1)) {
    if (is_asymptotic(point, kSameError)) before.add(point, decay);
  }
  if (before.x.size() < 2) return false;
  const double step = abscissa_of(series.back(), decay) - abscissa_of(series[i], decay);
  return -fit(before).slope * step > std::log10(kPromisedGain);
}

/// Index of the first point after which the error stops falling, or size().
std::size_t rounding_onset(std::span<const RefinementPoint> series, Decay decay) {
  for (std::size_t i = 0; i + 1 < series.size(); ++i) {
    if (is_stalled(series, i, decay)) return i;
  }
  return series.size();
}

}  // namespace

Convergence observe_convergence(std::span<const RefinementPoint> series, Decay decay,
                                double wanted_accuracy) {
  Convergence result;
  for (const auto& point : series) {
    // NaN gives way to any number.
    result.smallest_error = std::fmin(result.smallest_error, point.relative_error);
  }

  const std::size_t onset = rounding_onset(series, decay);
  double floor = 0.0;
  if (onset < series.size()) {
    result.rounding_onset = series[onset];
    for (const auto& point : series.subspan(onset)) {
      floor = std::max(floor, kAboveFloor * point.relative_error);
    }
  }

  std::vector<RefinementPoint> asymptotic;
  std::ranges::copy_if(series.first(onset), std::back_inserter(asymptotic), [&](const auto& point) {
    return is_asymptotic(point, std::max(floor, kSumRounding * point.degrees_of_freedom));
  });
  Line line;
  for (const auto& point : asymptotic) {
    const bool is_fine = point.setting * kWidestRange >= asymptotic.back().setting;
    if (decay == Decay::exponential || is_fine) line.add(point, decay);
  }
  result.points_fitted = static_cast<int>(line.x.size());
  if (result.points_fitted >= kFewestPoints) {
    const LineFit seen = fit(line);
    if (seen.slope < 0.0 && seen.r_squared >= kStraight) result.rate = -seen.slope;
  }

  for (auto point = series.rbegin(); point != series.rend(); ++point) {
    if (!(point->relative_error <= wanted_accuracy)) break;
    result.cheapest = *point;
  }
  return result;
}

}  // namespace flexarm::compare
