#include "report/page/measured_blocks.hpp"

#include "report/figures/frequency_response_figure.hpp"
#include "report/figures/sensor_label.hpp"
#include "report/page/page_curves.hpp"
#include "report/page/page_table.hpp"
#include "report/page/page_words.hpp"
#include "report/tables/measured_tables.hpp"

#include <fmt/format.h>

#include <cmath>
#include <complex>
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
  const MeasuredResponse measured = measured_response(compared.measured);
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
  auto panels = bode_panels(response_unit(compared.measured.sensor), curves);
  if (!panels.empty()) panels.push_back(std::move(apart));
  return panels;
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
  CurvesBlock block{{"measured-runs", "Measured and simulated runs",
                     "Simulated with all effects of the arm. Fit: 100 (1 - |y - simulated|/|y - "
                     "mean of y|)."},
                    {"time", "s"},
                    choices_of(arms, {"run", "channel"}),
                    {}};
  for (const NamedArm& arm : arms) {
    for (const auto& run : arm.arm->measured.runs) {
      for (const auto& signal : run.signals) {
        std::vector<double> measured = signal.measured;
        for (const std::size_t k : signal.left_out) measured[k] = kGapNumber;
        std::vector<double> residual;
        for (std::size_t k = 0; k < measured.size(); ++k) {
          residual.push_back(measured[k] - signal.simulated[k]);
        }
        const std::string name = text_in_words(signal.sensor);
        CurvesPanel values{{name, signal.unit}, 1.6, {}};
        values.series.push_back(
            {"measured", Role::measured, Draw::line, record_of(run.time_s, measured)});
        values.series.push_back({fmt::format("simulated, fit {} %", number_of(signal.fit_percent(), 4)),
                                 Role::before, Draw::line, record_of(run.time_s, signal.simulated)});
        CurvesPanel below{{"residual", signal.unit}, 1.0, {}};
        below.series.push_back(
            {"residual", Role::residual_before, Draw::line, record_of(run.time_s, residual)});
        block.views.push_back(view_of(arm, {run.run, name}, {std::move(values), std::move(below)}));
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
