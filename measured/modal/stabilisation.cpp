#include "measured/modal/stabilisation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flexarm::measured {
namespace {

using Eigen::Index;

/// |a^H b|^2/(|a|^2 |b|^2) [AllemangBrown1982].
double modal_assurance(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b) {
  const double sizes = a.squaredNorm() * b.squaredNorm();
  return sizes > 0.0 ? std::norm(a.dot(b)) / sizes : 0.0;
}

double frequency_Hz(std::complex<double> s) {
  return std::abs(s) / (2.0 * std::numbers::pi);
}

double damping_ratio(std::complex<double> s) {
  return -s.real() / std::abs(s);
}

ChartPole marked(const OrderPoles& at, std::size_t i, const OrderPoles& before,
                 const StabilisationTolerances& tolerances) {
  const auto s = at.s_rad_per_s[i];
  ChartPole pole{
      .order = at.order, .frequency_Hz = frequency_Hz(s), .damping_ratio = damping_ratio(s)};
  if (before.s_rad_per_s.empty()) return pole;
  const auto nearest = std::ranges::min_element(
      before.s_rad_per_s, {}, [s](std::complex<double> other) { return std::abs(other - s); });
  const auto k = static_cast<Index>(nearest - before.s_rad_per_s.begin());
  const double f = frequency_Hz(*nearest);
  const double zeta = damping_ratio(*nearest);
  pole.frequency_stable = std::abs(pole.frequency_Hz - f) <= tolerances.frequency * f;
  pole.damping_stable =
      pole.frequency_stable && std::abs(pole.damping_ratio - zeta) <=
                                   tolerances.damping_ratio * std::abs(zeta) + tolerances.undamped;
  pole.vector_stable = pole.frequency_stable &&
                       modal_assurance(at.residues.col(static_cast<Index>(i)),
                                       before.residues.col(k)) >= tolerances.modal_assurance;
  return pole;
}

}  // namespace

StabilisationChart stabilisation_chart(const std::vector<OrderPoles>& orders, double from_Hz,
                                       double to_Hz, const StabilisationTolerances& tolerances) {
  StabilisationChart chart{tolerances, from_Hz, to_Hz, {}, {}};
  const OrderPoles none;
  for (std::size_t n = 0; n < orders.size(); ++n) {
    chart.orders.push_back(orders[n].order);
    std::vector<ChartPole> row;
    for (std::size_t i = 0; i < orders[n].s_rad_per_s.size(); ++i) {
      const ChartPole pole = marked(orders[n], i, n == 0 ? none : orders[n - 1], tolerances);
      if (pole.frequency_Hz >= from_Hz && pole.frequency_Hz <= to_Hz) row.push_back(pole);
    }
    std::ranges::sort(row, {}, &ChartPole::frequency_Hz);
    chart.poles.insert(chart.poles.end(), row.begin(), row.end());
  }
  return chart;
}

std::vector<StablePole> stable_poles(const StabilisationChart& chart, int least_orders) {
  // Chains are followed from the highest order down, where poles are most accurate.
  std::vector<StablePole> found;
  const auto& tolerances = chart.tolerances;
  for (auto pole = chart.poles.rbegin(); pole != chart.poles.rend(); ++pole) {
    if (!pole->stable()) continue;
    const auto same = std::ranges::find_if(found, [&](const StablePole& other) {
      return std::abs(other.frequency_Hz - pole->frequency_Hz) <=
                 tolerances.frequency * other.frequency_Hz &&
             std::abs(other.damping_ratio - pole->damping_ratio) <=
                 3.0 * tolerances.damping_ratio * std::abs(other.damping_ratio) +
                     tolerances.undamped;
    });
    if (same == found.end()) {
      found.push_back({pole->frequency_Hz, pole->damping_ratio, 1});
    } else {
      ++same->orders;
    }
  }
  std::erase_if(found, [&](const StablePole& pole) { return pole.orders < least_orders; });
  std::ranges::stable_sort(found, std::ranges::greater{}, &StablePole::orders);
  return found;
}

}  // namespace flexarm::measured
