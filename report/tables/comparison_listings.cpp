#include "report/tables/comparison_tables.hpp"
#include "report/tables/zero_kind.hpp"

#include <complex>
#include <cstdint>
#include <numbers>
#include <string>

namespace flexarm::report {

namespace {

Cell number_or_missing(const std::optional<double>& value) {
  return value ? Cell(*value) : Cell(std::monostate{});
}

}  // namespace

Table root_listing(const compare::Comparison& comparison) {
  Table table{"Poles and zeros",
              {{"family"},
               {"order"},
               {"model"},
               {"s_re", "rad/s"},
               {"s_im", "rad/s"},
               {"frequency", "Hz"},
               {"relative difference from reference model"},
               {"non-minimum phase"}}};
  for (const auto& row : comparison.roots) {
    for (std::size_t k = 0; k < comparison.subjects.size(); ++k) {
      const auto s = row.s_rad_per_s[k].value_or(std::complex<double>(kMissing, kMissing));
      table.add_row({compare::label(row.family), std::int64_t{row.order}, comparison.subjects[k],
                     s.real(), s.imag(), std::abs(s) / (2.0 * std::numbers::pi), row.distance[k],
                     row.family.zeros_of && row.s_rad_per_s[k]
                         ? Cell(std::string(is_non_minimum_phase(s) ? "yes" : "no"))
                         : Cell()});
    }
  }
  return table;
}

Table convergence_listing(const compare::Comparison& comparison) {
  Table table{"Convergence by root",
              {{"family"},
               {"order"},
               {"refined"},
               {"setting"},
               {"decay"},
               {"observed order of convergence", "", 3},
               {"points fitted"},
               error_column("smallest relative error"),
               {"rounding floor from setting"},
               {"rounding floor from dof"},
               {"accuracy reached from setting"},
               {"accuracy reached from dof"}}};
  const auto setting_cells = [](const std::optional<compare::RefinementPoint>& point) {
    return point ? std::pair<Cell, Cell>{std::int64_t{point->setting},
                                         std::int64_t{point->degrees_of_freedom}}
                 : std::pair<Cell, Cell>{};
  };
  for (const auto& curve : comparison.refinements) {
    const auto& seen = curve.convergence;
    const auto [onset_setting, onset_dof] = setting_cells(seen.rounding_onset);
    const auto [cheapest_setting, cheapest_dof] = setting_cells(seen.cheapest);
    table.add_row({compare::label(curve.family), std::int64_t{curve.order}, curve.refinement,
                   curve.setting_name,
                   curve.decay == compare::Decay::algebraic ? "algebraic" : "exponential",
                   number_or_missing(seen.rate), std::int64_t{seen.points_fitted},
                   seen.smallest_error, onset_setting, onset_dof, cheapest_setting, cheapest_dof});
  }
  return table;
}

Table refinement_listing(const compare::Comparison& comparison) {
  Table table{"Convergence series",
              {{"family"},
               {"order"},
               {"refined"},
               {"setting"},
               {"value"},
               {"degrees of freedom"},
               {"relative error"}}};
  for (const auto& curve : comparison.refinements) {
    for (const auto& point : curve.points) {
      table.add_row({compare::label(curve.family), std::int64_t{curve.order}, curve.refinement,
                     curve.setting_name, std::int64_t{point.setting},
                     std::int64_t{point.degrees_of_freedom}, point.relative_error});
    }
  }
  return table;
}

Table shapes_listing(const compare::Comparison& comparison) {
  Table table{"Mode shapes", {{"model"}, {"mode"}, {"x", "m"}, {"displacement", "m"}}};
  for (std::size_t k = 0; k < comparison.subjects.size(); ++k) {
    for (std::size_t i = 0; i < comparison.modes[k].size(); ++i) {
      for (std::size_t j = 0; j < comparison.stations_m.size(); ++j) {
        table.add_row({comparison.subjects[k], std::int64_t(i) + 1, comparison.stations_m[j],
                       comparison.modes[k][i].displacement_m[j]});
      }
    }
  }
  return table;
}

Table responses_listing(const compare::Comparison& comparison) {
  Table table{"Frequency responses per unit torque",
              {{"sensor"},
               {"model"},
               {"frequency", "Hz"},
               {"re"},
               {"im"},
               {"relative difference from reference model"},
               {"1 - response agreement of all models"}}};
  for (const auto& response : comparison.responses) {
    for (std::size_t k = 0; k < comparison.subjects.size(); ++k) {
      for (std::size_t j = 0; j < response.frequency_Hz.size(); ++j) {
        const auto value = response.values[k][j];
        table.add_row({arm::to_string(response.sensor), comparison.subjects[k],
                       response.frequency_Hz[j], value.real(), value.imag(),
                       response.relative_error[k][j], response.one_minus_coherence[j]});
      }
    }
  }
  return table;
}

}  // namespace flexarm::report
