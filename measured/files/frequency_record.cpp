#include "measured/files/frequency_record.hpp"

#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"
#include "arm/range.hpp"
#include "measured/files/atomic_file.hpp"
#include "measured/files/csv.hpp"
#include "measured/files/file_kind.hpp"
#include "measured/files/number_cell.hpp"
#include "measured/files/record_constants.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <span>
#include <utility>

namespace flexarm::measured {

namespace {

using arm::InputError;

enum Place : std::size_t { frequency, sensor, re, im, coherence, input };
const std::array<std::string, 6> kNames = {"frequency [Hz]", "sensor", "re", "im",
                                           "coherence",      "input"};
/// The columns of a record whose input is the torque.
const auto kNamesOfTorque = std::span(kNames).first<input>();
constexpr std::string_view kTorqueInput = "torque";

/// Where each column of `kNames` stands in a row.
using FrequencyHeader = std::array<std::optional<std::size_t>, kNames.size()>;

/// " (did you mean ...?)", also for a column without its unit.
std::string meant(std::string_view typed) {
  if (typed == "frequency") return fmt::format(" (did you mean {}?)", kNames[frequency]);
  return arm::did_you_mean(typed, kNames);
}

FrequencyHeader read_frequency_header(std::span<const std::string_view> cells) {
  if (cells.size() == 1 && cells[0].find_first_of(";\t") != std::string::npos) {
    throw InputError("cells must be separated by commas, and numbers have a decimal point");
  }
  FrequencyHeader header;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto place =
        static_cast<std::size_t>(std::ranges::find(kNames, cells[i]) - kNames.begin());
    if (place == kNames.size()) {
      throw InputError(fmt::format("column {}: unknown{}; allowed: {}", arm::shown(cells[i]),
                                   meant(cells[i]), fmt::join(kNames, ", ")));
    }
    if (header[place]) throw InputError(fmt::format("column {}: given twice", cells[i]));
    header[place] = i;
  }
  for (const auto place : {frequency, sensor, re, im}) {
    if (!header[place]) {
      throw InputError(fmt::format("column {}: missing; the header is {}", kNames[place],
                                   fmt::join(kNamesOfTorque, ",")));
    }
  }
  return header;
}

double read_number(Place place, std::string_view cell, const arm::Range& range) {
  const auto value = number_cell<double>(cell);
  if (value && is_over_range(*value)) {
    throw InputError(fmt::format(
        "{} = {}: an instrument's sign of no measurement; must be a measured number, or the row "
        "left out",
        kNames[place], arm::shown(cell)));
  }
  if (value && range.contains(*value)) return *value;
  throw InputError(
      fmt::format("{} = {}: must be {}", kNames[place], arm::shown(cell), to_string(range)));
}

bool is_coherence(double value) {
  return value > 0.0 && value <= 1.0;
}

double read_coherence(std::string_view cell) {
  if (cell.empty()) return kUnknown;
  const auto value = number_cell<double>(cell);
  if (value && is_coherence(*value)) return *value;
  throw InputError(fmt::format("{} = {}: must be above 0 and 1 or less, or empty",
                               kNames[coherence], arm::shown(cell)));
}

void require_output(const arm::Sensor& sensor, const std::optional<arm::Sensor>& input) {
  if (sensor != input) return;
  throw InputError(fmt::format("{}: is the input; must be another sensor", arm::to_string(sensor)));
}

void require_ascending(const arm::Sensor& at, double before_Hz, double frequency_Hz) {
  if (frequency_Hz > before_Hz) return;
  throw InputError(fmt::format(
      "{} = {}: {} of {}; must be strictly increasing per sensor", kNames[frequency], frequency_Hz,
      frequency_Hz == before_Hz ? "again the one before" : "below the one before",
      arm::to_string(at)));
}

/// Fills a record row by row.
class Builder {
 public:
  explicit Builder(const FrequencyHeader& header) : header_(header) {
    columns_ = static_cast<std::size_t>(
        std::ranges::count_if(header, [](const auto& place) { return place.has_value(); }));
  }

  void add(std::span<const std::string_view> cells) {
    if (cells.size() != columns_) {
      throw InputError(fmt::format("{} cell{}; the header has {} (numbers have a decimal point)",
                                   cells.size(), cells.size() == 1 ? "" : "s", columns_));
    }
    if (header_[input]) add_input(cells[*header_[input]]);
    FrequencyChannel& channel = channel_of(cells[*header_[sensor]]);
    const double frequency_Hz =
        read_number(frequency, cells[*header_[frequency]], arm::kNotNegative);
    if (!channel.frequency_Hz.empty()) {
      require_ascending(channel.sensor, channel.frequency_Hz.back(), frequency_Hz);
    }
    channel.frequency_Hz.push_back(frequency_Hz);
    channel.response.emplace_back(read_number(re, cells[*header_[re]], arm::kAnyFinite),
                                  read_number(im, cells[*header_[im]], arm::kAnyFinite));
    channel.coherence.push_back(header_[coherence] ? read_coherence(cells[*header_[coherence]])
                                                   : kUnknown);
  }

  FrequencyRecord take() { return std::move(record_); }

 private:
  void add_input(std::string_view cell) {
    const auto read = parse_response_input(cell);
    if (!record_.channels.empty() && read != record_.input) {
      throw InputError(
          fmt::format("{} = {}: must be that of the rows before", kNames[input], arm::shown(cell)));
    }
    record_.input = read;
  }

  /// Two spellings of one place along the beam are one sensor.
  FrequencyChannel& channel_of(std::string_view name) {
    const auto known = channel_of_name_.find(name);
    if (known != channel_of_name_.end()) return record_.channels[known->second];
    const arm::Sensor read = arm::parse_sensor(name);
    require_output(read, record_.input);
    auto& channels = record_.channels;
    const auto place = static_cast<std::size_t>(
        std::ranges::find(channels, read, &FrequencyChannel::sensor) - channels.begin());
    if (place == kMostRecordColumns) {
      throw InputError(fmt::format("more than {} sensors", kMostRecordColumns));
    }
    if (place == channels.size()) channels.push_back({read, {}, {}, {}});
    channel_of_name_.emplace(name, place);
    return channels[place];
  }

  FrequencyHeader header_;
  std::size_t columns_ = 0;
  FrequencyRecord record_;
  std::map<std::string, std::size_t, std::less<>> channel_of_name_;
};

void require_valid(const FrequencyChannel& channel) {
  const std::size_t size = channel.frequency_Hz.size();
  const std::string name = arm::to_string(channel.sensor);
  if (size == 0 || channel.response.size() != size || channel.coherence.size() != size) {
    throw InputError(fmt::format(
        "{}: {} frequencies, {} values, {} coherences; must be as many of each, 1 or more", name,
        size, channel.response.size(), channel.coherence.size()));
  }
  for (std::size_t i = 0; i < size; ++i) {
    const double frequency_Hz = channel.frequency_Hz[i];
    const auto& response = channel.response[i];
    if (!std::isfinite(response.real()) || !std::isfinite(response.imag())) {
      throw InputError(fmt::format("{} = {} + {} i at {} Hz: must be finite numbers", name,
                                   response.real(), response.imag(), frequency_Hz));
    }
    if (!arm::kNotNegative.contains(frequency_Hz)) {
      throw InputError(fmt::format("{} = {} of {}: must be {}", kNames[frequency], frequency_Hz,
                                   name, to_string(arm::kNotNegative)));
    }
    if (i > 0) require_ascending(channel.sensor, channel.frequency_Hz[i - 1], frequency_Hz);
    if (!std::isnan(channel.coherence[i]) && !is_coherence(channel.coherence[i])) {
      throw InputError(
          fmt::format("{} = {} of {} at {} Hz: must be above 0 and 1 or less, or unknown",
                      kNames[coherence], channel.coherence[i], name, frequency_Hz));
    }
  }
}

}  // namespace

bool FrequencyChannel::operator==(const FrequencyChannel& other) const {
  const auto equal = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
  return sensor == other.sensor && frequency_Hz == other.frequency_Hz &&
         response == other.response && std::ranges::equal(coherence, other.coherence, equal);
}

void require_valid(const FrequencyRecord& record) {
  const auto& channels = record.channels;
  if (channels.empty()) throw InputError("no sensor; needs the response of one or more");
  parse_response_input(name_of_input(record));
  for (const auto& channel : channels) {
    if (std::ranges::count(channels, channel.sensor, &FrequencyChannel::sensor) > 1) {
      throw InputError(fmt::format("{}: given twice", arm::to_string(channel.sensor)));
    }
    require_output(channel.sensor, record.input);
    require_valid(channel);
  }
}

std::optional<arm::Sensor> parse_response_input(std::string_view name) {
  if (name == kTorqueInput) return std::nullopt;
  for (const auto kind : {arm::SensorKind::hub_angle, arm::SensorKind::hub_velocity}) {
    const arm::Sensor of_hub{kind, 0.0};
    if (name == arm::to_string(of_hub)) return of_hub;
  }
  throw InputError(fmt::format("{} = {}: must be {}, hub_angle or hub_velocity", kNames[input],
                               arm::shown(name), kTorqueInput));
}

std::string name_of_input(const FrequencyRecord& record) {
  return record.input ? arm::to_string(*record.input) : std::string(kTorqueInput);
}

FrequencyRecord parse_frequency_record(std::string_view csv, const std::string& file_name) {
  CsvReader reader(csv);
  try {
    if (!reader.next()) {
      throw InputError(fmt::format("empty; the header is {}", fmt::join(kNamesOfTorque, ",")));
    }
    Builder builder(read_frequency_header(reader.cells()));
    while (reader.next()) builder.add(reader.cells());
    FrequencyRecord record = builder.take();
    if (record.channels.empty()) throw InputError("only a header; must have one row or more");
    return record;
  } catch (const InputError& error) {
    throw arm::located(error, file_name, reader.line());
  }
}

FrequencyRecord read_frequency_record(const std::filesystem::path& path) {
  return read_file_as(FileKind::frequency_record, path, kLargestRecord_bytes,
                      parse_frequency_record);
}

std::string format_frequency_record(const FrequencyRecord& record) {
  require_valid(record);
  std::string end = "\n";
  std::string out = fmt::format("{}", fmt::join(kNamesOfTorque, ","));
  if (record.input) {
    out += fmt::format(",{}", kNames[input]);
    end = fmt::format(",{}\n", name_of_input(record));
  }
  out += '\n';
  for (const auto& channel : record.channels) {
    const std::string name = arm::to_string(channel.sensor);
    for (std::size_t i = 0; i < channel.frequency_Hz.size(); ++i) {
      fmt::format_to(std::back_inserter(out), "{},{},{},{},", channel.frequency_Hz[i], name,
                     channel.response[i].real(), channel.response[i].imag());
      if (!std::isnan(channel.coherence[i])) out += fmt::format("{}", channel.coherence[i]);
      out += end;
    }
  }
  return out;
}

void write_frequency_record(const FrequencyRecord& record, const std::filesystem::path& path) {
  measured::write_atomically(path, format_frequency_record(record));
}

}  // namespace flexarm::measured
