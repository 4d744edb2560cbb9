#include "report/tables/comparison_tables.hpp"

#include "report/tables/zero_kind.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>

namespace flexarm::report {

namespace {

constexpr int kRootDigits = 12;

bool is_real(std::complex<double> s) {
  return s.imag() == 0.0 && s.real() != 0.0;
}

/// Frequency [Hz] of a root on the imaginary axis, s [rad/s] of a real one, |s|/2 pi of a complex.
double shown_value(std::complex<double> s) {
  return is_real(s) ? s.real() : std::abs(s) / (2.0 * std::numbers::pi);
}

/// Where a root lies, in a cell and in a caption, and the unit of its `shown_value`.
struct RootPlace {
  std::string where;
  std::string axis;
  const char* unit = "";

  bool operator==(const RootPlace&) const = default;
};

RootPlace place_of(std::complex<double> s, bool is_zero) {
  const std::string remark = is_zero && is_non_minimum_phase(s) ? " (non-minimum phase)" : "";
  if (is_real(s)) return {"real" + remark, "on the real axis" + remark, "rad/s"};
  if (s.real() == 0.0) return {"imaginary", "on the imaginary axis", "Hz"};
  return {"complex" + remark, "complex" + remark, "|s| Hz"};
}

std::vector<compare::FeatureFamily> families_of(const compare::Comparison& comparison) {
  std::vector<compare::FeatureFamily> families;
  for (const auto& note : comparison.notes) {
    if (std::ranges::find(families, note.family) == families.end()) families.push_back(note.family);
  }
  return families;
}

std::string title_of(const compare::FeatureFamily& family) {
  return family.zeros_of ? "Zeros of torque to " + arm::to_string(*family.zeros_of) : "Poles";
}

/// What a series shows over all roots of one family.
struct SeriesSummary {
  const compare::RefinementCurve* any = nullptr;
  double lowest_rate = std::numeric_limits<double>::infinity();
  double highest_rate = -std::numeric_limits<double>::infinity();
  double smallest_error = 0.0;  ///< of the root that is worst off; infinite: a root is missing
  int rounding_from = 0;        ///< degrees of freedom at the first floor met; 0: none met
  int cheapest = 0;             ///< degrees of freedom at which every root is accurate; 0: never

  void add(const compare::RefinementCurve& curve) {
    const auto& seen = curve.convergence;
    if (seen.rate) {
      lowest_rate = std::min(lowest_rate, *seen.rate);
      highest_rate = std::max(highest_rate, *seen.rate);
    }
    // A root that no setting has is worse than any error.
    smallest_error = std::isnan(seen.smallest_error)
                         ? std::numeric_limits<double>::infinity()
                         : std::max(smallest_error, seen.smallest_error);
    if (seen.rounding_onset) {
      const int from = seen.rounding_onset->degrees_of_freedom;
      rounding_from = rounding_from == 0 ? from : std::min(rounding_from, from);
    }
    const bool reached = seen.cheapest && (any == nullptr || cheapest != 0);
    cheapest = reached ? std::max(cheapest, seen.cheapest->degrees_of_freedom) : 0;
    any = &curve;
  }

  /// "3.96 to 4.00" when the series decays like that, else missing.
  Cell rate_text(compare::Decay decay) const {
    if (any->decay != decay || !(lowest_rate <= highest_rate)) return std::monostate{};
    return fmt::format("{:.2f} to {:.2f}", lowest_rate, highest_rate);
  }

  Cell smallest_error_cell() const {
    return std::isfinite(smallest_error) ? Cell(smallest_error) : Cell(std::monostate{});
  }
};

Cell count_or_missing(int count) {
  return count > 0 ? Cell(std::int64_t{count}) : Cell(std::monostate{});
}

}  // namespace

Table subjects_table(const compare::Comparison& comparison) {
  Table table{"Models", {{"model"}, {"settings"}, {"degrees of freedom"}}};
  for (std::size_t k = 0; k < comparison.subjects.size(); ++k) {
    const int dof = comparison.degrees_of_freedom[k];
    table.add_row(
        {comparison.subjects[k],
         dof == 0 ? "exact solution of the boundary-value problem" : comparison.settings[k],
         count_or_missing(dof)});
  }
  return table;
}

std::vector<Table> root_tables(const compare::Comparison& comparison) {
  std::vector<Table> tables;
  for (const auto& family : families_of(comparison)) {
    const bool are_zeros = family.zeros_of.has_value();
    std::vector<RootPlace> places;
    for (const auto& row : comparison.roots) {
      if (row.family == family) places.push_back(place_of(*row.s_rad_per_s.front(), are_zeros));
    }
    const bool one_place = std::ranges::adjacent_find(places, std::not_equal_to{}) == places.end();
    Table table{title_of(family), {{"no."}}};
    if (one_place && !places.empty()) {
      table.caption += fmt::format(", {} [{}]", places.front().axis, places.front().unit);
    } else {
      table.columns.push_back({"axis, unit"});
    }
    for (std::size_t k = 0; k < comparison.subjects.size(); ++k) {
      table.columns.push_back({comparison.subjects[k], "", kRootDigits});
      if (k == 0) continue;
      table.columns.push_back(error_column("relative difference"));
      table.columns.back().joined = true;
    }
    for (const auto& row : comparison.roots) {
      if (!(row.family == family)) continue;
      std::vector<Cell> cells = {std::int64_t{row.order}};
      if (!one_place) {
        const RootPlace place = place_of(*row.s_rad_per_s.front(), are_zeros);
        cells.emplace_back(fmt::format("{}, {}", place.where, place.unit));
      }
      for (std::size_t k = 0; k < comparison.subjects.size(); ++k) {
        cells.emplace_back(row.s_rad_per_s[k] ? shown_value(*row.s_rad_per_s[k]) : kMissing);
        if (k > 0) cells.emplace_back(row.distance[k]);
      }
      table.add_row(std::move(cells));
    }
    tables.push_back(std::move(table));
  }
  return tables;
}

Table notes_table(const compare::Comparison& comparison) {
  Table table{"Root count check",
              {{"family"},
               {"model"},
               {"found"},
               {"counted"},
               {"counting method"},
               {"rejected"},
               {"infinite"}}};
  for (const auto& note : comparison.notes) {
    const bool counted = note.count.expected >= 0;
    table.add_row({compare::label(note.family), note.subject, std::int64_t{note.found},
                   counted ? Cell(std::int64_t{note.count.expected}) : Cell(std::monostate{}),
                   counted ? Cell(note.count.method) : Cell(std::monostate{}),
                   std::int64_t(note.rejected.size()), std::int64_t{note.infinite}});
  }
  return table;
}

std::vector<Table> convergence_tables(const compare::Comparison& comparison) {
  std::vector<Table> tables;
  for (const auto& family : families_of(comparison)) {
    std::vector<std::pair<std::string, SeriesSummary>> series;
    for (const auto& curve : comparison.refinements) {
      if (!(curve.family == family)) continue;
      auto known =
          std::ranges::find(series, curve.refinement, [](const auto& s) { return s.first; });
      if (known == series.end()) known = series.insert(known, {curve.refinement, {}});
      known->second.add(curve);
    }
    if (series.empty()) continue;
    Table table{"Convergence: " + title_of(family),
                {{"refined"},
                 {"setting"},
                 {"order"},
                 {"decades", "1/dof"},
                 error_column("smallest error"),
                 {"rounding floor", "dof"},
                 {fmt::format("{:.0e}", comparison.wanted_accuracy), "dof"}}};
    for (const auto& [name, summary] : series) {
      table.add_row({name, summary.any->setting_name, summary.rate_text(compare::Decay::algebraic),
                     summary.rate_text(compare::Decay::exponential), summary.smallest_error_cell(),
                     count_or_missing(summary.rounding_from), count_or_missing(summary.cheapest)});
    }
    tables.push_back(std::move(table));
  }
  return tables;
}

Table shapes_table(const compare::Comparison& comparison) {
  Table table{"Mode shapes compared with " + comparison.subjects.front(),
              {{"mode"},
               {"model"},
               error_column("1 - MAC"),
               error_column("largest error"),
               {"hub slope", "1", 10},
               error_column("relative error")}};
  for (const auto& row : comparison.shapes) {
    table.add_row({std::int64_t{row.order}, row.formulation, row.one_minus_mac, row.largest_error,
                   row.hub_slope, row.hub_slope_error});
  }
  return table;
}

Table responses_table(const compare::Comparison& comparison) {
  Table table{
      fmt::format("Frequency responses compared with {}, at least {} % away from poles and zeros",
                  comparison.subjects.front(), 100.0 * compare::kOffResonance),
      {{"sensor"}, {"model"}, error_column("largest error"), {"at", "Hz", 4}}};
  for (const auto& response : comparison.responses) {
    for (std::size_t k = 1; k < comparison.subjects.size(); ++k) {
      table.add_row({arm::to_string(response.sensor), comparison.subjects[k],
                     response.largest_error[k], response.largest_error_frequency_Hz[k]});
    }
  }
  return table;
}

std::string convergence_legend(const compare::Comparison& comparison) {
  return fmt::format(
      "Convergence with respect to {0}, over all roots of a family: range of the order "
      "p in error ~ setting^-p, or of decades per degree of freedom (dof); smallest "
      "error of the worst root; dof at which the first root reaches the rounding "
      "floor; dof from which all roots are accurate to {1:.0e}.",
      comparison.subjects.front(), comparison.wanted_accuracy);
}

std::string verdict_line(const compare::Comparison& comparison, bool beside_measurement) {
  const std::string head = beside_measurement ? "Formulations" : "Verdict";
  if (comparison.subjects.empty()) {
    return head + ": agree. Without a beam they are the same.";
  }
  const auto& worst = comparison.verdict.worst;
  const std::string where =
      std::isnan(worst.distance)
          ? fmt::format("{}: missing in {}", worst.quantity,
                        comparison.verdict.alone.empty() ? worst.first + " or " + worst.second
                                                         : comparison.verdict.alone)
          : fmt::format("{}: relative difference of {} and {} {:.1e}, tolerance {:.0e}",
                        worst.quantity, worst.first, worst.second, worst.distance, worst.tolerance);
  std::string line = fmt::format("{}: {}. Largest difference relative to its tolerance: {}.", head,
                                 comparison.verdict.agree ? "agree" : "DISAGREE", where);
  const std::string& alone = comparison.verdict.alone;
  if (!alone.empty()) {
    auto others = comparison.subjects;
    std::erase(others, alone);
    line += fmt::format(" {} alone differs: {} agree.", alone, fmt::join(others, " and "));
  }
  if (!comparison.verdict.agree && worst.stated > 0.0) {
    line += std::isinf(worst.stated)
                ? " One of the formulations states that it may lack a root."
                : fmt::format(" One of the two states an error of up to {:.1e}.", worst.stated);
  }
  return line;
}

}  // namespace flexarm::report
