#include "diagnose/search/hub_torque_probes.hpp"

#include "arm/given_effects.hpp"
#include "arm/hub_torque_table.hpp"
#include "measured/files/time_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <variant>

namespace flexarm::diagnose {

namespace {

/// A velocity is the slope of an angle over this part of its run, so that its noise does not widen
/// the range.
constexpr std::size_t kSlopesInRun = 200;

struct ValueRange {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();

  void add(double value) {
    if (std::isnan(value)) return;
    least = std::min(least, value);
    most = std::max(most, value);
  }
  bool is_wide() const { return least < most; }
};

struct HubRanges {
  ValueRange angle_rad;
  ValueRange velocity_rad_per_s;

  void add_angle(const std::vector<double>& values, double period_s) {
    for (const double value : values) angle_rad.add(value);
    const std::size_t step = std::max<std::size_t>(1, values.size() / kSlopesInRun);
    for (std::size_t k = step; k < values.size(); k += step) {
      velocity_rad_per_s.add((values[k] - values[k - step]) /
                             (static_cast<double>(step) * period_s));
    }
  }
};

HubRanges hub_ranges(const Experiment& experiment) {
  HubRanges ranges;
  for (const auto& run : experiment.runs) {
    const auto* record = std::get_if<measured::TimeRecord>(&run.data);
    if (record == nullptr) continue;
    for (const auto& channel : record->channels) {
      if (channel.sensor.kind == arm::SensorKind::hub_angle) {
        ranges.add_angle(channel.values, sampling_period_s(*record));
      }
      if (channel.sensor.kind == arm::SensorKind::hub_velocity) {
        for (const double value : channel.values) ranges.velocity_rad_per_s.add(value);
      }
    }
  }
  return ranges;
}

/// The table times its only parameter, which is at least `least_N_m`.
Hypothesis probe(const std::string& name, const arm::HubTorqueTable& table, double least_N_m,
                 double most_N_m) {
  arm::EffectDefinition definition;
  definition.name = name;
  definition.meaning = "law of hub torque for a score test";
  definition.parameters = {{.name = "torque",
                            .unit = "N m",
                            .range = arm::kAnyFinite,
                            .meaning = "torque",
                            .example = most_N_m}};
  definition.hub_torque = [table](const arm::Effect& effect) {
    arm::HubTorqueTable scaled = table;
    for (double& torque_N_m : scaled.torque_N_m) torque_N_m *= effect.value("torque");
    return arm::define_effect(scaled)->hub_torque(effect);
  };
  const auto entry = std::make_shared<effects::Entry>();
  entry->definition = std::make_shared<const arm::EffectDefinition>(std::move(definition));
  entry->shows = effects::Shows::in_time;
  return {.entry = entry,
          .effect = name,
          .parameters = {{.name = "torque",
                          .lowest = least_N_m,
                          .highest = most_N_m,
                          .spacing = effects::Spacing::linear,
                          .neutral = 0.0}}};
}

std::vector<double> places(const ValueRange& range) {
  std::vector<double> made;
  for (int i = 0; i < kHats; ++i) {
    made.push_back(std::lerp(range.least, range.most, static_cast<double>(i) / (kHats - 1)));
  }
  return made;
}

}  // namespace

std::vector<Hypothesis> hub_torque_probes(const Experiment& experiment) {
  const double torque_N_m = scales_of(experiment).torque_rms_N_m;
  std::vector<Hypothesis> made;
  if (!(torque_N_m > 0.0)) return made;
  const HubRanges ranges = hub_ranges(experiment);
  const auto add_hats = [&](const ValueRange& range, auto axis, const char* what) {
    if (!range.is_wide()) return;
    for (std::size_t i = 0; i < kHats; ++i) {
      arm::HubTorqueTable table;
      table.*axis = places(range);
      table.torque_N_m.assign(kHats, 0.0);
      table.torque_N_m[i] = 1.0;
      made.push_back(
          probe(fmt::format("hub_torque_over_{}_{}", what, i), table, -torque_N_m, torque_N_m));
    }
  };
  add_hats(ranges.angle_rad, &arm::HubTorqueTable::angle_rad, "angle");
  add_hats(ranges.velocity_rad_per_s, &arm::HubTorqueTable::velocity_rad_per_s, "velocity");
  if (const ValueRange& speed = ranges.velocity_rad_per_s; speed.is_wide()) {
    const double most = std::max(-speed.least, speed.most);
    const arm::HubTorqueTable friction{.velocity_rad_per_s = {-most, 0.0, 0.0, most},
                                       .torque_N_m = {1.0, 1.0, -1.0, -1.0}};
    made.push_back(probe("hub_torque_against_motion", friction, 0.0, torque_N_m));
  }
  return made;
}

}  // namespace flexarm::diagnose
