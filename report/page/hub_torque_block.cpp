#include "report/page/hub_torque_block.hpp"

#include "measured/spectra/robust.hpp"
#include "report/figures/residual_torque.hpp"

#include <algorithm>
#include <utility>

namespace flexarm::report::page {

namespace {

ScatterPanel torque_scatter(const diagnose::HubTorque& torque,
                            const diagnose::HubTorqueTrace& trace, bool of_velocity) {
  const auto& x = of_velocity ? trace.velocity_rad_per_s : trace.angle_rad;
  const auto& y = trace.torque_N_m;
  // The last samples say little of the torque (HubResponse::torque), and a few spikes would set the
  // scale.
  constexpr double kShown = 0.05;
  const double low = measured::quantile(y, kShown);
  const double high = measured::quantile(y, 1.0 - kShown);
  const double room = 0.5 * (high - low);
  ScatterPanel panel{of_velocity ? Axis{"hub velocity", "rad/s"} : Axis{"hub angle", "rad"},
                     {"residual hub torque", "N m"},
                     false,
                     {}};
  if (high > low) panel.y.range = {low - room, high + room};
  std::vector<float> some_x;
  std::vector<float> some_y;
  const std::size_t stride = (x.size() + kMostScattered - 1) / kMostScattered;
  for (std::size_t k = 0; k < x.size(); k += stride) {
    some_x.push_back(static_cast<float>(x[k]));
    some_y.push_back(static_cast<float>(y[k]));
  }
  panel.series.push_back(
      {"samples", Role::measured, Draw::points, std::move(some_x), std::move(some_y)});
  const TorqueMeans means = torque_means(x, y);
  std::vector<double> bar_x;
  std::vector<double> bar_y;
  for (std::size_t b = 0; b < means.x.size(); ++b) {
    for (const double side : {-2.0, 2.0}) {
      bar_x.push_back(means.x[b]);
      bar_y.push_back(means.mean[b] + side * means.std_error[b]);
    }
    bar_x.push_back(means.x[b]);
    bar_y.push_back(kGapNumber);
  }
  panel.series.push_back(
      {"mean ± 2 standard errors", Role::first, Draw::line, std::move(bar_x), std::move(bar_y)});
  panel.series.push_back({"mean", Role::first, Draw::points, means.x, means.mean});
  TorqueLine found = identified_torque(torque, of_velocity, x);
  if (!found.x.empty()) {
    panel.series.push_back({"significant terms", Role::after, Draw::line, std::move(found.x),
                            std::move(found.torque_N_m)});
  }
  return panel;
}

}  // namespace

ScatterBlock hub_torque_block(const diagnose::HubTorque& torque) {
  ScatterBlock block{{"hub-torque", "Over velocity and angle of the hub",
                      "The torque which, added at the hub, would make the simulation of the arm "
                      "file reproduce the signals of the hub."},
                     {"run"},
                     {}};
  if (torque.traces.empty()) return block;
  const auto add = [&](const diagnose::HubTorqueTrace& trace) {
    if (trace.torque_N_m.empty()) return;
    block.views.push_back(
        {{trace.run},
         {},
         {torque_scatter(torque, trace, true), torque_scatter(torque, trace, false)}});
  };
  const diagnose::HubTorqueTrace& first = clearest(torque);
  add(first);
  for (const auto& trace : torque.traces) {
    if (&trace != &first) add(trace);
  }
  return block;
}

}  // namespace flexarm::report::page
