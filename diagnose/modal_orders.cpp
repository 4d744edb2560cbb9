#include "diagnose/modal_orders.hpp"

#include "compare/identification.hpp"
#include "compare/measured.hpp"
#include "compare/root_numbering.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <utility>

namespace flexarm::diagnose {

std::vector<std::string> put_orders(const arm::Arm& arm, measured::ModalTable& table) {
  const bool all_stated =
      std::ranges::all_of(table, [](const auto& entry) { return entry.order.has_value(); });
  if (all_stated) return {};
  double top_Hz = 0.0;
  for (const auto& entry : table) top_Hz = std::max(top_Hz, entry.frequency_Hz.value_or(0.0));
  const compare::AnalyticalModes analytical = compare::analytical_modes(
      arm, compare::sensors_with_zeros(table), compare::needed_Hz(top_Hz));
  compare::ModelRoots model = compare::model_roots(analytical);
  for (std::size_t k = 0; k < model.zeros.size(); ++k) {
    model.zeros[k].roots.clear();
    int order = 0;  // real zeros count as well, antiresonances alone are measured
    for (const auto& s : analytical.zeros[k].s_rad_per_s) {
      ++order;
      if (s.real() == 0.0) {
        model.zeros[k].roots.push_back({s.imag() / (2.0 * std::numbers::pi), order});
      }
    }
  }
  const std::vector<compare::RootOrder> orders = compare::number_roots(table, model);
  std::vector<std::string> notices;
  measured::ModalTable kept;
  int interlaced = 0;
  int nearest = 0;
  for (std::size_t i = 0; i < table.size(); ++i) {
    measured::ModalEntry entry = table[i];
    entry.order = orders[i].order;
    interlaced += orders[i].basis == compare::OrderBasis::interlacing ? 1 : 0;
    nearest += orders[i].basis == compare::OrderBasis::distance ? 1 : 0;
    if (entry.order) {
      kept.push_back(std::move(entry));
      continue;
    }
    notices.push_back(fmt::format(
        "{}{}{} excluded: no order stated, and none can be assigned",
        entry.sensor ? arm::to_string(*entry.sensor) + " " : "", measured::to_string(entry.feature),
        entry.frequency_Hz ? fmt::format(" at {:.4g} Hz", *entry.frequency_Hz) : ""));
  }
  if (interlaced + nearest > 0) {
    notices.insert(
        notices.begin(),
        fmt::format("orders assigned to {} of {} roots: {} by interlacing, {} by distance",
                    interlaced + nearest, table.size(), interlaced, nearest));
  }
  table = std::move(kept);
  return notices;
}

}  // namespace flexarm::diagnose
