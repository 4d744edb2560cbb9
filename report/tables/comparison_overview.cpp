#include "report/tables/comparison_overview.hpp"

#include "compare/finding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::report {
namespace {

constexpr int kOverviewDigits = 7;

/// A root as a reader sees it.
struct ShownRoot {
  double value = 0.0;
  std::string unit;

  bool operator==(const ShownRoot&) const = default;
};

ShownRoot shown_root(std::complex<double> s) {
  if (s.imag() == 0.0 && s.real() != 0.0) return {s.real(), "rad/s"};
  return {std::abs(s) / (2.0 * std::numbers::pi), s.real() == 0.0 ? "Hz" : "|s| Hz"};
}

/// The roots of the first model in one family, and the sensors whose zeros they are.
struct OverviewColumn {
  std::string name;
  std::vector<ShownRoot> roots;
};

std::vector<OverviewColumn> overview_columns(const compare::Comparison& comparison) {
  std::vector<std::pair<compare::FeatureFamily, OverviewColumn>> families;
  for (const auto& row : comparison.roots) {
    auto at = std::ranges::find(families, row.family, [](const auto& one) { return one.first; });
    if (at == families.end()) {
      const auto& sensor = row.family.zeros_of;
      at = families.insert(
          at, {row.family, {sensor ? arm::to_string(*sensor) + " zeros" : "poles", {}}});
    }
    at->second.roots.push_back(shown_root(*row.s_rad_per_s.front()));
  }
  std::vector<OverviewColumn> columns;
  for (auto& [family, column] : families) {
    const auto same = std::ranges::find(columns, column.roots, &OverviewColumn::roots);
    if (same == columns.end() || !family.zeros_of) {
      columns.push_back(std::move(column));
    } else {
      same->name =
          fmt::format("{}, {}", same->name.substr(0, same->name.rfind(" zeros")), column.name);
    }
  }
  return columns;
}

/// The largest of the distances from the first model, NaN where a value is missing.
class LargestDifference {
 public:
  void add(double distance) {
    const bool is_larger = std::isnan(distance) || distance > largest_;
    if (!std::isnan(largest_) && is_larger) largest_ = distance;
  }
  Cell cell() const { return std::isnan(largest_) ? Cell(std::string("missing")) : Cell(largest_); }

 private:
  double largest_ = 0.0;
};

void add_agreement_row(const std::string& quantity, std::int64_t count,
                       const std::vector<LargestDifference>& largest, double tolerance,
                       Table& table) {
  std::vector<Cell> row = {quantity, count};
  for (const auto& difference : largest) row.push_back(difference.cell());
  row.emplace_back(tolerance);
  table.add_row(std::move(row));
}

/// NaN where no finding is about the quantity.
double tolerance_of(const compare::Comparison& comparison, const std::string& beginning) {
  const auto at = std::ranges::find_if(comparison.findings, [&](const compare::Finding& finding) {
    return finding.quantity.starts_with(beginning);
  });
  return at == comparison.findings.end() ? kMissing : at->tolerance;
}

/// How many times its tolerance a difference is.
double excess_of(const compare::Finding& finding) {
  return std::isnan(finding.distance) ? std::numeric_limits<double>::infinity()
                                      : finding.distance / finding.tolerance;
}

}  // namespace

Table roots_overview(const compare::Comparison& comparison) {
  const auto columns = overview_columns(comparison);
  const std::string caption = comparison.damped.empty() ? "Roots by " : "Undamped roots by ";
  Table table{caption + comparison.subjects.front(), {{"no."}}};
  std::size_t rows = 0;
  bool any_real = false;
  for (const auto& column : columns) {
    const bool one_unit = std::ranges::adjacent_find(column.roots, std::not_equal_to{},
                                                     &ShownRoot::unit) == column.roots.end();
    table.columns.push_back(
        {column.name, one_unit ? column.roots.front().unit : "", kOverviewDigits});
    rows = std::max(rows, column.roots.size());
    any_real |= std::ranges::count(column.roots, "rad/s", &ShownRoot::unit) > 0;
  }
  if (any_real) table.caption += "; zeros in rad/s lie on the real axis and are non-minimum phase";
  for (std::size_t r = 0; r < rows; ++r) {
    std::vector<Cell> row = {static_cast<std::int64_t>(r + 1)};
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const auto& roots = columns[k].roots;
      if (r >= roots.size()) {
        row.emplace_back();
      } else if (table.columns[k + 1].unit.empty()) {
        row.emplace_back(fmt::format("{:.{}g} {}", roots[r].value, kOverviewDigits, roots[r].unit));
      } else {
        row.emplace_back(roots[r].value);
      }
    }
    table.add_row(std::move(row));
  }
  return table;
}

Table agreement_overview(const compare::Comparison& comparison) {
  Table table{"Largest relative difference from " + comparison.subjects.front(),
              {{"quantity"}, {"compared"}}};
  const std::size_t others = comparison.subjects.size() - 1;
  for (std::size_t k = 0; k < others; ++k) {
    table.columns.push_back(error_column(comparison.subjects[k + 1]));
  }
  table.columns.push_back({"tolerance", "", 1, Notation::scientific});

  for (std::size_t r = 0; r < comparison.roots.size();) {
    const auto family = comparison.roots[r].family;
    std::vector<LargestDifference> largest(others);
    std::int64_t count = 0;
    for (; r < comparison.roots.size() && comparison.roots[r].family == family; ++r, ++count) {
      for (std::size_t k = 0; k < others; ++k) largest[k].add(comparison.roots[r].distance[k + 1]);
    }
    add_agreement_row(compare::label(family) + "s", count, largest,
                      tolerance_of(comparison, compare::label(family) + " "), table);
  }
  std::vector<LargestDifference> shapes(others);
  std::set<int> orders;
  for (const auto& shape : comparison.shapes) {
    const auto model = std::ranges::find(comparison.subjects, shape.formulation);
    const auto k = static_cast<std::size_t>(model - comparison.subjects.begin()) - 1;
    shapes[k].add(shape.largest_error);
    orders.insert(shape.order);
  }
  if (!orders.empty()) {
    add_agreement_row("mode shapes", std::ssize(orders), shapes,
                      tolerance_of(comparison, "mode shape "), table);
  }
  for (const auto& response : comparison.responses) {
    std::vector<LargestDifference> largest(others);
    for (std::size_t k = 0; k < others; ++k) largest[k].add(response.largest_error[k + 1]);
    const std::string name = arm::to_string(response.sensor) + " response";
    add_agreement_row(name, std::ssize(response.frequency_Hz), largest,
                      tolerance_of(comparison, name), table);
  }
  return table;
}

Table disagreements_table(const compare::Comparison& comparison) {
  Table table{"Beyond the tolerance",
              {{"quantity"},
               {"models"},
               error_column("relative difference"),
               {"tolerance", "", 1, Notation::scientific},
               error_column("stated error")}};
  std::vector<const compare::Finding*> beyond;
  for (const auto& finding : comparison.findings) {
    if (!(finding.distance <= finding.tolerance)) beyond.push_back(&finding);
  }
  std::ranges::stable_sort(beyond, std::ranges::greater{},
                           [](const compare::Finding* finding) { return excess_of(*finding); });
  for (const auto* finding : beyond) {
    table.add_row(
        {finding->quantity, fmt::format("{}, {}", finding->first, finding->second),
         std::isnan(finding->distance) ? Cell() : Cell(finding->distance), finding->tolerance,
         finding->stated > 0.0 && std::isfinite(finding->stated) ? Cell(finding->stated) : Cell()});
  }
  return table;
}

}  // namespace flexarm::report
