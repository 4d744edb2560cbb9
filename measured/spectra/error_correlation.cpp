#include "measured/spectra/error_correlation.hpp"

namespace flexarm::measured {

std::vector<Eigen::MatrixXcd> joint_spectra(std::span<const Signal> signals, double period_s,
                                            const SegmentPlan& plan) {
  std::vector<Eigen::MatrixXcd> made;
  for (std::size_t a = 0; a < signals.size(); ++a) {
    const auto row = static_cast<Eigen::Index>(a);
    const CrossSpectra from = cross_spectra(signals[a], signals.subspan(a + 1), period_s, plan);
    made.resize(from.input.size(), Eigen::MatrixXcd(signals.size(), signals.size()));
    for (std::size_t k = 0; k < made.size(); ++k) {
      made[k](row, row) = from.input[k];
      for (std::size_t b = 0; b < from.cross.size(); ++b) {
        const Eigen::Index column = row + 1 + static_cast<Eigen::Index>(b);
        made[k](row, column) = from.cross[b][k];
        made[k](column, row) = std::conj(from.cross[b][k]);
      }
    }
  }
  return made;
}

Eigen::MatrixXcd error_correlation(const Eigen::MatrixXcd& joint, const Eigen::VectorXcd& g) {
  Eigen::MatrixXcd to_errors(g.size(), g.size() + 1);
  to_errors.rightCols(g.size()).setIdentity();
  to_errors.col(0) = -g;
  const Eigen::MatrixXcd power = to_errors.conjugate() * joint * to_errors.transpose();
  const Eigen::VectorXd deviation = power.diagonal().real().cwiseMax(0.0).cwiseSqrt();
  Eigen::MatrixXcd made = Eigen::MatrixXcd::Zero(g.size(), g.size());
  for (Eigen::Index i = 0; i < g.size(); ++i) {
    for (Eigen::Index j = 0; j < g.size(); ++j) {
      const double scale = deviation(i) * deviation(j);
      if (scale > 0.0) made(i, j) = power(i, j) / scale;
    }
  }
  return made;
}

}  // namespace flexarm::measured
