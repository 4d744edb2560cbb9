#include "measured/files/measurement.hpp"

#include "arm/input_error.hpp"
#include "measured/files/controller_keys.hpp"
#include "measured/files/file_kind.hpp"
#include "measured/files/payload_keys.hpp"
#include "measured/files/text_file.hpp"
#include "measured/files/time_record.hpp"
#include "measured/files/toml_document.hpp"
#include "measured/files/toml_faults.hpp"
#include "measured/files/toml_node.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <type_traits>
#include <utility>

namespace flexarm::measured {

namespace {

using arm::InputError;

constexpr std::size_t kLargestMeasurement_bytes = 1 << 20;

template <class T>
using Words = std::array<std::pair<T, const char*>, 2>;

constexpr std::array<std::pair<RunKind, const char*>, 3> kKinds = {
    {{RunKind::time, "time"}, {RunKind::frf, "frf"}, {RunKind::modal, "modal"}}};
constexpr Words<Purpose> kPurposes = {
    {{Purpose::estimation, "estimation"}, {Purpose::validation, "validation"}}};
constexpr Words<TorqueHold> kHolds = {{{TorqueHold::zero, "zero"}, {TorqueHold::first, "first"}}};
constexpr Words<InitialState> kInitials = {
    {{InitialState::rest, "rest"}, {InitialState::free, "free"}}};

template <class Table, class T>
std::string_view word_of(const Table& table, T value) {
  for (const auto& [entry, word] : table) {
    if (entry == value) return word;
  }
  return "";
}

const std::vector<std::string> kTopKeys = {"name", "arm", "run"};
const std::vector<std::string> kRunKeys = {"id",          "kind",      "file",    "purpose",
                                           "torque_hold", "payload",   "initial", "columns",
                                           "reference",   "controller"};
const std::vector<std::string> kColumnKeys = {"name", "expression", "unit", "scale"};

class MeasurementReader : measured::TomlFaults {
 public:
  explicit MeasurementReader(const std::string& file_name) : TomlFaults(file_name) {}

  Measurement read(const toml::table& document) {
    for (const auto& [key, node] : document) read_top_level(arm::shown(key.str()), node);
    require(document, 1, "run", "run", "at least one [[run]]");
    throw_first();
    return std::move(measurement_);
  }

 private:
  void read_top_level(const std::string& key, const toml::node& node) {
    if (key == "name") {
      if (const auto* text = node.as_string()) {
        measurement_.name = text->get();
      } else {
        wrong(key, node, "a quoted string");
      }
    } else if (key == "arm") {
      read_file(key, node, measurement_.arm);
    } else if (key == "run") {
      read_runs(node);
    } else {
      unknown("", key, node, kTopKeys);
    }
  }

  void read_runs(const toml::node& node) {
    const auto* runs = node.as_array();
    if (runs == nullptr || runs->empty() || !runs->is_homogeneous<toml::table>()) {
      wrong("run", node, "one [[run]] table per run");
      return;
    }
    for (const auto& run : *runs) measurement_.runs.push_back(read_run(*run.as_table()));
  }

  Run read_run(const toml::table& table) {
    Run run;
    for (const auto& [name, node] : table) {
      const std::string leaf = arm::shown(name.str());
      const std::string key = "run." + leaf;
      if (leaf == "id") {
        read_id(node, run);
      } else if (leaf == "kind") {
        read_value(key, node, kKinds, run.kind);
      } else if (leaf == "file") {
        read_file(key, node, run.file);
      } else if (leaf == "purpose") {
        run.purpose = Purpose::estimation;
        read_value(key, node, kPurposes, *run.purpose);
      } else if (leaf == "torque_hold") {
        read_value(key, node, kHolds, run.torque_hold);
      } else if (leaf == "initial") {
        read_value(key, node, kInitials, run.initial);
      } else if (leaf == "payload") {
        run.payload = read_payload(*this, node);
      } else if (leaf == "columns") {
        run.columns = read_columns(node);
      } else if (leaf == "controller") {
        run.controller = read_controller(*this, "run.controller.", node);
      } else if (leaf != "reference") {
        unknown("run.", leaf, node, kRunKeys);
      }
    }
    run.torque_hold_is_known = run.kind != RunKind::time || table.contains("torque_hold");
    if (!run.columns.empty() && run.kind != RunKind::time) {
      fault(line_of(*table.get("columns")), "run.columns: only for time runs");
    }
    read_loop(table, run);
    const int line = line_of(table);
    require(table, line, "run.id", "id", "a quoted name");
    require(table, line, "run.kind", "kind", "\"time\", \"frf\" or \"modal\"");
    require(table, line, "run.file", "file", "the run's CSV file, relative to this file");
    return run;
  }

  /// The reference of a closed loop, and what else must hold for it; the controller has been read.
  void read_loop(const toml::table& table, Run& run) {
    const auto* reference = table.get("reference");
    const auto* controller = table.get("controller");
    if (reference == nullptr && controller == nullptr) return;
    const auto* first = controller == nullptr ? reference : controller;
    if (run.kind != RunKind::time) {
      fault(line_of(*first), fmt::format("run.{}: only for time runs",
                                         controller == nullptr ? "reference" : "controller"));
      return;
    }
    if (controller == nullptr || reference == nullptr) {
      fault(line_of(*first),
            controller == nullptr
                ? fmt::format("run.reference{}: needs a controller, as in controller = {{ sensor = "
                              "\"hub_angle\", kp = 2.5, kd = 0.1 }}",
                              measured::equals_value(*reference))
                : "run.controller: needs the column with its reference, as in reference = "
                  "\"reference\"");
      return;
    }
    read_reference(*reference, run);
    if (run.torque_hold == TorqueHold::first) {
      fault(line_of(*table.get("torque_hold")),
            "run.torque_hold = \"first\": must be \"zero\" where a controller made the torque, "
            "which it holds between its samples");
    }
    run.torque_hold_is_known = true;
  }

  void read_reference(const toml::node& node, Run& run) {
    constexpr const char* kKey = "run.reference";
    if (run.columns.empty()) {
      run.reference.emplace();
      read_text(kKey, node, "the quoted name of a column", run.reference->name);
      if (!run.reference->name.empty() && run.reference->name != kReferenceColumn) {
        fault(line_of(node), fmt::format("{} = \"{}\": not a column of a time record; must be "
                                         "\"{}\", which is reference [UNIT] in its header",
                                         kKey, arm::shown(run.reference->name), kReferenceColumn));
      }
      return;
    }
    if (run.controller->sensors.empty()) return;  // which is a fault of its own
    const std::string sensor = arm::to_string(run.controller->sensors.front());
    if (node.is_table()) {
      run.reference = read_mapping(kKey, sensor, node);
      return;
    }
    const auto of_sensor = run.columns.find(sensor);
    run.reference = of_sensor == run.columns.end() ? ColumnMapping() : of_sensor->second;
    run.reference->name.clear();
    run.reference->expression.clear();
    read_text(kKey, node,
              "the quoted name of a column, or a table, as in { name = \"Cmd\", unit = "
              "\"deg\" }",
              run.reference->name);
  }

  void read_id(const toml::node& node, Run& run) {
    const auto* text = node.as_string();
    if (text == nullptr || text->get().empty()) {
      wrong("run.id", node, "a quoted name");
      return;
    }
    run.id = text->get();
    const auto [first, is_new] = line_of_id_.emplace(run.id, line_of(node));
    if (!is_new) {
      fault(line_of(node), fmt::format("run.id{}: given twice; first on line {}",
                                       measured::equals_value(node), first->second));
    }
  }

  void read_file(const std::string& key, const toml::node& node, std::string& file) {
    read_text(key, node, "a quoted file name", file);
  }

  /// The value that a word of the file stands for.
  template <class Table, class T>
  void read_value(const std::string& key, const toml::node& node, const Table& table, T& value) {
    std::vector<std::string> words;
    for (const auto& [entry, word] : table) words.emplace_back(word);
    if (const auto at = read_word(key, node, words)) value = table[*at].first;
  }

  ColumnMappings read_columns(const toml::node& node) {
    ColumnMappings columns;
    const auto* table = node.as_table();
    if (table == nullptr || table->empty()) {
      wrong("run.columns", node, "a table, as in { torque = { name = \"Vm\", unit = \"N m\" } }");
      return columns;
    }
    for (const auto& [key, value] : *table) {
      const std::string full_key = "run.columns." + arm::shown(key.str());
      try {
        const std::string name = standard_name(key.str());
        if (const auto mapping = read_mapping(full_key, name, value);
            mapping && !columns.emplace(name, *mapping).second) {
          fault(line_of(value), fmt::format("{}: {} is given twice", full_key, name));
        }
      } catch (const InputError& error) {
        fault(line_of(value), fmt::format("run.columns: {}", error.what()));
      }
    }
    return columns;
  }

  std::optional<ColumnMapping> read_mapping(const std::string& key, const std::string& name,
                                            const toml::node& node) {
    const auto* table = node.as_table();
    if (table == nullptr) {
      wrong(key, node, "a table, as in { name = \"Time (ms)\", unit = \"ms\", scale = 1.0 }");
      return std::nullopt;
    }
    ColumnMapping mapping;
    bool is_whole = true;
    const auto take = [&](const std::string& leaf, const toml::node& value, auto& member,
                          const char* what) {
      using Member = std::remove_reference_t<decltype(member)>;
      const bool fits = std::is_same_v<Member, double> ? value.is_number() : value.is_string();
      if (fits) {
        member = *value.value<Member>();
      } else {
        is_whole = false;
        wrong(key + "." + leaf, value, what);
      }
    };
    for (const auto& [leaf_key, value] : *table) {
      const std::string leaf = arm::shown(leaf_key.str());
      if (leaf == "name") {
        take(leaf, value, mapping.name, "a quoted column name");
      } else if (leaf == "expression") {
        take(leaf, value, mapping.expression, "a quoted formula of columns");
      } else if (leaf == "unit") {
        take(leaf, value, mapping.unit, "a quoted unit");
      } else if (leaf == "scale") {
        take(leaf, value, mapping.scale, "a finite number, not 0");
      } else {
        is_whole = false;
        unknown(key + ".", leaf, value, kColumnKeys);
      }
    }
    if (!is_whole) return std::nullopt;
    try {
      require_valid(name, mapping, table->contains("scale"));
      if (!table->contains("scale")) {
        mapping.scale = scale_of_unit(name, mapping.unit);
      } else if (unit_of(name, mapping.unit) &&
                 repeats_conversion(name, mapping.unit, mapping.scale)) {
        throw InputError(fmt::format(
            "scale = {:.6g}: the factor of unit {}, which is applied already; leave scale out",
            mapping.scale, mapping.unit));
      } else if (const double of_unit = scale_of_unit(name, mapping.unit);
                 of_unit != 1.0 && !repeats_conversion(name, mapping.unit, mapping.scale)) {
        throw InputError(
            fmt::format("scale = {0:.6g}: in {1}, or from {1} to {2}; write unit = \"{2}\", with "
                        "scale = {3:.9g} if it is in {1}, {0:.9g} if not",
                        mapping.scale, mapping.unit, si_unit_of(name), mapping.scale * of_unit));
      }
    } catch (const InputError& error) {
      fault(line_of(node), fmt::format("{}.{}", key, error.what()));
      return std::nullopt;
    }
    return mapping;
  }

  Measurement measurement_;
  std::map<std::string, int> line_of_id_;
};

}  // namespace

std::string_view to_string(RunKind kind) {
  return word_of(kKinds, kind);
}

std::string_view to_string(Purpose purpose) {
  return word_of(kPurposes, purpose);
}

std::string_view to_string(TorqueHold hold) {
  return word_of(kHolds, hold);
}

std::string_view to_string(InitialState initial) {
  return word_of(kInitials, initial);
}

Measurement parse_measurement(std::string_view toml, const std::string& file_name) {
  if (toml.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    throw arm::located(InputError("empty; a measurement file needs at least one [[run]]"),
                       file_name, 1);
  }
  return MeasurementReader(file_name).read(measured::parse_toml(toml, file_name));
}

Measurement read_measurement(const std::filesystem::path& path) {
  return read_file_as(FileKind::measurement, path, kLargestMeasurement_bytes, parse_measurement);
}

int line_of_run_key(const std::filesystem::path& measurement_file, const std::string& run_id,
                    const std::string& key) {
  const std::string text = measured::read_text_file(measurement_file, kLargestMeasurement_bytes);
  const toml::table document = measured::parse_toml(text, measurement_file.string());
  const auto* runs = document.get_as<toml::array>("run");
  for (std::size_t i = 0; runs != nullptr && i < runs->size(); ++i) {
    const auto* run = (*runs)[i].as_table();
    if (run == nullptr || run->at_path("id").value<std::string>() != run_id) continue;
    std::string path = key;
    while (true) {
      if (const auto* node = run->at_path(path).node()) return TomlFaults::line_of(*node);
      const auto dot = path.rfind('.');
      if (dot == std::string::npos) return TomlFaults::line_of(*run);
      path.resize(dot);
    }
  }
  return 0;
}

std::filesystem::path arm_file_of(const std::filesystem::path& measurement_file,
                                  const Measurement& measurement) {
  if (measurement.arm.empty()) {
    throw arm::located(
        InputError("arm: missing; must be the arm file, relative to this file (flexarm identify "
                   "alone needs none)",
                   "arm"),
        arm::shown(measurement_file.string()), 1);
  }
  return beside(measurement_file, measurement.arm);
}

std::vector<std::filesystem::path> files_of(const std::filesystem::path& measurement_file,
                                            const Measurement& measurement) {
  std::vector<std::filesystem::path> files = {measurement_file};
  if (!measurement.arm.empty()) files.push_back(beside(measurement_file, measurement.arm));
  for (const Run& run : measurement.runs) files.push_back(beside(measurement_file, run.file));
  return files;
}

std::filesystem::path beside(const std::filesystem::path& measurement_file,
                             const std::string& file) {
  return measurement_file.parent_path() / file;
}

}  // namespace flexarm::measured
