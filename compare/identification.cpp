#include "compare/identification.hpp"

#include "arm/rigid_hub.hpp"
#include "compare/damped_roots.hpp"
#include "compare/reading_clusters.hpp"
#include "compare/standard_models.hpp"
#include "response/any_formulation.hpp"
#include "response/formulation_maker.hpp"
#include "response/frequency/response_study.hpp"
#include "response/truncation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace flexarm::compare {

namespace {

using Complex = std::complex<double>;

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
const arm::Sensor kTip{arm::SensorKind::tip_displacement, 0.0};

AnalyticalPole pole_of(const arm::PolePair& pair) {
  const Complex& first = pair.first_rad_per_s;
  const Complex& second = pair.second_rad_per_s;
  const double omega = std::sqrt(std::abs(first) * std::abs(second));
  return {omega / kTwoPi, -(first + second).real() / (2.0 * omega)};
}

AnalyticalGains gains_of(const std::string& model, const response::AnyFormulation& formulation,
                         int count) {
  const bool has_tip = arm::has_beam(response::arm_of(formulation));
  const auto modes =
      response::modal_model(formulation, count, std::span(&kTip, has_tip ? 1 : 0), {});
  AnalyticalGains gains{model, modes.modal_mass_kg_m2, {}, {}};
  for (std::size_t i = 1; i < modes.modes.size(); ++i) {
    gains.hub_slope.push_back(modes.modes[i].hub_slope);
    gains.tip_gain_m.push_back(modes.modes[i].sensor_values.front());
  }
  return gains;
}

/// The highest frequency that the readings of a payload show [Hz].
double highest_Hz(const measured::Identification& identification, const arm::Payload& payload,
                  const arm::Arm& arm) {
  double highest = 0.0;
  for (const auto& reading : identification.readings) {
    if (reading.payload.value_or(arm.payload) != payload) continue;
    for (const auto& entry : reading.table) {
      highest = std::max(highest, entry.frequency_Hz.value_or(0.0));
    }
  }
  return highest;
}

/// Returns the damped poles above the first `known` whose aliases are looked for in samples.
std::vector<ModelRoot> poles_beyond(const arm::Arm& arm, std::size_t known,
                                    const std::vector<SampledReading>& readings) {
  double period_s = std::numeric_limits<double>::infinity();
  for (const SampledReading& reading : readings) {
    if (reading.sampling_period_s > 0.0) period_s = std::min(period_s, reading.sampling_period_s);
  }
  if (std::isinf(period_s) || !arm::has_beam(arm)) return {};
  const auto formulation = response::formulation_of_fit(arm);
  response::ResponseOptions wanted;
  wanted.modes = 1;
  wanted.to_Hz = kMostTurns / period_s;
  const int count = std::min(response::roots_needed(arm, wanted),
                             response::most_chosen_modes(response::name(formulation)));
  const auto pairs = response::damped_poles(formulation, count).flexible;
  std::vector<ModelRoot> beyond;
  for (std::size_t i = known; i < pairs.size(); ++i) {
    const AnalyticalPole pole = pole_of(pairs[i]);
    if (pole.damping_ratio < 1.0) {
      beyond.push_back({pole.frequency_Hz, static_cast<int>(i) + 1});
    }
  }
  return beyond;
}

/// Of the responses of runs with a payload; empty where there are none.
std::optional<FrequencyRange> range_of(const measured::Identification& identification,
                                       const arm::Payload& payload, const arm::Arm& arm) {
  FrequencyRange range{std::numeric_limits<double>::infinity(), 0.0};
  for (const auto& run : identification.runs) {
    if (run.run.payload.value_or(arm.payload) != payload) continue;
    for (const auto& channel : run.response.channels) {
      const auto above_0 = std::ranges::upper_bound(channel.frequency_Hz, 0.0);
      if (above_0 == channel.frequency_Hz.end()) continue;
      range.from_Hz = std::min(range.from_Hz, *above_0);
      range.to_Hz = std::max(range.to_Hz, channel.frequency_Hz.back());
    }
  }
  if (!(range.from_Hz < range.to_Hz)) return std::nullopt;
  return range;
}

void add_sensor(const arm::Sensor& sensor, std::vector<arm::Sensor>& sensors) {
  if (std::ranges::find(sensors, sensor) == sensors.end()) sensors.push_back(sensor);
}

/// Of all runs and readings.
std::vector<arm::Sensor> sensors_of(const measured::Identification& identification) {
  std::vector<arm::Sensor> sensors;
  for (const auto& run : identification.runs) {
    for (const auto& channel : run.response.channels) add_sensor(channel.sensor, sensors);
  }
  for (const auto& reading : identification.readings) {
    for (const auto& entry : reading.table) {
      if (entry.sensor) add_sensor(*entry.sensor, sensors);
    }
  }
  return sensors;
}

std::vector<std::vector<Complex>> damped_roots(const response::AnyFormulation& formulation,
                                               const arm::Sensor& sensor,
                                               const std::vector<Complex>& undamped_rad_per_s) {
  std::vector<std::vector<Complex>> roots;
  if (undamped_rad_per_s.empty()) return roots;
  for (const auto& pair : zeros_with_damping(formulation, sensor, undamped_rad_per_s)) {
    roots.push_back(pair ? with_conjugates(*pair) : std::vector<Complex>());
  }
  return roots;
}

}  // namespace

AnalyticalModes analytical_modes(const arm::Arm& arm, std::span<const arm::Sensor> sensors,
                                 double to_Hz, const std::optional<FrequencyRange>& range) {
  response::ResponseOptions wanted;
  wanted.modes = 1;
  wanted.to_Hz = to_Hz;
  const int roots = response::roots_needed(arm, wanted);
  const auto models = standard_models(roots);
  AnalyticalModes analytical;
  for (const auto& model : models) {
    const auto formulation = model.make(arm);
    if (analytical.gains.empty()) {
      const arm::DampedPoleSet poles = response::damped_poles(formulation, roots);
      const Complex lowest = poles.lowest.first_rad_per_s * poles.lowest.second_rad_per_s;
      analytical.lowest_Hz = std::sqrt(std::max(lowest.real(), 0.0)) / kTwoPi;
      for (const auto& pair : poles.flexible) {
        analytical.poles.push_back(pole_of(pair));
        if (analytical.poles.back().frequency_Hz > to_Hz) break;
      }
      for (const auto& sensor : sensors) {
        arm::require_valid(sensor, arm);
        if (!arm::is_responsive(sensor, arm)) continue;
        auto undamped = response::zeros(formulation, sensor, roots).s_rad_per_s;
        auto damped = damped_roots(formulation, sensor, undamped);
        analytical.zeros.push_back({sensor, std::move(undamped), std::move(damped)});
        wanted.sensors.push_back(sensor);
      }
      if (range && !wanted.sensors.empty()) {
        wanted.from_Hz = range->from_Hz;
        wanted.to_Hz = range->to_Hz;
        analytical.response = response::study_response(arm, formulation, wanted).response;
      }
    }
    analytical.gains.push_back(gains_of(std::string(response::name(formulation)), formulation,
                                        std::max(1, static_cast<int>(analytical.poles.size()))));
    if (!arm::has_beam(arm)) break;  // the others are the same
  }
  return analytical;
}

ModelRoots model_roots(const AnalyticalModes& analytical) {
  ModelRoots model{.lowest_Hz = analytical.lowest_Hz};
  for (const auto& pole : analytical.poles) {
    model.poles.push_back({pole.frequency_Hz, static_cast<int>(model.poles.size()) + 1});
  }
  for (const auto& zeros : analytical.zeros) {
    auto& own = model.zeros.emplace_back(ModelRoots::Zeros{zeros.sensor, {}}).roots;
    for (const Complex& s : zeros.s_rad_per_s) {
      if (s.real() != 0.0) continue;
      own.push_back({s.imag() / kTwoPi, static_cast<int>(own.size()) + 1});
    }
  }
  return model;
}

double IdentifiedRoot::error_percent() const {
  if (!analytical_Hz || !measured.frequency_Hz) return kNaN;
  return 100.0 * (*measured.frequency_Hz - *analytical_Hz) / *analytical_Hz;
}

namespace {

/// The entry beside the analytical root of that order, without an order where there is none.
IdentifiedRoot beside(const measured::ModalEntry& entry, int order, const ModelRoots& model,
                      const AnalyticalModes& analytical) {
  IdentifiedRoot root{entry, {}, {}, {}};
  const std::vector<ModelRoot>* roots = &model.poles;
  if (entry.feature == measured::Feature::zero) {
    const auto zeros = std::ranges::find(model.zeros, *entry.sensor, &ModelRoots::Zeros::sensor);
    if (zeros == model.zeros.end()) return root;
    roots = &zeros->roots;
  }
  const auto at = std::ranges::find(*roots, order, &ModelRoot::order);
  if (at == roots->end()) return root;
  root.order = order;
  root.analytical_Hz = at->frequency_Hz;
  if (entry.feature == measured::Feature::pole) {
    root.analytical_damping_ratio =
        analytical.poles[static_cast<std::size_t>(order - 1)].damping_ratio;
  }
  return root;
}

/// The roots of one reading at their places.
std::vector<IdentifiedRoot> at_places(const measured::ModalTable& table,
                                      const std::vector<RootPlace>& places, const ModelRoots& model,
                                      const AnalyticalModes& analytical) {
  std::vector<IdentifiedRoot> roots;
  for (std::size_t i = 0; i < table.size(); ++i) {
    IdentifiedRoot& root =
        roots.emplace_back(beside(table[i], places[i].order.value_or(0), model, analytical));
    if (analytical.is_empty()) root.order = places[i].order;
    root.alias_of_Hz = places[i].alias_of_Hz;
    root.alias_of_order = places[i].alias_of_order;
  }
  return roots;
}

/// The sampling period that all runs of a reading have; 0 without one.
double sampling_period_s(const measured::Identification& identification,
                         const measured::ModalReading& reading) {
  double period_s = 0.0;
  for (const auto& run : identification.runs) {
    if (std::ranges::find(reading.runs, run.run.id) == reading.runs.end()) continue;
    if (run.sampling_period_s == 0.0) return 0.0;
    period_s = run.sampling_period_s;
  }
  return period_s;
}

}  // namespace

std::vector<IdentifiedRoot> beside_analytical(const measured::ModalTable& table,
                                              const AnalyticalModes& analytical) {
  const ModelRoots model = model_roots(analytical);
  const std::vector<RootOrder> orders = number_roots(table, model);
  std::vector<IdentifiedRoot> roots;
  for (std::size_t i = 0; i < table.size(); ++i) {
    roots.push_back(beside(table[i], orders[i].order.value_or(0), model, analytical));
  }
  return roots;
}

measured::ModalTable in_analytical_order(const std::vector<IdentifiedRoot>& roots) {
  measured::ModalTable table;
  for (const auto& root : roots) {
    if (!root.order) continue;
    table.push_back(root.measured);
    if (root.analytical_Hz) table.back().order = *root.order;
  }
  return table;
}

std::vector<IdentifiedCondition> conditions_of(const measured::Identification& identification,
                                               const std::optional<arm::Arm>& arm) {
  std::vector<IdentifiedCondition> conditions;
  const auto condition_of = [&](const std::optional<arm::Payload>& payload) -> auto& {
    const arm::Payload own = payload.value_or(arm ? arm->payload : arm::Payload{});
    const auto at = std::ranges::find(conditions, own, &IdentifiedCondition::payload);
    if (at != conditions.end()) return *at;
    conditions.push_back({.payload = own});
    return conditions.back();
  };
  for (std::size_t i = 0; i < identification.runs.size(); ++i) {
    condition_of(identification.runs[i].run.payload).runs.push_back(i);
  }
  const auto loaded = [&](const arm::Payload& payload) {
    arm::Arm made = *arm;
    made.payload = payload;
    return made;
  };
  const auto sensors = sensors_of(identification);
  for (auto& condition : conditions) {
    if (!arm) break;
    condition.analytical =
        analytical_modes(loaded(condition.payload), sensors,
                         needed_Hz(highest_Hz(identification, condition.payload, *arm)),
                         range_of(identification, condition.payload, *arm));
  }
  for (std::size_t i = 0; i < identification.readings.size(); ++i) {
    condition_of(identification.readings[i].payload).readings.push_back(i);
  }
  for (auto& condition : conditions) {
    std::vector<SampledReading> readings;
    for (const std::size_t i : condition.readings) {
      const auto& reading = identification.readings[i];
      readings.push_back({&reading, sampling_period_s(identification, reading)});
    }
    ModelRoots model = model_roots(condition.analytical);
    if (arm) {
      model.beyond = poles_beyond(loaded(condition.payload), model.poles.size(), readings);
    }
    const auto places = place_readings(readings, arm ? std::optional(model) : std::nullopt);
    for (std::size_t k = 0; k < readings.size(); ++k) {
      condition.roots.push_back(
          at_places(readings[k].reading->table, places[k], model, condition.analytical));
    }
  }
  for (std::size_t i = 0; i < identification.fits.size(); ++i) {
    condition_of(identification.fits[i].payload).fits.push_back(i);
  }
  return conditions;
}

}  // namespace flexarm::compare
