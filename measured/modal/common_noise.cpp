#include "measured/modal/common_noise.hpp"

#include <Eigen/Dense>

#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <vector>

namespace flexarm::measured {

namespace {

/// A channel's line, by its index in `FrequencyRecord::channels`, and the gradient there.
struct ScaledGradient {
  std::size_t channel = 0;
  Eigen::RowVectorXcd values;  ///< to all parameters, over the standard deviation
};

/// The lines of all channels, by frequency.
std::map<double, std::vector<ScaledGradient>> gradients_by_line(
    const ModalFit& fit, const FrequencyRecord& record,
    const std::vector<std::vector<double>>& deviation) {
  std::map<double, std::vector<ScaledGradient>> lines;
  const Eigen::Index shared = fit.blocks.parameters();
  for (std::size_t j = 0; j < record.channels.size(); ++j) {
    const FrequencyChannel& channel = record.channels[j];
    const FittedTransfer& transfer = fit.transfers[j];
    double squares = 0.0;
    for (std::size_t k = 0; k < channel.response.size(); ++k) {
      const std::complex<double> s(0.0, 2.0 * std::numbers::pi * channel.frequency_Hz[k]);
      squares += std::norm((channel.response[k] - transfer.value(s)) / deviation[j][k]);
      const Eigen::RowVectorXcd gradient = transfer.gradient(s) / deviation[j][k];
      auto& made = lines[channel.frequency_Hz[k]].emplace_back(
          ScaledGradient{j, Eigen::RowVectorXcd::Zero(fit.covariance.cols())});
      made.values.head(shared) = gradient.head(shared);
      made.values.segment(fit.first_parameter(j), transfer.beta().size()) =
          gradient.tail(transfer.beta().size());
    }
    const double rms = std::sqrt(squares / (2.0 * static_cast<double>(channel.response.size())));
    for (const double frequency_Hz : channel.frequency_Hz) {
      lines[frequency_Hz].back().values /= rms;
    }
  }
  return lines;
}

/// Parameters whose variance is more than this times that with all others known are not identified;
/// the products of the sandwich would lose half of the digits or more.
constexpr double kMostVarianceInflation = 1e8;

/// The covariance given the parameters that are not identified, 0 for them. `information` of the
/// data: sum Re(z^H z).
Eigen::MatrixXd of_identified(const Eigen::MatrixXd& covariance,
                              const Eigen::VectorXd& information) {
  std::vector<Eigen::Index> kept;
  std::vector<Eigen::Index> given;
  for (Eigen::Index i = 0; i < covariance.rows(); ++i) {
    const bool is_identified = covariance(i, i) * information(i) <= kMostVarianceInflation;
    (is_identified ? kept : given).push_back(i);
  }
  if (given.empty()) return covariance;
  const Eigen::VectorXd scale = covariance(given, given).diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd correlation =
      scale.asDiagonal() * covariance(given, given) * scale.asDiagonal();
  const Eigen::MatrixXd cross = covariance(kept, given) * scale.asDiagonal();
  Eigen::MatrixXd made = Eigen::MatrixXd::Zero(covariance.rows(), covariance.cols());
  made(kept, kept) = covariance(kept, kept) -
                     cross * correlation.completeOrthogonalDecomposition().solve(cross.transpose());
  return made;
}

}  // namespace

Eigen::MatrixXd with_common_noise(
    const ModalFit& fit, const FrequencyRecord& record,
    const std::vector<std::vector<double>>& deviation,
    const std::function<Eigen::MatrixXcd(double frequency_Hz)>& correlation_at) {
  const Eigen::Index parameters = fit.covariance.rows();
  Eigen::VectorXd information = Eigen::VectorXd::Zero(parameters);
  Eigen::MatrixXd between = Eigen::MatrixXd::Zero(parameters, parameters);
  for (const auto& [frequency_Hz, gradients] : gradients_by_line(fit, record, deviation)) {
    const Eigen::MatrixXcd correlation = correlation_at(frequency_Hz);
    for (const ScaledGradient& a : gradients) {
      information += a.values.cwiseAbs2().transpose();
      for (const ScaledGradient& b : gradients) {
        if (a.channel == b.channel) continue;
        const std::complex<double> of_errors =
            correlation(static_cast<Eigen::Index>(a.channel), static_cast<Eigen::Index>(b.channel));
        // Of two scores Re(z^H e): E[Re(u) Re(v)] = Re(E[u conj(v)])/2 of circular numbers.
        between += (a.values.adjoint() * (std::conj(of_errors) * b.values)).real();
      }
    }
  }
  const Eigen::MatrixXd bread = of_identified(fit.covariance, information);
  return fit.covariance + bread * between * bread;
}

}  // namespace flexarm::measured
