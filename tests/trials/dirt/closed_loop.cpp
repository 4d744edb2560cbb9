#include "tests/trials/dirt.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace flexarm::trials {

namespace {

/// Of the rigid arm in its loop.
constexpr double kLoop_Hz = 0.5;
constexpr double kLoopDamping = 0.35;
constexpr double kStair_s = 0.8;
/// The largest step asks for this many times the lowest torque, of which the limit leaves less.
constexpr double kAsked = 8.0;
constexpr double kLimit = 6.0;

}  // namespace

/// The torque is that of a PD controller of the hub with a limit, which follows a staircase. It is
/// recorded, the controller is not.
Dirt closed_loop() {
  return {.name = "closed_loop",
          .simulation = [](double size, const TrialArm& of, Random& random, TimeOptions& options) {
            if (size == 0.0) return;
            const double omega = 2.0 * std::numbers::pi * kLoop_Hz;
            const double inertia = NaturalSizes(of).inertia_kg_m2;
            const double kp = inertia * omega * omega;
            const double kd = 2.0 * kLoopDamping * inertia * omega;
            const double limit_N_m = kLimit * of.low_torque_N_m;
            const double height_rad = 0.5 * kAsked * of.low_torque_N_m / kp;
            const auto per_stair = static_cast<std::size_t>(kStair_s / options.sample_time_s);
            std::vector<double> stairs;
            for (std::size_t k = 0; k < kSamples; k += per_stair) {
              stairs.push_back(random.uniform(-height_rad, height_rad));
            }
            options.control = [=](std::size_t sample, std::span<const double> readings) {
              const double error_rad = stairs[sample / per_stair] - readings[0];
              return std::clamp(kp * error_rad - kd * readings[1], -limit_N_m, limit_N_m);
            };
          }};
}

}  // namespace flexarm::trials
