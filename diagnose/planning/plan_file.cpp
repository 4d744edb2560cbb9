#include "arm/input_error.hpp"
#include "diagnose/planning/measurement_plan.hpp"
#include "measured/files/file_kind.hpp"
#include "measured/files/payload_keys.hpp"
#include "measured/files/toml_document.hpp"
#include "measured/files/toml_faults.hpp"
#include "measured/files/toml_node.hpp"
#include "response/excitation/excitation_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace flexarm::diagnose {

namespace {

using arm::InputError;
using measured::RunKind;

constexpr std::size_t kLargestPlan_bytes = 1 << 20;
/// More of a planned run is a slip of the pen: a run is predicted some thousand times.
constexpr double kMostPlannedSamples = 1e5;
constexpr double kMostPlannedFrequencies = 1e5;
constexpr std::size_t kMostPlannedSensors = 100;
/// Poles, or zeros of a sensor, of a modal table.
constexpr double kMostPlannedRoots = 50;

constexpr std::array kKinds = {RunKind::time, RunKind::frf, RunKind::modal};
constexpr std::array kPurposes = {measured::Purpose::estimation, measured::Purpose::validation};
constexpr std::array kHolds = {measured::TorqueHold::zero, measured::TorqueHold::first};

/// The keys of a run of each kind, beside those of all.
const std::vector<std::string>& keys_of_kind(RunKind kind) {
  static const std::vector<std::string> time = {
      "id",    "kind",       "purpose",  "payload",     "sensors",
      "noise", "excitation", "duration", "sample_time", "torque_hold"};
  static const std::vector<std::string> frf = {"id",      "kind",  "purpose",    "payload",
                                               "sensors", "noise", "frequencies"};
  static const std::vector<std::string> modal = {"id",    "kind",  "purpose", "payload",
                                                 "poles", "zeros", "noise",   "damping_noise"};
  return kind == RunKind::time ? time : kind == RunKind::frf ? frf : modal;
}

class PlanReader : measured::TomlFaults {
 public:
  explicit PlanReader(const std::string& file_name) : TomlFaults(file_name) {}

  MeasurementPlan read(const toml::table& document) {
    for (const auto& [key, node] : document) {
      const std::string name = arm::shown(key.str());
      if (name == "name") {
        read_text(name, node, "a quoted string", plan_.name);
      } else if (name == "run") {
        read_runs(node);
      } else {
        unknown("", name, node, {"name", "run"});
      }
    }
    require(document, 1, "run", "run", "at least one [[run]]");
    throw_first();
    return std::move(plan_);
  }

 private:
  void read_runs(const toml::node& node) {
    const auto* runs = node.as_array();
    if (runs == nullptr || runs->empty() || !runs->is_homogeneous<toml::table>()) {
      wrong("run", node, "one [[run]] table per run");
      return;
    }
    for (const auto& run : *runs) plan_.runs.push_back(read_run(*run.as_table()));
  }

  template <class Values, class T>
  void read_value(const std::string& key, const toml::node& node, const Values& values, T& value) {
    std::vector<std::string> words;
    for (const auto entry : values) words.emplace_back(to_string(entry));
    if (const auto at = read_word(key, node, words)) value = values[*at];
  }

  /// The kind comes first: it says which keys there may be.
  PlannedRun read_run(const toml::table& table) {
    PlannedRun run;
    const int line = line_of(table);
    require(table, line, "run.id", "id", "a quoted name");
    require(table, line, "run.kind", "kind", "\"time\", \"frf\" or \"modal\"");
    if (const auto* kind = table.get("kind")) read_value("run.kind", *kind, kKinds, run.kind);
    const auto& allowed = keys_of_kind(run.kind);
    for (const auto& [name, node] : table) {
      const std::string leaf = arm::shown(name.str());
      if (std::ranges::find(allowed, leaf) == allowed.end()) {
        unknown(fmt::format("run ({}).", to_string(run.kind)), leaf, node, allowed);
      }
    }
    if (const auto* id = table.get("id")) read_id(*id, run);
    if (const auto* purpose = table.get("purpose")) {
      run.purpose = measured::Purpose::estimation;
      read_value("run.purpose", *purpose, kPurposes, *run.purpose);
    }
    if (const auto* payload = table.get("payload")) {
      run.payload = measured::read_payload(*this, *payload);
    }
    if (run.kind == RunKind::modal) {
      read_roots(table, line, run);
    } else {
      read_sensors(table, line, run);
    }
    read_noise(table, run);
    if (run.kind == RunKind::time) read_torque(table, line, run);
    if (run.kind == RunKind::frf) read_frequencies(table, line, run);
    return run;
  }

  void read_id(const toml::node& node, PlannedRun& run) {
    read_text("run.id", node, "a quoted name", run.id);
    const auto [first, is_new] = line_of_id_.emplace(run.id, line_of(node));
    if (!is_new) {
      fault(line_of(node), fmt::format("run.id{}: given twice; first on line {}",
                                       measured::equals_value(node), first->second));
    }
  }

  /// Nothing, with a fault, for what is no sensor.
  std::optional<arm::Sensor> sensor_named(const std::string& key, std::string_view name,
                                          const toml::node& node) {
    try {
      return arm::parse_sensor(name);
    } catch (const InputError& error) {
      fault(line_of(node), fmt::format("{}: {}", key, error.what()));
      return std::nullopt;
    }
  }

  void read_sensors(const toml::table& table, int line, PlannedRun& run) {
    require(table, line, "run.sensors", "sensors", "a list as in [\"hub_angle\", \"strain@0.05\"]");
    const auto* node = table.get("sensors");
    if (node == nullptr) return;
    const auto* list = node->as_array();
    if (list == nullptr || list->empty() || !list->is_homogeneous<std::string>()) {
      wrong("run.sensors", *node, "a list of quoted names");
      return;
    }
    if (list->size() > kMostPlannedSensors) {
      fault(line_of(*node), fmt::format("run.sensors: {} names; must be {} or fewer", list->size(),
                                        kMostPlannedSensors));
      return;
    }
    for (const auto& entry : *list) {
      const auto sensor = sensor_named("run.sensors", entry.as_string()->get(), entry);
      if (!sensor) continue;
      if (std::ranges::find(run.sensors, *sensor, &PlannedSensor::sensor) != run.sensors.end()) {
        fault(line_of(entry),
              fmt::format("run.sensors: {} is given twice", arm::to_string(*sensor)));
        continue;
      }
      run.sensors.push_back({*sensor, kPlannedNoise});
    }
  }

  void read_count(const std::string& key, const toml::node& node, double lowest, double highest,
                  int& count) {
    const auto* number = node.as_integer();
    const double value = number == nullptr ? -1.0 : static_cast<double>(number->get());
    if (!(value >= lowest && value <= highest)) {
      wrong(key, node, fmt::format("a whole number from {:g} to {:g}", lowest, highest));
      return;
    }
    count = static_cast<int>(value);
  }

  void read_roots(const toml::table& table, int line, PlannedRun& run) {
    run.noise = kPlannedModalNoise;
    run.damping_noise = kPlannedDampingNoise;
    require(table, line, "run.poles", "poles", "number of measured poles, from the lowest");
    if (const auto* node = table.get("poles")) {
      read_count("run.poles", *node, 0, kMostPlannedRoots, run.poles);
    }
    if (const auto* node = table.get("zeros")) {
      const auto* zeros = node->as_table();
      if (zeros == nullptr) {
        wrong("run.zeros", *node, "a table, as in { hub_angle = 2 }");
        return;
      }
      for (const auto& [name, value] : *zeros) {
        const std::string leaf = arm::shown(name.str());
        const auto sensor = sensor_named("run.zeros", leaf, value);
        if (!sensor) continue;
        PlannedSensor planned{*sensor, kPlannedModalNoise};
        read_count("run.zeros." + leaf, value, 1, kMostPlannedRoots, planned.zeros);
        run.sensors.push_back(planned);
      }
    }
    if (run.poles == 0 && run.sensors.empty() && table.contains("poles")) {
      fault(line_of(*table.get("poles")),
            "run.poles = 0: must be 1 or more where there are no zeros");
    }
    if (const auto* node = table.get("damping_noise")) {
      read_number("run.damping_noise", *node, "", arm::kPositive, run.damping_noise);
    }
  }

  /// One number for all sensors, or a table with some of them.
  void read_noise(const toml::table& table, PlannedRun& run) {
    const auto* node = table.get("noise");
    if (node == nullptr) return;
    const auto* by_sensor = node->as_table();
    if (by_sensor == nullptr || run.kind == RunKind::modal) {
      double noise = kPlannedNoise;
      read_number("run.noise", *node, "", arm::kPositive, noise);
      run.noise = noise;
      for (PlannedSensor& sensor : run.sensors) sensor.noise = noise;
      return;
    }
    for (const auto& [name, value] : *by_sensor) {
      const std::string leaf = arm::shown(name.str());
      const auto sensor = sensor_named("run.noise", leaf, value);
      if (!sensor) continue;
      const auto at = std::ranges::find(run.sensors, *sensor, &PlannedSensor::sensor);
      if (at == run.sensors.end()) {
        fault(line_of(value), fmt::format("run.noise: {} is not among run.sensors", leaf));
        continue;
      }
      read_number("run.noise." + leaf, value, "", arm::kPositive, at->noise);
    }
  }

  void read_torque(const toml::table& table, int line, PlannedRun& run) {
    require(table, line, "run.excitation", "excitation",
            "a table, as in { kind = \"multisine\", rms = 0.05, to = 60.0 }");
    require(table, line, "run.duration", "duration", "the length of the run [s]");
    require(table, line, "run.sample_time", "sample_time", "the sampling period [s]");
    if (const auto* node = table.get("torque_hold")) {
      read_value("run.torque_hold", *node, kHolds, run.torque_hold);
    }
    const auto* duration = table.get("duration");
    const auto* period = table.get("sample_time");
    const auto* node = table.get("excitation");
    if (duration != nullptr) {
      read_number("run.duration", *duration, "s", arm::kPositive, run.duration_s);
    }
    if (period != nullptr) {
      read_number("run.sample_time", *period, "s", arm::kPositive, run.sample_time_s);
    }
    const auto excitation = node == nullptr ? std::nullopt : read_excitation(*node);
    if (!excitation || !(run.duration_s > 0.0) || !(run.sample_time_s > 0.0)) return;
    run.torque = *excitation;
    const double samples = run.duration_s / run.sample_time_s;
    if (!(samples >= 2.0 && samples <= kMostPlannedSamples)) {
      fault(line_of(*duration),
            fmt::format("run.duration = {} s at sample_time = {} s: {:.6g} samples; must be from 2 "
                        "to {:g}",
                        run.duration_s, run.sample_time_s, samples, kMostPlannedSamples));
      return;
    }
    try {
      if (response::peak_N_m(torque_of(run)) > 0.0) return;
      fault(line_of(*node), "run.excitation: the torque is zero at all samples");
    } catch (const InputError& error) {
      fault(line_of(*node), fmt::format("run.excitation: {}", error.what()));
    }
  }

  std::optional<response::Excitation> read_excitation(const toml::node& node) {
    const auto* table = node.as_table();
    const auto* kind = table == nullptr ? nullptr : table->get("kind");
    if (kind == nullptr || !kind->is_string()) {
      wrong("run.excitation", node, "a table, as in { kind = \"multisine\", rms = 0.05 }");
      return std::nullopt;
    }
    try {
      auto excitation = response::excitation_of(kind->as_string()->get());
      for (const auto& [name, value] : *table) {
        if (name.str() == "kind") continue;
        std::string text;
        if (const auto* word = value.as_string()) text = word->get();
        if (const auto number = measured::number_of(value)) text = fmt::format("{}", *number);
        response::set_key(excitation, name.str(), text, {"kind"});
      }
      return excitation;
    } catch (const InputError& error) {
      fault(line_of(node), fmt::format("run.excitation: {}", error.what()));
      return std::nullopt;
    }
  }

  void read_frequencies(const toml::table& table, int line, PlannedRun& run) {
    constexpr const char* kWhat = "{ from = 0.5, to = 60.0, count = 200 }, or a list [Hz]";
    require(table, line, "run.frequencies", "frequencies", kWhat);
    const auto* node = table.get("frequencies");
    if (node == nullptr) return;
    if (const auto* list = node->as_array()) {
      std::vector<double> frequencies;
      for (const auto& entry : *list) {
        read_number("run.frequencies", entry, "Hz", arm::kPositive, frequencies.emplace_back());
      }
      const bool ascends = std::ranges::adjacent_find(frequencies, std::ranges::greater_equal{}) ==
                           frequencies.end();
      if (frequencies.empty() || !ascends) {
        fault(line_of(*node), "run.frequencies: must be one or more, ascending");
      }
      run.frequencies = std::move(frequencies);
      return;
    }
    const auto* from_to = node->as_table();
    if (from_to == nullptr) {
      wrong("run.frequencies", *node, kWhat);
      return;
    }
    PlannedBand band;
    for (const auto& [name, value] : *from_to) {
      const std::string leaf = arm::shown(name.str());
      const std::string key = "run.frequencies." + leaf;
      if (leaf == "from") {
        read_number(key, value, "Hz", arm::kPositive, band.from_Hz);
      } else if (leaf == "to") {
        read_number(key, value, "Hz", arm::kPositive, band.to_Hz);
      } else if (leaf == "count") {
        read_count(key, value, 2, kMostPlannedFrequencies, band.count);
      } else {
        unknown("run.frequencies.", leaf, value, {"from", "to", "count"});
      }
    }
    for (const char* leaf : {"from", "to", "count"}) {
      require(*from_to, line_of(*node), "run.frequencies", leaf, kWhat);
    }
    if (band.from_Hz > 0.0 && band.to_Hz > 0.0 && band.to_Hz <= band.from_Hz) {
      fault(line_of(*node), fmt::format("run.frequencies.to = {} Hz: must be above from = {} Hz",
                                        band.to_Hz, band.from_Hz));
    }
    run.frequencies = band;
  }

  MeasurementPlan plan_;
  std::map<std::string, int> line_of_id_;
};

}  // namespace

MeasurementPlan parse_measurement_plan(std::string_view toml, const std::string& file_name) {
  if (toml.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    throw arm::located(InputError("empty; a measurement plan needs at least one [[run]]"),
                       file_name, 1);
  }
  return PlanReader(file_name).read(measured::parse_toml(toml, file_name));
}

MeasurementPlan read_measurement_plan(const std::filesystem::path& path) {
  return measured::read_file_as(measured::FileKind::plan, path, kLargestPlan_bytes,
                                parse_measurement_plan);
}

}  // namespace flexarm::diagnose
