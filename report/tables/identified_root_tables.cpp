#include "report/tables/identified_root_tables.hpp"

#include "compare/features.hpp"
#include "report/tables/identification_tables.hpp"
#include "report/tables/method_differences.hpp"
#include "report/tables/table.hpp"
#include "report/tables/zero_kind.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

namespace flexarm::report {

namespace {

using compare::IdentifiedRoot;
using measured::Feature;
using measured::Method;
using measured::ModalReading;

constexpr double kRounding = 1e-14;
constexpr std::size_t kMostOthers = 5;
constexpr std::size_t kNoReading = std::numeric_limits<std::size_t>::max();

using Roots = std::vector<IdentifiedRoot>;

Cell cell(const std::optional<double>& value) {
  return value ? Cell(*value) : Cell();
}

const ModalReading& reading_of(const IdentifiedData& data, std::size_t index) {
  return data.identification.readings[data.condition.readings[index]];
}

/// The readings of the runs whose roots have the feature, with the hub held or free.
std::vector<std::size_t> readings_with(const IdentifiedData& data, Feature feature,
                                       bool hub_held = false) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < data.condition.roots.size(); ++i) {
    if (joined(reading_of(data, i).runs) != data.runs) continue;
    if (reading_of(data, i).hub_held != hub_held) continue;
    const bool has = std::ranges::any_of(data.condition.roots[i], [&](const IdentifiedRoot& root) {
      return root.measured.feature == feature;
    });
    if (has) found.push_back(i);
  }
  return found;
}

/// Orders of the analytical roots that a reading stands for, ascending.
std::vector<int> orders_of(const IdentifiedData& data, const std::vector<std::size_t>& readings,
                           Feature feature) {
  std::set<int> orders;
  for (const std::size_t i : readings) {
    for (const auto& root : data.condition.roots[i]) {
      if (root.measured.feature == feature && root.order) orders.insert(*root.order);
    }
  }
  return {orders.begin(), orders.end()};
}

const IdentifiedRoot* find_order(const Roots& roots, Feature feature, int order) {
  const auto at = std::ranges::find_if(roots, [&](const IdentifiedRoot& root) {
    return root.measured.feature == feature && root.order == order;
  });
  return at == roots.end() ? nullptr : &*at;
}

const compare::AnalyticalPole* analytical_pole(const IdentifiedData& data, int order) {
  const auto& poles = data.condition.analytical.poles;
  const auto index = static_cast<std::size_t>(order - 1);
  return index < poles.size() ? &poles[index] : nullptr;
}

/// Frequencies that stand for no analytical root, the lowest of them.
std::string others_of(const Roots& roots, Feature feature) {
  std::vector<std::string> frequencies;
  for (const auto& root : roots) {
    if (root.measured.feature == feature && !root.order && root.measured.frequency_Hz) {
      frequencies.push_back(
          fmt::format("{:.4g}{}", *root.measured.frequency_Hz, root.alias_of_Hz ? " (alias)" : ""));
    }
  }
  const std::size_t left_out =
      frequencies.size() > kMostOthers ? frequencies.size() - kMostOthers : 0;
  frequencies.resize(frequencies.size() - left_out);
  return fmt::format("{}{}", fmt::join(frequencies, ", "),
                     left_out > 0 ? fmt::format(", {} more", left_out) : "");
}

/// Frequencies of measured zeros in the right half plane.
std::string right_half_plane_zeros_of(const Roots& roots) {
  std::vector<std::string> frequencies;
  for (const auto& root : roots) {
    const auto& measured = root.measured;
    if (measured.feature == Feature::zero && measured.frequency_Hz &&
        is_non_minimum_phase(measured.damping_ratio, measured.damping_ratio_std)) {
      frequencies.push_back(fmt::format("{:.4g}", *measured.frequency_Hz));
    }
  }
  return fmt::format("{}", fmt::join(frequencies, ", "));
}

std::string sensor_name(const std::optional<arm::Sensor>& sensor) {
  return sensor ? arm::to_string(*sensor) : "all";
}

/// A value with what it is compared to.
struct ComparedValue {
  std::optional<double> value = {};
  std::optional<double> standard_error = {};
  double error_percent = kMissing;
};

/// Mean, scatter between sensors and mean error of two or more.
ComparedValue mean_of(const std::vector<ComparedValue>& figures) {
  double sum = 0.0, errors = 0.0, squares = 0.0;
  double count = 0.0;
  for (const auto& figure : figures) {
    if (!figure.value) continue;
    sum += *figure.value;
    errors += figure.error_percent;
    count += 1.0;
  }
  if (count < 2.0) return {};
  for (const auto& figure : figures) {
    if (figure.value) squares += std::pow(*figure.value - sum / count, 2);
  }
  const double scatter = std::sqrt(squares / (count - 1.0));
  return {sum / count, scatter > kRounding * std::abs(sum / count) ? scatter : 0.0, errors / count};
}

/// The columns of method and sensor, with the analytical roots' row where there is one.
Table table_of(const IdentifiedData& data, const std::string& caption) {
  return {fmt::format("{}: {}", data.runs, caption), {{"method"}, {"sensor"}}};
}

/// A last column with a text of each reading, unless all are empty.
template <class TextOf>
void add_column(const std::vector<std::size_t>& row_readings, const Column& column,
                const TextOf& text_of, Table& table) {
  std::vector<std::string> texts(table.rows.size());
  const std::size_t first = table.rows.size() - row_readings.size();
  bool any = false;
  for (std::size_t k = 0; k < row_readings.size(); ++k) {
    if (row_readings[k] == kNoReading) continue;
    texts[first + k] = text_of(row_readings[k]);
    any = any || !texts[first + k].empty();
  }
  if (!any) return;
  table.columns.push_back(column);
  for (std::size_t r = 0; r < texts.size(); ++r) {
    table.rows[r].push_back(texts[r].empty() ? Cell() : Cell(texts[r]));
  }
}

/// What corresponds to no analytical root.
void add_others(const IdentifiedData& data, const std::vector<std::size_t>& row_readings,
                Feature feature, Table& table) {
  add_column(
      row_readings, {"unmatched", "Hz"},
      [&](std::size_t i) { return others_of(data.condition.roots[i], feature); }, table);
}

/// The poles whose frequency, or damping ratio, is off that of a more accurate method.
void add_differing(const IdentifiedData& data, const std::vector<std::size_t>& row_readings,
                   bool is_damping, Table& table) {
  const auto differing = differing_poles(data);
  add_column(
      row_readings, {"differs"},
      [&](std::size_t i) {
        std::vector<std::string> poles;
        for (const DifferingPole& pole : differing) {
          if (pole.reading != &reading_of(data, i) || pole.is_damping != is_damping) continue;
          poles.push_back(fmt::format("pole {}", pole.order));
        }
        return fmt::format("{}", fmt::join(poles, ", "));
      },
      table);
}

/// Rows of a table of one figure a pole: those of the readings, and where two sensors or more were
/// read by one method, their mean. Returns the reading of each row, kNoReading for means.
template <class FigureOf>
std::vector<std::size_t> add_pole_rows(const IdentifiedData& data,
                                       const std::vector<std::size_t>& readings,
                                       const std::vector<int>& orders, bool with_error,
                                       const FigureOf& figure_of, Table& table) {
  std::vector<std::size_t> row_readings;
  std::vector<std::vector<ComparedValue>> group(orders.size());
  const auto add_row = [&](Method method, const std::string& sensor, std::size_t reading,
                           const auto& figure_at) {
    std::vector<Cell> row = {std::string(to_string(method)), sensor};
    for (std::size_t i = 0; i < orders.size(); ++i) {
      const ComparedValue figure = figure_at(i);
      row.push_back(cell(figure.value));
      row.push_back(cell(figure.standard_error));
      if (with_error) row.emplace_back(figure.error_percent);
    }
    table.add_row(std::move(row));
    row_readings.push_back(reading);
  };
  for (std::size_t k = 0; k < readings.size(); ++k) {
    const auto& reading = reading_of(data, readings[k]);
    add_row(reading.method, sensor_name(reading.sensor), readings[k], [&](std::size_t i) {
      const auto* root = find_order(data.condition.roots[readings[k]], Feature::pole, orders[i]);
      group[i].push_back(root ? figure_of(*root) : ComparedValue{});
      return group[i].back();
    });
    const bool ends =
        k + 1 == readings.size() || reading_of(data, readings[k + 1]).method != reading.method;
    if (!ends) continue;
    if (!group.empty() && group.front().size() > 1) {
      add_row(reading.method, "mean, std. dev.", kNoReading,
              [&](std::size_t i) { return mean_of(group[i]); });
    }
    for (auto& figures : group) figures.clear();
  }
  return row_readings;
}

}  // namespace

std::vector<std::string> sources(const measured::Identification& identification,
                                 const compare::IdentifiedCondition& condition) {
  std::vector<std::string> found;
  for (const std::size_t i : condition.readings) {
    const std::string runs = joined(identification.readings[i].runs);
    if (std::ranges::find(found, runs) == found.end()) found.push_back(runs);
  }
  return found;
}

Table without_predictions(Table table, const compare::IdentifiedCondition& condition) {
  if (!condition.analytical.is_empty()) return table;
  for (std::size_t c = table.columns.size(); c-- > 0;) {
    const std::string& name = table.columns[c].name;
    if (name != "exact_tf" && name != "analytical" && name != "error") continue;
    const auto at = static_cast<std::ptrdiff_t>(c);
    table.columns.erase(table.columns.begin() + at);
    for (auto& row : table.rows) row.erase(row.begin() + at);
  }
  return table;
}

Table pole_table(const IdentifiedData& data) {
  const auto readings = readings_with(data, Feature::pole);
  const auto orders = orders_of(data, readings, Feature::pole);
  Table table = table_of(data, "poles, natural frequencies |s|/(2 pi)");
  std::vector<Cell> analytical = {std::string("exact_tf"), std::string("analytical")};
  for (const int order : orders) {
    table.columns.push_back({fmt::format("pole {}", order), "Hz", 6});
    table.columns.push_back(qualifying("+-", "Hz", 2));
    table.columns.push_back(qualifying("error", "%", 3));
    const auto* pole = analytical_pole(data, order);
    analytical.push_back(pole ? Cell(pole->frequency_Hz) : Cell());
    analytical.resize(analytical.size() + 2);
  }
  if (readings.empty()) return table;
  if (!data.condition.analytical.is_empty()) table.add_row(std::move(analytical));
  const auto rows = add_pole_rows(
      data, readings, orders, true,
      [](const IdentifiedRoot& root) {
        return ComparedValue{root.measured.frequency_Hz, root.measured.frequency_std_Hz,
                             root.error_percent()};
      },
      table);
  add_differing(data, rows, false, table);
  add_others(data, rows, Feature::pole, table);
  return without_predictions(std::move(table), data.condition);
}

Table zero_table(const IdentifiedData& data) {
  const auto readings = readings_with(data, Feature::zero);
  const auto orders = orders_of(data, readings, Feature::zero);
  Table table = table_of(data, "zeros of each sensor, natural frequencies |s|/(2 pi)");
  for (const int order : orders) {
    table.columns.push_back({"analytical", "Hz", 6});
    table.columns.push_back(qualifying(fmt::format("zero {}", order), "Hz", 6));
    table.columns.push_back(qualifying("+-", "Hz", 2));
    table.columns.push_back(qualifying("error", "%", 3));
  }
  for (const std::size_t i : readings) {
    const auto& reading = reading_of(data, i);
    std::vector<Cell> row = {std::string(to_string(reading.method)), sensor_name(reading.sensor)};
    for (const int order : orders) {
      const auto* root = find_order(data.condition.roots[i], Feature::zero, order);
      row.push_back(root ? cell(root->analytical_Hz) : Cell());
      row.push_back(root ? cell(root->measured.frequency_Hz) : Cell());
      row.push_back(root ? cell(root->measured.frequency_std_Hz) : Cell());
      row.emplace_back(root ? root->error_percent() : kMissing);
    }
    table.add_row(std::move(row));
  }
  add_others(data, readings, Feature::zero, table);
  add_column(
      readings, {"non-minimum phase", "Hz"},
      [&](std::size_t i) { return right_half_plane_zeros_of(data.condition.roots[i]); }, table);
  return without_predictions(std::move(table), data.condition);
}

Table held_pole_table(const IdentifiedData& data) {
  const auto readings = readings_with(data, Feature::zero, true);
  Table table{fmt::format("{}: poles with the hub held, of responses to the hub motion", data.runs),
              {{"method"},
               {"sensor"},
               {"pole"},
               {"analytical", "Hz", 6},
               {"measured", "Hz", 6},
               {"+-", "Hz", 2},
               {"error", "%", 3},
               {"damping ratio", "", 4},
               {"+-", "", 2}}};
  for (const std::size_t i : readings) {
    const auto& reading = reading_of(data, i);
    for (const auto& root : data.condition.roots[i]) {
      table.add_row({std::string(to_string(reading.method)), sensor_name(reading.sensor),
                     root.order ? fmt::format("pole {}, hub held", *root.order) : "unmatched",
                     cell(root.analytical_Hz), cell(root.measured.frequency_Hz),
                     cell(root.measured.frequency_std_Hz), root.error_percent(),
                     cell(root.measured.damping_ratio), cell(root.measured.damping_ratio_std)});
    }
  }
  return without_predictions(std::move(table), data.condition);
}

Table damping_table(const IdentifiedData& data) {
  const auto readings = readings_with(data, Feature::pole);
  const auto orders = orders_of(data, readings, Feature::pole);
  Table table = table_of(data, "damping ratios");
  std::vector<Cell> analytical = {std::string("exact_tf"), std::string("analytical")};
  for (const int order : orders) {
    table.columns.push_back({fmt::format("pole {}", order), "", 4});
    table.columns.push_back(qualifying("+-", "", 2));
    const auto* pole = analytical_pole(data, order);
    analytical.push_back(pole ? Cell(pole->damping_ratio) : Cell());
    analytical.emplace_back();
  }
  if (orders.empty()) return table;
  if (!data.condition.analytical.is_empty()) table.add_row(std::move(analytical));
  const auto rows = add_pole_rows(
      data, readings, orders, false,
      [](const IdentifiedRoot& root) {
        return ComparedValue{root.measured.damping_ratio, root.measured.damping_ratio_std,
                             kMissing};
      },
      table);
  add_differing(data, rows, true, table);
  return table;
}

Table real_zero_table(const IdentifiedData& data) {
  Table table{fmt::format("{}: zeros on the real axis (no antiresonance)", data.runs),
              {{"sensor"},
               {"analytical", "rad/s", 6},
               {"fitted", "rad/s", 6},
               {"+-", "rad/s", 2},
               {"non-minimum phase"}}};
  for (const std::size_t f : data.condition.fits) {
    const auto& fit = data.identification.fits[f];
    if (joined(ids_of(fit, data.identification)) != data.runs) continue;
    for (const auto& sensor : fit.fit.sensors) {
      const auto zeros = std::ranges::find(data.condition.analytical.zeros, sensor.sensor,
                                           &compare::AnalyticalZeros::sensor);
      if (zeros == data.condition.analytical.zeros.end()) continue;
      std::vector<std::complex<double>> expected, found;
      for (const auto& zero : zeros->s_rad_per_s) {
        if (zero.imag() != 0.0) continue;
        expected.push_back(zero);
        expected.push_back(-zero);
      }
      for (const auto& zero : sensor.zeros) {
        if (zero.is_told && zero.s_rad_per_s.imag() == 0.0) found.push_back(zero.s_rad_per_s);
      }
      const auto matched = compare::match_nearest(expected, found);
      for (std::size_t i = 0; i < expected.size(); ++i) {
        if (!matched[i]) continue;
        const auto zero =
            std::ranges::find(sensor.zeros, *matched[i], &measured::FittedZero::s_rad_per_s);
        table.add_row({arm::to_string(sensor.sensor), expected[i].real(), matched[i]->real(),
                       2.0 * std::numbers::pi * zero->frequency_std_Hz,
                       std::string(matched[i]->real() > 0.0 ? "yes" : "no")});
      }
    }
  }
  return table;
}

}  // namespace flexarm::report
