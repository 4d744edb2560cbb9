#include "diagnose/search/hypothesis.hpp"

#include "arm/effect_label.hpp"
#include "arm/effects.hpp"
#include "arm/linear_arm.hpp"
#include "arm/rigid_hub.hpp"
#include "effects/registry/stated_entry.hpp"
#include "effects/registry/vocabulary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <ranges>
#include <utility>
#include <variant>
#include <vector>

namespace flexarm::diagnose {

namespace {

/// A beam by whose sizes effects on a rigid hub are looked for: with three times the hub's inertia
/// in m l^3, and the frequency scale midway between the lowest and the highest frequency of the
/// runs, in ratio.
arm::LinearArm beam_beside(arm::LinearArm hub, const Experiment& experiment) {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = 0.0;
  for (const auto& [run, data] : experiment.runs) {
    if (const auto* record = std::get_if<measured::TimeRecord>(&data)) {
      lowest = std::min(lowest, 1.0 / (record->time_s.back() - record->time_s.front()));
      highest = std::max(highest, 1.0 / measured::sampling_period_s(*record));
    } else if (const auto* frequency = std::get_if<measured::FrequencyRecord>(&data)) {
      for (const auto& channel : frequency->channels) {
        highest = std::max(highest, 2.0 * std::numbers::pi * channel.frequency_Hz.back());
        lowest = std::min(lowest, highest / static_cast<double>(channel.frequency_Hz.size()));
      }
    }
  }
  const double scale_rad_per_s = highest > 0.0 ? std::sqrt(lowest * highest) : 1.0;
  hub.length_m = 1.0;
  hub.linear_density_kg_per_m = 3.0 * hub.hub_inertia_kg_m2;
  hub.flexural_rigidity_N_m2 = hub.linear_density_kg_per_m * scale_rad_per_s * scale_rad_per_s;
  return hub;
}

/// Of the values that are numbers; 0 without any.
double range_of(std::vector<double> values) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  if (values.empty()) return 0.0;
  const auto [least, most] = std::ranges::minmax(values);
  return most - least;
}

/// Returns the mean square of the velocity that a sensor of the hub shows: of its readings, or of
/// the slope of its angle over so many samples that the counts of an encoder show little. Readings
/// that are left out do not count; empty without others.
std::optional<double> mean_square_speed(const measured::Channel& channel, double period_s) {
  constexpr std::size_t kSlopeSamples = 10;
  const std::vector<double>& values = channel.values;
  const bool is_angle = channel.sensor.kind == arm::SensorKind::hub_angle;
  const std::size_t lag = is_angle ? kSlopeSamples : 0;
  std::vector<bool> counts(values.size(), true);
  for (const std::size_t k : channel.left_out) counts[k] = false;
  double sum = 0.0;
  double samples = 0.0;
  for (std::size_t k = lag; k < values.size(); ++k) {
    if (!counts[k] || !counts[k - lag]) continue;
    const double speed = is_angle
                             ? (values[k] - values[k - lag]) / (static_cast<double>(lag) * period_s)
                             : values[k];
    sum += speed * speed;
    samples += 1.0;
  }
  if (samples == 0.0) return std::nullopt;
  return sum / samples;
}

/// Returns mean_square_speed of a run by a sensor of the hub, its velocity before its angle.
std::optional<double> mean_square_speed(const measured::TimeRecord& record) {
  for (const auto kind : {arm::SensorKind::hub_velocity, arm::SensorKind::hub_angle}) {
    for (const measured::Channel& channel : record.channels) {
      if (channel.sensor.kind != kind) continue;
      return mean_square_speed(channel, measured::sampling_period_s(record));
    }
  }
  return std::nullopt;
}

/// Returns whether the arm file states dissipation of the beam.
bool states_dissipation(const arm::Arm& arm) {
  return arm.damping.kelvin_voigt_s > 0.0 || std::ranges::any_of(arm.effects, [](const auto& one) {
           const effects::Entry* entry = effects::find(one.first);
           return entry != nullptr && entry->family == effects::Family::beam_dissipation;
         });
}

void add_unknown(std::vector<arm::Sensor>& sensors, const arm::Sensor& sensor) {
  if (std::ranges::find(sensors, sensor) == sensors.end()) sensors.push_back(sensor);
}

/// Of a modal table, those whose zeros it has.
std::vector<arm::Sensor> sensors_in(const measured::RunData& data) {
  std::vector<arm::Sensor> sensors;
  if (const auto* record = std::get_if<measured::TimeRecord>(&data)) {
    for (const auto& channel : record->channels) add_unknown(sensors, channel.sensor);
  } else if (const auto* frequency = std::get_if<measured::FrequencyRecord>(&data)) {
    for (const auto& channel : frequency->channels) add_unknown(sensors, channel.sensor);
  } else {
    for (const auto& entry : std::get<measured::ModalTable>(data)) {
      if (entry.feature == measured::Feature::zero && entry.sensor) {
        add_unknown(sensors, *entry.sensor);
      }
    }
  }
  return sensors;
}

Scales scales_of_sensor(Scales scales, const Experiment& experiment, const arm::Sensor& sensor) {
  scales.sensor = sensor;
  double squares = 0.0;
  double samples = 0.0;
  for (const auto& run : experiment.runs) {
    const auto* record = std::get_if<measured::TimeRecord>(&run.data);
    if (record == nullptr) continue;
    for (const auto& channel : record->channels) {
      if (channel.sensor != sensor) continue;
      for (const double value : channel.values) {
        if (std::isnan(value)) continue;  // missing
        squares += value * value;
        samples += 1.0;
      }
    }
  }
  if (samples > 0.0) scales.reading_rms = std::sqrt(squares / samples);
  return scales;
}

template <class Test>
std::optional<std::size_t> first_of(const std::vector<SearchedParameter>& parameters, Test test) {
  const auto found = std::ranges::find_if(parameters, test);
  if (found == parameters.end()) return std::nullopt;
  return static_cast<std::size_t>(found - parameters.begin());
}

}  // namespace

std::string Hypothesis::label() const {
  return arm::effect_label(effect, sensor);
}

bool Hypothesis::shows_in(measured::RunKind kind) const {
  switch (kind) {
    case measured::RunKind::time:
      return true;
    case measured::RunKind::frf:
      return entry->shows != Shows::in_time;
    case measured::RunKind::modal:
      return entry->shows == Shows::in_all;
  }
  return false;
}

bool Hypothesis::contains(const std::string& other_effect) const {
  return std::ranges::find(entry->contains, other_effect) != entry->contains.end();
}

std::vector<double> Hypothesis::middle() const {
  return effects::values_at(parameters, std::vector<double>(parameters.size(), 0.5));
}

std::optional<std::size_t> Hypothesis::size_parameter() const {
  return first_of(parameters, [](const auto& one) { return one.neutral_coordinate().has_value(); });
}

bool Hypothesis::is_at_end_of_range(std::span<const double> values) const {
  constexpr double kEnd = 1e-3;
  const auto sized = size_parameter();
  if (!sized) return false;
  const double place = effects::coordinates_of(parameters, values)[*sized];
  const bool does_nothing = std::abs(place - *parameters[*sized].neutral_coordinate()) < kEnd;
  return !does_nothing && (place < kEnd || place > 1.0 - kEnd);
}

std::optional<std::size_t> Hypothesis::place_parameter() const {
  return first_of(parameters, [](const SearchedParameter& one) {
    return one.spacing == effects::Spacing::linear && !one.periodic && !one.neutral_coordinate();
  });
}

std::string Hypothesis::unit_of(const SearchedParameter& parameter) const {
  return effects::unit_of(*std::ranges::find(entry->definition->parameters, parameter.name,
                                             &arm::EffectParameter::name),
                          sensor);
}

std::vector<Hypothesis> hypotheses(const Experiment& experiment) {
  const Scales scales = scales_of(experiment);
  const bool lacks_dissipation =
      arm::has_beam(experiment.arm) && !states_dissipation(experiment.arm);
  std::vector<Hypothesis> all;
  for (const effects::Entry& entry : effects::entries()) {
    const std::string& name = entry.definition->name;
    if (experiment.arm.effects.contains(name)) continue;
    if (!arm::has_beam(experiment.arm) && !arm::acts_without_beam(*entry.definition)) continue;
    const std::shared_ptr<const effects::Entry> of_library(std::shared_ptr<void>(), &entry);
    const auto add = [&](const Scales& its_scales, const std::string& sensor) {
      if (entry.applies && !entry.applies(its_scales)) return;
      all.push_back({of_library, name, sensor, entry.search(its_scales)});
      all.back().is_family_certain =
          lacks_dissipation && entry.family == effects::Family::beam_dissipation;
    };
    const auto shown_in = [&](const measured::MeasuredRun& run) {
      return Hypothesis{of_library, name}.shows_in(run.run.kind);
    };
    if (!entry.definition->sensor) {
      if (std::ranges::any_of(experiment.runs, shown_in)) add(scales, {});
      continue;
    }
    std::vector<arm::Sensor> sensors;
    for (const auto& run : experiment.runs | std::views::filter(shown_in)) {
      for (const arm::Sensor& sensor : sensors_in(run.data)) add_unknown(sensors, sensor);
    }
    for (const arm::Sensor& sensor : sensors) {
      add(scales_of_sensor(scales, experiment, sensor), arm::to_string(sensor));
    }
  }
  for (const auto& [name, stated] : experiment.arm.hypotheses) {
    const auto entry = std::make_shared<const effects::Entry>(effects::stated_entry(name, stated));
    const Hypothesis made{entry, name, {}, entry->search(scales), stated.known};
    if (std::ranges::any_of(experiment.runs,
                            [&](const auto& run) { return made.shows_in(run.run.kind); })) {
      all.push_back(made);
    }
  }
  return all;
}

std::vector<Hypothesis> without(std::vector<Hypothesis> all,
                                const std::vector<std::string>& excluded) {
  std::erase_if(all, [&](const Hypothesis& one) {
    return std::ranges::find(excluded, one.effect) != excluded.end() ||
           std::ranges::find(excluded, one.label()) != excluded.end();
  });
  return all;
}

std::vector<Hypothesis> distinct(std::vector<Hypothesis> all) {
  std::vector<Hypothesis> made;
  const auto is_same = [](const Hypothesis& one, const Hypothesis& other) {
    return std::ranges::find(one.entry->same_as, other.effect) != one.entry->same_as.end();
  };
  // Those that name another as the same follow it.
  std::ranges::stable_partition(all,
                                [](const Hypothesis& one) { return one.entry->same_as.empty(); });
  for (Hypothesis& one : all) {
    const auto same =
        std::ranges::find_if(made, [&](const Hypothesis& other) { return is_same(one, other); });
    if (same == made.end()) {
      made.push_back(std::move(one));
    } else {
      same->other_names.push_back(one.effect);
    }
  }
  return made;
}

arm::Arm extended(const arm::Arm& arm, const Hypothesis& hypothesis,
                  std::span<const double> values) {
  arm::Arm made = arm;
  arm::Effect effect{.definition = hypothesis.entry->definition,
                     .parameters = hypothesis.known,
                     .sensor = hypothesis.sensor};
  for (std::size_t i = 0; i < values.size(); ++i) {
    effect.parameters[hypothesis.parameters[i].name] = values[i];
  }
  made.effects[hypothesis.effect] = std::move(effect);
  made.hypotheses.erase(hypothesis.effect);
  return made;
}

Scales scales_of(const Experiment& experiment) {
  Scales scales;
  scales.arm = experiment.arm;
  scales.beam = arm::linear_arm(experiment.arm);
  if (!arm::has_beam(experiment.arm)) scales.beam = beam_beside(scales.beam, experiment);
  effects::TorqueScales torques;
  double measured_squares = 0.0;  // of the hub, in the runs that show it
  double measured_samples = 0.0;
  double highest_Hz = 0.0;
  double period_s = 0.0;
  for (const auto& [run, data] : experiment.runs) {
    scales.has_payload_mass =
        scales.has_payload_mass || arm_in(experiment, run).payload.mass_kg > 0.0;
    if (const auto* record = std::get_if<measured::TimeRecord>(&data)) {
      const double step = measured::sampling_period_s(*record);
      const double inertia = arm::total_inertia_kg_m2(arm_in(experiment, run));
      period_s = period_s > 0.0 ? std::min(period_s, step) : step;
      torques.add(record->torque_N_m, step, inertia);
      if (const auto mean_square = mean_square_speed(*record)) {
        const auto count = static_cast<double>(record->time_s.size());
        measured_squares += *mean_square * count;
        measured_samples += count;
      }
      for (const auto& channel : record->channels) {
        add_unknown(scales.sensors, channel.sensor);
        if (channel.sensor.kind != arm::SensorKind::hub_angle) continue;
        scales.hub_angle_range_rad = std::max(scales.hub_angle_range_rad, range_of(channel.values));
      }
    } else if (const auto* frequency = std::get_if<measured::FrequencyRecord>(&data)) {
      for (const auto& channel : frequency->channels) {
        add_unknown(scales.sensors, channel.sensor);
        highest_Hz = std::max(highest_Hz, channel.frequency_Hz.back());
      }
    }
  }
  if (period_s > 0.0) {
    torques.put(scales);
    if (measured_squares > 0.0) {
      scales.speed_rms_rad_per_s = std::sqrt(measured_squares / measured_samples);
    }
    scales.shortest_time_s = 0.5 * period_s;
  } else if (highest_Hz > 0.0) {
    scales.shortest_time_s = 1.0 / (20.0 * highest_Hz);
  }
  return scales;
}

}  // namespace flexarm::diagnose
