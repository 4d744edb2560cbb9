#include "report/page/measured_blocks.hpp"

#include "report/figures/frequency_response_figure.hpp"
#include "report/figures/sensor_label.hpp"
#include "report/largest_stretch.hpp"
#include "report/page/overlay_blocks.hpp"
#include "report/page/page_curves.hpp"
#include "report/page/page_table.hpp"
#include "report/page/page_words.hpp"
#include "report/tables/measured_tables.hpp"
#include "report/words.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <complex>
#include <optional>
#include <utility>

namespace flexarm::report::page {

namespace {

/// Of a model from the measured response, relative; gaps where either is unknown.
Series difference(const compare::MeasuredResponse& compared, std::size_t model) {
  std::vector<double> values;
  for (std::size_t i = 0; i < compared.measured.frequency_Hz.size(); ++i) {
    const std::complex<double> measured = compared.measured.response[i];
    values.push_back(std::abs(compared.values[model][i] - measured) / std::abs(measured));
  }
  return curve(text_in_words(compared.models[model]), numbered_role(model),
               compared.measured.frequency_Hz, for_log_axis(std::move(values)), Draw::points);
}

std::vector<CurvesPanel> response_panels(const compare::MeasuredResponse& compared) {
  const MeasuredResponse measured = measured_response(compared.measured, {}, compared.input);
  std::vector<BodeCurve> curves = {{"measured", Role::measured, measured.frequency_Hz,
                                    measured.response, measured.relative_std, measured.coherence}};
  CurvesPanel apart{{"relative difference", "", AxisScale::logarithmic}, 0.9, {}};
  const bool is_dense = !compared.curves.empty();
  for (std::size_t k = 0; k < compared.models.size(); ++k) {
    curves.push_back({text_in_words(compared.models[k]), numbered_role(k),
                      is_dense ? compared.curve_frequency_Hz : measured.frequency_Hz,
                      is_dense ? compared.curves[k] : compared.values[k]});
    apart.series.push_back(difference(compared, k));
  }
  auto panels = bode_panels(response_unit(measured.sensor, measured.input), curves);
  if (!panels.empty()) panels.push_back(std::move(apart));
  return panels;
}

std::vector<double> readings_with_gaps(const compare::MeasuredSignal& signal) {
  std::vector<double> measured = signal.measured;
  for (const std::size_t k : signal.left_out) measured[k] = kGapNumber;
  return measured;
}

std::vector<double> run_residual(const compare::MeasuredSignal& signal) {
  std::vector<double> residual = readings_with_gaps(signal);
  for (std::size_t k = 0; k < residual.size(); ++k) residual[k] -= signal.simulated[k];
  return residual;
}

/// The signal, its residual, and what drives the simulation.
std::vector<CurvesPanel> run_panels(const compare::MeasuredTimeRun& run,
                                    const compare::MeasuredSignal& signal) {
  const auto series = [&](const std::string& label, Role role, const std::vector<double>& values) {
    return Series{label, role, Draw::line, record_of(run.time_s, values)};
  };
  const std::string unit = unit_text(signal.unit);
  CurvesPanel values{{text_in_words(signal.sensor), unit}, 1.6, {}};
  values.series = {series("measured", Role::measured, readings_with_gaps(signal)),
                   series("simulated", Role::before, signal.simulated)};
  CurvesPanel below{{"residual", unit}, 1.0, {}};
  below.series = {series("residual", Role::residual_before, run_residual(signal))};
  CurvesPanel input = {{"torque", "N m"}, 0.8, {}};
  input.series = {series("torque", Role::measured, run.torque_N_m)};
  if (run.closed_loop) {
    input = {{"reference", unit_text(run.reference.unit)}, 0.8, {}};
    input.series = {series("reference", Role::measured, run.reference.values)};
  }
  return {std::move(values), std::move(below), std::move(input)};
}

/// The part of a long run in which the residuals have the largest squares.
std::optional<std::array<double, 2>> worst_part_s(const compare::MeasuredTimeRun& run,
                                                  const compare::MeasuredSignal& signal) {
  if (run.time_s.size() <= kWorstSamples) return std::nullopt;
  std::vector<double> squares = run_residual(signal);
  for (double& value : squares) value = std::isfinite(value) ? value * value : 0.0;
  const std::size_t from = begin_of_largest_stretch(squares, kWorstSamples);
  return std::array{run.time_s[from], run.time_s[from + kWorstSamples - 1]};
}

}  // namespace

CurvesBlock measured_responses(const std::vector<NamedArm>& arms) {
  CurvesBlock block{{"measured-responses", "Measured frequency responses and the models",
                     "The lowest panel has the difference of each model from the measured "
                     "response, relative to it."},
                    frequency_axis(),
                    choices_of(arms, {"run", "sensor"}),
                    {}};
  for (const NamedArm& arm : arms) {
    for (const auto& compared : arm.arm->measured.responses) {
      auto panels = response_panels(compared);
      if (panels.empty()) continue;
      block.views.push_back(view_of(arm,
                                    {compared.run.empty() ? "measured" : compared.run,
                                     sensor_label(compared.measured.sensor)},
                                    std::move(panels)));
    }
  }
  return block;
}

CurvesBlock measured_runs(const std::vector<NamedArm>& arms) {
  CurvesBlock block{
      {"measured-runs", "Measured and simulated runs",
       "Simulated with all effects of the arm. Fit, as of compare of MATLAB: "
       "100 (1 - |y - simulated|/|y - mean of y|) %. Of a long run the panels show the part where "
       "residuals are largest; the strip below them shows the whole run."},
      {"time", "s"},
      choices_of(arms, {"run", "channel"}),
      {}};
  for (const NamedArm& arm : arms) {
    for (const auto& run : arm.arm->measured.runs) {
      for (const auto& signal : run.signals) {
        const std::string name = text_in_words(signal.sensor);
        CurvesView view = view_of(arm, {run.run, name}, run_panels(run, signal));
        view.facts = {{"fit", number_of(signal.fit_percent(), 4) + " %"},
                      {"NRMSE", number_of(signal.nrmse_percent, 3) + " %"},
                      {"payload", number_of(run.payload.mass_kg, 5) + " kg"},
                      {"start", run.free_start ? "free, estimated" : "at rest"},
                      {"loop", run.closed_loop ? "closed" : "open"}};
        view.shown = worst_part_s(run, signal);
        block.views.push_back(std::move(view));
      }
    }
  }
  return block;
}

void add_measured_tables(Section& section, const NamedArm& arm) {
  const compare::MeasuredComparison& measured = arm.arm->measured;
  add_table(section, measured_runs_table(measured.runs), "measured-runs-table");
  add_table(section, measured_table(measured.rows, arm.arm->comparison.subjects), "measured");
  add_table(section, measured_damping_table(measured.rows), "measured-damping");
  add_table(section, measured_response_table(measured.responses), "measured-response-table");
  for (std::size_t i = 0; i < measured.shapes.size(); ++i) {
    add_table(section, mac_table(measured.shapes[i]), fmt::format("mac-{}", i + 1));
  }
  if (std::string summary = measured_summary(measured.rows); !summary.empty()) {
    section.text.push_back(text_in_words(summary));
  }
}

}  // namespace flexarm::report::page
