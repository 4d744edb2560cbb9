#include "measured/modal/modal_fit_task.hpp"

#include "arm/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <utility>

namespace flexarm::measured {
namespace {

using Eigen::Index;

/// A coherence is not believed to be closer to 1 than this.
constexpr double kCoherenceRounding = 1e-12;
/// Relative deviation of lines that nothing is known about.
constexpr double kUnknownDeviation = 0.01;
/// Sampling periods closer than this, relatively, are one; far above a file's rounding of times,
/// far below what would move an alias.
constexpr double kSamePeriod = 1e-6;

void require_at_least(const char* key, double value, double least) {
  if (!(value >= least))
    throw arm::out_of_range(key, value, "", fmt::format("{:g} or more", least));
}

void require_options(const ModalFitOptions& options) {
  require_at_least("modes", options.modes.value_or(1), 1);
  require_at_least("most_blocks", options.most_blocks, 1);
  require_at_least("highest_order", options.highest_order, 2);
  require_at_least("averages", options.averages, 1.0);
  require_at_least("search_samples", static_cast<double>(options.search_samples), kLeastSamples);
  if (options.band &&
      !(options.band->from_Hz >= 0.0 && options.band->to_Hz > options.band->from_Hz)) {
    throw arm::InputError(fmt::format(
        "band = {:g} to {:g} Hz: lower limit must be 0 or more and below the upper limit",
        options.band->from_Hz, options.band->to_Hz));
  }
}

template <class Channels>
void require_each_sensor_once(const Channels& channels) {
  std::set<std::string> names;
  for (const auto& channel : channels) {
    if (!names.insert(arm::to_string(channel.sensor)).second) {
      throw std::invalid_argument("duplicate sensor in a record");
    }
  }
}

void require_finite(const std::string& name, std::span<const double> values) {
  const auto at = std::ranges::find_if_not(values, [](double x) { return std::isfinite(x); });
  if (at == values.end()) return;
  throw arm::InputError(
      fmt::format("{} = {} at sample {}: must be a finite number", name, *at, at - values.begin()));
}

void require_record(const TimeRecord& record, InitialState initial) {
  const std::size_t samples = record.time_s.size();
  bool alike = record.torque_N_m.size() == samples;
  for (const Channel& channel : record.channels) alike &= channel.values.size() == samples;
  if (!alike) throw std::invalid_argument("columns of different length");
  require_each_sensor_once(record.channels);
  if (samples < kLeastSamples) {
    throw arm::InputError(
        fmt::format("samples = {}: a fit needs at least {}", samples, kLeastSamples));
  }
  if (record.channels.empty()) throw arm::InputError("a record without a sensor cannot be fitted");
  require_finite("torque", record.torque_N_m);
  if (initial == InitialState::rest && is_zero(record.torque_N_m)) {
    throw arm::InputError("torque is zero at all samples: no response to fit");
  }
  for (const Channel& channel : record.channels) {
    const std::string name = arm::to_string(channel.sensor);
    require_finite(name, channel.values);
    if (std::ranges::adjacent_find(channel.values, std::not_equal_to<>()) == channel.values.end()) {
      throw arm::InputError(
          fmt::format("{} = {:g} {} at all samples: no response; exclude it from the fit", name,
                      channel.values.front(), arm::unit(channel.sensor)));
    }
  }
}

void require_channel(const FrequencyChannel& channel) {
  const std::size_t lines = channel.frequency_Hz.size();
  if (channel.response.size() != lines || channel.coherence.size() != lines) {
    throw std::invalid_argument("frequency response with columns of different length");
  }
  const std::string name = arm::to_string(channel.sensor);
  for (std::size_t k = 0; k < lines; ++k) {
    if (std::isfinite(std::abs(channel.response[k]))) continue;
    throw arm::InputError(fmt::format("{} at {:g} Hz: the response must be a finite number", name,
                                      channel.frequency_Hz[k]));
  }
}

/// Standard deviation of real and imaginary part of each line; infinite where nothing is known.
std::vector<double> deviations(const FrequencyChannel& channel, std::size_t index,
                               const ModalFitOptions& options) {
  if (index < options.response_std.size() && !options.response_std[index].empty()) {
    const auto& given = options.response_std[index];
    const bool usable = given.size() == channel.response.size() &&
                        std::ranges::all_of(given, [](double d) { return d > 0.0; });
    if (!usable) {
      throw arm::InputError(fmt::format("response_std of {}: must be above 0, one per frequency",
                                        arm::to_string(channel.sensor)));
    }
    return given;
  }
  std::vector<double> deviation;
  for (std::size_t k = 0; k < channel.response.size(); ++k) {
    const double coherence = std::min(channel.coherence[k], 1.0 - kCoherenceRounding);
    const double relative =
        std::isnan(coherence) ? kUnknownDeviation
                              : std::sqrt((1.0 - coherence) / (2.0 * options.averages * coherence));
    deviation.push_back(relative * std::abs(channel.response[k]));
    if (!(deviation.back() > 0.0)) deviation.back() = std::numeric_limits<double>::infinity();
  }
  return deviation;
}

void require_lines(const FrequencyChannel& channel, std::span<const double> deviation) {
  std::size_t usable = 0;
  for (std::size_t k = 0; k < deviation.size(); ++k) {
    if (channel.frequency_Hz[k] > 0.0 && std::isfinite(deviation[k])) ++usable;
  }
  if (usable >= kLeastLines) return;
  throw arm::InputError(fmt::format(
      "{}: {} frequencies above 0 with a response and a coherence above 0; a fit needs at least {}",
      arm::to_string(channel.sensor), usable, kLeastLines));
}

/// The chart and the search need something in the band.
void require_lines_in_band(const ModalFitTask& task) {
  const bool holds_lines = std::ranges::any_of(
      task.equations,
      [](const DenominatorEquation& equation) { return equation.angle.size() > 0; });
  if (holds_lines) return;
  throw arm::InputError(fmt::format("band = {:g} to {:g} Hz: contains no spectral line",
                                    task.band.from_Hz, task.band.to_Hz));
}

Index sensor_index(std::vector<arm::Sensor>& sensors, const arm::Sensor& sensor) {
  const auto at = std::ranges::find(sensors, sensor);
  const auto index = static_cast<Index>(at - sensors.begin());
  if (at == sensors.end()) sensors.push_back(sensor);
  return index;
}

/// All that the torques excite; `shortest_s` is the shortest sampling period.
FitBand time_band(std::span<const TimeRecord> records, const ModalFitOptions& options,
                  double shortest_s) {
  if (!options.band) {
    FitBand band = excited_band(records.front());
    for (const TimeRecord& record : records.subspan(1)) {
      const FitBand more = excited_band(record);
      band = {std::min(band.from_Hz, more.from_Hz), std::max(band.to_Hz, more.to_Hz)};
    }
    return band;
  }
  constexpr double kRounding = 1e-9;
  if (options.band->to_Hz > 0.5 / shortest_s * (1.0 + kRounding)) {
    throw arm::out_of_range(
        "band", options.band->to_Hz, "Hz",
        fmt::format("at most the Nyquist frequency, {:g} Hz", 0.5 / shortest_s));
  }
  return *options.band;
}

}  // namespace

ModalFitTask time_task(std::span<const TimeRecord> records, const ModalFitOptions& options) {
  require_options(options);
  if (records.empty()) throw arm::InputError("no record to fit");
  if (options.initial.size() > 1 && options.initial.size() != records.size()) {
    throw arm::out_of_range("initial", static_cast<double>(options.initial.size()), "states",
                            fmt::format("none, 1, or {}, one per record", records.size()));
  }
  double shortest_s = std::numeric_limits<double>::infinity();
  double longest_s = 0.0;
  const auto initial_of = [&options](std::size_t r) {
    return options.initial.empty() ? InitialState::rest
                                   : options.initial[std::min(r, options.initial.size() - 1)];
  };
  for (std::size_t r = 0; r < records.size(); ++r) {
    const TimeRecord& record = records[r];
    require_record(record, initial_of(r));
    shortest_s = std::min(shortest_s, sampling_period_s(record));
    longest_s = std::max(longest_s, sampling_period_s(record));
  }
  ModalFitTask task;
  task.in_time = true;
  task.forced = !std::ranges::all_of(
      records, [](const TimeRecord& record) { return is_zero(record.torque_N_m); });
  task.period_s = longest_s <= shortest_s * (1.0 + kSamePeriod) ? shortest_s : 0.0;
  task.band = time_band(records, options, shortest_s);
  task.highest_Hz = 0.5 / shortest_s;
  task.angle_period_s = 0.5 / task.band.to_Hz;
  for (std::size_t r = 0; r < records.size(); ++r) {
    const TimeRecord& record = records[r];
    std::vector<Index> sensors;
    for (const Channel& channel : record.channels) {
      sensors.push_back(sensor_index(task.sensors, channel.sensor));
    }
    task.all.push_back(
        time_stretch(record, sensors, options.torque_hold, initial_of(r), record.time_s.size()));
    task.search.push_back(
        time_stretch(record, sensors, options.torque_hold, initial_of(r), options.search_samples));
    for (auto& equation :
         time_equations(record, options.rigid_body, task.band, options.search_samples)) {
      task.equations.push_back(std::move(equation));
    }
  }
  require_lines_in_band(task);
  return task;
}

ModalFitTask frequency_task(const FrequencyRecord& record, const ModalFitOptions& options) {
  require_options(options);
  if (record.channels.empty()) throw arm::InputError("no frequency response to fit");
  require_each_sensor_once(record.channels);
  ModalFitTask task;
  task.in_time = false;
  task.band = {std::numeric_limits<double>::infinity(), 0.0};
  std::vector<std::vector<double>> deviation;
  for (const FrequencyChannel& channel : record.channels) {
    require_channel(channel);
    deviation.push_back(deviations(channel, deviation.size(), options));
    require_lines(channel, deviation.back());
    task.band.from_Hz = std::min(task.band.from_Hz, channel.frequency_Hz.front());
    task.band.to_Hz = std::max(task.band.to_Hz, channel.frequency_Hz.back());
  }
  if (options.band) task.band = *options.band;
  task.angle_period_s = 0.5 / task.band.to_Hz;
  for (std::size_t j = 0; j < record.channels.size(); ++j) {
    const FrequencyChannel& channel = record.channels[j];
    task.sensors.push_back(channel.sensor);
    task.equations.push_back(
        frequency_equation(channel, deviation[j], options.rigid_body, task.band));
    task.all.push_back(frequency_stretch(channel, static_cast<Index>(j), deviation[j]));
  }
  require_lines_in_band(task);
  task.search = task.all;
  return task;
}

}  // namespace flexarm::measured
