#include "report/figures/frequency_response_figure.hpp"

#include "measured/spectra/frequency_response.hpp"
#include "measured/spectra/robust.hpp"
#include "report/figures/axis_units.hpp"
#include "report/figures/feature_marks.hpp"
#include "report/figures/figure_layout.hpp"
#include "report/figures/meaning.hpp"
#include "report/figures/measured_curve.hpp"
#include "report/figures/phase.hpp"
#include "report/figures/phase_panel.hpp"
#include "report/figures/refined_curve.hpp"
#include "report/tables/response_tables.hpp"
#include "report/words.hpp"

#include <boost/math/distributions/students_t.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace flexarm::report {
namespace {

using Complex = std::complex<double>;

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kProbability = 0.95;
constexpr int kResponseWidth_px = 1000;
constexpr int kResponseHeight_px = 780;
constexpr int kCoherence_px = 140;
constexpr double kMagnitudeRoom = 0.12;
constexpr double kModelAbove = 5.0;  // the largest measured value, as far as a model sets limits
constexpr double kKnown = 0.3;       // half a 95 % interval, relative
constexpr double kMostPhase_rad = std::numbers::pi / 4.0;  // half of one
constexpr double kCoherenceRoom = 0.04;
constexpr double kLeastPower = 1e-3;  // of the torque, relative to where it has its full power
constexpr double kFullPower = 0.9;    // quantile of the powers of its lines
constexpr std::size_t kLinesBeside = 5;
constexpr double kPeakProminence_dB = 6.0;
constexpr double kSamePeak = 0.05;  // relative distance of the lines of one peak
constexpr const char* kMeasured = "measured";
constexpr const char* kInterval = "95 % interval";

/// A model's curve, broken so that what lies below shows where they agree: the arm file, then the
/// extended arm.
Style model_style(const std::vector<AnalyticalResponse>& models, std::size_t i) {
  constexpr std::array kLines{Line::dotted, Line::dashed};
  Style style;
  style.colour = models[i].colour.value_or(i == 0 ? kBaselineColour : kIdentifiedColour);
  style.line = kLines[i % kLines.size()];
  style.line_width_px = 2.0;
  return style;
}

const Style kFit{.colour = kIdentifiedColour, .line = Line::dashed, .line_width_px = 1.8};

struct ModelCurve {
  std::string name;
  std::vector<double> frequency_Hz;
  std::vector<Complex> response;
  Style style;
};

void require_valid(const MeasuredResponse& m, const FrequencyResponsePlot& plot) {
  const std::size_t n = m.frequency_Hz.size();
  const auto optional_of_length = [&](const std::vector<double>& v) {
    return v.empty() || v.size() == n;
  };
  if (n == 0 || m.response.size() != n || !optional_of_length(m.relative_std) ||
      !optional_of_length(m.coherence)) {
    throw std::invalid_argument(fmt::format(
        "{}: {} responses, {} spreads, {} coherences at {} frequencies", arm::to_string(m.sensor),
        m.response.size(), m.relative_std.size(), m.coherence.size(), n));
  }
  for (const auto& model : plot.analytical) {
    if (model.response.size() != model.frequency_Hz.size()) {
      throw std::invalid_argument(fmt::format("{}: {} responses at {} frequencies", model.name,
                                              model.response.size(), model.frequency_Hz.size()));
    }
  }
}

/// The bands in which the response was measured.
std::vector<Range> measured_bands(const MeasuredResponse& measured) {
  std::vector<double> lines_Hz;
  for (std::size_t k = 0; k < measured.frequency_Hz.size(); ++k) {
    if (std::isfinite(std::abs(measured.response[k]))) lines_Hz.push_back(measured.frequency_Hz[k]);
  }
  std::vector<Range> bands;
  for (std::size_t k = 0; k < lines_Hz.size(); ++k) {
    if (bands.empty() || begins_band(lines_Hz, k)) bands.push_back({lines_Hz[k], lines_Hz[k]});
    bands.back().to = lines_Hz[k];
  }
  return bands;
}

void add_gap(ModelCurve& curve) {
  if (curve.frequency_Hz.empty()) return;
  curve.frequency_Hz.push_back(curve.frequency_Hz.back());
  curve.response.emplace_back(kNotDrawn, kNotDrawn);
}

/// Models where the response was measured.
std::vector<ModelCurve> model_curves(const MeasuredResponse& measured,
                                     const FrequencyResponsePlot& plot) {
  const std::vector<Range> bands = measured_bands(measured);
  std::vector<ModelCurve> curves;
  if (plot.fit) {
    const auto value = [&](double f_Hz) {
      return plot.fit->value(Complex(0.0, 2.0 * std::numbers::pi * f_Hz));
    };
    ModelCurve curve{"fit", {}, {}, kFit};
    for (const Range& band : bands) {
      if (!(band.from < band.to)) continue;
      add_gap(curve);
      const auto refined = refined_curve(value, band.from, band.to, plot.frequency_scale);
      std::ranges::copy(refined.frequency_Hz, std::back_inserter(curve.frequency_Hz));
      std::ranges::copy(refined.response, std::back_inserter(curve.response));
    }
    if (!curve.response.empty()) curves.push_back(std::move(curve));
  }
  for (std::size_t i = 0; i < plot.analytical.size(); ++i) {
    const auto& model = plot.analytical[i];
    ModelCurve curve{model.name, {}, {}, model_style(plot.analytical, i)};
    std::size_t k = 0;
    for (const Range& band : bands) {
      while (k < model.frequency_Hz.size() && model.frequency_Hz[k] < band.from) ++k;
      if (k < model.frequency_Hz.size() && model.frequency_Hz[k] <= band.to) add_gap(curve);
      for (; k < model.frequency_Hz.size() && model.frequency_Hz[k] <= band.to; ++k) {
        curve.frequency_Hz.push_back(model.frequency_Hz[k]);
        curve.response.push_back(model.response[k]);
      }
    }
    if (!curve.response.empty()) curves.push_back(std::move(curve));
  }
  return curves;
}

std::vector<double> magnitude(const std::vector<Complex>& response) {
  std::vector<double> sizes;
  for (const Complex& value : response) sizes.push_back(std::abs(value));
  return sizes;
}

/// Values for the limits of the axis: where little is known of |G|, as where the torque has no
/// power, none is above those that are known.
std::vector<double> up_to_known(std::vector<double> sizes, const std::vector<double>& interval) {
  double highest = 0.0;
  for (std::size_t i = 0; i < interval.size(); ++i) {
    if (interval[i] < kKnown) highest = std::fmax(highest, sizes[i]);
  }
  if (highest == 0.0) return sizes;
  for (double& size : sizes) size = std::isnan(size) ? size : std::min(size, highest);
  return sizes;
}

/// 0 where none is above it.
double largest_of(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double value : values) largest = std::fmax(largest, value);
  return largest;
}

Panel magnitude_panel(const MeasuredResponse& m, const std::vector<double>& interval,
                      const std::vector<ModelCurve>& models) {
  Panel panel;
  panel.y = {.label = kMagnitude,
             .unit = unit_text(response_unit(m.sensor, m.input)),
             .scale = Scale::logarithmic};
  panel.height = 1.8;
  const auto sizes = magnitude(m.response);
  panel.series.push_back(measured_curve(kMeasured, m.frequency_Hz, up_to_known(sizes, interval)));
  // A model's resonance between two lines has no bound: it does not set the limits.
  const double highest = largest_of(panel.series.front().y);
  for (const auto& model : models) {
    auto limited = magnitude(model.response);
    for (double& size : limited) {
      if (highest > 0.0 && size > kModelAbove * highest) size = kModelAbove * highest;
    }
    panel.series.push_back({model.name, model.frequency_Hz, std::move(limited), model.style});
  }
  fix_limits(panel, kMagnitudeRoom);
  panel.series.front() = measured_curve(kMeasured, m.frequency_Hz, sizes);
  for (std::size_t i = 0; i < models.size(); ++i) {
    panel.series[i + 1].y = magnitude(models[i].response);
  }
  if (!interval.empty() && panel.y.minimum) {
    std::vector<double> low;
    std::vector<double> high;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      const bool known = std::isfinite(interval[i] * sizes[i]);
      const auto limit = [&](double value) { return std::max(value, *panel.y.minimum); };
      low.push_back(known ? limit(sizes[i] * (1.0 - interval[i])) : kNotDrawn);
      high.push_back(known ? limit(sizes[i] * (1.0 + interval[i])) : kNotDrawn);
    }
    panel.series.insert(panel.series.begin(),
                        measured_interval(kInterval, m.frequency_Hz, low, high));
  }
  return panel;
}

/// Continuous over the lines whose phase is known, by whole turns near the model's.
std::vector<double> measured_phase_deg(const MeasuredResponse& m,
                                       const std::vector<double>& interval,
                                       const PhaseCurve* model) {
  auto response = m.response;
  for (std::size_t i = 0; i < interval.size(); ++i) {
    if (interval[i] > kMostPhase_rad) response[i] = {kNotDrawn, kNotDrawn};
  }
  PhaseCurve phase{m.frequency_Hz, continuous_phase_deg(response)};
  if (model != nullptr) turn_towards(*model, phase);
  return std::move(phase.phase_deg);
}

Panel phase_panel(const MeasuredResponse& m, const std::vector<double>& interval,
                  const std::vector<ModelCurve>& models) {
  Panel panel;
  panel.height = 1.1;
  std::vector<PhaseCurve> of_models;
  for (const auto& model : models) {
    of_models.push_back({model.frequency_Hz, continuous_phase_deg(model.response)});
    turn_towards(of_models.front(), of_models.back());
  }
  auto phase = measured_phase_deg(m, interval, of_models.empty() ? nullptr : &of_models.front());
  const double turn_deg = to_principal_turn_deg(phase);
  for (double& value : phase) value += turn_deg;
  for (PhaseCurve& of_model : of_models) {
    for (double& value : of_model.phase_deg) value += turn_deg;
  }
  const Series curve = measured_curve(kMeasured, m.frequency_Hz, phase);
  panel.series.push_back(phase_series(kMeasured, curve.x, curve.y, curve.style));
  for (std::size_t i = 0; i < models.size(); ++i) {
    panel.series.push_back(phase_series(models[i].name, of_models[i].frequency_Hz,
                                        of_models[i].phase_deg, models[i].style));
  }
  panel.y = phase_axis(panel.series);
  if (!interval.empty()) {
    std::vector<double> low;
    std::vector<double> high;
    for (std::size_t i = 0; i < phase.size(); ++i) {
      const double half_deg = interval[i] <= kMostPhase_rad ? kDegrees * interval[i] : kNotDrawn;
      low.push_back(phase[i] - half_deg);
      high.push_back(phase[i] + half_deg);
    }
    panel.series.insert(panel.series.begin(),
                        measured_interval(kInterval, m.frequency_Hz, low, high));
  }
  return panel;
}

Panel coherence_panel(const MeasuredResponse& m) {
  Panel panel;
  panel.y = {.label = "coherence", .minimum = -kCoherenceRoom, .maximum = 1.0 + kCoherenceRoom};
  panel.y.ticks = {{0.0, "0"}, {0.5, "0.5"}, {1.0, "1"}};
  panel.height = 0.7;
  panel.series.push_back(measured_curve(kMeasured, m.frequency_Hz, m.coherence));
  if (m.averages > 1.0) {
    const double chance = measured::coherence_of_chance(m.averages, 1.0 - kProbability);
    Style style{.colour = grey, .line = Line::dotted};
    panel.series.push_back({"coherence threshold",
                            {m.frequency_Hz.front(), m.frequency_Hz.back()},
                            {chance, chance},
                            style});
  }
  return panel;
}

/// Without values at lines where the torque has next to no power and the sensor no relation to it.
void drop_unexcited(const std::vector<double>& input_autopower, MeasuredResponse& m) {
  std::vector<double> powers;
  for (const double power : input_autopower) {
    if (std::isfinite(power)) powers.push_back(power);
  }
  if (powers.size() != m.frequency_Hz.size() || !(m.averages > 1.0)) return;
  const double least = kLeastPower * measured::quantile(powers, kFullPower);
  const double chance = measured::coherence_of_chance(m.averages, 1.0 - kProbability);
  for (std::size_t k = 0; k < m.frequency_Hz.size(); ++k) {
    if (input_autopower[k] >= least) continue;
    const std::size_t from = k - std::min(k, kLinesBeside);
    const std::size_t to = std::min(m.coherence.size(), k + kLinesBeside + 1);
    std::vector<double> coherences;
    for (std::size_t i = from; i < to; ++i) {
      if (std::isfinite(m.coherence[i])) coherences.push_back(m.coherence[i]);
    }
    if (!coherences.empty() && measured::quantile(coherences, 0.5) > chance) continue;
    m.response[k] = {kNotDrawn, kNotDrawn};
    m.relative_std[k] = kNotDrawn;
  }
}

/// The features, and the highest peak of the response if it is none of them.
std::vector<measured::SpectralFeature> with_highest_peak(
    std::vector<measured::SpectralFeature> features, const MeasuredResponse& m,
    const std::vector<double>& interval) {
  std::vector<double> power;
  for (std::size_t k = 0; k < m.response.size(); ++k) {
    const bool is_known = interval.empty() || interval[k] < 1.0;
    power.push_back(is_known ? std::norm(m.response[k]) : kNotDrawn);
  }
  const std::vector<double> exact(power.size(), 0.0);
  measured::PeakSettings settings;
  settings.least_prominence_dB = kPeakProminence_dB;
  settings.most_damping_ratio = 1.0;
  auto found = measured::peaks_and_valleys(m.frequency_Hz, power, exact, settings);
  std::erase_if(found, [](const auto& one) { return one.feature != measured::Feature::pole; });
  const auto highest = std::ranges::max_element(found, {}, &measured::SpectralFeature::level_dB);
  if (highest == found.end()) return features;
  const auto is_same = [&](const measured::SpectralFeature& one) {
    return one.feature == measured::Feature::pole &&
           std::abs(one.line_Hz - highest->line_Hz) <= kSamePeak * highest->line_Hz;
  };
  if (std::ranges::none_of(features, is_same)) features.push_back(*highest);
  return features;
}

/// Without line 0, which a logarithmic axis has not.
MeasuredResponse above_zero(MeasuredResponse m) {
  const auto first = std::ranges::upper_bound(m.frequency_Hz, 0.0) - m.frequency_Hz.begin();
  const auto cut = [&](auto& values) {
    if (!values.empty()) values.erase(values.begin(), values.begin() + first);
  };
  cut(m.response);
  cut(m.relative_std);
  cut(m.coherence);
  cut(m.frequency_Hz);
  return m;
}

}  // namespace

MeasuredResponse measured_response(const measured::FrequencyResponseEstimate& estimate,
                                   std::size_t channel) {
  const auto& found = estimate.channels.at(channel);
  MeasuredResponse made{found.sensor,       estimate.frequency_Hz,      found.response,
                        found.relative_std, found.estimators.coherence, estimate.averages};
  made.input = estimate.settings.estimator.hub_sensor();
  drop_unexcited(estimate.input_autopower, made);
  return made;
}

MeasuredResponse measured_response(const measured::FrequencyChannel& channel,
                                   std::optional<double> averages,
                                   const std::optional<arm::Sensor>& input) {
  MeasuredResponse made{channel.sensor, channel.frequency_Hz, channel.response};
  made.input = input;
  made.coherence = channel.coherence;
  made.averages = averages.value_or(0.0);
  if (!averages) return made;
  for (const double coherence : channel.coherence) {
    made.relative_std.push_back(measured::relative_response_std(coherence, *averages));
  }
  return made;
}

std::vector<double> interval_95(const MeasuredResponse& measured) {
  const bool known =
      std::ranges::any_of(measured.relative_std, [](double value) { return std::isfinite(value); });
  if (!known || !(measured.averages > 1.0)) return {};
  const boost::math::students_t spread(2.0 * (measured.averages - 1.0));
  const double quantile = boost::math::quantile(spread, 0.5 * (1.0 + kProbability));
  std::vector<double> interval;
  for (const double value : measured.relative_std) interval.push_back(quantile * value);
  return interval;
}

Figure frequency_response_figure(const MeasuredResponse& measured,
                                 const FrequencyResponsePlot& plot) {
  require_valid(measured, plot);
  const MeasuredResponse shown = above_zero(measured);
  if (shown.frequency_Hz.empty()) {
    throw std::invalid_argument(
        fmt::format("{}: no frequency above 0", arm::to_string(measured.sensor)));
  }
  const bool has_value = std::ranges::any_of(shown.response, [](const Complex& value) {
    return std::isfinite(std::abs(value)) && value != 0.0;
  });
  if (!has_value) {
    throw std::invalid_argument(
        fmt::format("{}: no response to draw", arm::to_string(measured.sensor)));
  }
  const auto interval = interval_95(shown);
  const auto models = model_curves(shown, plot);

  PanelStack stack;
  stack.x = {.label = "frequency", .unit = "Hz", .scale = plot.frequency_scale};
  stack.panels.push_back(magnitude_panel(shown, interval, models));
  Panel phase = phase_panel(shown, interval, models);
  if (phase.y.minimum) stack.panels.push_back(std::move(phase));
  Figure figure{
      .title = plot.title, .width_px = kResponseWidth_px, .height_px = kResponseHeight_px};
  const bool has_coherence =
      std::ranges::any_of(shown.coherence, [](double value) { return std::isfinite(value); });
  if (has_coherence) {
    stack.panels.push_back(coherence_panel(shown));
  } else {
    figure.height_px -= kCoherence_px;
  }

  std::vector<double> poles_Hz;
  for (const double pole_Hz : plot.analytical_poles_Hz) {
    if (pole_Hz >= shown.frequency_Hz.front() && pole_Hz <= shown.frequency_Hz.back()) {
      poles_Hz.push_back(pole_Hz);
    }
  }
  for (Panel& panel : stack.panels) {
    add_frequency_lines(panel, poles_Hz, "analytical pole", analytical_pole_style());
  }
  add_feature_marks(stack.panels.front(), with_highest_peak(plot.features, shown, interval),
                    FeatureLevel::amplitude);
  figure.stacks.push_back(std::move(stack));
  return figure;
}

}  // namespace flexarm::report
