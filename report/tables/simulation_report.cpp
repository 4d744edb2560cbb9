#include "report/tables/simulation_report.hpp"

#include "measured/files/controller_keys.hpp"
#include "report/figures/sensor_label.hpp"
#include "report/figures/time_figure.hpp"
#include "response/excitation/excitation.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace flexarm::report {
namespace {

struct Peak {
  double value = 0.0;
  std::size_t sample = 0;
};

/// The value of largest size.
Peak peak_of(const std::vector<double>& values) {
  Peak peak;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::abs(values[i]) > std::abs(peak.value)) peak = {values[i], i};
  }
  return peak;
}

/// The excitation with its numbers, and how many lines it has.
std::string excitation_text(const SimulatedRun& run) {
  std::string text =
      (run.controller ? "reference " : "") + response::describe(run.excitation, run.keys);
  if (!run.lines_Hz.empty()) text += fmt::format(", {} lines", run.lines_Hz.size());
  if (!run.detection_Hz.empty())
    text += fmt::format(", {} detection line{}", run.detection_Hz.size(),
                        run.detection_Hz.size() == 1 ? "" : "s");
  return text;
}

/// Null where the loop is open.
nlohmann::ordered_json loop_json(const SimulatedRun& run) {
  if (!run.controller) return nullptr;
  return {{"controller", measured::format_controller(*run.controller)},
          {"reference_unit", run.record.reference.unit},
          {"reference", run.record.reference.values}};
}

nlohmann::ordered_json energy_json(const response::EnergyBalance& energy) {
  return {{"work_in_J", energy.work_in_J},
          {"kinetic_J", energy.kinetic_J},
          {"potential_J", energy.potential_J},
          {"viscous_J", energy.viscous_J},
          {"material_air_J", energy.material_air_J},
          {"dry_friction_J", energy.dry_friction_J},
          {"drag_J", energy.drag_J},
          {"residual_J", energy.residual_J()},
          {"largest_residual_J", energy.largest_residual_J},
          {"relative_residual", relative_energy_residual(energy)}};
}

nlohmann::ordered_json stepping_json(const response::SimulationSummary& summary) {
  return {{"steps", summary.steps},
          {"inner_steps", summary.inner_steps},
          {"most_iterations", summary.most_iterations},
          {"halved_steps", summary.halved_steps},
          {"reversals", summary.reversals},
          {"stops", summary.stops},
          {"breakaways", summary.breakaways},
          {"stick_time_s", summary.stick_time_s},
          {"samples_per_period", summary.samples_per_period}};
}

nlohmann::ordered_json excitation_json(const SimulatedRun& run) {
  nlohmann::ordered_json keys = nlohmann::ordered_json::array();
  for (const auto& key : run.keys) {
    keys.push_back({{"name", key.name}, {"value", key.value}, {"unit", key.unit}});
  }
  return {{"name", run.excitation},
          {"keys", keys},
          {"peak_N_m", response::peak_N_m(run.record.torque_N_m)},
          {"rms_N_m", response::rms_N_m(run.record.torque_N_m)},
          {"crest_factor", response::crest_factor(run.record.torque_N_m)},
          {"lines_Hz", run.lines_Hz},
          {"detection_Hz", run.detection_Hz}};
}

nlohmann::ordered_json channel_json(const SimulatedRun& run, std::size_t i) {
  const auto& channel = run.record.channels[i];
  const Peak peak = peak_of(run.simulation.channels[i]);
  nlohmann::ordered_json json = {{"sensor", arm::to_string(channel.sensor)},
                                 {"unit", arm::unit(channel.sensor)},
                                 {"peak", peak.value},
                                 {"peak_time_s", run.record.time_s[peak.sample]},
                                 {"last", run.simulation.channels[i].back()},
                                 {"noise_deviation", run.noise_deviation[i]},
                                 {"step_error", nullptr},
                                 {"values", channel.values}};
  if (!run.step_error.empty()) json["step_error"] = run.step_error[i];
  return json;
}

}  // namespace

Table torque_table(const std::vector<SimulatedRun>& runs) {
  Table table{"Commanded torque",
              {{"run"},
               {"samples"},
               {"period", "s", 4},
               {"duration", "s", 4},
               {"peak", "N m", 4},
               {"rms", "N m", 4},
               {"crest", "", 3},
               {"payload", "kg", 4},
               {"excitation"}}};
  for (const auto& run : runs) {
    const auto& torque = run.record.torque_N_m;
    const double period_s = measured::sampling_period_s(run.record);
    table.add_row({run.id, static_cast<std::int64_t>(torque.size()), period_s,
                   period_s * static_cast<double>(torque.size()), response::peak_N_m(torque),
                   response::rms_N_m(torque), response::crest_factor(torque), run.payload.mass_kg,
                   excitation_text(run)});
  }
  return table;
}

Table reading_table(const std::vector<SimulatedRun>& runs) {
  Table table{"Sensors",
              {{"run"},
               {"sensor"},
               {"unit"},
               {"peak"},
               {"peak time", "s"},
               {"final value"},
               {"noise", "", 3}}};
  const bool has_step_error =
      std::ranges::any_of(runs, [](const auto& run) { return !run.step_error.empty(); });
  if (has_step_error) table.columns.push_back(error_column("step-size error"));
  for (const auto& run : runs) {
    for (std::size_t i = 0; i < run.record.channels.size(); ++i) {
      const auto& sensor = run.record.channels[i].sensor;
      const Peak peak = peak_of(run.simulation.channels[i]);
      std::vector<Cell> row = {run.id,
                               arm::to_string(sensor),
                               std::string(arm::unit(sensor)),
                               peak.value,
                               run.record.time_s[peak.sample],
                               run.simulation.channels[i].back(),
                               run.noise_deviation[i]};
      if (has_step_error) row.emplace_back(run.step_error[i]);
      table.add_row(std::move(row));
    }
  }
  return table;
}

double relative_energy_residual(const response::EnergyBalance& energy) {
  const double scale = std::max({std::abs(energy.work_in_J), std::abs(energy.kinetic_J),
                                 std::abs(energy.potential_J), energy.dissipated_J()});
  if (!std::isfinite(energy.residual_J())) return std::numeric_limits<double>::quiet_NaN();
  return scale > 0.0 ? energy.residual_J() / scale : 0.0;
}

Table energy_table(const std::vector<SimulatedRun>& runs) {
  Table table{
      "Energy balance: work in = kinetic + potential (at the end) + losses (viscous hub friction, "
      "beam and air,\ndry friction, drag) + residual; residual relative to the work",
      {{"run"},
       {"work in", "J", 4},
       {"kinetic", "J", 4},
       {"potential", "J", 4},
       {"viscous", "J", 4},
       {"material", "J", 4},
       {"friction", "J", 4},
       {"drag", "J", 4},
       error_column("residual")}};
  for (const auto& run : runs) {
    const auto& energy = run.simulation.energy;
    table.add_row({run.id, energy.work_in_J, energy.kinetic_J, energy.potential_J, energy.viscous_J,
                   energy.material_air_J, energy.dry_friction_J, energy.drag_J,
                   relative_energy_residual(energy)});
  }
  return table;
}

Table hub_motion_table(const std::vector<SimulatedRun>& runs) {
  Table table{"Stick and slip of the hub",
              {{"run"}, {"reversals"}, {"stops"}, {"breakaways"}, {"stick time", "s"}}};
  for (const auto& run : runs) {
    const auto& summary = run.simulation.summary;
    table.add_row(
        {run.id, summary.reversals, summary.stops, summary.breakaways, summary.stick_time_s});
  }
  return table;
}

Figure simulation_figure(const std::string& arm_name, const SimulatedRun& run) {
  TimePlot plot;
  plot.title = arm_name.empty() ? run.id : fmt::format("{}: {}", arm_name, run.id);
  plot.time_s = run.record.time_s;
  TimePanel torque{"torque", "N m", {}};
  if (run.simulation.hub_torque_N_m == run.record.torque_N_m) {
    torque.curves = {{"", run.record.torque_N_m}};
  } else {
    torque.curves = {{"commanded", run.record.torque_N_m},
                     {"at the hub", run.simulation.hub_torque_N_m}};
  }
  plot.panels.push_back(std::move(torque));
  for (const auto& channel : run.record.channels) {
    TimePanel panel{sensor_label(channel.sensor), axis_unit(channel.sensor), {}, true};
    panel.curves = {{"", channel.values}};
    if (run.controller && channel.sensor == run.controller->sensors.front()) {
      panel.curves = {{"simulated", channel.values}, {"reference", run.record.reference.values}};
    }
    plot.panels.push_back(std::move(panel));
  }
  return time_figure(plot);
}

nlohmann::ordered_json runs_json(const std::vector<SimulatedRun>& runs) {
  nlohmann::ordered_json entries = nlohmann::ordered_json::array();
  for (const auto& run : runs) {
    nlohmann::ordered_json channels = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < run.record.channels.size(); ++i) {
      channels.push_back(channel_json(run, i));
    }
    entries.push_back({{"id", run.id},
                       {"excitation", excitation_json(run)},
                       {"payload_mass_kg", run.payload.mass_kg},
                       {"payload_inertia_kg_m2", run.payload.inertia_kg_m2},
                       {"sampling_period_s", measured::sampling_period_s(run.record)},
                       {"energy", energy_json(run.simulation.energy)},
                       {"stepping", stepping_json(run.simulation.summary)},
                       {"time_s", run.record.time_s},
                       {"torque_N_m", run.record.torque_N_m},
                       {"loop", loop_json(run)},
                       {"hub_torque_N_m", run.simulation.hub_torque_N_m},
                       {"channels", channels}});
  }
  return entries;
}

}  // namespace flexarm::report
