#include "report/page/diagnosed_maps.hpp"

#include "arm/input_error.hpp"
#include "arm/linear_arm.hpp"
#include "arm/rigid_hub.hpp"
#include "compare/identification.hpp"
#include "report/figures/overlay_figure.hpp"
#include "report/page/diagnosed_channels.hpp"
#include "report/page/page_words.hpp"
#include "report/page/root_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace flexarm::report::page {

namespace {

const MapSeries kMeasuredRoots{"measured", Role::measured};
const MapSeries kBeforeRoots{"arm file", Role::before};
const MapSeries kAfterRoots{"extended arm", Role::after};

constexpr const char* kSameRoots = "The extended arm has the same poles and zeros as the arm file.";

constexpr const char* kMeasuredErrors = "Bars at measured poles and zeros show one standard error.";

std::string caption_of_map(const diagnose::Diagnosis& diagnosis, bool is_same) {
  std::string caption = diagnosis.symptoms.roots.empty() ? "" : kMeasuredErrors;
  if (is_same && has_after(diagnosis))
    caption += (caption.empty() ? "" : " ") + std::string(kSameRoots);
  return caption;
}

/// Whether two arms differ in nothing that a map shows: effects that are not linear change neither.
bool have_same_roots(const compare::AnalyticalModes& one, const compare::AnalyticalModes& other) {
  constexpr double kSameRoot = 1e-9;
  const auto same_zeros = [](const compare::AnalyticalZeros& a, const compare::AnalyticalZeros& b) {
    return std::ranges::equal(a.s_rad_per_s, b.s_rad_per_s, [](const auto& s, const auto& other_s) {
      return std::abs(s - other_s) <= kSameRoot * std::abs(s);
    });
  };
  return std::ranges::equal(one.poles, other.poles,
                            [](const auto& a, const auto& b) {
                              return std::abs(a.frequency_Hz - b.frequency_Hz) <=
                                         kSameRoot * a.frequency_Hz &&
                                     std::abs(a.damping_ratio - b.damping_ratio) <= kSameRoot;
                            }) &&
         std::ranges::equal(one.zeros, other.zeros, same_zeros);
}

/// The runs of one payload.
struct Condition {
  arm::Payload payload;
  std::vector<arm::Sensor> sensors = {};
  double measured_Hz = 0.0;  ///< the highest measured pole or zero
};

std::vector<arm::Sensor> sensors_of(const measured::RunData& data) {
  std::vector<arm::Sensor> sensors;
  if (const auto* table = std::get_if<measured::ModalTable>(&data)) {
    for (const auto& entry : *table) {
      if (entry.sensor) sensors.push_back(*entry.sensor);
    }
  } else if (const auto* record = std::get_if<measured::TimeRecord>(&data)) {
    for (const auto& channel : record->channels) sensors.push_back(channel.sensor);
  } else {
    for (const auto& channel : std::get<measured::FrequencyRecord>(data).channels) {
      sensors.push_back(channel.sensor);
    }
  }
  return sensors;
}

std::vector<Condition> conditions_of_runs(const diagnose::Experiment& experiment,
                                          const diagnose::Diagnosis& diagnosis) {
  std::vector<Condition> conditions;
  for (const auto& [run, data] : experiment.runs) {
    const arm::Payload payload = diagnose::arm_in(experiment, run).payload;
    auto at = std::ranges::find(conditions, payload, &Condition::payload);
    if (at == conditions.end()) at = conditions.insert(conditions.end(), Condition{payload});
    for (const arm::Sensor& sensor : sensors_of(data)) {
      if (std::ranges::find(at->sensors, sensor) == at->sensors.end()) {
        at->sensors.push_back(sensor);
      }
    }
    for (const auto& shift : diagnosis.symptoms.roots) {
      if (shift.run != run.id || !shift.frequency_Hz) continue;
      at->measured_Hz = std::max(at->measured_Hz, shift.frequency_Hz->measured);
    }
  }
  return conditions;
}

/// Up to here there are kMostMapPoles poles and a few more: beta l of pole n is near (n + 1/4) pi.
double shown_to_Hz(const arm::Arm& arm, double measured_Hz) {
  const double beta_l = std::numbers::pi * (static_cast<double>(kMostMapPoles) + 0.25);
  const double model_Hz =
      beta_l * beta_l * arm::omega_scale_rad_per_s(arm) / (2.0 * std::numbers::pi);
  return measured_Hz > 0.0 ? measured_Hz : model_Hz;
}

/// The poles to show: kMostMapPoles of them, or up to the first one above what was measured.
std::vector<compare::AnalyticalPole> shown_poles(const compare::AnalyticalModes& modes,
                                                 double measured_Hz) {
  std::vector<compare::AnalyticalPole> shown;
  for (const auto& pole : modes.poles) {
    if (measured_Hz > 0.0 ? pole.frequency_Hz > compare::needed_Hz(measured_Hz)
                          : shown.size() == kMostMapPoles) {
      break;
    }
    shown.push_back(pole);
  }
  return shown;
}

std::vector<std::vector<std::complex<double>>> shown_zeros(const compare::AnalyticalModes& modes,
                                                           const arm::Sensor& sensor,
                                                           double to_Hz) {
  const auto zeros = std::ranges::find(modes.zeros, sensor, &compare::AnalyticalZeros::sensor);
  if (zeros == modes.zeros.end()) return {};
  return zeros_up_to(zeros->damped_rad_per_s, 2.0 * std::numbers::pi * to_Hz);
}

void add_measured(MapBlock& map, const std::vector<arm::Sensor>& sensors,
                  const Condition& condition, const diagnose::Experiment& experiment,
                  const diagnose::Diagnosis& diagnosis) {
  for (const auto& shift : diagnosis.symptoms.roots) {
    const auto run =
        std::ranges::find(experiment.runs, shift.run, [](const auto& any) { return any.run.id; });
    if (diagnose::arm_in(experiment, run->run).payload != condition.payload) continue;
    const bool is_other =
        shift.zero_of && std::ranges::find(sensors, *shift.zero_of) == sensors.end();
    if (!shift.frequency_Hz || is_other) continue;
    MeasuredRoot root{
        shift.zero_of ? Mark::zero : Mark::pole,
        fmt::format("{} {} of run {}", shift.zero_of ? "zero" : "pole", shift.order, shift.run),
        shift.frequency_Hz->measured, shift.frequency_Hz->std_error};
    if (shift.damping_ratio) {
      root.damping_ratio = shift.damping_ratio->measured;
      root.damping_ratio_std = shift.damping_ratio->std_error;
    }
    add_root(map, kMeasuredRoots, root);
  }
}

}  // namespace

std::vector<MapBlock> diagnosed_maps(const diagnose::Experiment& experiment,
                                     const diagnose::Diagnosis& diagnosis) {
  std::vector<MapBlock> maps;
  if (!arm::has_beam(experiment.arm)) return maps;
  const auto conditions = conditions_of_runs(experiment, diagnosis);
  for (const Condition& condition : conditions) {
    arm::Arm before = experiment.arm;
    arm::Arm after = diagnosis.extended_arm;
    before.payload = after.payload = condition.payload;
    const double to_Hz = shown_to_Hz(before, condition.measured_Hz);
    try {
      const double needed_Hz = compare::needed_Hz(to_Hz);
      const auto of_file = compare::analytical_modes(before, condition.sensors, needed_Hz);
      const auto of_extended = compare::analytical_modes(after, condition.sensors, needed_Hz);
      const auto poles = shown_poles(of_file, condition.measured_Hz);
      const auto poles_after = shown_poles(of_extended, condition.measured_Hz);
      if (poles.empty()) continue;
      const double zeros_to_Hz = poles.back().frequency_Hz;
      const bool is_same = have_same_roots(of_file, of_extended);
      for (const auto& sensors : sensors_by_zeros(condition.sensors)) {
        const arm::Sensor& sensor = sensors.front();
        std::string title = map_title(sensors);
        if (conditions.size() > 1) {
          title += fmt::format(", payload {:.4g} kg", condition.payload.mass_kg);
        }
        MapBlock map =
            root_map("map-" + arm::to_string(sensor), title, caption_of_map(diagnosis, is_same));
        add_measured(map, sensors, condition, experiment, diagnosis);
        add_poles(map, kBeforeRoots, poles);
        add_zeros(map, kBeforeRoots, shown_zeros(of_file, sensor, zeros_to_Hz));
        if (!is_same) {
          add_poles(map, kAfterRoots, poles_after);
          add_zeros(map, kAfterRoots, shown_zeros(of_extended, sensor, zeros_to_Hz));
        }
        maps.push_back(std::move(map));
      }
    } catch (const arm::InputError&) {
      continue;
    }
  }
  return maps;
}

}  // namespace flexarm::report::page
