#include "measured/files/arm_file.hpp"

#include "arm/arm_keys.hpp"
#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"
#include "arm/uncertainties.hpp"
#include "measured/files/hub_torque_table_keys.hpp"
#include "measured/files/stated_effect.hpp"
#include "measured/files/toml_document.hpp"
#include "measured/files/toml_node.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

namespace flexarm::measured {

namespace {

std::vector<std::string> leaves_of(const std::string& table) {
  std::vector<std::string> leaves;
  for (const auto& key : arm::arm_keys()) {
    if (key.table == table) leaves.push_back(key.leaf);
  }
  return leaves;
}

/// " (did you mean ...?)" for the unknown key `typed` of `table`, or "". It may be the symbol of
/// the equations, right but in another table, or misspelt.
std::string meant(const std::string& table, const std::string& typed,
                  const std::vector<std::string>& allowed, const arm::Vocabulary& vocabulary) {
  std::vector<std::string> names;
  for (const auto& key : arm::arm_keys()) {
    if (key.table == table && key.symbol == typed) names.push_back(key.leaf);
    if (key.leaf == typed) names.push_back(key.name());
  }
  if (arm::find_effect(vocabulary, typed) != nullptr) names.push_back("effects." + typed);
  return names.empty() ? arm::did_you_mean(typed, allowed)
                       : fmt::format(" (did you mean {}?)", fmt::join(names, " or "));
}

/// Walks a document once; keeps the line of every key, so that later faults find theirs.
class Reader {
 public:
  Reader(const std::string& file_name, const arm::Vocabulary& vocabulary)
      : file_name_(file_name), vocabulary_(vocabulary) {}

  arm::Arm read(const toml::table& document) {
    for (const auto& [key, node] : document) read_top_level(arm::shown(key.str()), node);
    throw_first_fault();
    require_all_given();
    throw_first_fault();
    try {
      arm::require_valid(arm_);
    } catch (const arm::InputError& error) {
      throw located(error, file_name_, line_of(error.key()));
    }
    return arm_;
  }

 private:
  void fault(const std::string& key, const std::string& what) {
    faults_.emplace(line_of(key), key + what);
  }

  FaultAtLine by_line() {
    return [this](int line, const std::string& what) { faults_.emplace(line, what); };
  }

  void wrong_type(const std::string& key, const toml::node& node, const std::string& allowed) {
    fault(key, fmt::format("{}: {}; must be {}", equals_value(node), kind_of(node), allowed));
  }

  void read_top_level(const std::string& name, const toml::node& node) {
    note_line(name, node);
    if (name == "name") {
      if (const auto* text = node.as_string()) {
        arm_.name = text->get();
      } else {
        wrong_type(name, node, "a quoted string");
      }
    } else if (name == "effects" || std::ranges::count(arm::arm_tables(), name) > 0) {
      const auto* table = node.as_table();
      if (table == nullptr) {
        wrong_type(name, node, fmt::format("a table: a line [{}], then its keys", name));
      } else if (name == "effects") {
        for (const auto& [key, effect] : *table) read_effect(arm::shown(key.str()), effect);
      } else {
        for (const auto& [key, value] : *table) read_number(name, arm::shown(key.str()), value);
      }
    } else {
      std::vector<std::string> names = {"name"};
      names.insert(names.end(), arm::arm_tables().begin(), arm::arm_tables().end());
      names.emplace_back("effects");
      fault(name,
            fmt::format(": unknown {}{}; allowed: name, [{}], [effects.NAME]",
                        node.is_table() ? "table" : "key", meant("", name, names, vocabulary_),
                        fmt::join(arm::arm_tables(), "], [")));
    }
  }

  void read_number(const std::string& table, const std::string& leaf, const toml::node& node) {
    const std::string name = table + "." + leaf;
    note_line(name, node);
    const auto key = std::ranges::find(arm::arm_keys(), name, &arm::ArmKey::name);
    const bool is_uncertainty = leaf.ends_with(arm::kUncertaintySuffix);
    const std::string of = is_uncertainty
                               ? name.substr(0, name.size() - arm::kUncertaintySuffix.size())
                               : std::string();
    if (std::ranges::find(arm::arm_keys(), of, &arm::ArmKey::name) != arm::arm_keys().end()) {
      if (const auto value = number(name, node, arm::kNotNegative, "")) {
        arm_.relative_uncertainties[of] = *value;
      }
    } else if (key == arm::arm_keys().end()) {
      const auto leaves = leaves_of(table);
      auto meant_leaves = leaves;
      if (is_uncertainty) {
        for (std::string& meant_leaf : meant_leaves) meant_leaf += arm::kUncertaintySuffix;
      }
      fault(name, fmt::format(": unknown key{}; allowed in [{}]: {}{}",
                              meant(table, leaf, meant_leaves, vocabulary_), table,
                              fmt::join(leaves, ", "),
                              is_uncertainty ? ", and each followed by _uncertainty" : ""));
    } else if (const auto value = number(name, node, key->range, key->unit)) {
      key->set(arm_, *value);
    }
  }

  void read_effect(const std::string& name, const toml::node& node) {
    const std::string key = "effects." + name;
    note_line(key, node);
    const auto definition = arm::find_effect(vocabulary_, name);
    const auto* table = node.as_table();
    if (name == arm::kHubTorqueTable) {
      if (table == nullptr) {
        wrong_type(key, node, "a table with angle_rad, velocity_rad_per_s or both, and torque_N_m");
      } else if (const auto read = read_hub_torque_table(*table, by_line())) {
        arm_.effects[name] = {.definition = read};
      }
      return;
    }
    if (table != nullptr && table->contains(kStatedLawKey)) {
      read_stated(name, *table, definition != nullptr);
      return;
    }
    if (definition == nullptr) {
      fault(key, ": " + arm::unknown_effect(vocabulary_, name) +
                     "; a law of your own needs the key hub_torque");
      return;
    }
    if (table == nullptr) {
      std::vector<std::string> parameters;
      for (const auto& parameter : definition->parameters) parameters.push_back(parameter.name);
      wrong_type(
          key, node,
          fmt::format("a table: a line [{}], then its keys {}", key, fmt::join(parameters, ", ")));
      return;
    }
    arm::Effect& effect = arm_.effects[name];
    effect.definition = definition;
    for (const auto& [leaf, value] : *table) {
      read_parameter(*definition, arm::shown(leaf.str()), value, effect);
    }
  }

  /// A law of the user's own: an effect where every number has a value, a hypothesis where one has
  /// a range, or both.
  void read_stated(const std::string& name, const toml::table& table, bool is_of_library) {
    const std::string key = "effects." + name;
    if (is_of_library) {
      note_line(key + "." + kStatedLawKey, *table.get(kStatedLawKey));
      fault(key + "." + kStatedLawKey,
            fmt::format(": {} is an effect of the library; a law of your own needs another name",
                        name));
      return;
    }
    const auto stated = read_stated_effect(name, table, by_line());
    if (!stated) return;
    const auto& formula = std::get<arm::HubTorqueFormula>(stated->definition->given);
    if (stated->values.size() == formula.numbers.size()) {
      arm_.effects[name] = {.definition = stated->definition, .parameters = stated->values};
    }
    if (stated->ranges.empty()) return;
    arm::HubTorqueHypothesis hypothesis{formula, stated->ranges, stated->values};
    std::erase_if(hypothesis.known,
                  [&](const auto& value) { return hypothesis.ranges.contains(value.first); });
    arm_.hypotheses[name] = std::move(hypothesis);
  }

  void read_parameter(const arm::EffectDefinition& definition, const std::string& leaf,
                      const toml::node& node, arm::Effect& effect) {
    const std::string key = "effects." + definition.name + "." + leaf;
    note_line(key, node);
    if (leaf == "sensor" && definition.sensor) {
      if (const auto* text = node.as_string(); text != nullptr && !text->get().empty()) {
        effect.sensor = text->get();
      } else {
        wrong_type(key, node, "a quoted sensor name, e.g. \"tip_acceleration\"");
      }
      return;
    }
    const auto parameter =
        std::ranges::find(definition.parameters, leaf, &arm::EffectParameter::name);
    if (parameter == definition.parameters.end()) {
      effect.parameters[leaf] = 0.0;  // arm::require_valid(arm::Effects) names it
    } else if (const auto value = number(key, node, parameter->range, parameter->unit)) {
      effect.parameters[leaf] = *value;
    }
  }

  std::optional<double> number(const std::string& key, const toml::node& node,
                               const arm::Range& range, const std::string& unit) {
    const auto value = number_of(node);
    if (!value) {
      wrong_type(key, node,
                 fmt::format("{} [{}]{}", to_string(range), unit,
                             node.is_string() ? ", without quotes or unit" : ""));
      return std::nullopt;
    }
    if (range.contains(*value)) return value;
    faults_.emplace(line_of(key), arm::out_of_range(key, *value, unit, to_string(range)).what());
    return std::nullopt;
  }

  void require_all_given() {
    for (const auto& key : arm::arm_keys()) {
      const bool is_left_out = key.table == "beam" && !lines_.contains("beam");
      if (!key.required || is_left_out || lines_.contains(key.name())) continue;
      fault(key.name(), fmt::format(": missing; must be {} [{}]", to_string(key.range), key.unit));
    }
  }

  void throw_first_fault() const {
    if (faults_.empty()) return;
    const auto& [line, what] = *faults_.begin();
    throw located(arm::InputError(what), file_name_, line);
  }

  void note_line(const std::string& key, const toml::node& node) {
    lines_[key] = static_cast<int>(node.source().begin.line);
  }

  /// The line of a key, else of the table that it belongs in, else the first.
  int line_of(std::string key) const {
    while (true) {
      if (const auto line = lines_.find(key); line != lines_.end()) return line->second;
      const auto dot = key.rfind('.');
      if (dot == std::string::npos) return 1;
      key.resize(dot);
    }
  }

  std::string file_name_;
  const arm::Vocabulary& vocabulary_;
  arm::Arm arm_;
  std::map<std::string, int> lines_;
  std::multimap<int, std::string> faults_;  // by line; equal lines in the order found
};

}  // namespace

arm::Arm parse_arm(std::string_view toml, const std::string& file_name,
                   const arm::Vocabulary& vocabulary) {
  if (toml.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    throw located(arm::InputError("empty; an arm file needs at least [hub], and [beam] unless it "
                                  "is a rigid hub; flexarm new writes an example"),
                  file_name, 1);
  }
  return Reader(file_name, vocabulary).read(parse_toml(toml, file_name));
}

}  // namespace flexarm::measured
