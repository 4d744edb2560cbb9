#include "measured/modal/common_noise.hpp"

#include <algorithm>
#include <map>
#include <numbers>

namespace flexarm::measured {

namespace {

std::complex<double> s_at(double frequency_Hz) {
  return {0.0, 2.0 * std::numbers::pi * frequency_Hz};
}

}  // namespace

double common_noise_factor(const FrequencyRecord& record,
                           const std::vector<std::vector<double>>& deviation,
                           std::span<const FittedTransfer> transfers) {
  const Eigen::Index parameters = transfers.front().blocks().parameters();
  std::map<double, Eigen::ArrayXd> of_line;
  Eigen::ArrayXd expected = Eigen::ArrayXd::Zero(parameters);
  for (std::size_t j = 0; j < record.channels.size(); ++j) {
    const FrequencyChannel& channel = record.channels[j];
    std::vector<std::complex<double>> residual;
    double variance = 0.0;
    for (std::size_t k = 0; k < channel.response.size(); ++k) {
      residual.push_back((channel.response[k] - transfers[j].value(s_at(channel.frequency_Hz[k]))) /
                         deviation[j][k]);
      variance += std::norm(residual[k]) / (2.0 * static_cast<double>(channel.response.size()));
    }
    for (std::size_t k = 0; k < channel.response.size(); ++k) {
      const Eigen::ArrayXcd gradient = transfers[j]
                                           .gradient(s_at(channel.frequency_Hz[k]))
                                           .head(parameters)
                                           .transpose()
                                           .array() /
                                       deviation[j][k];
      expected += gradient.abs2() * variance;
      const auto at =
          of_line.try_emplace(channel.frequency_Hz[k], Eigen::ArrayXd::Zero(parameters)).first;
      at->second += (gradient.conjugate() * residual[k]).real();
    }
  }
  Eigen::ArrayXd together = Eigen::ArrayXd::Zero(parameters);
  for (const auto& [frequency_Hz, score] : of_line) together += score.square();
  double sum = 0.0;
  double count = 0.0;
  for (Eigen::Index p = 0; p < parameters; ++p) {
    if (!(expected(p) > 0.0)) continue;
    sum += together(p) / expected(p);
    count += 1.0;
  }
  return count > 0.0 ? std::max(1.0, sum / count) : 1.0;
}

}  // namespace flexarm::measured
