#include "tests/trials/cause.hpp"

#include <cmath>
#include <numbers>

namespace flexarm::trials {

namespace {

/// Of the payload on its clamp.
constexpr double kClamp_Hz = 200.0;
constexpr double kSlippingPayloadDampingRatio = 0.02;

}  // namespace

/// The clamp of the payload slips. Of size 1 it holds what a payload of the beam's mass needs under
/// the typical torque on the rigid arm; shows in runs with a payload.
Cause slipping_payload() {
  return {.name = "slipping_payload",
          .outside = true,
          .port = "tip",
          .shown_in = ShownIn::time,
          .acts_on = ActsOn::beam,
          .largest = 100.0,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& /*chance*/) -> Parameters {
            const double acceleration =
                natural.torque_N_m / natural.inertia_kg_m2 * natural.length_m;
            return {{"slip", natural.beam_kg * acceleration / size}};
          },
          .change =
              [](const Parameters& of, const arm::Sensor& /*sensor*/, TrueArm& arm) {
                if (arm.payload_kg == 0.0) return;
                const double omega = 2.0 * std::numbers::pi * kClamp_Hz;
                const double stiffness = arm.payload_kg * omega * omega;
                arm.slipping = TrueArm::SlippingMass{
                    arm.payload_kg, stiffness,
                    2.0 * kSlippingPayloadDampingRatio * stiffness / omega, of.at("slip")};
                arm.payload_kg = 0.0;
              }};
}

}  // namespace flexarm::trials
