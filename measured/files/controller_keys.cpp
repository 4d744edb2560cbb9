#include "measured/files/controller_keys.hpp"

#include "arm/input_error.hpp"
#include "arm/number.hpp"
#include "measured/files/arm_file.hpp"
#include "measured/files/file_kind.hpp"
#include "measured/files/key_values.hpp"
#include "measured/files/toml_document.hpp"
#include "measured/files/toml_node.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace flexarm::measured {

namespace {

using arm::InputError;
using Rows = arm::StateSpaceController::Rows;

constexpr std::size_t kLargestControllerFile_bytes = 1 << 20;

const std::vector<std::string> kControllerKeys = {"sensor", "kp", "kd", "ki",    "derivative", "A",
                                                  "B",      "C",  "D",  "limit", "sample_time"};
constexpr std::array kGains = {"kp", "kd", "ki", "derivative"};
constexpr std::array kMatrices = {"A", "B", "C", "D"};
const std::vector<std::string> kDerivatives = {"error", "measurement"};

/// Reads the table of a controller once.
class ControllerReader {
 public:
  ControllerReader(TomlFaults& faults, const std::string& prefix, const toml::table& table)
      : faults_(&faults), prefix_(&prefix), table_(&table) {}

  arm::Controller read() {
    for (const auto& [key, value] : *table_) {
      const std::string leaf = arm::shown(key.str());
      if (std::ranges::count(kControllerKeys, leaf) == 0) {
        faults_->unknown(*prefix_, leaf, value, kControllerKeys);
      }
    }
    const std::string gain = first_of(kGains);
    const std::string matrix = first_of(kMatrices);
    if (!gain.empty() && !matrix.empty()) {
      fault(matrix, fmt::format(": not together with {}; allowed: kp, kd, ki, derivative, or A, B, "
                                "C, D",
                                gain));
      return {};
    }
    if (gain.empty() && matrix.empty()) {
      faults_->fault(TomlFaults::line_of(*table_),
                     fmt::format("{}kp: missing; needs one or more of the gains kp, kd, ki, or the "
                                 "matrices A, B, C, D",
                                 *prefix_));
      return {};
    }
    arm::Controller controller;
    read_sensors(controller.sensors);
    if (controller.sensors.empty()) return controller;
    read_optional("limit", "N m", arm::kPositive, controller.limit_N_m);
    read_optional("sample_time", "s", arm::kPositive, controller.sample_time_s);
    if (matrix.empty()) {
      read_gains(controller);
    } else if (!read_matrices(controller)) {
      return controller;
    }
    try {
      arm::require_valid(controller);
    } catch (const InputError& error) {
      const auto* node = table_->get(error.key());
      faults_->fault(TomlFaults::line_of(node == nullptr ? *table_ : *node),
                     *prefix_ + error.what());
    }
    return controller;
  }

 private:
  void fault(const std::string& leaf, const std::string& what) {
    faults_->fault(TomlFaults::line_of(*table_->get(leaf)), *prefix_ + leaf + what);
  }

  /// The first of `keys` that the table has; empty where it has none.
  std::string first_of(const std::array<const char*, 4>& keys) const {
    const auto found =
        std::ranges::find_if(keys, [&](const char* key) { return table_->contains(key); });
    return found == keys.end() ? "" : *found;
  }

  /// Leaves no sensor, with a fault, where they cannot be read.
  void read_sensors(std::vector<arm::Sensor>& sensors) {
    const auto* node = table_->get("sensor");
    if (node == nullptr) {
      sensors = {{arm::SensorKind::hub_angle}};
      return;
    }
    std::vector<const toml::node*> names = {node};
    if (const auto* list = node->as_array()) {
      names.clear();
      for (const auto& name : *list) names.push_back(&name);
      if (names.empty()) fault("sensor", " = []: must be one or more sensors");
    }
    for (const auto* name : names) {
      const auto* text = name->as_string();
      if (text == nullptr) {
        faults_->wrong(*prefix_ + "sensor", *name,
                       "a quoted sensor name, e.g. \"hub_angle\"; a list of them with A, B, C, D");
        sensors.clear();
        return;
      }
      try {
        sensors.push_back(arm::parse_sensor(text->get()));
      } catch (const InputError& error) {
        fault("sensor", fmt::format(": {}", error.what()));
        sensors.clear();
        return;
      }
    }
  }

  void read_optional(const char* leaf, const char* unit, const arm::Range& range,
                     std::optional<double>& number) {
    const auto* node = table_->get(leaf);
    if (node == nullptr) return;
    number = 1.0;
    faults_->read_number(*prefix_ + leaf, *node, unit, range, *number);
  }

  void read_gain(const char* leaf, const std::string& unit, double& gain) {
    const auto* node = table_->get(leaf);
    if (node == nullptr) return;
    faults_->read_number(*prefix_ + leaf, *node, unit.c_str(), arm::kAnyFinite, gain);
  }

  void read_gains(arm::Controller& controller) {
    const std::string unit(arm::unit(controller.sensors.front()));
    arm::PidController law;
    read_gain("kp", fmt::format("N m/({})", unit), law.kp);
    read_gain("kd", fmt::format("N m s/({})", unit), law.kd);
    read_gain("ki", fmt::format("N m/(({}) s)", unit), law.ki);
    if (const auto* node = table_->get("derivative")) {
      if (const auto at = faults_->read_word(*prefix_ + "derivative", *node, kDerivatives)) {
        law.derivative = *at == 0 ? arm::PidController::Derivative::error
                                  : arm::PidController::Derivative::measurement;
      }
    }
    controller.law = law;
  }

  bool read_matrices(arm::Controller& controller) {
    arm::StateSpaceController law;
    const bool is_whole = read_matrix("A", law.a) && read_matrix("B", law.b) &&
                          read_matrix("C", law.c) && read_matrix("D", law.d);
    controller.law = std::move(law);
    return is_whole;
  }

  /// False, with a fault, for what is no matrix; one that is not there is left as it is.
  bool read_matrix(const char* leaf, Rows& matrix) {
    const auto* node = table_->get(leaf);
    if (node == nullptr) return true;
    constexpr const char* kAllowed = "a list of rows of numbers, as in [[0.9, 0.0], [0.1, 1.0]]";
    const auto* list = node->as_array();
    bool is_matrix = list != nullptr;
    Rows rows;
    for (std::size_t i = 0; is_matrix && i < list->size(); ++i) {
      const auto* numbers = (*list)[i].as_array();
      is_matrix = numbers != nullptr;
      rows.emplace_back();
      for (std::size_t j = 0; is_matrix && j < numbers->size(); ++j) {
        const auto number = number_of((*numbers)[j]);
        is_matrix = number.has_value();
        rows.back().push_back(number.value_or(0.0));
      }
    }
    if (!is_matrix) {
      faults_->wrong(*prefix_ + leaf, *node, kAllowed);
      return false;
    }
    matrix = std::move(rows);
    return true;
  }

  TomlFaults* faults_;
  const std::string* prefix_;
  const toml::table* table_;
};

arm::Controller parse_controller(std::string_view toml, const std::string& file_name) {
  TomlFaults faults(file_name);
  const toml::table document = parse_toml(toml, file_name);
  arm::Controller controller = ControllerReader(faults, "", document).read();
  faults.throw_first();
  return controller;
}

std::string format_rows(const Rows& rows) {
  std::vector<std::string> texts;
  for (const auto& row : rows) {
    std::vector<std::string> numbers;
    for (const double value : row) numbers.push_back(toml_number(value));
    texts.push_back(fmt::format("[{}]", fmt::join(numbers, ", ")));
  }
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

}  // namespace

arm::Controller read_controller(TomlFaults& faults, const std::string& prefix,
                                const toml::node& node) {
  if (const auto* table = node.as_table()) return ControllerReader(faults, prefix, *table).read();
  faults.wrong(prefix.substr(0, prefix.size() - 1), node,
               "a table, as in { sensor = \"hub_angle\", kp = 2.5, kd = 0.1 }");
  return {};
}

arm::Controller read_controller_file(const std::filesystem::path& path) {
  return read_file_as(FileKind::controller, path, kLargestControllerFile_bytes, parse_controller);
}

arm::Controller parse_controller_keys(std::string_view text, const std::string& where) {
  KeyValues keys;
  try {
    keys = read_key_values(text, "KEY=VALUE, separated by commas, or a TOML file");
  } catch (const InputError& error) {
    throw arm::located(error, where, 0);
  }
  toml::table table;
  for (const auto& [key, value] : keys) {
    if (const auto number = arm::parse_number<double>(value)) {
      table.insert(key, *number);
    } else {
      table.insert(key, value);
    }
  }
  TomlFaults faults(where);
  arm::Controller controller = ControllerReader(faults, "", table).read();
  faults.throw_first();
  return controller;
}

std::string format_controller(const arm::Controller& controller) {
  std::vector<std::string> keys;
  const auto add = [&](const char* key, const std::string& value) {
    keys.push_back(fmt::format("{} = {}", key, value));
  };
  std::vector<std::string> sensors;
  for (const auto& sensor : controller.sensors) {
    sensors.push_back(toml_string(arm::to_string(sensor)));
  }
  add("sensor",
      sensors.size() == 1 ? sensors.front() : fmt::format("[{}]", fmt::join(sensors, ", ")));
  if (const auto* law = std::get_if<arm::PidController>(&controller.law)) {
    if (law->kp != 0.0) add("kp", toml_number(law->kp));
    if (law->kd != 0.0) add("kd", toml_number(law->kd));
    if (law->ki != 0.0) add("ki", toml_number(law->ki));
    if (law->derivative == arm::PidController::Derivative::measurement) {
      add("derivative", "\"measurement\"");
    }
  } else {
    const auto& matrices = std::get<arm::StateSpaceController>(controller.law);
    if (!matrices.a.empty()) {
      add("A", format_rows(matrices.a));
      add("B", format_rows(matrices.b));
      add("C", format_rows(matrices.c));
    }
    add("D", format_rows(matrices.d));
  }
  if (controller.limit_N_m) add("limit", toml_number(*controller.limit_N_m));
  if (controller.sample_time_s) add("sample_time", toml_number(*controller.sample_time_s));
  return fmt::format("{{ {} }}", fmt::join(keys, ", "));
}

}  // namespace flexarm::measured
