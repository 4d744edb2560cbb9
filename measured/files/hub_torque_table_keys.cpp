#include "measured/files/hub_torque_table_keys.hpp"

#include "arm/given_effects.hpp"
#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"
#include "measured/files/arm_file.hpp"
#include "measured/files/toml_node.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace flexarm::measured {

namespace {

constexpr const char* kAngleKey = "angle_rad";
constexpr const char* kVelocityKey = "velocity_rad_per_s";
constexpr const char* kTorqueKey = "torque_N_m";

int line_in_file(const toml::node& node) {
  return static_cast<int>(node.source().begin.line);
}

class HubTorqueTableReader {
 public:
  explicit HubTorqueTableReader(const FaultAtLine& fault) : fault_(fault) {}

  std::shared_ptr<const arm::EffectDefinition> read(const toml::table& table) {
    static const std::vector<std::string> allowed = {kAngleKey, kVelocityKey, kTorqueKey};
    for (const auto& [leaf, node] : table) {
      const std::string key = fmt::format("{}.{}", whole_, arm::shown(leaf.str()));
      lines_[key] = line_in_file(node);
      if (leaf.str() == kAngleKey) {
        read_numbers(key, node, made_.angle_rad);
      } else if (leaf.str() == kVelocityKey) {
        read_numbers(key, node, made_.velocity_rad_per_s);
      } else if (leaf.str() == kTorqueKey) {
        read_torques(key, node, table.contains(kAngleKey) && table.contains(kVelocityKey));
      } else {
        add_fault(line_in_file(node),
                  fmt::format("{}: unknown key{}; allowed: {}", key,
                              arm::did_you_mean(leaf.str(), allowed), fmt::join(allowed, ", ")));
      }
    }
    if (is_wrong_) return nullptr;
    try {
      return arm::define_effect(made_);
    } catch (const arm::InputError& error) {
      const auto line = lines_.find(error.key());
      add_fault(line == lines_.end() ? line_in_file(table) : line->second, error.what());
      return nullptr;
    }
  }

 private:
  void add_fault(int line, const std::string& what) {
    fault_(line, what);
    is_wrong_ = true;
  }

  void wrong(const std::string& key, const toml::node& node, std::string_view allowed) {
    add_fault(line_in_file(node),
              fmt::format("{}{}: {}; must be {}", key, equals_value(node), kind_of(node), allowed));
  }

  /// Appends a list of numbers; false, with a fault, where it is none.
  bool read_numbers(const std::string& key, const toml::node& node, std::vector<double>& numbers) {
    const auto* list = node.as_array();
    if (list == nullptr || list->empty()) {
      wrong(key, node, "a list of numbers");
      return false;
    }
    for (const auto& element : *list) {
      const auto number = number_of(element);
      if (!number) {
        wrong(key, element, "a list of numbers");
        return false;
      }
      numbers.push_back(*number);
    }
    return true;
  }

  void read_torques(const std::string& key, const toml::node& node, bool is_of_both) {
    if (!is_of_both) {
      read_numbers(key, node, made_.torque_N_m);
      return;
    }
    constexpr std::string_view kForm =
        "a list with a list for each angle, of the torques at the velocities";
    const auto* rows = node.as_array();
    if (rows == nullptr || rows->empty() || !rows->is_homogeneous<toml::array>()) {
      wrong(key, node, kForm);
      return;
    }
    const std::size_t columns = rows->front().as_array()->size();
    for (const auto& row : *rows) {
      if (row.as_array()->size() != columns) {
        add_fault(line_in_file(row),
                  fmt::format("{}: {} torques at one angle, {} at the first; must be as many", key,
                              row.as_array()->size(), columns));
        return;
      }
      if (!read_numbers(key, row, made_.torque_N_m)) return;
    }
  }

  const FaultAtLine& fault_;
  std::string whole_ = fmt::format("effects.{}", arm::kHubTorqueTable);
  std::map<std::string, int> lines_;
  arm::HubTorqueTable made_;
  bool is_wrong_ = false;
};

std::string list_of(std::span<const double> numbers) {
  std::vector<std::string> texts;
  for (const double number : numbers) texts.push_back(toml_number(number));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

}  // namespace

std::shared_ptr<const arm::EffectDefinition> read_hub_torque_table(const toml::table& table,
                                                                   const FaultAtLine& fault) {
  return HubTorqueTableReader(fault).read(table);
}

std::string format_hub_torque_table(const arm::HubTorqueTable& table) {
  std::string out = fmt::format("\n[effects.{}]\n", arm::kHubTorqueTable);
  if (!table.angle_rad.empty())
    out += fmt::format("{} = {}\n", kAngleKey, list_of(table.angle_rad));
  if (!table.velocity_rad_per_s.empty()) {
    out += fmt::format("{} = {}\n", kVelocityKey, list_of(table.velocity_rad_per_s));
  }
  if (table.angle_rad.empty() || table.velocity_rad_per_s.empty()) {
    return out + fmt::format("{} = {}\n", kTorqueKey, list_of(table.torque_N_m));
  }
  std::vector<std::string> rows;
  for (std::size_t i = 0; i < table.angle_rad.size(); ++i) {
    rows.push_back(
        "  " + list_of(std::span(table.torque_N_m).subspan(i * table.columns(), table.columns())));
  }
  return out + fmt::format("{} = [\n{}\n]\n", kTorqueKey, fmt::join(rows, ",\n"));
}

}  // namespace flexarm::measured
