#include "measured/checks/data_check_stamps.hpp"

#include "measured/spectra/robust.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace flexarm::measured {

namespace {

using Eigen::Index;

constexpr std::size_t kFewestStamps = 32;
constexpr double kLeastScatter_periods = 0.1;
/// rms of what is no step of the grid over its scatter from sample to sample: 1 for white jitter.
constexpr double kWhiteJitter = 1.5;
constexpr double kLeastShift_periods = 0.7;
constexpr double kShiftEvidence = 40.0;  // variances of the jitter
constexpr std::size_t kMostShifts = 12;

/// Scatter of each of the stamps, from the changes of their distances from the grid.
double scatter_of(const Eigen::VectorXd& grid_error) {
  const Index count = grid_error.size() - 1;
  const Eigen::VectorXd change = grid_error.tail(count) - grid_error.head(count);
  return robust_deviation({change.data(), change.data() + count}) / std::numbers::sqrt2;
}

/// Offset, slope and the steps at `shifts`, fitted to values over their index.
struct ShiftFit {
  Eigen::MatrixXd basis;  ///< orthonormal columns of the regressors
  Eigen::VectorXd shares;
  Eigen::VectorXd residual;
};

ShiftFit fit_shifts(const Eigen::VectorXd& values, const std::vector<std::size_t>& shifts) {
  const Index samples = values.size();
  Eigen::MatrixXd regressors(samples, 2 + std::ssize(shifts));
  regressors.col(0).setOnes();
  regressors.col(1).setLinSpaced(samples, -1.0, 1.0);
  for (std::size_t j = 0; j < shifts.size(); ++j) {
    const auto from = static_cast<Index>(shifts[j]);
    regressors.col(2 + static_cast<Index>(j)).setZero();
    regressors.col(2 + static_cast<Index>(j)).tail(samples - from).setOnes();
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> factors(regressors);
  ShiftFit fit;
  fit.shares = factors.solve(values);
  fit.residual = values - regressors * fit.shares;
  fit.basis = factors.householderQ() * Eigen::MatrixXd::Identity(samples, regressors.cols());
  return fit;
}

/// The place whose step explains most of the residual, and how much of its sum of squares.
struct BestShift {
  std::size_t at = 0;
  double explained = 0.0;
};

BestShift best_shift(const ShiftFit& fit) {
  // A step is no combination of the others if this part of it is left.
  constexpr double kIndependent = 1e-9;
  BestShift best;
  double along = 0.0;
  Eigen::RowVectorXd inside = Eigen::RowVectorXd::Zero(fit.basis.cols());
  const Index samples = fit.residual.size();
  for (Index k = samples - 1; k > 0; --k) {
    along += fit.residual[k];
    inside += fit.basis.row(k);
    const double length = static_cast<double>(samples - k);
    const double free = length - inside.squaredNorm();
    if (free <= kIndependent * length) continue;
    const double explained = along * along / free;
    if (explained > best.explained) best = {static_cast<std::size_t>(k), explained};
  }
  return best;
}

/// Looks for the place of each shift again beside all others: a first one takes the place between
/// two.
ShiftFit relocate(const Eigen::VectorXd& values, std::vector<std::size_t>& shifts) {
  for (std::size_t& shift : shifts) {
    std::vector<std::size_t> others;
    for (const std::size_t other : shifts) {
      if (other != shift) others.push_back(other);
    }
    const BestShift again = best_shift(fit_shifts(values, others));
    if (again.at != 0 && std::ranges::find(others, again.at) == others.end()) shift = again.at;
  }
  return fit_shifts(values, shifts);
}

}  // namespace

std::optional<ClockSteps> jittered_steps(std::span<const double> times_s, double period_s) {
  if (times_s.size() < kFewestStamps || period_s <= 0.0) return std::nullopt;
  const auto samples = static_cast<Index>(times_s.size());
  const Eigen::VectorXd values =
      (Eigen::Map<const Eigen::VectorXd>(times_s.data(), samples).array() - times_s[0]) / period_s -
      Eigen::ArrayXd::LinSpaced(samples, 0.0, static_cast<double>(samples - 1));
  const double scatter = scatter_of(values);
  if (scatter < kLeastScatter_periods) return std::nullopt;

  std::vector<std::size_t> shifts;
  ShiftFit fit = fit_shifts(values, shifts);
  for (BestShift next = best_shift(fit); next.explained > kShiftEvidence * scatter * scatter;
       next = best_shift(fit)) {
    if (shifts.size() == kMostShifts) return std::nullopt;
    shifts.push_back(next.at);
    fit = relocate(values, shifts);
    if (std::abs(fit.shares[fit.shares.size() - 1]) < kLeastShift_periods) return std::nullopt;
  }
  const double rms = fit.residual.norm() / std::sqrt(static_cast<double>(samples));
  if (rms > kWhiteJitter * scatter) return std::nullopt;

  ClockSteps steps;
  // The slope of the fit spans two units over the record.
  steps.period_s = period_s * (1.0 + 2.0 * fit.shares[1] / static_cast<double>(samples - 1));
  steps.periods.assign(times_s.size(), 1.0);
  steps.periods[0] = 0.0;
  for (std::size_t j = 0; j < shifts.size(); ++j) {
    const double shift = fit.shares[2 + static_cast<Index>(j)];
    const bool is_gap = shift > 0.0;
    steps.periods[shifts[j]] = is_gap ? 1.0 + std::max(1.0, std::round(shift)) : 0.0;
    (is_gap ? steps.gaps : steps.backward).push_back(shifts[j]);
  }
  std::ranges::sort(steps.gaps);
  std::ranges::sort(steps.backward);
  return steps;
}

}  // namespace flexarm::measured
