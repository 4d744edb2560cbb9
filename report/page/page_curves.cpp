#include "report/page/page_curves.hpp"

#include "report/figures/measured_curve.hpp"
#include "report/figures/phase.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace flexarm::report::page {

namespace {

constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;

bool has_value(const BodeCurve& curve, std::size_t k) {
  const double magnitude = std::abs(curve.response[k]);
  return curve.frequency_Hz[k] > 0.0 && std::isfinite(magnitude) && magnitude > 0.0;
}

/// Indices of the lines that are drawn, of all or of those of which something is known.
std::vector<std::size_t> drawn_lines(const BodeCurve& curve, bool known_alone) {
  std::vector<std::size_t> lines;
  for (std::size_t k = 0; k < curve.frequency_Hz.size(); ++k) {
    if (has_value(curve, k) && (!known_alone || is_known(curve.relative_std, k))) {
      lines.push_back(k);
    }
  }
  std::vector<double> sizes;
  for (const auto& value : curve.response) sizes.push_back(std::abs(value));
  return thinned_lines(curve.frequency_Hz, sizes, std::move(lines));
}

/// Numbers over the drawn lines, with a NaN where a gap is.
struct GappedCurve {
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> y_std;

  void add(double at, double value, double deviation) {
    x.push_back(at);
    y.push_back(value);
    y_std.push_back(deviation);
  }
};

Series to_series(const BodeCurve& curve, Role role, const GappedCurve& gapped, bool has_std) {
  Samples samples{as_singles(gapped.x), as_singles(gapped.y)};
  if (has_std) samples.y_std = as_singles(gapped.y_std);
  return {curve.label, role, Draw::line, std::move(samples)};
}

/// Whether curves have a gap between drawn lines i - 1 and i.
bool has_gap(const BodeCurve& curve, const std::vector<std::size_t>& lines, std::size_t i) {
  if (i == 0) return false;
  if (begins_band(curve.frequency_Hz, lines[i])) return true;
  for (std::size_t line = lines[i - 1] + 1; line < lines[i]; ++line) {
    const bool is_unknown = !has_value(curve, line) || !is_known(curve.relative_std, line);
    if (is_unknown || begins_band(curve.frequency_Hz, line)) return true;
  }
  return false;
}

/// A value of each drawn line, with gaps over what was not measured.
template <class ValueAndStd>
GappedCurve gapped(const BodeCurve& curve, const std::vector<std::size_t>& lines,
                   const ValueAndStd& value_and_std) {
  GappedCurve made;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::size_t line = lines[i];
    const auto [value, deviation] = value_and_std(i);
    const double f_Hz = curve.frequency_Hz[line];
    if (has_gap(curve, lines, i)) made.add(f_Hz, kGapNumber, kGapNumber);
    made.add(f_Hz, value, deviation);
  }
  return made;
}

/// The phase at all lines, continuous over those that are drawn at all.
PhaseCurve phase_of(const BodeCurve& curve) {
  auto response = curve.response;
  for (std::size_t k = 0; k < response.size(); ++k) {
    if (!has_value(curve, k) || !is_known(curve.relative_std, k)) response[k] = kGapNumber;
  }
  return {curve.frequency_Hz, continuous_phase_deg(response)};
}

/// Without the values that have no phase.
BodeCurve where_known(BodeCurve curve, const PhaseCurve& phase) {
  for (std::size_t k = 0; k < curve.response.size(); ++k) {
    if (!std::isfinite(phase.phase_deg[k])) curve.response[k] = kGapNumber;
  }
  return curve;
}

/// The phases of curves, each by whole turns near that of the first one without a deviation.
std::vector<PhaseCurve> phases_of(const std::vector<BodeCurve>& curves) {
  std::vector<PhaseCurve> phases;
  for (const BodeCurve& curve : curves) phases.push_back(phase_of(curve));
  const auto model = std::ranges::find_if(
      curves, [](const BodeCurve& curve) { return curve.relative_std.empty(); });
  if (model == curves.end()) return phases;
  const PhaseCurve reference = phases[static_cast<std::size_t>(model - curves.begin())];
  for (PhaseCurve& phase : phases) turn_towards(reference, phase);
  const double turn_deg = to_principal_turn_deg(phases.front().phase_deg);
  for (PhaseCurve& phase : phases) {
    for (double& value : phase.phase_deg) value += turn_deg;
  }
  return phases;
}

}  // namespace

std::vector<std::size_t> thinned_lines(const std::vector<double>& frequency_Hz,
                                       const std::vector<double>& values,
                                       std::vector<std::size_t> lines) {
  if (lines.size() <= kMostLines) return lines;
  constexpr std::size_t kSteps = kMostLines / 2;
  const double from = std::log(frequency_Hz[lines.front()]);
  const double range = std::log(frequency_Hz[lines.back()]) - from;
  const auto step_of = [&](std::size_t line) {
    const double part = (std::log(frequency_Hz[line]) - from) / range;
    return std::min(kSteps - 1, static_cast<std::size_t>(part * kSteps));
  };
  const auto size_of = [&](std::size_t line) { return values[line]; };
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < lines.size();) {
    std::size_t end = i;
    while (end < lines.size() && step_of(lines[end]) == step_of(lines[i])) ++end;
    const auto first = lines.begin() + static_cast<std::ptrdiff_t>(i);
    const auto last = lines.begin() + static_cast<std::ptrdiff_t>(end);
    const auto [least, greatest] = std::ranges::minmax_element(first, last, {}, size_of);
    kept.push_back(std::min(*least, *greatest));
    if (*least != *greatest) kept.push_back(std::max(*least, *greatest));
    i = end;
  }
  return kept;
}

bool has_number(const std::vector<double>& values) {
  return std::ranges::any_of(values, [](double value) { return std::isfinite(value); });
}

std::vector<double> for_log_axis(std::vector<double> values) {
  for (double& value : values) {
    if (!(value > 0.0)) value = kGapNumber;
  }
  return values;
}

std::vector<float> as_singles(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

Record record_of(const std::vector<double>& time_s, const std::vector<double>& values) {
  Record record{{time_s.empty() ? 0.0 : time_s.front(), 1.0, values.size()}, {}};
  if (time_s.size() > 1) {
    record.x.step = (time_s.back() - time_s.front()) / static_cast<double>(time_s.size() - 1);
  }
  record.y.reserve(values.size());
  for (const double value : values) record.y.push_back(static_cast<float>(value));
  return record;
}

Series curve(const std::string& label, Role role, std::vector<double> x, std::vector<double> y,
             Draw draw) {
  return {label, role, draw, Samples{std::move(x), std::move(y)}};
}

std::vector<CurvesPanel> bode_panels(const std::string& unit,
                                     const std::vector<BodeCurve>& curves) {
  CurvesPanel magnitude{{"magnitude", unit, AxisScale::logarithmic}, 2.0, {}};
  CurvesPanel phase{{"phase", "deg"}, 1.2, {}};
  CurvesPanel coherence{{"coherence", "", AxisScale::linear, std::array{0.0, 1.0}}, 0.7, {}};
  const auto phases = phases_of(curves);
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const BodeCurve& curve = curves[c];
    const auto lines = drawn_lines(curve, true);
    if (lines.empty()) continue;
    const bool has_std = !curve.relative_std.empty();
    const auto std_of = [&](std::size_t line) {
      return has_std ? curve.relative_std[line] : kGapNumber;
    };
    auto sizes = gapped(curve, lines, [&](std::size_t i) {
      const double size = std::abs(curve.response[lines[i]]);
      return std::pair(size, size * std_of(lines[i]));
    });
    const BodeCurve turned = where_known(curve, phases[c]);
    const auto turned_lines = drawn_lines(turned, true);
    auto angles = gapped(turned, turned_lines, [&](std::size_t i) {
      const std::size_t line = turned_lines[i];
      return std::pair(phases[c].phase_deg[line], kDegreesPerRadian * std_of(line));
    });
    magnitude.series.push_back(to_series(curve, curve.role, sizes, has_std));
    phase.series.push_back(to_series(curve, curve.role, angles, has_std));
    if (curve.coherence.empty()) continue;
    const auto all_lines = drawn_lines(curve, false);
    GappedCurve squared;
    for (const std::size_t line : all_lines) {
      if (!squared.x.empty() && begins_band(curve.frequency_Hz, line)) {
        squared.add(curve.frequency_Hz[line], kGapNumber, kGapNumber);
      }
      squared.add(curve.frequency_Hz[line], curve.coherence[line], kGapNumber);
    }
    if (std::ranges::none_of(squared.y, [](double value) { return std::isfinite(value); }))
      continue;
    coherence.series.push_back(to_series(curve, Role::coherence, squared, false));
  }
  std::vector<CurvesPanel> panels;
  if (magnitude.series.empty()) return panels;
  panels.push_back(std::move(magnitude));
  panels.push_back(std::move(phase));
  if (!coherence.series.empty()) panels.push_back(std::move(coherence));
  return panels;
}

bool is_known(const std::vector<double>& relative_std, std::size_t line) {
  return relative_std.empty() || !(relative_std[line] > kMostRelativeStd);
}

Axis frequency_axis() {
  return {"frequency", "Hz", AxisScale::logarithmic};
}

}  // namespace flexarm::report::page
