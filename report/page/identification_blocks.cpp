#include "report/page/identification_blocks.hpp"

#include "report/figures/frequency_response_figure.hpp"
#include "report/figures/identification_plots.hpp"
#include "report/figures/refined_curve.hpp"
#include "report/figures/sensor_label.hpp"
#include "report/page/excited_lines.hpp"
#include "report/page/page_curves.hpp"
#include "report/page/page_words.hpp"
#include "report/page/root_map.hpp"
#include "report/tables/best_roots.hpp"
#include "report/tables/identification_tables.hpp"
#include "report/tables/zero_kind.hpp"
#include "report/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <string_view>
#include <utility>

namespace flexarm::report::page {

namespace {

using measured::RunIdentification;

constexpr const char* kArmFile = "arm file";

const compare::IdentifiedCondition* condition_of(const IdentifiedRuns& runs, std::size_t run) {
  const auto at = std::ranges::find_if(runs.conditions, [run](const auto& condition) {
    return std::ranges::find(condition.runs, run) != condition.runs.end();
  });
  return at == runs.conditions.end() ? nullptr : &*at;
}

/// As given; of a time record, where the torque is the input, the lines that it excites.
MeasuredResponse response_of(const IdentifiedRuns& runs, const RunIdentification& run,
                             const measured::FrequencyChannel& channel) {
  if (!run.estimate) return measured_response(channel, {}, run.response.input);
  const auto& channels = run.estimate->channels;
  const auto at = std::ranges::find(channels, channel.sensor, &measured::ChannelEstimate::sensor);
  auto response = measured_response(*run.estimate, static_cast<std::size_t>(at - channels.begin()));
  const auto own = std::ranges::find(runs.recorded, run.run.id,
                                     [](const auto& recorded) { return recorded.run.id; });
  if (run.hub_held() || own == runs.recorded.end()) return response;
  const auto& record = std::get<measured::TimeRecord>(own->data);
  return picked(response, excited_lines(record, response.frequency_Hz));
}

/// The arm file's response within the frequencies that were measured.
std::optional<BodeCurve> arm_response(const compare::AnalyticalModes& analytical,
                                      const arm::Sensor& sensor, double from_Hz, double to_Hz) {
  const auto& model = analytical.response;
  const auto at = std::ranges::find(model.sensors, sensor);
  if (at == model.sensors.end()) return std::nullopt;
  const auto& values = model.values[static_cast<std::size_t>(at - model.sensors.begin())];
  BodeCurve curve{kArmFile, Role::before, {}, {}};
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (model.frequency_Hz[k] < from_Hz || model.frequency_Hz[k] > to_Hz) continue;
    curve.frequency_Hz.push_back(model.frequency_Hz[k]);
    curve.response.push_back(values[k]);
  }
  return curve;
}

CurvesView response_view(const IdentifiedRuns& runs, std::size_t r,
                         const measured::FrequencyChannel& channel) {
  const RunIdentification& run = runs.identification.runs[r];
  const MeasuredResponse measured = response_of(runs, run, channel);
  const auto positive = std::ranges::upper_bound(measured.frequency_Hz, 0.0);
  CurvesView view{{run.run.id, sensor_label(channel.sensor)}, {}, {}};
  if (positive == measured.frequency_Hz.end()) return view;
  const double from_Hz = *positive;
  const double to_Hz = measured.frequency_Hz.back();
  std::vector<BodeCurve> curves = {{"measured", Role::measured, measured.frequency_Hz,
                                    measured.response, measured.relative_std, measured.coherence}};
  if (run.hub_held()) {
    view.facts.push_back({"input", "motion of the hub"});
  } else {
    if (const auto* condition = condition_of(runs, r)) {
      if (auto model = arm_response(condition->analytical, channel.sensor, from_Hz, to_Hz)) {
        curves.push_back(*std::move(model));
      }
    }
    if (const auto fit = fitted_transfer(runs.identification, r, channel.sensor)) {
      const auto value = [&](double f_Hz) {
        return fit->value(std::complex<double>(0.0, 2.0 * std::numbers::pi * f_Hz));
      };
      auto fitted = refined_curve(value, from_Hz, to_Hz, Scale::logarithmic);
      curves.push_back(
          {"fit", Role::after, std::move(fitted.frequency_Hz), std::move(fitted.response)});
    }
  }
  if (run.estimate) {
    view.facts.push_back({"effective averages", number_of(run.estimate->averages, 3)});
    view.facts.push_back({"line spacing", number_of(run.estimate->spacing_Hz, 3) + " Hz"});
  }
  view.panels = bode_panels(response_unit(channel.sensor, measured.input), curves);
  return view;
}

/// "(m/s²)²/Hz".
std::string density_of(const std::string& unit) {
  if (unit.empty()) return "1/Hz";
  const bool is_single = unit.find_first_of(" /") == std::string::npos;
  return is_single ? unit + "²/Hz" : "(" + unit + ")²/Hz";
}

CurvesPanel spectrum_of(const std::string& label, const std::string& unit, Role role,
                        const std::vector<double>& frequency_Hz, const std::vector<double>& density,
                        const std::vector<double>& relative_std) {
  std::vector<std::size_t> lines;
  for (std::size_t k = 0; k < density.size(); ++k) {
    if (frequency_Hz[k] > 0.0) lines.push_back(k);
  }
  std::vector<float> x;
  std::vector<float> y;
  std::vector<float> y_std;
  for (const std::size_t k : thinned_lines(frequency_Hz, density, std::move(lines))) {
    x.push_back(static_cast<float>(frequency_Hz[k]));
    y.push_back(static_cast<float>(density[k] > 0.0 ? density[k] : kGapNumber));
    if (!relative_std.empty()) y_std.push_back(static_cast<float>(density[k] * relative_std[k]));
  }
  Samples samples{std::move(x), std::move(y)};
  if (!relative_std.empty()) samples.y_std = std::move(y_std);
  return {{label, density_of(unit), AxisScale::logarithmic},
          1.0,
          {{label, role, Draw::line, std::move(samples)}}};
}

/// What a root of a reading is called.
std::string root_name(const compare::IdentifiedRoot& root) {
  const bool is_zero = root.measured.feature == measured::Feature::zero;
  return std::string(is_zero ? "zero" : "pole") +
         (root.order ? fmt::format(" {}", *root.order) : "");
}

void add_identified(MapBlock& map, const IdentifiedRuns& runs,
                    const compare::IdentifiedCondition& condition, const arm::Sensor& sensor,
                    bool with_poles) {
  const auto roots = read_roots(runs.identification, condition);
  const auto best = best_roots(roots);
  for (const ReadRoot& one : roots) {
    const auto& entry = one.root->measured;
    const bool is_zero = entry.feature == measured::Feature::zero;
    if (one.root->alias_of_Hz || !is_by_best(one, best)) continue;
    if (is_zero ? entry.sensor != sensor : !with_poles) continue;
    add_root(map, {"measured", Role::measured},
             {is_zero ? Mark::zero : Mark::pole,
              fmt::format("{} of {}", root_name(*one.root), one.runs), *entry.frequency_Hz,
              entry.frequency_std_Hz, entry.damping_ratio, entry.damping_ratio_std});
  }
  // Real zeros, those of a tip for one, are in the fits alone.
  for (const std::size_t f : condition.fits) {
    const auto& fit = runs.identification.fits[f];
    if (!fit.refusal.empty() || fit.hub_held) continue;
    const auto own = std::ranges::find(fit.fit.sensors, sensor, &measured::FittedSensor::sensor);
    if (own == fit.fit.sensors.end()) continue;
    for (const auto& zero : own->zeros) {
      const std::complex<double> s = zero.s_rad_per_s;
      if (s.imag() != 0.0 || !zero.in_band || !zero.is_told) continue;
      map.points.push_back({.mark = Mark::zero,
                            .non_minimum_phase = is_non_minimum_phase(zero),
                            .series = "measured",
                            .role = Role::measured,
                            .real = s.real(),
                            .imaginary = 0.0,
                            .real_std = 2.0 * std::numbers::pi * zero.frequency_std_Hz,
                            .details = {{"s", number_of(s.real(), 5) + " 1/s"}}});
    }
  }
}

const std::array<std::pair<const char*, Role>, 4> kStabilities = {
    {{"new pole", Role::noise},
     {"stable frequency", Role::third},
     {"stable frequency and damping", Role::first},
     {"stable pole", Role::after}}};

std::size_t stability_class(const measured::ChartPole& pole) {
  if (pole.stable()) return 3;
  if (!pole.frequency_stable) return 0;
  return pole.damping_stable ? 2 : 1;
}

ScatterPanel circle_of(const measured::NyquistCircle& resonance) {
  ScatterPanel panel{{"real part of the velocity response", ""},
                     {"imaginary part of the velocity response", ""},
                     true,
                     {}};
  constexpr int kSteps = 120;
  std::vector<double> circle_x;
  std::vector<double> circle_y;
  for (int k = 0; k <= kSteps; ++k) {
    const auto at = resonance.circle.centre +
                    std::polar(resonance.circle.radius, 2.0 * std::numbers::pi * k / kSteps);
    circle_x.push_back(at.real());
    circle_y.push_back(at.imag());
  }
  std::vector<double> x;
  std::vector<double> y;
  for (const auto& value : resonance.velocity) {
    x.push_back(value.real());
    y.push_back(value.imag());
  }
  panel.series.push_back({"measured", Role::measured, Draw::points, std::move(x), std::move(y)});
  panel.series.push_back(
      {"fitted circle", Role::after, Draw::line, std::move(circle_x), std::move(circle_y)});
  return panel;
}

}  // namespace

CurvesBlock identified_responses(const IdentifiedRuns& runs) {
  CurvesBlock block{{"responses", "Measured frequency responses",
                     "Bands show one standard deviation of the measured response."},
                    frequency_axis(),
                    {"run", "sensor"},
                    {}};
  for (std::size_t r = 0; r < runs.identification.runs.size(); ++r) {
    for (const auto& channel : runs.identification.runs[r].response.channels) {
      CurvesView view = response_view(runs, r, channel);
      if (!view.panels.empty()) block.views.push_back(std::move(view));
    }
  }
  return block;
}

CurvesBlock autopower_spectra(const IdentifiedRuns& runs) {
  CurvesBlock block{{"autopower", "Autopower spectra", "Power spectral densities, one-sided."},
                    frequency_axis(),
                    {"run"},
                    {}};
  for (const RunIdentification& run : runs.identification.runs) {
    if (!run.estimate) continue;
    const auto& estimate = *run.estimate;
    const auto input = estimate.settings.estimator.input;
    const auto hub_sensor = estimate.settings.estimator.hub_sensor();
    const std::string input_unit = hub_sensor ? axis_unit(*hub_sensor) : "N m";
    CurvesView view{{run.run.id}, {}, {}};
    view.panels.push_back(spectrum_of(text_in_words(measured::to_string(input)), input_unit,
                                      Role::measured, estimate.frequency_Hz,
                                      estimate.input_autopower, {}));
    for (const auto& channel : estimate.channels) {
      view.panels.push_back(spectrum_of(sensor_label(channel.sensor), axis_unit(channel.sensor),
                                        Role::measured, estimate.frequency_Hz, channel.autopower,
                                        channel.autopower_relative_std));
    }
    block.views.push_back(std::move(view));
  }
  return block;
}

std::vector<MapBlock> identified_maps(const IdentifiedRuns& runs) {
  std::vector<MapBlock> maps;
  for (const auto& condition : runs.conditions) {
    double to_Hz = 0.0;
    for (const auto& roots : condition.roots) {
      for (const auto& root : roots)
        to_Hz = std::max(to_Hz, root.measured.frequency_Hz.value_or(0));
    }
    constexpr double kBeyondMeasured = 1.2;
    const double shown_Hz = kBeyondMeasured * to_Hz;
    std::vector<compare::AnalyticalPole> poles;
    for (const auto& pole : condition.analytical.poles) {
      if (pole.frequency_Hz <= shown_Hz) poles.push_back(pole);
    }
    std::vector<arm::Sensor> all;
    for (const auto& zeros : condition.analytical.zeros) all.push_back(zeros.sensor);
    for (const auto& sensors : sensors_by_zeros(all)) {
      std::string title = map_title(sensors);
      if (runs.conditions.size() > 1) {
        title += fmt::format(", payload {} kg", number_of(condition.payload.mass_kg, 5));
      }
      MapBlock map = root_map("map-" + arm::to_string(sensors.front()), title,
                              "Bars at measured poles and zeros show one standard error.");
      for (const arm::Sensor& sensor : sensors) {
        add_identified(map, runs, condition, sensor, &sensor == &sensors.front());
      }
      const auto zeros = std::ranges::find(condition.analytical.zeros, sensors.front(),
                                           &compare::AnalyticalZeros::sensor);
      add_poles(map, {kArmFile, Role::before}, poles);
      add_zeros(map, {kArmFile, Role::before},
                zeros_up_to(zeros->damped_rad_per_s, 2.0 * std::numbers::pi * shown_Hz));
      if (!map.points.empty()) maps.push_back(std::move(map));
    }
  }
  return maps;
}

ScatterBlock stabilisation_charts(const IdentifiedRuns& runs) {
  ScatterBlock block{{"stabilisation", "Stabilisation chart",
                      "Poles of fits of ascending order. Poles of the arm stay where they are; "
                      "those of noise wander."},
                     {"fit"},
                     {}};
  for (const auto& fit : runs.identification.fits) {
    const auto& chart = fit.fit.chart;
    if (!fit.refusal.empty() || chart.poles.empty()) continue;
    ScatterPanel panel{
        {"frequency", "Hz", AxisScale::linear, std::array{chart.from_Hz, chart.to_Hz}},
        {"order of the denominator", ""},
        false,
        {}};
    for (std::size_t kind = 0; kind < kStabilities.size(); ++kind) {
      std::vector<double> x;
      std::vector<double> y;
      for (const auto& pole : chart.poles) {
        if (stability_class(pole) != kind) continue;
        x.push_back(pole.frequency_Hz);
        y.push_back(pole.order);
      }
      if (x.empty()) continue;
      panel.series.push_back({kStabilities[kind].first, kStabilities[kind].second, Draw::points,
                              std::move(x), std::move(y)});
    }
    block.views.push_back({{joined(ids_of(fit, runs.identification))}, {}, {std::move(panel)}});
  }
  return block;
}

ScatterBlock nyquist_circles_block(const IdentifiedRuns& runs) {
  ScatterBlock block{{"circles", "Circles of the resonances",
                      "Velocity response per torque around a resonance, in SI units. A mode with "
                      "viscous damping makes a circle."},
                     {"run", "sensor", "resonance"},
                     {}};
  for (const RunIdentification& run : runs.identification.runs) {
    for (const auto& [sensor, set] : run.circles) {
      for (const auto& resonance : set.circles) {
        const double f_Hz = resonance.natural_frequency_Hz;
        block.views.push_back(
            {{run.run.id, sensor_label(sensor), number_of(f_Hz, 6) + " Hz"},
             {{"natural frequency", fmt::format("{} ± {} Hz", number_of(f_Hz, 6),
                                                number_of(resonance.natural_frequency_std_Hz, 2))},
              {"damping ratio", fmt::format("{} ± {}", number_of(resonance.damping_ratio, 4),
                                            number_of(resonance.damping_ratio_std, 2))}},
             {circle_of(resonance)}});
      }
    }
  }
  return block;
}

CurvesBlock recorded_signals(const IdentifiedRuns& runs) {
  CurvesBlock block{{"recorded", "Recorded signals", ""}, {"time", "s"}, {"run", "signal"}, {}};
  for (const auto& [run, data] : runs.recorded) {
    const auto* record = std::get_if<measured::TimeRecord>(&data);
    if (record == nullptr) continue;
    const auto add = [&](const std::string& label, const std::string& unit, Role role,
                         const std::vector<double>& values) {
      CurvesPanel panel{{label, unit}, 1.0, {}};
      panel.series.push_back({label, role, Draw::line, record_of(record->time_s, values)});
      block.views.push_back({{run.id, label}, {}, {std::move(panel)}});
    };
    add("torque", "N m", Role::measured, record->torque_N_m);
    if (!record->reference.values.empty()) {
      add("reference", unit_text(record->reference.unit), Role::measured, record->reference.values);
    }
    for (const auto& channel : record->channels) {
      add(sensor_label(channel.sensor), axis_unit(channel.sensor), Role::measured, channel.values);
    }
  }
  return block;
}

}  // namespace flexarm::report::page
