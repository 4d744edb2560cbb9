#include "report/tables/empirical_law_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

namespace flexarm::report {

namespace {

std::string_view axes_of(const arm::HubTorqueTable& table) {
  if (table.angle_rad.empty()) return "the hub velocity";
  return table.velocity_rad_per_s.empty() ? "the hub angle" : "the hub angle and velocity";
}

}  // namespace

std::string empirical_law_text(const diagnose::EmpiricalLaw& law) {
  std::string text = fmt::format(
      "Empirical law: a torque on the hub that depends on {} removes {:.3g} % of the mean square "
      "of the residual hub torque. With it in the extended arm, NRMSE of a simulation falls from "
      "{:.3g} to {:.3g} %. Median standard error of its torques: {:.2g} N m.",
      axes_of(law.table), explained_percent(law.share), 100.0 * law.error_before,
      100.0 * law.error_after, law.std_error_N_m);
  if (law.table.friction_N_m() > 0.0) {
    text += fmt::format(" Dry friction in it: {:.3g} N m.", law.table.friction_N_m());
  }
  return text;
}

Table empirical_law_table(const diagnose::EmpiricalLaw& law) {
  const arm::HubTorqueTable& table = law.table;
  Table made{"Empirical law", {}};
  if (!table.angle_rad.empty()) made.columns.push_back({.name = "hub angle", .unit = "rad"});
  if (!table.velocity_rad_per_s.empty()) {
    made.columns.push_back({.name = "hub velocity", .unit = "rad/s"});
  }
  made.columns.push_back({.name = "torque", .unit = "N m"});
  for (std::size_t i = 0; i < std::max<std::size_t>(1, table.angle_rad.size()); ++i) {
    for (std::size_t j = 0; j < table.columns(); ++j) {
      std::vector<Cell> row;
      if (!table.angle_rad.empty()) row.emplace_back(table.angle_rad[i]);
      if (!table.velocity_rad_per_s.empty()) row.emplace_back(table.velocity_rad_per_s[j]);
      row.emplace_back(table.torque_N_m[i * table.columns() + j]);
      made.add_row(std::move(row));
    }
  }
  return made;
}

}  // namespace flexarm::report
