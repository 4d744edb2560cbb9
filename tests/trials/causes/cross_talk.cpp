#include "tests/trials/cause.hpp"
#include "tests/trials/experiment_plan.hpp"

namespace flexarm::trials {

/// The strain gauge's amplifier picks up the accelerometer's signal. Of size 1 it reads as much for
/// the acceleration of the rigid arm as for the bending that goes with the same torque.
Cause cross_talk() {
  return {.name = "cross_talk",
          .outside = true,
          .port = "sensor strain@0.05",
          .shown_in = ShownIn::time,
          .acts_on = ActsOn::sensor,
          .largest = 3.0,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& chance) -> Parameters {
            const double strain =
                0.5 * natural.thickness_m / (natural.spring_N_m_per_rad * natural.length_m);
            const double acceleration = natural.length_m / natural.inertia_kg_m2;
            return {{"factor", chance.sign * size * strain / acceleration}};
          },
          .change =
              [](const Parameters& of, const arm::Sensor& /*sensor*/, TrueArm& arm) {
                arm.cross_talks.push_back(
                    {{arm::SensorKind::tip_acceleration, 0.0}, kGauge, of.at("factor")});
              }};
}

}  // namespace flexarm::trials
