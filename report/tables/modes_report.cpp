#include "report/tables/modes_report.hpp"

#include "report/figures/mode_shape_figure.hpp"
#include "report/json/arm_json.hpp"
#include "report/tables/zero_kind.hpp"
#include "report/words.hpp"

#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <numbers>

namespace flexarm::report {

namespace {

constexpr int kModeDigits = 12;

double frequency_Hz(double omega_rad_per_s) {
  return omega_rad_per_s / (2.0 * std::numbers::pi);
}

}  // namespace

Table poles_table(const arm::Arm& arm, const response::ModalSummary& summary) {
  Table table{"Flexible modes (undamped; damping ratio by projection; modal mass I_T)",
              {{"mode"},
               {"frequency", "Hz", kModeDigits},
               {"omega", "rad/s", kModeDigits},
               {"lambda", "", kModeDigits},
               {"hub slope", "", 8},
               {"damping ratio", "", 4}}};
  for (std::size_t i = 0; i < summary.modes.size(); ++i) {
    const auto& mode = summary.modes[i];
    table.add_row({std::int64_t(i) + 1, frequency_Hz(mode.omega_rad_per_s), mode.omega_rad_per_s,
                   response::lambda_of(arm, mode.omega_rad_per_s), mode.hub_slope,
                   mode.damping_ratio});
  }
  for (std::size_t k = 0; k < summary.sensors.size(); ++k) {
    const auto kind = summary.sensors[k].kind;
    // The hub's own value is the slope, and the tip's value is the same for both of its sensors.
    if (arm::is_collocated(summary.sensors[k])) continue;
    const bool tip =
        kind == arm::SensorKind::tip_acceleration || kind == arm::SensorKind::tip_displacement;
    table.columns.push_back({tip ? "phi(l)" : arm::to_string(summary.sensors[k]),
                             kind == arm::SensorKind::strain ? "1" : "m", 8});
    for (std::size_t i = 0; i < summary.modes.size(); ++i) {
      table.rows[i].emplace_back(summary.modes[i].sensor_values[k]);
    }
  }
  return table;
}

Table damped_poles_table(const response::ModalSummary& summary) {
  Table table{"Damped poles, two per mode; mode 0 is the rigid-body mode",
              {{"mode"},
               {"Re s", "rad/s", kModeDigits},
               {"Im s", "rad/s", kModeDigits},
               {"abs(s)/2 pi", "Hz", kModeDigits},
               {"damping ratio", "", 6}}};
  const auto add = [&table](std::int64_t mode, std::complex<double> s) {
    const double size = std::abs(s);
    Cell damping_ratio;
    if (size > 0.0) damping_ratio = -s.real() / size;
    table.add_row({mode, s.real(), s.imag(), frequency_Hz(size), damping_ratio});
  };
  const auto& poles = summary.damped_poles;
  add(0, poles.lowest.first_rad_per_s);
  add(0, poles.lowest.second_rad_per_s);
  for (std::size_t i = 0; i < poles.flexible.size(); ++i) {
    add(std::int64_t(i) + 1, poles.flexible[i].first_rad_per_s);
    add(std::int64_t(i) + 1, poles.flexible[i].second_rad_per_s);
  }
  return table;
}

std::string lowest_mode_line(const response::ModalSummary& summary) {
  const double omega_squared = summary.poles.lowest_omega_squared_rad2_per_s2;
  if (omega_squared == 0.0) return "";
  const double size = std::sqrt(std::abs(omega_squared));
  if (omega_squared > 0.0) {
    return fmt::format("The hub is restrained: lowest undamped mode at {:.12g} Hz\n",
                       frequency_Hz(size));
  }
  return fmt::format(
      "The arm is statically unstable (inverted): undamped poles at s = +-{:.12g} rad/s\n", size);
}

Table zeros_table(const response::ModalSummary& summary) {
  Table table{
      "Undamped zeros of torque to each sensor (one per pair or quadruple); non-minimum phase: "
      "right half plane",
      {{"sensor"},
       {"no."},
       {"Re s", "rad/s", kModeDigits},
       {"Im s", "rad/s", kModeDigits},
       {"frequency", "Hz", kModeDigits},
       {"non-minimum phase"}}};
  for (const auto& [sensor, zeros] : summary.zeros) {
    for (std::size_t i = 0; i < zeros.s_rad_per_s.size(); ++i) {
      const auto s = zeros.s_rad_per_s[i];
      table.add_row({arm::to_string(sensor), std::int64_t(i) + 1, s.real(), s.imag(),
                     s.imag() > 0.0 ? Cell(frequency_Hz(std::abs(s))) : Cell(),
                     std::string(is_non_minimum_phase(s) ? "yes" : "no")});
    }
  }
  return table;
}

Table shapes_over_x_table(const response::ModalSummary& summary) {
  Table table{"Mode shapes", {{"x", "m"}}};
  for (std::size_t i = 0; i < summary.modes.size(); ++i) {
    table.columns.push_back({fmt::format("mode {}", i + 1), "m"});
  }
  for (std::size_t j = 0; j < summary.stations_m.size(); ++j) {
    std::vector<Cell> row = {summary.stations_m[j]};
    for (const auto& mode : summary.modes) row.emplace_back(mode.displacement_m[j]);
    table.add_row(std::move(row));
  }
  return table;
}

Figure shapes_figure(const std::string& formulation, const response::ModalSummary& summary) {
  constexpr std::size_t kMostPanels = 8;
  ModeShapePlot plot;
  plot.title = "Mode shapes, modal mass I_T";
  plot.station_m = summary.stations_m;
  for (std::size_t i = 0; i < summary.modes.size() && i < kMostPanels; ++i) {
    plot.modes.push_back(
        {fmt::format("mode {}, {:.5g} Hz", i + 1, frequency_Hz(summary.modes[i].omega_rad_per_s)),
         {{in_words(formulation), summary.modes[i].displacement_m}}});
  }
  return mode_shape_figure(plot);
}

nlohmann::ordered_json modes_json(const arm::Arm& arm, const response::ModalSummary& summary) {
  using Json = nlohmann::ordered_json;
  Json modes = Json::array();
  for (std::size_t i = 0; i < summary.modes.size(); ++i) {
    const auto& mode = summary.modes[i];
    Json entry = {{"order", i + 1},
                  {"frequency_Hz", frequency_Hz(mode.omega_rad_per_s)},
                  {"omega_rad_per_s", mode.omega_rad_per_s},
                  {"lambda", response::lambda_of(arm, mode.omega_rad_per_s)},
                  {"hub_slope", mode.hub_slope},
                  {"damping_ratio", mode.damping_ratio},
                  {"sensor_values", Json::object()}};
    for (std::size_t k = 0; k < summary.sensors.size(); ++k) {
      entry["sensor_values"][arm::to_string(summary.sensors[k])] = mode.sensor_values[k];
    }
    entry["displacement_m"] = mode.displacement_m;
    modes.push_back(std::move(entry));
  }
  Json zeros = Json::array();
  for (const auto& [sensor, set] : summary.zeros) {
    Json entry = {{"sensor", arm::to_string(sensor)}, {"s_rad_per_s", Json::array()}};
    entry["non_minimum_phase"] = Json::array();
    for (const auto s : set.s_rad_per_s) {
      entry["s_rad_per_s"].push_back(complex_json(s));
      entry["non_minimum_phase"].push_back(is_non_minimum_phase(s));
    }
    entry["rejected"] = Json::array();
    for (const auto& zero : set.rejected) {
      entry["rejected"].push_back({{"s_rad_per_s", complex_json(zero.s_rad_per_s)},
                                   {"relative_change", zero.relative_change},
                                   {"reason", zero.reason}});
    }
    entry["infinite"] = set.infinite;
    zeros.push_back(std::move(entry));
  }
  const auto pair = [](const arm::PolePair& poles) {
    return Json::array({complex_json(poles.first_rad_per_s), complex_json(poles.second_rad_per_s)});
  };
  Json flexible = Json::array();
  for (const auto& poles : summary.damped_poles.flexible) {
    flexible.push_back({{"s_rad_per_s", pair(poles)}});
  }
  return {
      {"lowest_omega_squared_rad2_per_s2", summary.poles.lowest_omega_squared_rad2_per_s2},
      {"damped_poles",
       {{"lowest", {{"s_rad_per_s", pair(summary.damped_poles.lowest)}}}, {"flexible", flexible}}},
      {"stations_m", summary.stations_m},
      {"modes", modes},
      {"zeros", zeros}};
}

}  // namespace flexarm::report
