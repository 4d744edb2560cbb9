#include "measured/modal/start_spectra.hpp"

#include "measured/files/sensor_columns.hpp"
#include "measured/spectra/fourier.hpp"
#include "measured/spectra/robust.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flexarm::measured {
namespace {

using Complex = std::complex<double>;
using Eigen::ArrayXcd;
using Eigen::Index;

constexpr std::size_t kBins = 100;
/// The part of a sensor's lines that lie at its noise, for a start.
constexpr double kNoiseQuantile = 0.1;

/// Lines 0 to samples/2 of the first `samples` values, their mean left out.
std::vector<Complex> lines_of(const std::vector<double>& values, std::size_t samples) {
  std::vector<double> centred(values.begin(),
                              values.begin() + static_cast<std::ptrdiff_t>(samples));
  const double offset = mean(centred);
  for (double& value : centred) value -= offset;
  RealTransform transform(samples);
  std::vector<Complex> lines(transform.lines());
  transform(centred, lines);
  return lines;
}

/// How many poles at 0 the rigid body has in the sensor's response.
int integrations(const arm::Sensor& sensor, bool rigid) {
  return !rigid || bends_only(sensor.kind) ? 0 : 2 - arm::derivative_order(sensor);
}

double noise_of(const ArrayXcd& lines) {
  const Eigen::ArrayXd sizes = lines.abs();
  const double noise = quantile({sizes.begin(), sizes.end()}, kNoiseQuantile);
  return noise > 0.0 ? noise : 1.0;
}

}  // namespace

bool is_zero(std::span<const double> torque_N_m) {
  return std::ranges::all_of(torque_N_m, [](double torque) { return torque == 0.0; });
}

FitBand excited_band(const TimeRecord& record) {
  const std::size_t samples = fast_length_within(record.time_s.size());
  const auto lines = lines_of(record.torque_N_m, samples);
  const double nyquist_Hz = 0.5 / sampling_period_s(record);
  std::vector<double> power(std::min(kBins, lines.size()), 0.0);
  for (std::size_t k = 1; k < lines.size(); ++k) {
    power[std::min(power.size() - 1, k * power.size() / lines.size())] += std::norm(lines[k]);
  }
  const double largest = *std::ranges::max_element(power);
  std::size_t highest = power.size();  // of a free decay: the initial state has power everywhere
  while (highest > 1 && power[highest - 1] < kBandPower * largest) --highest;
  return {2.0 * nyquist_Hz / static_cast<double>(lines.size()),
          nyquist_Hz * static_cast<double>(highest) / static_cast<double>(power.size())};
}

std::vector<DenominatorEquation> time_equations(const TimeRecord& record, bool rigid,
                                                const FitBand& band, std::size_t samples) {
  samples = fast_length_within(std::min(samples, record.time_s.size()));
  const double period_s = sampling_period_s(record);
  const double line_Hz = 1.0 / (static_cast<double>(samples) * period_s);
  const auto torque = lines_of(record.torque_N_m, samples);
  std::vector<std::size_t> used;
  for (std::size_t k = 1; k < torque.size(); ++k) {
    if (band.contains(static_cast<double>(k) * line_Hz)) used.push_back(k);
  }
  std::vector<DenominatorEquation> equations;
  for (const Channel& channel : record.channels) {
    const auto reading = lines_of(channel.values, samples);
    const int poles_at_one = integrations(channel.sensor, rigid);
    const auto count = static_cast<Index>(used.size());
    DenominatorEquation equation{
        Eigen::ArrayXd(count), ArrayXcd(count), {ArrayXcd(count), ArrayXcd(count)}};
    for (Index i = 0; i < count; ++i) {
      const std::size_t k = used[static_cast<std::size_t>(i)];
      const double frequency_Hz = static_cast<double>(k) * line_Hz;
      equation.angle(i) = std::numbers::pi * frequency_Hz / band.to_Hz;
      equation.y(i) = reading[k];
      const Complex difference =
          1.0 - std::polar(1.0, -2.0 * std::numbers::pi * frequency_Hz * period_s);
      const Complex divisor = std::pow(difference, poles_at_one);
      equation.inputs[0](i) = torque[k] / divisor;
      equation.inputs[1](i) = 1.0 / divisor;
    }
    if (is_zero(record.torque_N_m)) equation.inputs.erase(equation.inputs.begin());
    const double noise = noise_of(equation.y);
    equation.y /= noise;
    for (ArrayXcd& input : equation.inputs) input /= noise;
    equations.push_back(std::move(equation));
  }
  return equations;
}

DenominatorEquation frequency_equation(const FrequencyChannel& channel,
                                       std::span<const double> deviation, bool rigid,
                                       const FitBand& band) {
  std::vector<std::size_t> used;
  for (std::size_t k = 0; k < channel.frequency_Hz.size(); ++k) {
    const double f = channel.frequency_Hz[k];
    if (f > 0.0 && std::isfinite(deviation[k]) && band.contains(f)) used.push_back(k);
  }
  const auto count = static_cast<Index>(used.size());
  DenominatorEquation equation{Eigen::ArrayXd(count), ArrayXcd(count), {ArrayXcd(count)}};
  const int poles_at_zero = integrations(channel.sensor, rigid);
  for (Index i = 0; i < count; ++i) {
    const std::size_t k = used[static_cast<std::size_t>(i)];
    equation.angle(i) = std::numbers::pi * channel.frequency_Hz[k] / band.to_Hz;
    equation.y(i) = channel.response[k] / deviation[k];
    const Complex s(0.0, channel.frequency_Hz[k] / band.to_Hz);
    equation.inputs[0](i) = 1.0 / (deviation[k] * std::pow(s, poles_at_zero));
  }
  return equation;
}

}  // namespace flexarm::measured
