#include "report/page/overlay_blocks.hpp"

#include "measured/spectra/correlation.hpp"
#include "measured/spectra/robust.hpp"
#include "report/largest_stretch.hpp"
#include "report/page/page_curves.hpp"
#include "report/page/page_words.hpp"
#include "report/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

namespace flexarm::report::page {

namespace {

const measured::TimeRecord& record_of_run(const DiagnosedChannel& channel) {
  return std::get<measured::TimeRecord>(channel.run->data);
}

CurvesPanel residual_panel(const DiagnosedChannel& channel, const std::string& label, Role role,
                           const std::vector<double>& simulated) {
  const auto& time_s = record_of_run(channel).time_s;
  CurvesPanel panel{{label, channel.unit}, 1.0, {}};
  panel.series.push_back({label, role, Draw::line, record_of(time_s, channel.residual(simulated))});
  const double noise =
      channel.error->noise_floor * measured::standard_deviation(channel.overlay->measured);
  for (const double side : {-1.0, 1.0}) {
    panel.levels.push_back({"noise, 1 standard deviation", Role::noise, side * noise});
  }
  return panel;
}

/// Recorded inputs of the run: the torque, and the reference of a controller.
std::vector<CurvesPanel> input_panels(const DiagnosedChannel& channel) {
  const auto& record = record_of_run(channel);
  std::vector<CurvesPanel> panels;
  const auto add = [&](const char* label, const std::string& unit,
                       const std::vector<double>& values) {
    CurvesPanel panel{{label, unit}, 0.8, {}};
    panel.series.push_back({label, Role::measured, Draw::line, record_of(record.time_s, values)});
    panels.push_back(std::move(panel));
  };
  add("torque", "N m", record.torque_N_m);
  if (!record.reference.values.empty()) {
    add("reference", unit_text(record.reference.unit), record.reference.values);
  }
  return panels;
}

std::vector<CurvesPanel> overlay_panels(const DiagnosedChannel& channel, bool has_causes) {
  const auto& time_s = record_of_run(channel).time_s;
  CurvesPanel signal{{channel.sensor, channel.unit}, 1.6, {}};
  const auto add = [&](const char* label, Role role, const std::vector<double>& values) {
    signal.series.push_back({label, role, Draw::line, record_of(time_s, values)});
  };
  add("measured", Role::measured, channel.measured());
  add(kBeforeLabel, Role::before, channel.overlay->before);
  if (has_causes) add(kAfterLabel, Role::after, channel.overlay->after);
  std::vector<CurvesPanel> panels = {std::move(signal)};
  panels.push_back(residual_panel(channel, has_causes ? "residual, arm file" : "residual",
                                  Role::residual_before, channel.overlay->before));
  if (has_causes) {
    panels.push_back(residual_panel(channel, "residual, extended arm", Role::residual_after,
                                    channel.overlay->after));
  }
  std::ranges::move(input_panels(channel), std::back_inserter(panels));
  return panels;
}

/// The part of a long run in which the residuals of the arm file have the largest squares.
std::optional<std::array<double, 2>> worst_stretch_s(const DiagnosedChannel& channel) {
  const auto& time_s = record_of_run(channel).time_s;
  if (time_s.size() <= kWorstSamples) return std::nullopt;
  std::vector<double> squares;
  for (const double value : channel.residual(channel.overlay->before)) {
    squares.push_back(std::isfinite(value) ? value * value : 0.0);
  }
  const std::size_t from = begin_of_largest_stretch(squares, kWorstSamples);
  return std::array{time_s[from], time_s[from + kWorstSamples - 1]};
}

/// What drives the simulation of a run: the reference of a stated controller, else the torque.
const std::vector<double>& input_of(const DiagnosedChannel& channel) {
  const auto& record = record_of_run(channel);
  return channel.run->run.controller ? record.reference.values : record.torque_N_m;
}

/// Correlations of lags from -(the greatest) to it.
Series stems(const std::string& label, Role role, const std::vector<double>& values) {
  const double first_lag = -0.5 * static_cast<double>(values.size() - 1);
  return {label, role, Draw::stems,
          Samples{EvenRange{first_lag, 1.0, values.size()},
                  std::vector<float>(values.begin(), values.end())}};
}

/// An auto-correlation, which is even, at negative lags too.
std::vector<double> both_sides(const std::vector<double>& from_zero) {
  std::vector<double> made(from_zero.rbegin(), from_zero.rend());
  made.insert(made.end(), from_zero.begin() + 1, from_zero.end());
  return made;
}

void add_bounds(CurvesPanel& panel, const char* label, double bound) {
  for (const double side : {-1.0, 1.0}) {
    panel.levels.push_back({label, Role::bound, side * bound});
  }
}

std::string beyond_text(std::size_t beyond, std::size_t lags) {
  return fmt::format("{} of {} lags", beyond, lags);
}

CurvesView correlation_view(const DiagnosedChannel& channel, bool has_causes,
                            bool is_driven_by_motion) {
  const std::vector<double> none;
  const auto& input = is_driven_by_motion ? none : input_of(channel);
  const std::string input_name = channel.run->run.controller ? "reference" : "torque";
  CurvesPanel self{{"auto-correlation", ""}, 1.0, {}};
  CurvesPanel with_input{{"cross-correlation with the " + input_name, ""}, 1.0, {}};
  CurvesView view{{channel.run->run.id, channel.sensor}, {}, {}};
  const auto add = [&](const std::string& label, Role role, const std::vector<double>& simulated) {
    const auto r = measured::residual_correlation(channel.residual(simulated), input, kMostLag);
    self.series.push_back(stems(label, role, both_sides(r.auto_lag)));
    if (self.levels.empty()) add_bounds(self, "99 % bounds of white noise", r.auto_bound);
    view.facts.push_back({label + ": auto-correlation beyond its bounds",
                          beyond_text(r.auto_beyond(), r.greatest_lag)});
    if (r.cross_lag.empty()) return;
    with_input.series.push_back(stems(label, role, r.cross_lag));
    view.facts.push_back({label + ": cross-correlation beyond its bounds",
                          beyond_text(r.cross_beyond(), r.cross_lag.size())});
    // The bounds depend on the spectrum of the residuals: those of the last ones are drawn.
    with_input.levels.clear();
    add_bounds(with_input, "99 % bounds of independent signals", r.cross_bound);
  };
  add("arm file", Role::residual_before, channel.overlay->before);
  if (has_causes) add("extended arm", Role::residual_after, channel.overlay->after);
  view.panels.push_back(std::move(self));
  if (!with_input.series.empty()) view.panels.push_back(std::move(with_input));
  return view;
}

}  // namespace

CurvesBlock overlay_block(const std::vector<DiagnosedChannel>& channels, bool has_causes) {
  CurvesBlock block{
      {"overlay", "Signals, residuals and torque",
       "The channel with the largest error is first. Each panel has a scale of its own. "
       "Of a long run the panels show the part where the residuals of the arm file are "
       "largest; the strip below them shows the whole run."},
      {"time", "s"},
      {"run", "sensor"},
      {}};
  for (const DiagnosedChannel& channel : channels) {
    block.views.push_back({{channel.run->run.id, channel.sensor},
                           channel.facts(has_causes),
                           overlay_panels(channel, has_causes),
                           worst_stretch_s(channel)});
  }
  return block;
}

CurvesBlock correlation_block(const std::vector<DiagnosedChannel>& channels, bool has_causes,
                              bool is_driven_by_motion) {
  CurvesBlock block{
      {"correlation", "Auto-correlation and cross-correlation",
       "As resid of MATLAB's System Identification Toolbox: normalised, 1 % of the lags of noise "
       "lie beyond the bounds. At positive lags of the cross-correlation the residual follows the "
       "input: dynamics that the model lacks."},
      {"lag", "samples"},
      {"run", "sensor"},
      {}};
  for (const DiagnosedChannel& channel : channels) {
    block.views.push_back(correlation_view(channel, has_causes, is_driven_by_motion));
  }
  return block;
}

}  // namespace flexarm::report::page
