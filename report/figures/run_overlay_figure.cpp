#include "report/figures/run_overlay_figure.hpp"

#include "report/figures/meaning.hpp"
#include "report/largest_stretch.hpp"
#include "report/words.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::report {

namespace {

constexpr int kRunSignal_px = 195;    // "tip acceleration [m/s²]" fits beside it
constexpr int kRunResidual_px = 130;  // with its note
constexpr int kRunInput_px = 120;
constexpr int kRunFurniture_px = 110;
constexpr int kWholeRun_px = 1000;
constexpr int kRunLens_px = 550;

const Style kMeasuredLine{.colour = kMeasuredColour, .tint = 0.6, .line_width_px = 3.0};
const Style kSimulatedLine{.colour = kBaselineColour, .line_width_px = 1.1};

/// Gaps where samples are no readings.
std::vector<double> readings_of(const compare::MeasuredSignal& signal) {
  std::vector<double> measured = signal.measured;
  for (const std::size_t k : signal.left_out) measured[k] = kNotDrawn;
  return measured;
}

std::vector<double> residual_of(const compare::MeasuredSignal& signal) {
  std::vector<double> residual = readings_of(signal);
  for (std::size_t k = 0; k < residual.size(); ++k) residual[k] -= signal.simulated[k];
  return residual;
}

/// Where `kWholeSamples` begin in which residuals are largest, relative to those of the run.
std::size_t worst_samples(const compare::MeasuredTimeRun& run) {
  std::vector<double> squares(run.time_s.size());
  for (const auto& signal : run.signals) {
    const std::vector<double> residual = residual_of(signal);
    double sum = 0.0;
    for (const double value : residual) sum += std::isfinite(value) ? value * value : 0.0;
    for (std::size_t k = 0; k < squares.size() && sum > 0.0; ++k) {
      if (std::isfinite(residual[k])) squares[k] += residual[k] * residual[k] / sum;
    }
  }
  return begin_of_largest_stretch(squares, kWholeSamples);
}

PanelStack samples_of(const compare::MeasuredTimeRun& run, std::size_t from, std::size_t count) {
  const auto part = [&](const std::vector<double>& values) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(from);
    return std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(count));
  };
  const std::vector<double> time_s = part(run.time_s);
  PanelStack stack{.x = {.label = "time", .unit = "s"}};
  for (const auto& signal : run.signals) {
    const std::string unit = unit_text(signal.unit);
    Panel both{.y = {.label = in_words(signal.sensor), .unit = unit, .robust = true}};
    both.series.push_back({"measured", time_s, part(readings_of(signal)), kMeasuredLine});
    both.series.push_back({"simulated", time_s, part(signal.simulated), kSimulatedLine});
    Panel residual{.y = {.label = "residual", .unit = unit, .robust = true},
                   .height = static_cast<double>(kRunResidual_px) / kRunSignal_px};
    residual.note = fmt::format("fit of the run {:.4g} %, NRMSE {:.3g} %", signal.fit_percent(),
                                signal.nrmse_percent);
    residual.series.push_back({"", time_s, part(residual_of(signal)), kSimulatedLine});
    stack.panels.push_back(std::move(both));
    stack.panels.push_back(std::move(residual));
  }
  Panel input{.y = {.label = run.closed_loop ? "reference" : "torque",
                    .unit = run.closed_loop ? unit_text(run.reference.unit) : "N m"},
              .height = static_cast<double>(kRunInput_px) / kRunSignal_px};
  input.series.push_back({"",
                          time_s,
                          part(run.closed_loop ? run.reference.values : run.torque_N_m),
                          {.colour = kMeasuredColour, .line_width_px = 1.0}});
  stack.panels.push_back(std::move(input));
  return stack;
}

}  // namespace

Figure run_overlay_figure(const compare::MeasuredTimeRun& run) {
  const std::size_t samples = run.time_s.size();
  Figure figure;
  figure.title = "Measured and simulated: " + run.run;
  figure.width_px = kWholeRun_px;
  figure.height_px = kRunFurniture_px + kRunInput_px +
                     static_cast<int>(run.signals.size()) * (kRunSignal_px + kRunResidual_px);
  figure.stacks.push_back(samples_of(run, 0, samples));
  if (samples <= kWholeSamples) return figure;
  const std::size_t from = worst_samples(run);
  figure.title += fmt::format("; on the right {:.4g} to {:.4g} s, where residuals are largest",
                              run.time_s[from], run.time_s[from + kWholeSamples - 1]);
  figure.width_px += kRunLens_px;
  figure.stacks.push_back(samples_of(run, from, kWholeSamples));
  for (Panel& panel : figure.stacks.back().panels) {
    if (!panel.note.empty()) panel.note = " ";  // they are of the run; as much room as on the left
  }
  return figure;
}

}  // namespace flexarm::report
