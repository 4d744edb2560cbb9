#include "measured/checks/data_check_prediction.hpp"

#include "measured/spectra/robust.hpp"

#include <Eigen/Cholesky>

namespace flexarm::measured {

namespace {

/// Keeps the normal equations solvable where columns are alike; far below any noise.
constexpr double kRidge = 1e-12;

}  // namespace

std::vector<Eigen::VectorXd> standardised(std::span<const CheckedSignal> signals) {
  std::vector<Eigen::VectorXd> values;
  for (const auto& signal : signals) {
    const auto map = Eigen::Map<const Eigen::VectorXd>(
        signal.values.data(), static_cast<Eigen::Index>(signal.values.size()));
    const double scale = signal.deviation > 0.0 ? signal.deviation : 1.0;
    values.emplace_back((map.array() - mean(signal.values)) / scale);
  }
  return values;
}

std::vector<Lagged> regressors_around(std::size_t self, const std::vector<bool>& usable,
                                      const Reach& reach) {
  std::vector<Lagged> regressors;
  for (std::size_t i = 0; i < usable.size(); ++i) {
    if (!usable[i]) continue;
    const int here = i == self ? reach.own : (i == 0 ? reach.torque : reach.others);
    const bool at_once = i != self && (i == 0 || reach.others_at_once);
    for (int lag = -here; lag <= here; ++lag) {
      if (lag != 0 || at_once) regressors.push_back({i, lag});
    }
  }
  return regressors;
}

Regression regress(const std::vector<Eigen::VectorXd>& values, std::size_t self,
                   const std::vector<Lagged>& regressors, Eigen::Index first, Eigen::Index rows) {
  const auto columns = static_cast<Eigen::Index>(regressors.size());
  Eigen::MatrixXd matrix(rows, columns);
  for (Eigen::Index j = 0; j < columns; ++j) {
    const auto& [signal, lag] = regressors[static_cast<std::size_t>(j)];
    matrix.col(j) = values[signal].segment(first + lag, rows);
  }
  const Eigen::VectorXd target = values[self].segment(first, rows);
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(columns, columns);
  normal.selfadjointView<Eigen::Lower>().rankUpdate(matrix.transpose());
  normal.diagonal().array() += kRidge * normal.diagonal().maxCoeff();
  Regression made;
  made.shares = normal.selfadjointView<Eigen::Lower>().ldlt().solve(matrix.transpose() * target);
  made.left = target - matrix * made.shares;
  return made;
}

}  // namespace flexarm::measured
