#include "diagnose/unknown/force_size.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;

/// The frequency below which that part of the squares lies.
double quantile_Hz(const std::vector<std::pair<double, double>>& power, double part) {
  double all = 0.0;
  for (const auto& [frequency_Hz, square] : power) all += square;
  double sum = 0.0;
  for (const auto& [frequency_Hz, square] : power) {
    sum += square;
    if (sum >= part * all) return frequency_Hz;
  }
  return power.back().first;
}

struct SegmentMean {
  double value = 0.0;
  std::optional<double> std_error = {};
};

SegmentMean mean_of(const std::vector<double>& squares) {
  const auto n = static_cast<double>(squares.size());
  SegmentMean mean{std::reduce(squares.begin(), squares.end()) / n};
  if (squares.size() < 2) return mean;
  double spread = 0.0;
  for (const double square : squares) spread += (square - mean.value) * (square - mean.value);
  mean.std_error = std::sqrt(spread / (n * (n - 1.0)));
  return mean;
}

int third_octave(double frequency_Hz) {
  return static_cast<int>(std::floor(10.0 * std::log10(frequency_Hz) + 0.5));
}

double lower_limit_Hz(int third_octave) {
  return std::pow(10.0, (2.0 * third_octave - 1.0) / 20.0);
}

std::vector<ForceBand> spectrum_of(const std::vector<TriedSegment>& segments, std::size_t place) {
  std::map<int, std::vector<double>> squares;  // of each segment
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const TriedSegment& segment = segments[i];
    for (std::size_t k = 0; k < segment.frequency_Hz.size(); ++k) {
      auto& own = squares[third_octave(segment.frequency_Hz[k])];
      own.resize(segments.size());
      own[i] += segment.power[place](static_cast<Index>(k));
    }
  }
  std::vector<ForceBand> spectrum;
  for (const auto& [band, own] : squares) {
    const SegmentMean mean = mean_of(own);
    spectrum.push_back(
        {lower_limit_Hz(band), lower_limit_Hz(band + 1), mean.value, mean.std_error});
  }
  return spectrum;
}

}  // namespace

double ForceBand::rms_at(double std_errors) const {
  return std::sqrt(std::max(0.0, mean_square + std_errors * std_error.value_or(0.0)));
}

ForceSize force_size(const TriedPlaces& tried, std::size_t place) {
  ForceSize size{.unit = tried.places[place].unit, .spectrum = spectrum_of(tried.segments, place)};
  std::vector<double> squares;
  std::vector<std::pair<double, double>> power;
  for (const TriedSegment& segment : tried.segments) {
    squares.push_back(std::max(0.0, segment.power[place].sum()));
    for (std::size_t k = 0; k < segment.frequency_Hz.size(); ++k) {
      power.emplace_back(segment.frequency_Hz[k], segment.power[place](static_cast<Index>(k)));
    }
  }
  std::ranges::sort(power);
  size.from_Hz = quantile_Hz(power, 0.1);
  size.to_Hz = quantile_Hz(power, 0.9);
  const SegmentMean mean = mean_of(squares);
  size.rms = std::sqrt(mean.value);
  if (mean.std_error && mean.value > 0.0) size.std_error = 0.5 * *mean.std_error / size.rms;
  return size;
}

}  // namespace flexarm::diagnose
