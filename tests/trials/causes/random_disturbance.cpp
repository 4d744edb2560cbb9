#include "tests/trials/cause.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <vector>

namespace flexarm::trials {

namespace {

/// It repeats itself after far more than a run.
constexpr int kDisturbanceLines = 60;

struct Band {
  double rms_N_m;
  double lowest_Hz;
  double highest_Hz;
};

struct DisturbanceLine {
  double omega_rad_per_s;
  double phase_rad;
};

std::function<double(const HubStep&)> disturbance(const Band& band, const RunConditions& run) {
  Random random(run.seed, "disturbance");
  const double amplitude_N_m = band.rms_N_m * std::sqrt(2.0 / kDisturbanceLines);
  const double lowest_Hz = std::max(band.lowest_Hz, 0.5 / run.duration_s);
  std::vector<DisturbanceLine> lines;
  for (int i = 0; i < kDisturbanceLines; ++i) {
    const double frequency_Hz = random.uniform(lowest_Hz, band.highest_Hz);
    lines.push_back(
        {2.0 * std::numbers::pi * frequency_Hz, random.uniform(0.0, 2.0 * std::numbers::pi)});
  }
  return [amplitude_N_m, lines](const HubStep& step) {
    double sum = 0.0;
    for (const DisturbanceLine& line : lines) {
      sum += std::sin(line.omega_rad_per_s * step.time_s + line.phase_rad);
    }
    return amplitude_N_m * sum;
  };
}

}  // namespace

/// A torque on the hub that is not measured, another noise in every run: lines of equal amplitude,
/// at frequencies drawn from a band.
Cause random_disturbance() {
  return {
      .name = "random_disturbance",
      .outside = true,
      .port = "hub",
      .shown_in = ShownIn::time,
      .acts_on = ActsOn::hub,
      .parameters = [](const NaturalSizes& natural, double size,
                       const Chance& chance) -> Parameters {
        return {{"rms", size * natural.torque_N_m},
                {"lowest", 0.5},
                {"highest", between(5.0, 40.0, chance.place)}};
      },
      .change =
          [](const Parameters& of, const arm::Sensor& /*sensor*/, TrueArm& arm) {
            arm.hub_torques.push_back([band = Band{of.at("rms"), of.at("lowest"),
                                                   of.at("highest")}](const RunConditions& run) {
              return std::make_unique<PlainHubTorque>(disturbance(band, run));
            });
          }};
}

}  // namespace flexarm::trials
