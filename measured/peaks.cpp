#include "measured/peaks.hpp"

#include <boost/math/special_functions/gamma.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace flexarm::measured {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
const double kdB = 10.0 / std::log(10.0);

/// The lines looked at: frequency, log power upside down where valleys are wanted.
struct Levels {
  std::vector<double> frequency_Hz;
  std::vector<double> log_power;
  std::vector<double> relative_std;
};

/// log of the quantile of a mean power over its expectation; 0 without noise.
double log_quantile(double relative_std, double probability) {
  constexpr double kExact = 1e-7;
  if (!(relative_std > kExact)) return 0.0;
  const double shape = 1.0 / (relative_std * relative_std);
  return std::log(boost::math::gamma_p_inv(shape, probability) / shape);
}

/// How far up or down a log power comes by chance, a table over standard deviations: quantiles
/// are dear.
class ChanceLevels {
 public:
  explicit ChanceLevels(double probability) : probability_(probability) {}

  double up(double relative_std) { return at(relative_std).first; }
  double down(double relative_std) { return at(relative_std).second; }

 private:
  std::pair<double, double> at(double relative_std) {
    if (relative_std != last_std_) {
      last_std_ = relative_std;
      last_ = {log_quantile(relative_std, 1.0 - 0.5 * probability_),
               -log_quantile(relative_std, 0.5 * probability_)};
    }
    return last_;
  }

  double probability_;
  double last_std_ = kNaN;
  std::pair<double, double> last_;
};

/// Lowest level on the way from `peak` to a higher one, or to the end.
std::size_t saddle(const std::vector<double>& level, std::size_t peak, std::ptrdiff_t step) {
  std::size_t lowest = peak;
  const auto count = static_cast<std::ptrdiff_t>(level.size());
  for (auto k = static_cast<std::ptrdiff_t>(peak) + step; k >= 0 && k < count; k += step) {
    const auto here = static_cast<std::size_t>(k);
    if (level[here] > level[peak]) break;
    if (level[here] < level[lowest]) lowest = here;
  }
  return lowest;
}

/// The saddle that the prominence counts from: the higher one.
std::size_t higher_saddle(const std::vector<double>& level, std::size_t peak) {
  const std::size_t left = saddle(level, peak, -1);
  const std::size_t right = saddle(level, peak, 1);
  return level[left] > level[right] ? left : right;
}

/// The vertex of the parabola through (-1, y0), (0, y1), (1, y2), and its value there.
struct Vertex {
  double place = 0.0;
  double value = 0.0;
  double curvature = 0.0;  ///< the second difference
};

Vertex vertex_of(double y0, double y1, double y2) {
  const double curvature = y0 - 2.0 * y1 + y2;
  const double slope = 0.5 * (y2 - y0);
  if (curvature == 0.0) return {0.0, y1, 0.0};
  const double place = -slope / curvature;
  return {place, y1 + 0.5 * slope * place, curvature};
}

/// Lines from the middle one, by the log powers of it and of both neighbours.
double place_of(PeakPlace place, Feature feature, const std::array<double, 3>& log_power) {
  const auto& [before, here, after] = log_power;
  switch (place) {
    case PeakPlace::on_line:
      return 0.0;
    case PeakPlace::log_parabola:
      return vertex_of(before, here, after).place;
    case PeakPlace::resonance: {
      // 1/power of a peak, power of a valley, relative to the middle.
      const double sign = feature == Feature::pole ? -1.0 : 1.0;
      return vertex_of(std::exp(sign * (before - here)), 1.0, std::exp(sign * (after - here)))
          .place;
    }
    case PeakPlace::hann_line: {
      // With the amplitude ratio r of neighbour to peak the sine is (2 r - 1)/(r + 1) lines away.
      const double r = std::exp(0.5 * (std::max(before, after) - here));
      return (after > before ? 1.0 : -1.0) * (2.0 * r - 1.0) / (r + 1.0);
    }
  }
  return 0.0;
}

/// Standard deviation in lines, by differences of `place_of` in each level.
double place_std(PeakPlace place, Feature feature, const std::array<double, 3>& log_power,
                 const std::array<double, 3>& std_of) {
  constexpr double kStep = 1e-4;
  double variance = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    auto up = log_power;
    auto down = log_power;
    up[i] += kStep;
    down[i] -= kStep;
    const double slope =
        (place_of(place, feature, up) - place_of(place, feature, down)) / (2.0 * kStep);
    variance += slope * slope * std_of[i] * std_of[i];
  }
  return std::sqrt(variance);
}

Levels wanted(std::span<const double> frequency_Hz, std::span<const double> power,
              std::span<const double> relative_std, const PeakSettings& settings) {
  Levels levels;
  for (std::size_t k = 0; k < frequency_Hz.size(); ++k) {
    const bool inside = frequency_Hz[k] >= settings.from_Hz && frequency_Hz[k] <= settings.to_Hz;
    if (!inside || !(power[k] > 0.0) || !std::isfinite(power[k])) continue;
    levels.frequency_Hz.push_back(frequency_Hz[k]);
    levels.log_power.push_back(std::log(power[k]));
    levels.relative_std.push_back(relative_std[k]);
  }
  return levels;
}

SpectralFeature feature_at(const Levels& levels, std::size_t k, Feature feature,
                           const PeakSettings& settings) {
  const double spacing_Hz = 0.5 * (levels.frequency_Hz[k + 1] - levels.frequency_Hz[k - 1]);
  const std::array<double, 3> log_power = {levels.log_power[k - 1], levels.log_power[k],
                                           levels.log_power[k + 1]};
  SpectralFeature made;
  made.feature = feature;
  made.line_Hz = levels.frequency_Hz[k];
  made.level_dB = kdB * levels.log_power[k];
  const double place = place_of(settings.place, feature, log_power);
  made.frequency_Hz = made.line_Hz + spacing_Hz * place;
  made.frequency_uncertainty_Hz =
      settings.place == PeakPlace::on_line
          ? 0.5 * spacing_Hz
          : spacing_Hz * place_std(settings.place, feature, log_power,
                                   {levels.relative_std[k - 1], levels.relative_std[k],
                                    levels.relative_std[k + 1]});
  if (settings.place != PeakPlace::resonance) return made;
  // y = c/2 ((x - x0)^2 + half_width^2) has the value c/2 half_width^2 at its vertex.
  const double sign = feature == Feature::pole ? -1.0 : 1.0;
  const Vertex vertex = vertex_of(std::exp(sign * (log_power[0] - log_power[1])), 1.0,
                                  std::exp(sign * (log_power[2] - log_power[1])));
  if (vertex.curvature > 0.0 && vertex.value > 0.0) {
    made.damping_ratio =
        spacing_Hz * std::sqrt(2.0 * vertex.value / vertex.curvature) / made.frequency_Hz;
  }
  return made;
}

}  // namespace

std::vector<SpectralFeature> peaks_and_valleys(std::span<const double> frequency_Hz,
                                               std::span<const double> power,
                                               std::span<const double> relative_std,
                                               const PeakSettings& settings) {
  const Levels levels = wanted(frequency_Hz, power, relative_std, settings);
  std::vector<SpectralFeature> found;
  if (levels.log_power.size() < 3) return found;
  ChanceLevels chance(settings.false_alarm_rate / static_cast<double>(levels.log_power.size()));
  for (const Feature feature : {Feature::pole, Feature::zero}) {
    std::vector<double> level = levels.log_power;
    if (feature == Feature::zero) std::ranges::for_each(level, [](double& x) { x = -x; });
    for (std::size_t k = 1; k + 1 < level.size(); ++k) {
      if (!(level[k] > level[k - 1] && level[k] >= level[k + 1])) continue;
      const std::size_t from = higher_saddle(level, k);
      const double prominence = level[k] - level[from];
      if (kdB * prominence < settings.least_prominence_dB) continue;
      const std::size_t high = feature == Feature::pole ? k : from;
      const std::size_t low = feature == Feature::pole ? from : k;
      const double by_chance =
          chance.up(levels.relative_std[high]) + chance.down(levels.relative_std[low]);
      if (!(prominence > by_chance)) continue;
      found.push_back(feature_at(levels, k, feature, settings));
      found.back().prominence_dB = kdB * prominence;
    }
  }
  std::ranges::sort(found, {}, &SpectralFeature::frequency_Hz);
  return found;
}

double natural_frequency_Hz(double peak_Hz, double damping_ratio, int derivative_order) {
  const double rest = 1.0 - 2.0 * damping_ratio * damping_ratio;
  if (!(damping_ratio >= 0.0 && rest > 0.0)) {
    throw std::invalid_argument("a response with this damping has no peak");
  }
  return peak_Hz * std::pow(rest, 0.5 * (derivative_order - 1));
}

ModalTable modal_table(const arm::Sensor& sensor, std::span<const SpectralFeature> features,
                       PeakPlace place) {
  ModalTable table;
  int poles = 0;
  int zeros = 0;
  for (const auto& found : features) {
    ModalEntry entry;
    entry.sensor = sensor;
    entry.feature = found.feature;
    const bool is_pole = found.feature == Feature::pole;
    entry.order = is_pole ? ++poles : ++zeros;
    entry.frequency_Hz = found.frequency_Hz;
    entry.frequency_std_Hz =
        found.frequency_uncertainty_Hz / (place == PeakPlace::on_line ? std::sqrt(3.0) : 1.0);
    constexpr double kHasAPeak = 0.7;
    if (is_pole && found.damping_ratio && *found.damping_ratio < kHasAPeak) {
      entry.damping_ratio = found.damping_ratio;
      entry.frequency_Hz = natural_frequency_Hz(found.frequency_Hz, *found.damping_ratio,
                                                arm::derivative_order(sensor));
    }
    table.push_back(entry);
  }
  return table;
}

}  // namespace flexarm::measured
