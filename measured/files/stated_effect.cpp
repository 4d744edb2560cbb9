#include "measured/files/stated_effect.hpp"

#include "arm/ascii.hpp"
#include "arm/given_effects.hpp"
#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"
#include "measured/files/arm_file.hpp"
#include "measured/files/toml_node.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

namespace flexarm::measured {

namespace {

using std::string;

constexpr const char* kNumberForm =
    "a finite number, or a table { value = NUMBER, range = [LOWEST, HIGHEST], unit = \"UNIT\" }";

int line_of_node(const toml::node& node) {
  return static_cast<int>(node.source().begin.line);
}

std::optional<double> finite_number(const toml::node& node) {
  const auto value = number_of(node);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

class StatedEffectReader {
 public:
  StatedEffectReader(const string& name, const FaultAtLine& fault)
      : name_(name), key_("effects." + name), fault_(fault) {}

  std::optional<StatedEffect> read(const toml::table& table) {
    require_name(table);
    for (const auto& [leaf, node] : table) {
      const string key = arm::shown(leaf.str());
      lines_[key_ + "." + key] = line_of_node(node);
      if (key == kStatedLawKey) {
        read_formula(node);
      } else {
        read_number(key, node);
      }
    }
    if (is_wrong_) return std::nullopt;
    try {
      const arm::HubTorqueHypothesis all{formula_, made_.ranges, made_.values};
      auto typical = all.typical();
      for (const auto& [number, value] : made_.values) typical[number] = value;
      made_.definition = arm::define_effect(name_, formula_, typical);
    } catch (const arm::InputError& error) {
      const auto line = lines_.find(error.key());
      add_fault(line == lines_.end() ? line_of_node(table) : line->second, error.what());
      return std::nullopt;
    }
    return std::move(made_);
  }

 private:
  void add_fault(int line, const string& what) {
    fault_(line, what);
    is_wrong_ = true;
  }

  void wrong(const string& key, const toml::node& node, std::string_view allowed) {
    add_fault(line_of_node(node),
              fmt::format("{}{}: {}; must be {}", key, equals_value(node), kind_of(node), allowed));
  }

  void require_name(const toml::table& table) {
    const bool is_plain = std::ranges::all_of(
        name_, [](char c) { return arm::is_letter(c) || arm::is_digit(c) || c == '_'; });
    if (is_plain && !name_.empty()) return;
    add_fault(line_of_node(table),
              fmt::format("{}: the name of a stated law must be letters, digits and _", key_));
  }

  void read_formula(const toml::node& node) {
    if (const auto* text = node.as_string()) {
      formula_.text = text->get();
    } else {
      wrong(key_ + "." + kStatedLawKey, node,
            "a formula in quotes, in theta [rad], omega [rad/s], tau [N m] and t [s]");
    }
  }

  void read_number(const string& name, const toml::node& node) {
    const string key = key_ + "." + name;
    arm::HubTorqueFormula::Number number{name};
    if (const auto* table = node.as_table()) {
      for (const auto& [leaf, value] : *table) {
        read_property(key, arm::shown(leaf.str()), value, number);
      }
      require_value_or_range(key, name, node);
    } else if (const auto value = finite_number(node)) {
      made_.values[name] = *value;
    } else {
      wrong(key, node, kNumberForm);
    }
    formula_.numbers.push_back(std::move(number));
  }

  void read_property(const string& key, const string& leaf, const toml::node& node,
                     arm::HubTorqueFormula::Number& number) {
    static const std::vector<string> allowed = {"value", "range", "unit"};
    if (leaf == "value") {
      if (const auto value = finite_number(node)) {
        made_.values[number.name] = *value;
      } else {
        wrong(key + ".value", node, "a finite number");
      }
    } else if (leaf == "unit") {
      const auto* text = node.as_string();
      if (text != nullptr && !text->get().empty()) {
        number.unit = text->get();
      } else {
        wrong(key + ".unit", node, "a text in quotes, such as \"N m/rad^3\"");
      }
    } else if (leaf == "range") {
      read_range(key + ".range", node, number.name);
    } else {
      add_fault(line_of_node(node),
                fmt::format("{}.{}: unknown key{}; allowed: {}", key, leaf,
                            arm::did_you_mean(leaf, allowed), fmt::join(allowed, ", ")));
    }
  }

  void read_range(const string& key, const toml::node& node, const string& name) {
    constexpr std::string_view kForm = "[LOWEST, HIGHEST], two finite numbers in ascending order";
    std::vector<double> ends;
    if (const auto* array = node.as_array()) {
      for (const auto& element : *array) {
        if (const auto value = finite_number(element)) ends.push_back(*value);
      }
      if (array->size() != 2) ends.clear();
    }
    if (ends.size() == 2 && ends[0] < ends[1]) {
      made_.ranges[name] = {ends[0], ends[1]};
    } else if (ends.size() == 2) {
      add_fault(line_of_node(node),
                fmt::format("{} = [{}, {}]: is empty; must be {}", key, ends[0], ends[1], kForm));
    } else {
      wrong(key, node, kForm);
    }
  }

  void require_value_or_range(const string& key, const string& name, const toml::node& node) {
    const auto value = made_.values.find(name);
    const auto range = made_.ranges.find(name);
    if (is_wrong_) return;
    if (value == made_.values.end() && range == made_.ranges.end()) {
      add_fault(line_of_node(node),
                fmt::format("{}: needs a value, or the range in which it is to be found", key));
    } else if (value != made_.values.end() && range != made_.ranges.end() &&
               (value->second < range->second.lowest || value->second > range->second.highest)) {
      add_fault(line_of_node(node),
                fmt::format("{}.value = {}: must be within its range, {} to {}", key, value->second,
                            range->second.lowest, range->second.highest));
    }
  }

  const string& name_;
  string key_;
  const FaultAtLine& fault_;
  std::map<string, int> lines_;
  arm::HubTorqueFormula formula_;
  StatedEffect made_;
  bool is_wrong_ = false;
};

}  // namespace

std::optional<StatedEffect> read_stated_effect(const std::string& name, const toml::table& table,
                                               const FaultAtLine& fault) {
  return StatedEffectReader(name, fault).read(table);
}

std::string format_stated_effect(const std::string& name, const arm::HubTorqueFormula& formula,
                                 const std::map<std::string, double>& values,
                                 const std::map<std::string, arm::Interval>& ranges) {
  std::string out =
      fmt::format("\n[effects.{}]\n{} = {}\n", name, kStatedLawKey, toml_string(formula.text));
  for (const auto& number : formula.numbers) {
    std::vector<std::string> parts;
    if (const auto value = values.find(number.name); value != values.end()) {
      parts.push_back("value = " + toml_number(value->second));
    }
    if (const auto range = ranges.find(number.name); range != ranges.end()) {
      parts.push_back(fmt::format("range = [{}, {}]", toml_number(range->second.lowest),
                                  toml_number(range->second.highest)));
    }
    if (!number.unit.empty()) parts.push_back("unit = " + toml_string(number.unit));
    out += fmt::format("{} = {{ {} }}\n", number.name, fmt::join(parts, ", "));
  }
  return out;
}

}  // namespace flexarm::measured
