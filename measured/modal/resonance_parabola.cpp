#include "measured/modal/resonance_parabola.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>

namespace flexarm::measured {

namespace {

constexpr std::array<double, 2> kStartFactors = {4.0, 16.0};
constexpr int kPasses = 6;

struct Lines {
  std::size_t first = 0;
  std::size_t last = 0;  ///< included

  std::size_t count() const { return last - first + 1; }
};

/// The fit of y = a + b u + c u^2, u = (f^2 - origin^2)/scale, with the covariance of a, b, c.
struct Fit {
  double origin_Hz = 0.0;
  double scale_Hz2 = 1.0;
  Eigen::Vector3d abc = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();

  bool is_peak() const {
    return abc(2) > 0.0 && 4.0 * abc(0) * abc(2) > abc(1) * abc(1) && place_Hz2() > 0.0;
  }
  double place_Hz2() const { return origin_Hz * origin_Hz - 0.5 * abc(1) / abc(2) * scale_Hz2; }
  double place_Hz() const { return std::sqrt(place_Hz2()); }
  /// Of u.
  double half_width() const {
    const double b = 0.5 * abc(1) / abc(2);
    return std::sqrt(abc(0) / abc(2) - b * b);
  }
  double half_width_Hz() const { return half_width() * scale_Hz2 / (2.0 * place_Hz()); }
  double u(double frequency_Hz) const {
    return (frequency_Hz - origin_Hz) * (frequency_Hz + origin_Hz) / scale_Hz2;
  }
  double value(double frequency_Hz) const {
    const double x = u(frequency_Hz);
    return abc(0) + x * (abc(1) + x * abc(2));
  }
};

class Peak {
 public:
  Peak(std::span<const double> frequency_Hz, std::span<const double> power,
       std::span<const double> relative_std, Feature feature, std::size_t peak,
       double shared_variance)
      : frequency_Hz_(frequency_Hz),
        power_(power),
        relative_std_(relative_std),
        feature_(feature),
        peak_(peak),
        shared_variance_(shared_variance) {}

  /// Whether the fit is one of a peak that lies among its lines: one beyond is another's flank.
  bool holds(const Fit& fit, const Lines& lines) const {
    return fit.is_peak() && fit.place_Hz() >= frequency_Hz_[lines.first] &&
           fit.place_Hz() <= frequency_Hz_[lines.last];
  }

  Lines three() const { return {peak_ - 1, peak_ + 1}; }

  /// Lines around the peak to where two in a row have y above `factor` times its own there.
  Lines below(double factor) const {
    Lines lines = three();
    const auto within = [&](std::size_t k, std::size_t next) {
      return y(k) < factor || y(next) < factor;
    };
    while (lines.first > 0 && within(lines.first, lines.first - 1)) --lines.first;
    while (lines.last + 1 < power_.size() && within(lines.last, lines.last + 1)) ++lines.last;
    return lines;
  }

  /// Lines within half a width of the place, among `allowed`.
  Lines around(const Fit& fit, const Lines& allowed) const {
    const double from_Hz = fit.place_Hz() - fit.half_width_Hz();
    const double to_Hz = fit.place_Hz() + fit.half_width_Hz();
    Lines lines = allowed;
    while (lines.first + 1 < peak_ && frequency_Hz_[lines.first] < from_Hz) ++lines.first;
    while (lines.last > peak_ + 1 && frequency_Hz_[lines.last] > to_Hz) --lines.last;
    return lines;
  }

  /// Least squares with the weights of y as `before` has it, or as it was measured.
  Fit fit(const Lines& lines, const std::optional<Fit>& before) const {
    Fit made;
    made.origin_Hz = frequency_Hz_[peak_];
    made.scale_Hz2 = made.origin_Hz * (frequency_Hz_[lines.last] - frequency_Hz_[lines.first]);
    // u within +-1 or so: normal equations lose the square of a condition number of some ten.
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    double squares = 0.0;
    double known = 0.0;
    const auto count = static_cast<double>(lines.count());
    for (std::size_t k = lines.first; k <= lines.last; ++k) {
      const double u = made.u(frequency_Hz_[k]);
      const double weight = 1.0 / (before ? before->value(frequency_Hz_[k]) : y(k));
      const Eigen::Vector3d row = weight * Eigen::Vector3d(1.0, u, u * u);
      matrix += row * row.transpose();
      right += row * (weight * y(k));
      squares += std::pow(weight * y(k), 2);
      known += relative_std_[k] * relative_std_[k] / count;
    }
    const Eigen::Matrix3d inverse = matrix.inverse();
    made.abc = inverse * right;
    double variance = known;
    if (lines.count() > 3) {
      const double scatter = std::max(0.0, squares - made.abc.dot(right)) / (count - 3.0);
      variance = shared_variance_ * std::max(known, scatter);
    }
    made.covariance = variance * inverse;
    return made;
  }

 private:
  /// 1/power of a peak, power of a valley, over that of the peak's own line.
  double y(std::size_t k) const {
    return feature_ == Feature::pole ? power_[peak_] / power_[k] : power_[k] / power_[peak_];
  }

  std::span<const double> frequency_Hz_;
  std::span<const double> power_;
  std::span<const double> relative_std_;
  Feature feature_;
  std::size_t peak_;
  double shared_variance_;
};

ResonanceParabola result_of(const Fit& fit, std::size_t lines) {
  const double a = fit.abc(0), b = fit.abc(1), c = fit.abc(2);
  const Eigen::RowVector3d place(0.0, -0.5 / c, 0.5 * b / (c * c));
  // 2 width d width = d(a/c - b^2/(4 c^2)).
  const Eigen::RowVector3d half_width =
      Eigen::RowVector3d(1.0 / c, -0.5 * b / (c * c), (0.5 * b * b / c - a) / (c * c)) /
      (2.0 * fit.half_width());
  const auto deviation_Hz = [&](const Eigen::RowVector3d& gradient) {
    const double variance = gradient.dot(gradient * fit.covariance);
    return fit.scale_Hz2 / (2.0 * fit.place_Hz()) * std::sqrt(std::max(0.0, variance));
  };
  return {fit.place_Hz(), deviation_Hz(place), fit.half_width_Hz(), deviation_Hz(half_width),
          lines};
}

}  // namespace

std::optional<ResonanceParabola> resonance_parabola(std::span<const double> frequency_Hz,
                                                    std::span<const double> power,
                                                    std::span<const double> relative_std,
                                                    Feature feature, std::size_t peak,
                                                    double shared_variance) {
  const Peak data(frequency_Hz, power, relative_std, feature, peak, shared_variance);
  for (const double factor : kStartFactors) {
    const Lines widest = data.below(factor);
    Lines lines = widest;
    Fit fit = data.fit(lines, {});
    for (int pass = 0; pass < kPasses && fit.is_peak(); ++pass) {
      lines = data.around(fit, widest);
      fit = data.fit(lines, fit);
    }
    if (data.holds(fit, lines)) return result_of(fit, lines.count());
  }
  const Fit fit = data.fit(data.three(), {});
  if (!data.holds(fit, data.three())) return std::nullopt;
  return result_of(fit, data.three().count());
}

}  // namespace flexarm::measured
