#include "tests/trials/cause.hpp"

#include <cmath>
#include <memory>

namespace flexarm::trials {

namespace {

/// [Dahl1968]: dF/dtheta = (torque - F sign(theta'))/angle, exactly.
class DahlFriction : public HubTorque {
 public:
  DahlFriction(double last_N_m, double angle_rad) : last_N_m_(last_N_m), angle_rad_(angle_rad) {}
  double mean_N_m(const HubStep& step) const override {
    return -0.5 * (held_N_m_ + after(step.turn_rad));
  }
  void turned(double turn_rad) override { held_N_m_ = after(turn_rad); }

 private:
  double after(double turn_rad) const {
    const double last = std::copysign(last_N_m_, turn_rad);
    return last + (held_N_m_ - last) * std::exp(-std::abs(turn_rad) / angle_rad_);
  }

  double last_N_m_;
  double angle_rad_;
  double held_N_m_ = 0.0;
};

}  // namespace

/// Dahl's friction, of which the torque creeps up to its final size over an angle.
Cause hub_hysteresis() {
  return {.name = "hub_hysteresis",
          .shown_in = ShownIn::time,
          .acts_on = ActsOn::hub,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& chance) -> Parameters {
            // Of the typical torque the friction creeps up over 10 to 100 mrad.
            return {{"torque", size * natural.torque_N_m},
                    {"stiffness", natural.torque_N_m / between(0.01, 0.1, chance.place)}};
          },
          .change =
              [](const Parameters& of, const arm::Sensor& /*sensor*/, TrueArm& arm) {
                arm.hub_torques.push_back(
                    [last_N_m = of.at("torque"),
                     stiffness = of.at("stiffness")](const RunConditions& /*run*/) {
                      return std::make_unique<DahlFriction>(last_N_m, last_N_m / stiffness);
                    });
              }};
}

}  // namespace flexarm::trials
