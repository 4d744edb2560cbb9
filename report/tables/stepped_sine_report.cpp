#include "report/tables/stepped_sine_report.hpp"

#include "report/figures/bode_figure.hpp"
#include "report/tables/response_tables.hpp"
#include "report/words.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace flexarm::report {
namespace {

using Complex = std::complex<double>;

/// Frequencies further apart than this times the smaller of the steps beside them are two bands.
constexpr double kBandGap = 1.5;

/// Whether a band ends before the k-th frequency.
bool begins_band(const std::vector<double>& frequency_Hz, std::size_t k) {
  const std::size_t count = frequency_Hz.size();
  if (k == 0 || count < 3) return false;
  const double step = frequency_Hz[k] - frequency_Hz[k - 1];
  double beside = std::numeric_limits<double>::infinity();
  if (k >= 2) beside = frequency_Hz[k - 1] - frequency_Hz[k - 2];
  if (k + 1 < count) beside = std::min(beside, frequency_Hz[k + 1] - frequency_Hz[k]);
  return step > kBandGap * beside;
}

BodePlot bode_plot(const SteppedSineRun& run, std::size_t sensor) {
  const auto& frequency_Hz = run.measured.frequency_Hz;
  BodePlot plot;
  plot.unit = unit_text(response_unit(run.sensors[sensor]));
  plot.curves = {{"", {}}};
  auto& curve = plot.curves.front().response;
  for (std::size_t k = 0; k < frequency_Hz.size(); ++k) {
    if (begins_band(frequency_Hz, k)) {
      plot.frequency_Hz.push_back(0.5 * (frequency_Hz[k - 1] + frequency_Hz[k]));
      curve.emplace_back(kNotDrawn, kNotDrawn);
    }
    const Complex value = run.measured.values[sensor][k];
    plot.frequency_Hz.push_back(frequency_Hz[k]);
    curve.push_back(value == 0.0 ? Complex(kNotDrawn, kNotDrawn) : value);
  }
  return plot;
}

nlohmann::ordered_json channel_json(const SteppedSineRun& run, std::size_t sensor) {
  std::vector<double> re;
  std::vector<double> im;
  for (const Complex& value : run.measured.values[sensor]) {
    re.push_back(value.real());
    im.push_back(value.imag());
  }
  return {{"sensor", arm::to_string(run.sensors[sensor])},
          {"unit", response_unit(run.sensors[sensor])},
          {"noise_deviation", run.measured.noise_deviation[sensor]},
          {"re", re},
          {"im", im},
          {"coherence", run.measured.coherence[sensor]}};  // NaN: null
}

}  // namespace

measured::FrequencyRecord frequency_record(const SteppedSineRun& run) {
  measured::FrequencyRecord record;
  for (std::size_t j = 0; j < run.sensors.size(); ++j) {
    record.channels.push_back({run.sensors[j], run.measured.frequency_Hz, run.measured.values[j],
                               run.measured.coherence[j]});
  }
  return record;
}

Table stepped_sine_table(const std::vector<SteppedSineRun>& runs) {
  Table table{"Stepped sine (change: largest difference between the first and last measured cycle)",
              {{"run"},
               {"frequencies"},
               {"samples/period"},
               {"measured", "s", 4},
               {"change", "", 2},
               {"payload", "kg", 4},
               {"excitation"}}};
  for (const auto& run : runs) {
    const auto& summary = run.measured.summary;
    table.add_row({run.id, static_cast<std::int64_t>(run.measured.frequency_Hz.size()),
                   std::int64_t{summary.least_samples_per_period}, summary.measured_s,
                   summary.largest_change, run.payload.mass_kg,
                   response::describe(response::kSteppedSine, run.keys)});
  }
  return table;
}

Table stepped_response_table(const std::vector<SteppedSineRun>& runs) {
  Table table{"Measured frequency responses: largest and smallest magnitude",
              {{"run"},
               {"sensor"},
               {"unit"},
               {"largest"},
               {"at", "Hz"},
               {"smallest"},
               {"at", "Hz"},
               {"noise", "", 3}}};
  for (const auto& run : runs) {
    for (std::size_t j = 0; j < run.sensors.size(); ++j) {
      const auto& values = run.measured.values[j];
      const auto size = [](const Complex& value) { return std::abs(value); };
      const auto [least, most] = std::ranges::minmax_element(values, {}, size);
      const auto at = [&](auto place) {
        return run.measured.frequency_Hz[static_cast<std::size_t>(place - values.begin())];
      };
      table.add_row({run.id, arm::to_string(run.sensors[j]), response_unit(run.sensors[j]),
                     std::abs(*most), at(most), std::abs(*least), at(least),
                     run.measured.noise_deviation[j]});
    }
  }
  return table;
}

Table stepped_hub_motion_table(const std::vector<SteppedSineRun>& runs) {
  Table table{"Stick and slip of the hub in the measured cycles",
              {{"run"}, {"reversals"}, {"stops"}, {"stick time", "s"}}};
  for (const auto& run : runs) {
    const auto& summary = run.measured.summary;
    table.add_row({run.id, summary.reversals, summary.stops, summary.stick_time_s});
  }
  return table;
}

std::vector<NamedFigure> stepped_sine_plots(const std::string& arm_name,
                                            const SteppedSineRun& run) {
  std::vector<NamedFigure> plots;
  for (std::size_t j = 0; j < run.sensors.size(); ++j) {
    const auto& values = run.measured.values[j];
    if (std::ranges::all_of(values, [](const Complex& value) { return value == 0.0; })) continue;
    const std::string sensor = arm::to_string(run.sensors[j]);
    BodePlot plot = bode_plot(run, j);
    plot.title = fmt::format("{}{}: torque to {}, stepped sine",
                             arm_name.empty() ? "" : arm_name + ", ", run.id, in_words(sensor));
    Figure figure = bode_figure(plot);
    figure.height_px = 640;  // as `flexarm response` draws it
    plots.push_back({fmt::format("{}-{}", run.id, sensor), std::move(figure)});
  }
  return plots;
}

nlohmann::ordered_json stepped_runs_json(const std::vector<SteppedSineRun>& runs) {
  nlohmann::ordered_json entries = nlohmann::ordered_json::array();
  for (const auto& run : runs) {
    nlohmann::ordered_json keys = nlohmann::ordered_json::array();
    for (const auto& key : run.keys) {
      keys.push_back({{"name", key.name}, {"value", key.value}, {"unit", key.unit}});
    }
    nlohmann::ordered_json channels = nlohmann::ordered_json::array();
    for (std::size_t j = 0; j < run.sensors.size(); ++j) channels.push_back(channel_json(run, j));
    const auto& summary = run.measured.summary;
    entries.push_back({{"id", run.id},
                       {"keys", keys},
                       {"payload_mass_kg", run.payload.mass_kg},
                       {"payload_inertia_kg_m2", run.payload.inertia_kg_m2},
                       {"least_samples_per_period", summary.least_samples_per_period},
                       {"most_samples_per_period", summary.most_samples_per_period},
                       {"periods", summary.periods},
                       {"measured_s", summary.measured_s},
                       {"largest_change", summary.largest_change},
                       {"largest_change_Hz", summary.largest_change_Hz},
                       {"unsettled", summary.unsettled},
                       {"reversals", summary.reversals},
                       {"stops", summary.stops},
                       {"stick_time_s", summary.stick_time_s},
                       {"frequency_Hz", run.measured.frequency_Hz},
                       {"channels", channels}});
  }
  return entries;
}

}  // namespace flexarm::report
