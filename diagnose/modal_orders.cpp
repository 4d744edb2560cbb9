#include "diagnose/modal_orders.hpp"

#include "compare/identification.hpp"
#include "compare/measured.hpp"
#include "compare/root_numbering.hpp"
#include "measured/modal/modal_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace flexarm::diagnose {

namespace {

/// "tip_acceleration zero at 12.3 Hz".
std::string name_of(const measured::ModalEntry& entry) {
  return fmt::format("{}{}{}", entry.sensor ? arm::to_string(*entry.sensor) + " " : "",
                     measured::to_string(entry.feature),
                     entry.frequency_Hz ? fmt::format(" at {:.4g} Hz", *entry.frequency_Hz) : "");
}

/// As `measured::modal_table` takes none from a fit.
bool is_real_zero(const measured::ModalEntry& entry) {
  return entry.feature == measured::Feature::zero &&
         std::abs(entry.damping_ratio.value_or(0.0)) >
             measured::ModalFitOptions{}.most_damping_ratio;
}

}  // namespace

std::vector<std::string> put_orders(const arm::Arm& arm, measured::ModalTable& table) {
  std::vector<std::string> notices;
  for (const auto& entry : table) {
    if (!is_real_zero(entry)) continue;
    notices.push_back(
        fmt::format("{} excluded: with a damping ratio of {:.2g} it is no antiresonance",
                    name_of(entry), *entry.damping_ratio));
  }
  std::erase_if(table, is_real_zero);
  const bool all_stated =
      std::ranges::all_of(table, [](const auto& entry) { return entry.order.has_value(); });
  if (all_stated) return notices;
  double top_Hz = 0.0;
  for (const auto& entry : table) top_Hz = std::max(top_Hz, entry.frequency_Hz.value_or(0.0));
  const compare::AnalyticalModes analytical = compare::analytical_modes(
      arm, compare::sensors_with_zeros(table), compare::needed_Hz(top_Hz));
  const std::vector<compare::RootOrder> orders =
      compare::number_roots(table, compare::model_roots(analytical));
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
    notices.push_back(name_of(entry) + " excluded: no order stated, and none can be assigned");
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
