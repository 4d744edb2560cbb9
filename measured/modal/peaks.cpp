#include "measured/modal/peaks.hpp"

#include "measured/files/record_constants.hpp"
#include "measured/modal/resonance_parabola.hpp"

#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/gamma.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace flexarm::measured {

namespace {

const double kdB = 10.0 / std::log(10.0);
constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// The lines looked at.
struct Levels {
  std::vector<double> frequency_Hz;
  std::vector<double> power;
  std::vector<double> log_power;
  std::vector<double> relative_std;
};

/// log of the quantile of a mean power over its expectation; 0 without noise.
double log_quantile(double relative_std, double probability) {
  constexpr double kExact = 1e-7;
  if (!(relative_std > kExact)) return 0.0;
  const double shape = 1.0 / (relative_std * relative_std);
  if (shape == 0.0) return std::copysign(kUnbounded, probability - 0.5);  // nothing is known
  return std::log(boost::math::gamma_p_inv(shape, probability) / shape);
}

/// What noise alone makes of two lines of a smooth spectrum.
class Chance {
 public:
  /// `probability` of a line.
  Chance(PowerNoise noise, double probability)
      : noise_(noise),
        probability_(probability),
        normal_(std::sqrt(2.0) * boost::math::erfc_inv(probability)) {}

  /// Whether a log power `rise` above another is more than that; both powers' relative standard
  /// deviations.
  bool exceeded_by(double rise, double high_std, double low_std) {
    if (noise_ == PowerNoise::multiplicative) return rise > up(high_std) + down(low_std);
    // |H| has half the relative standard deviation of its square.
    const double low = std::exp(-0.5 * rise);
    return 1.0 - low > 0.5 * normal_ * (high_std + low * low_std);
  }

 private:
  double up(double relative_std) { return levels(relative_std).first; }
  double down(double relative_std) { return levels(relative_std).second; }

  /// Quantiles are dear, and one standard deviation is often that of all lines.
  std::pair<double, double> levels(double relative_std) {
    if (relative_std != last_std_) {
      last_std_ = relative_std;
      last_ = {log_quantile(relative_std, 1.0 - 0.5 * probability_),
               -log_quantile(relative_std, 0.5 * probability_)};
    }
    return last_;
  }

  PowerNoise noise_;
  double probability_;
  double normal_;
  double last_std_ = kUnknown;
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

/// Three neighbouring lines.
struct Three {
  std::array<double, 3> from_middle_Hz;
  std::array<double, 3> log_power;
};

/// The vertex of the parabola through three points; the middle one where they lie on a line.
double vertex(const std::array<double, 3>& x, const std::array<double, 3>& y) {
  // Newton's divided differences.
  const double below = (y[1] - y[0]) / (x[1] - x[0]);
  const double above = (y[2] - y[1]) / (x[2] - x[1]);
  const double half_curvature = (above - below) / (x[2] - x[0]);
  if (half_curvature == 0.0) return x[1];
  const double slope = below + half_curvature * (x[1] - x[0]);  // at x[1]
  return x[1] - 0.5 * slope / half_curvature;
}

/// From the middle line [Hz].
double place_of(PeakPlace place, const Three& three) {
  switch (place) {
    case PeakPlace::on_line:
    case PeakPlace::resonance:
      return 0.0;
    case PeakPlace::log_parabola:
      return vertex(three.from_middle_Hz, three.log_power);
    case PeakPlace::hann_line: {
      // With the amplitude ratio r of neighbour to peak the sine is (2 r - 1)/(r + 1) lines away.
      const std::size_t side = three.log_power[2] > three.log_power[0] ? 2 : 0;
      const double r = std::exp(0.5 * (three.log_power[side] - three.log_power[1]));
      return three.from_middle_Hz[side] * (2.0 * r - 1.0) / (r + 1.0);
    }
  }
  return 0.0;
}

/// Standard deviation [Hz], by differences of `place_of` in each level.
double place_std(PeakPlace place, const Three& three, const std::array<double, 3>& std_of) {
  constexpr double kStep = 1e-4;
  double variance = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    Three up = three;
    Three down = three;
    up.log_power[i] += kStep;
    down.log_power[i] -= kStep;
    const double slope = (place_of(place, up) - place_of(place, down)) / (2.0 * kStep);
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
    levels.power.push_back(power[k]);
    levels.log_power.push_back(std::log(power[k]));
    levels.relative_std.push_back(relative_std[k]);
  }
  return levels;
}

SpectralFeature feature_at(const Levels& levels, std::size_t k, Feature feature,
                           const PeakSettings& settings) {
  Three three{};
  std::array<double, 3> std_of{};
  for (std::size_t i = 0; i < 3; ++i) {
    three.from_middle_Hz[i] = levels.frequency_Hz[k + i - 1] - levels.frequency_Hz[k];
    three.log_power[i] = levels.log_power[k + i - 1];
    std_of[i] = levels.relative_std[k + i - 1];
  }
  const PeakPlace place = settings.place;
  SpectralFeature made;
  made.feature = feature;
  made.line_Hz = levels.frequency_Hz[k];
  made.level_dB = kdB * levels.log_power[k];
  made.frequency_Hz = made.line_Hz + place_of(place, three);
  made.frequency_uncertainty_Hz = place == PeakPlace::log_parabola || place == PeakPlace::hann_line
                                      ? place_std(place, three, std_of)
                                      : 0.25 * (three.from_middle_Hz[2] - three.from_middle_Hz[0]);
  const auto shape = resonance_parabola(levels.frequency_Hz, levels.power, levels.relative_std,
                                        feature, k, settings.shared_variance);
  if (!shape) return made;
  made.damping_ratio = shape->half_width_Hz / shape->place_Hz;
  made.damping_ratio_std = shape->half_width_std_Hz / shape->place_Hz;
  if (place == PeakPlace::resonance) {
    made.frequency_Hz = shape->place_Hz;
    made.frequency_uncertainty_Hz = shape->place_std_Hz;
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
  Chance chance(settings.noise,
                settings.false_alarm_rate / static_cast<double>(levels.log_power.size()));
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
      if (!chance.exceeded_by(prominence, levels.relative_std[high], levels.relative_std[low])) {
        continue;
      }
      SpectralFeature made = feature_at(levels, k, feature, settings);
      if (made.damping_ratio > settings.most_damping_ratio) continue;
      made.prominence_dB = kdB * prominence;
      found.push_back(made);
    }
  }
  std::ranges::sort(found, {}, &SpectralFeature::frequency_Hz);
  return found;
}

double natural_frequency_Hz(double peak_Hz, double damping_ratio, int derivative_order) {
  const double rest = 1.0 - 2.0 * damping_ratio * damping_ratio;
  if (!(damping_ratio >= 0.0 && rest > 0.0)) {
    throw std::invalid_argument("no resonance peak at this damping ratio");
  }
  return peak_Hz * std::pow(rest, 0.5 * (derivative_order - 1));
}

ModalTable modal_table(const arm::Sensor& sensor, std::span<const SpectralFeature> features,
                       PeakPlace place) {
  ModalTable table;
  for (const auto& found : features) {
    ModalEntry entry;
    entry.sensor = sensor;
    entry.feature = found.feature;
    const bool is_pole = found.feature == Feature::pole;
    entry.frequency_Hz = found.frequency_Hz;
    entry.frequency_std_Hz =
        found.frequency_uncertainty_Hz / (place == PeakPlace::on_line ? std::sqrt(3.0) : 1.0);
    constexpr double kHasAPeak = 0.7;
    if (is_pole && found.damping_ratio && *found.damping_ratio < kHasAPeak) {
      entry.damping_ratio = found.damping_ratio;
      entry.damping_ratio_std = found.damping_ratio_std;
    }
    if (entry.damping_ratio && place != PeakPlace::on_line) {
      entry.frequency_Hz = natural_frequency_Hz(found.frequency_Hz, *found.damping_ratio,
                                                arm::derivative_order(sensor));
    }
    table.push_back(entry);
  }
  return table;
}

}  // namespace flexarm::measured
