#include "compare/paper/paper_tables.hpp"

#include "arm/number.hpp"
#include "compare/paper/paper_csv.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>

namespace flexarm::compare::paper {

namespace {

using Record = std::vector<std::string>;

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/// Records of a transcribed table, its header line left out. These files have no quoted fields.
std::vector<Record> records(std::string_view csv) {
  std::vector<Record> result;
  const auto lines = split(csv, '\n');
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (!lines[i].empty()) result.push_back(split(lines[i], ','));
  }
  return result;
}

PrintedNumber number(const std::string& text) {
  const auto value = arm::parse_number<double>(text);
  if (!value) throw std::logic_error("data/paper: not a number: \"" + text + "\"");
  PrintedNumber result;
  result.value = *value;
  const auto point = text.find('.');
  if (point != std::string::npos) result.decimals = static_cast<int>(text.size() - point - 1);
  return result;
}

std::optional<PrintedNumber> optional_number(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(number(text));
}

int order_of(const std::string& text) {
  return static_cast<int>(number(text).value);
}

ArmTable read_arm(std::string_view csv) {
  const auto rows = records(csv);
  const auto value = [&rows](std::string_view quantity) {
    const auto row = std::find_if(rows.begin(), rows.end(),
                                  [quantity](const Record& r) { return r.at(0) == quantity; });
    if (row == rows.end()) throw std::logic_error("data/paper/table_1.csv: a quantity is missing");
    return number(row->at(2)).value;
  };
  return {.length_mm = value("length"),
          .thickness_mm = value("thickness"),
          .width_mm = value("width"),
          .density_kg_per_m3 = value("mass density per volume"),
          .youngs_modulus_Pa = value("Young's modulus"),
          .area_moment_m4 = value("area moment of inertia"),
          .hub_inertia_kg_m2 = value("hub inertia"),
          .beam_inertia_kg_m2 = value("manipulator moment of inertia")};
}

void read_frequencies(int table, std::string_view csv, std::vector<FrequencyCell>& cells) {
  for (const auto& r : records(csv)) {
    cells.push_back({.table = table,
                     .method = r.at(0),
                     .location = r.at(1),
                     .feature = r.at(2),
                     .order = order_of(r.at(3)),
                     .analytical_Hz = number(r.at(4)),
                     .measured_Hz = optional_number(r.at(5)),
                     .error_percent = optional_number(r.at(6))});
  }
}

std::vector<DampingCell> read_damping(std::string_view csv) {
  std::vector<DampingCell> cells;
  for (const auto& r : records(csv)) {
    cells.push_back(
        {.location = r.at(0), .order = order_of(r.at(1)), .damping_ratio = number(r.at(2))});
  }
  return cells;
}

ModelTable read_model(std::string_view csv, std::string_view gain_name) {
  ModelTable model;
  for (const auto& r : records(csv)) {
    const auto mode = static_cast<std::size_t>(order_of(r.at(1)) - 1);
    const auto& name = r.at(0);
    auto& column = name == "zero"            ? model.zero_Hz
                   : name == "pole"          ? model.pole_Hz
                   : name == "damping ratio" ? model.damping_ratio
                   : name == gain_name       ? model.gain
                                             : throw std::logic_error("data/paper: " + name);
    column.at(mode) = number(r.at(2));
  }
  return model;
}

Tables read_tables() {
  Tables all;
  all.arm = read_arm(kTable1Csv);
  read_frequencies(2, kTable2Csv, all.frequencies);
  read_frequencies(3, kTable3Csv, all.frequencies);
  read_frequencies(4, kTable4Csv, all.frequencies);
  all.damping_ratios = read_damping(kTable5Csv);
  all.hub_model = read_model(kTable6Csv, "hub modal slope");
  all.accelerometer_model = read_model(kTable7Csv, "acceleration modal gain");
  return all;
}

}  // namespace

bool rounds_to(double value, const PrintedNumber& printed) {
  // The margin lets a tie that binary fractions cannot hold go either way.
  const double half_unit = 0.5 * std::pow(10.0, -printed.decimals);
  return std::abs(value - printed.value) <= half_unit * (1.0 + 1e-9);
}

const Tables& tables() {
  static const Tables all = read_tables();
  return all;
}

PrintedNumber analytical_Hz(const std::string& feature, int order) {
  for (const auto& cell : tables().frequencies) {
    if (cell.feature == feature && cell.order == order) return cell.analytical_Hz;
  }
  throw std::logic_error("data/paper: no " + feature + " of that order");
}

}  // namespace flexarm::compare::paper
