#include "tests/trials/cause.hpp"

#include <cmath>
#include <memory>
#include <numbers>

namespace flexarm::trials {

namespace {

/// Of the hub's inertia, that of the rotor.
constexpr double kRotorPart = 0.5;
/// Of the rotor on the flanks of the gear, were the hub fixed.
constexpr double kFlanks_Hz = 150.0;
constexpr double kBacklashDampingRatio = 0.05;

/// The rotor drives the hub through a gap; what the actuator gives goes to the rotor alone.
class GapDrive : public HubTorque {
 public:
  GapDrive(double inertia_kg_m2, double gap_rad)
      : inertia_kg_m2_(inertia_kg_m2), half_gap_rad_(0.5 * gap_rad) {}

  double mean_N_m(const HubStep& step) const override {
    const double rotor_rad = angle_rad_ + 0.5 * step.duration_s * speed_rad_per_s_;
    return contact_N_m(rotor_rad - step.angle_rad, speed_rad_per_s_ - step.speed_rad_per_s) -
           step.driving_N_m;
  }

  void made(const HubStep& step) override {
    const double contact = mean_N_m(step) + step.driving_N_m;
    speed_rad_per_s_ += step.duration_s * (step.driving_N_m - contact) / inertia_kg_m2_;
    angle_rad_ += step.duration_s * speed_rad_per_s_;
  }

 private:
  double contact_N_m(double ahead_rad, double ahead_rad_per_s) const {
    const double pressed = std::abs(ahead_rad) - half_gap_rad_;
    if (pressed <= 0.0) return 0.0;
    const double omega = 2.0 * std::numbers::pi * kFlanks_Hz;
    return inertia_kg_m2_ * (omega * omega * std::copysign(pressed, ahead_rad) +
                             2.0 * kBacklashDampingRatio * omega * ahead_rad_per_s);
  }

  double inertia_kg_m2_;
  double half_gap_rad_;
  double angle_rad_ = 0.0;
  double speed_rad_per_s_ = 0.0;
};

}  // namespace

/// A gear with a gap between the rotor and the hub, whose sensors are behind it. Of size 1 the gap
/// is the angle by which the typical torque bends the beam.
Cause backlash() {
  return {.name = "backlash",
          .outside = true,
          .port = "hub",
          .shown_in = ShownIn::time,
          .acts_on = ActsOn::hub,
          .largest = 50.0,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& /*chance*/) -> Parameters {
            return {{"gap", size * natural.torque_N_m / natural.spring_N_m_per_rad}};
          },
          .change =
              [](const Parameters& of, const arm::Sensor& /*sensor*/, TrueArm& arm) {
                const double rotor_kg_m2 = kRotorPart * arm.hub_inertia_kg_m2;
                arm.hub_inertia_kg_m2 -= rotor_kg_m2;
                arm.hub_torques.push_back(
                    [rotor_kg_m2, gap_rad = of.at("gap")](const RunConditions& /*run*/) {
                      return std::make_unique<GapDrive>(rotor_kg_m2, gap_rad);
                    });
              }};
}

}  // namespace flexarm::trials
