#include "measured/modal/nyquist_circle.hpp"

#include "measured/modal/peaks.hpp"

#include <Eigen/Dense>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>

namespace flexarm::measured {

namespace {

using Complex = std::complex<double>;

/// A circle of more is none: its points are not near a resonance.
constexpr double kMostDamping = 0.5;
constexpr double kDegree = std::numbers::pi / 180.0;

/// The channel in velocity form, without line 0.
struct Velocity {
  std::vector<double> frequency_Hz;
  std::vector<Complex> value;
};

Velocity velocity_form(const FrequencyChannel& channel) {
  Velocity made;
  for (std::size_t k = 0; k < channel.frequency_Hz.size(); ++k) {
    const double omega = 2.0 * std::numbers::pi * channel.frequency_Hz[k];
    if (!(omega > 0.0)) continue;
    const int powers = 1 - arm::derivative_order(channel.sensor);
    Complex factor = 1.0;
    if (powers == 1) factor = Complex(0.0, omega);
    if (powers == -1) factor = Complex(0.0, -1.0 / omega);
    made.frequency_Hz.push_back(channel.frequency_Hz[k]);
    made.value.push_back(factor * channel.response[k]);
  }
  return made;
}

/// Points first to last of a Velocity.
struct Arc {
  std::size_t first = 0;
  std::size_t last = 0;

  std::size_t size() const { return last - first + 1; }
  bool operator==(const Arc&) const = default;
};

/// angle = a - 2 atan q.
struct AngleFit {
  double a = 0.0;
  double natural_frequency_Hz = 0.0;
  double damping_ratio = 0.0;
  double natural_frequency_std_Hz = 0.0;

  double p(double frequency_Hz) const {
    return frequency_Hz / natural_frequency_Hz - natural_frequency_Hz / frequency_Hz;
  }
  double q(double frequency_Hz) const { return p(frequency_Hz) / (2.0 * damping_ratio); }
};

std::vector<double> unwrapped_angles(std::span<const Complex> points, Complex centre) {
  std::vector<double> angles(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    angles[i] = std::arg(points[i] - centre);
    if (i == 0) continue;
    angles[i] +=
        2.0 * std::numbers::pi * std::round((angles[i - 1] - angles[i]) / (2.0 * std::numbers::pi));
  }
  return angles;
}

/// Gauss-Newton in a, log omega_n, log zeta from `start`, steps halved until the sum falls.
AngleFit fit_angles(std::span<const double> frequency_Hz, std::span<const double> angles,
                    AngleFit start) {
  const auto count = static_cast<Eigen::Index>(angles.size());
  const auto residuals = [&](const AngleFit& fit) {
    Eigen::VectorXd r(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto k = static_cast<std::size_t>(i);
      r(i) = angles[k] - fit.a + 2.0 * std::atan(fit.q(frequency_Hz[k]));
    }
    return r;
  };
  AngleFit fit = start;
  Eigen::VectorXd r = residuals(fit);
  Eigen::MatrixXd jacobian(count, 3);
  constexpr int kMostIterations = 60;
  constexpr double kSmallStep = 1e-14;
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    for (Eigen::Index i = 0; i < count; ++i) {
      const double f = frequency_Hz[static_cast<std::size_t>(i)];
      const double q = fit.q(f);
      const double slope = 2.0 / (1.0 + q * q);
      const double dp_dlog = -(f / fit.natural_frequency_Hz + fit.natural_frequency_Hz / f) /
                             (2.0 * fit.damping_ratio);
      jacobian.row(i) << -1.0, slope * dp_dlog, -slope * q;
    }
    const Eigen::Vector3d step = -jacobian.colPivHouseholderQr().solve(r);
    double length = 1.0;
    for (; length > 1e-6; length *= 0.5) {
      AngleFit next = fit;
      next.a += length * step(0);
      next.natural_frequency_Hz *= std::exp(std::clamp(length * step(1), -0.5, 0.5));
      next.damping_ratio *= std::exp(std::clamp(length * step(2), -1.0, 1.0));
      const Eigen::VectorXd found = residuals(next);
      if (found.squaredNorm() > r.squaredNorm()) continue;
      fit = next;
      r = found;
      break;
    }
    if (length <= 1e-6 || std::abs(step(1)) + std::abs(step(2)) < kSmallStep) break;
  }
  const Eigen::Matrix3d inverse = (jacobian.transpose() * jacobian).inverse();
  const double freedom = std::max<double>(1.0, static_cast<double>(count - 3));
  fit.natural_frequency_std_Hz =
      fit.natural_frequency_Hz * std::sqrt(inverse(1, 1) * r.squaredNorm() / freedom);
  return fit;
}

/// Points on both sides of `peak` whose size is above a part of the peak's.
Arc around_peak(const Velocity& v, std::size_t peak) {
  // On a circle through 0 the size is the cosine of half the angle from resonance.
  constexpr double kPart = 0.6;
  const double least = kPart * std::abs(v.value[peak]);
  Arc arc{peak, peak};
  while (arc.first > 0 && std::abs(v.value[arc.first - 1]) > least) --arc.first;
  while (arc.last + 1 < v.value.size() && std::abs(v.value[arc.last + 1]) > least) ++arc.last;
  return arc;
}

/// Uphill from a frequency to a point that no other within reach exceeds.
std::size_t peak_near(const Velocity& v, double frequency_Hz) {
  constexpr std::size_t kReach = 5;
  const auto above = std::ranges::lower_bound(v.frequency_Hz, frequency_Hz);
  auto at = static_cast<std::size_t>(above - v.frequency_Hz.begin());
  at = std::min(at, v.frequency_Hz.size() - 1);
  for (;;) {
    std::size_t next = at;
    const std::size_t last = std::min(at + kReach, v.value.size() - 1);
    for (std::size_t k = at - std::min(at, kReach); k <= last; ++k) {
      if (std::abs(v.value[k]) > std::abs(v.value[next])) next = k;
    }
    if (next == at) return at;
    at = next;
  }
}

Arc arc_of(const Velocity& v, const AngleFit& fit, double half_arc_rad) {
  const double most = std::tan(0.5 * half_arc_rad);
  const auto first =
      std::ranges::find_if(v.frequency_Hz, [&](double f) { return fit.q(f) >= -most; });
  const auto last = std::find_if(v.frequency_Hz.rbegin(), v.frequency_Hz.rend(),
                                 [&](double f) { return fit.q(f) <= most; });
  if (first == v.frequency_Hz.end() || last == v.frequency_Hz.rend()) return {1, 0};
  return {static_cast<std::size_t>(first - v.frequency_Hz.begin()),
          v.frequency_Hz.size() - 1 - static_cast<std::size_t>(last - v.frequency_Hz.rbegin())};
}

/// Where angles fall fastest with log frequency, by differences over a tenth of the points.
double fastest_Hz(std::span<const double> frequency_Hz, std::span<const double> angles) {
  const std::size_t reach = std::max<std::size_t>(1, angles.size() / 20);
  double most = -std::numeric_limits<double>::infinity();
  double place_Hz = frequency_Hz[angles.size() / 2];
  for (std::size_t k = reach; k + reach < angles.size(); ++k) {
    const double rate = (angles[k - reach] - angles[k + reach]) /
                        std::log(frequency_Hz[k + reach] / frequency_Hz[k - reach]);
    if (rate <= most) continue;
    most = rate;
    place_Hz = std::sqrt(frequency_Hz[k - reach] * frequency_Hz[k + reach]);
  }
  return place_Hz;
}

void damping_from_pairs(NyquistCircle& made, std::span<const double> angles, const AngleFit& fit) {
  constexpr double kLeastAngle = 30.0 * kDegree;
  constexpr double kMostAngle = 150.0 * kDegree;
  struct Point {
    double p;
    double q;
  };
  std::vector<Point> below;
  std::vector<Point> above;
  for (std::size_t k = 0; k < angles.size(); ++k) {
    const double angle = angles[k] - fit.a;
    if (std::abs(angle) < kLeastAngle || std::abs(angle) > kMostAngle) continue;
    (angle > 0.0 ? below : above).push_back({fit.p(made.frequency_Hz[k]), -std::tan(0.5 * angle)});
  }
  double sum = 0.0;
  double squares = 0.0;
  // More pairs than this say no more of the scatter.
  constexpr std::size_t kMostASide = 200;
  const std::size_t step_below = below.size() / kMostASide + 1;
  const std::size_t step_above = above.size() / kMostASide + 1;
  for (std::size_t i = 0; i < below.size(); i += step_below) {
    for (std::size_t j = 0; j < above.size(); j += step_above) {
      const double zeta = 0.5 * (above[j].p - below[i].p) / (above[j].q - below[i].q);
      ++made.pairs;
      // Welford: the mean, and squares about it.
      const double off = zeta - sum;
      sum += off / made.pairs;
      squares += off * (zeta - sum);
    }
  }
  made.damping_ratio = sum;
  made.damping_ratio_std = made.pairs > 1 ? std::sqrt(squares / (made.pairs - 1)) : 0.0;
}

/// One resonance; the reason where there is no circle.
std::optional<std::string> draw(const Velocity& v, double near_Hz, const CircleSettings& settings,
                                NyquistCircle& made) {
  const auto fewest = static_cast<std::size_t>(std::max(3, settings.fewest_points));
  const std::size_t peak = peak_near(v, near_Hz);
  Arc arc = around_peak(v, peak);
  AngleFit fit;
  fit.natural_frequency_Hz = v.frequency_Hz[peak];
  std::vector<double> angles;
  constexpr int kMostRounds = 20;
  for (int round = 0; round < kMostRounds; ++round) {
    if (arc.last < arc.first || arc.size() < fewest) {
      return fmt::format("{} points on the arc; needs {}", arc.last < arc.first ? 0 : arc.size(),
                         fewest);
    }
    const std::span points(v.value.data() + arc.first, arc.size());
    const std::span frequencies(v.frequency_Hz.data() + arc.first, arc.size());
    try {
      made.circle = fit_circle(points);
    } catch (const std::invalid_argument&) {
      return "points lie on a straight line";
    }
    angles = unwrapped_angles(points, made.circle.centre);
    if (round == 0) {
      const double width = std::abs(angles.back() - angles.front());
      const double p = frequencies.back() / frequencies.front() - 1.0;
      fit.damping_ratio = std::max(1e-9, 0.5 * p / std::max(0.1, std::tan(0.25 * width)));
      fit.a = angles[peak - arc.first];
    }
    // The centre's place decides the branch of the angles.
    fit.a += 2.0 * std::numbers::pi *
             std::round((angles[angles.size() / 2] - fit.a) / (2.0 * std::numbers::pi));
    fit = fit_angles(frequencies, angles, fit);
    made.frequency_Hz.assign(frequencies.begin(), frequencies.end());
    made.velocity.assign(points.begin(), points.end());
    const Arc next = arc_of(v, fit, settings.half_arc_deg * kDegree);
    if (next == arc) break;
    arc = next;
  }
  constexpr double kMostDistance = 0.1;
  if (made.circle.rms_distance > kMostDistance * made.circle.radius) {
    return fmt::format("circle fit residual {:.2g} of the radius",
                       made.circle.rms_distance / made.circle.radius);
  }
  const bool inside = fit.natural_frequency_Hz >= made.frequency_Hz.front() &&
                      fit.natural_frequency_Hz <= made.frequency_Hz.back();
  if (!inside) return "resonance outside the measured points";
  made.natural_frequency_Hz = fit.natural_frequency_Hz;
  made.natural_frequency_std_Hz = fit.natural_frequency_std_Hz;
  made.fastest_Hz = fastest_Hz(made.frequency_Hz, angles);
  damping_from_pairs(made, angles, fit);
  if (made.pairs == 0) return "no points on both sides, 30 to 150 degrees from resonance";
  if (!(made.damping_ratio > 0.0 && made.damping_ratio < kMostDamping)) {
    return fmt::format("implausible damping ratio {:.3g}", made.damping_ratio);
  }
  made.modal_constant = 2.0 * made.circle.radius * std::polar(1.0, fit.a) * 2.0 *
                        made.damping_ratio * 2.0 * std::numbers::pi * made.natural_frequency_Hz;
  return std::nullopt;
}

/// Two ragged peaks of one resonance lead to the same circle.
bool is_known(const NyquistCircle& circle, const std::vector<NyquistCircle>& circles) {
  return std::ranges::any_of(circles, [&](const NyquistCircle& known) {
    const double half_width_Hz = known.damping_ratio * known.natural_frequency_Hz;
    return std::abs(circle.natural_frequency_Hz - known.natural_frequency_Hz) < half_width_Hz;
  });
}

std::vector<double> peaks_of(const Velocity& v) {
  std::vector<double> power(v.value.size());
  for (std::size_t k = 0; k < power.size(); ++k) power[k] = std::norm(v.value[k]);
  const std::vector<double> exact(power.size(), 0.0);
  constexpr double kLeastProminence_dB = 6.0;
  std::vector<double> peaks;
  for (const auto& found : peaks_and_valleys(
           v.frequency_Hz, power, exact,
           {.place = PeakPlace::on_line, .least_prominence_dB = kLeastProminence_dB})) {
    if (found.feature == Feature::pole) peaks.push_back(found.line_Hz);
  }
  return peaks;
}

}  // namespace

CircleSet nyquist_circles(const FrequencyChannel& channel, const CircleSettings& settings) {
  const Velocity v = velocity_form(channel);
  CircleSet made;
  if (v.value.empty()) return made;
  const auto near_Hz = settings.near_Hz.empty() ? peaks_of(v) : settings.near_Hz;
  for (const double frequency_Hz : near_Hz) {
    NyquistCircle circle;
    if (const auto reason = draw(v, frequency_Hz, settings, circle)) {
      made.refused.push_back({frequency_Hz, *reason});
      continue;
    }
    if (!is_known(circle, made.circles)) made.circles.push_back(std::move(circle));
  }
  std::ranges::sort(made.circles, {}, &NyquistCircle::natural_frequency_Hz);
  for (std::size_t i = 0; i < made.circles.size(); ++i) {
    made.circles[i].order = static_cast<int>(i) + 1;
  }
  return made;
}

ModalTable modal_table(const arm::Sensor& sensor, const std::vector<NyquistCircle>& circles) {
  ModalTable table;
  for (const auto& circle : circles) {
    table.push_back({.sensor = sensor,
                     .feature = Feature::pole,
                     .order = {},
                     .frequency_Hz = circle.natural_frequency_Hz,
                     .frequency_std_Hz = circle.natural_frequency_std_Hz,
                     .damping_ratio = circle.damping_ratio,
                     .damping_ratio_std = circle.damping_ratio_std});
  }
  return table;
}

}  // namespace flexarm::measured
