#include "report/figures/residual_torque.hpp"

#include "measured/spectra/robust.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace flexarm::report {

namespace {

using diagnose::HubTorqueKind;

constexpr std::size_t kBins = 24;

double found_torque(const diagnose::HubTorque& torque, bool of_velocity, double x) {
  double sum = 0.0;
  for (const auto& term : torque.terms) {
    if (of_velocity && term.kind == HubTorqueKind::coulomb_friction) {
      sum -= std::copysign(term.coefficient, term.coefficient * x);
    }
    if (of_velocity && term.kind == HubTorqueKind::viscous_friction) sum -= term.coefficient * x;
    if (!of_velocity && term.kind == HubTorqueKind::spring) sum -= term.coefficient * x;
  }
  return sum;
}

}  // namespace

double TorqueMeans::contrast() const {
  const double middle = measured::mean(mean);
  double sum = 0.0;
  for (std::size_t b = 0; b < mean.size(); ++b) {
    sum += std::pow((mean[b] - middle) / std_error[b], 2);
  }
  return sum / static_cast<double>(mean.size());
}

TorqueMeans torque_means(const std::vector<double>& x, const std::vector<double>& torque_N_m) {
  std::vector<std::size_t> order(x.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](std::size_t k) { return x[k]; });
  TorqueMeans made;
  for (std::size_t b = 0; b < kBins; ++b) {
    const std::size_t from = b * order.size() / kBins;
    const std::size_t to = (b + 1) * order.size() / kBins;
    std::vector<double> own_x;
    std::vector<double> own_y;
    for (std::size_t i = from; i < to; ++i) {
      own_x.push_back(x[order[i]]);
      own_y.push_back(torque_N_m[order[i]]);
    }
    if (own_y.size() < 2) continue;
    made.x.push_back(measured::mean(own_x));
    made.mean.push_back(measured::mean(own_y));
    made.std_error.push_back(measured::standard_deviation(own_y) /
                             std::sqrt(static_cast<double>(own_y.size() - 1)));
  }
  return made;
}

TorqueLine identified_torque(const diagnose::HubTorque& torque, bool of_velocity,
                             const std::vector<double>& x) {
  const auto [least, most] = std::ranges::minmax_element(x);
  TorqueLine line;
  const double tiny = 1e-9 * (*most - *least);  // both sides of a jump at 0
  for (const double at : {*least, -tiny, tiny, *most}) {
    if (at < *least || at > *most) continue;
    line.x.push_back(at);
    line.torque_N_m.push_back(found_torque(torque, of_velocity, at));
  }
  const bool is_zero = std::ranges::all_of(line.torque_N_m, [](double t) { return t == 0.0; });
  return is_zero ? TorqueLine{} : line;
}

bool depends_on_motion(const diagnose::HubTorque& torque) {
  return std::ranges::any_of(torque.terms, [](const auto& term) {
    return term.kind == HubTorqueKind::coulomb_friction ||
           term.kind == HubTorqueKind::viscous_friction || term.kind == HubTorqueKind::spring ||
           term.kind == HubTorqueKind::ripple;
  });
}

const diagnose::HubTorqueTrace& clearest(const diagnose::HubTorque& torque) {
  return *std::ranges::max_element(torque.traces, {}, [](const diagnose::HubTorqueTrace& trace) {
    return std::max(torque_means(trace.velocity_rad_per_s, trace.torque_N_m).contrast(),
                    torque_means(trace.angle_rad, trace.torque_N_m).contrast());
  });
}

}  // namespace flexarm::report
