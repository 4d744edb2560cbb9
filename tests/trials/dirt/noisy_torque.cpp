#include "tests/trials/dirt.hpp"

namespace flexarm::trials {

namespace {

constexpr double kNoisyTorquePart = 0.05;

}  // namespace

/// The torque is measured, with white noise of 5 %.
Dirt noisy_torque() {
  return {.name = "noisy_torque", .recording = [](double size, Random& random, Recording& made) {
            if (size == 0.0) return;
            const double scale = size * kNoisyTorquePart * deviation(made.record.torque_N_m);
            for (double& torque : made.record.torque_N_m) torque += scale * random.normal();
          }};
}

}  // namespace flexarm::trials
