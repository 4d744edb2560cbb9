#include "arm/input_error.hpp"
#include "effects/registry/entry.hpp"
#include "effects/registry/rotational_spring.hpp"

namespace flexarm::effects {

namespace {

void require_divisible_hub(const arm::Effect& effect, const arm::Arm& arm) {
  const double share = effect.value("rotor_share");
  if (share >= 1.0) {
    throw arm::out_of_range("effects.drive_compliance.rotor_share", share, "",
                            "above 0 and below 1");
  }
  if (!(arm.hub.inertia_kg_m2 > 0.0)) {
    throw arm::InputError(
        "effects.drive_compliance: rotor and hub share hub.inertia; must be above 0",
        "effects.drive_compliance");
  }
}

void add_drive(const arm::Effect& effect, const arm::Arm& arm, arm::LinearTerms& terms) {
  terms.drive = arm::Drive{effect.value("rotor_share") * arm.hub.inertia_kg_m2,
                           effect.value("stiffness"), effect.value("time")};
}

}  // namespace

Entry drive_compliance() {
  return {
      .definition = define(
          {.name = "drive_compliance",
           .meaning = "rotational spring and dashpot beside each other, a gear or a coupling, "
                      "between the rotor and the rest of the hub: moment stiffness (phi + time d "
                      "phi/dt), phi the rotation between them. Torque, hub friction, hub springs "
                      "and hub sensors are at the rotor",
           .parameters = {rotational_stiffness(30.0),
                          {.name = "rotor_share",
                           .unit = "1",
                           .range = arm::kPositive,
                           .meaning = "the rotor's part of hub.inertia, below 1",
                           .example = 0.6},
                          retardation_time("the drive", 1e-3, 0.0)},
           .linear_term = add_drive,
           .require_fit = require_divisible_hub}),
      .shows = Shows::in_all,
      .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
        return {searched_stiffness(scales),
                {"rotor_share", 0.02, 0.98, Spacing::linear},
                searched_retardation_time(scales)};
      },
      .applies = [](const Scales& scales) { return scales.arm.hub.inertia_kg_m2 > 0.0; },
      // As rotor_share nears 1, on a hub without radius.
      .contains = {"root_compliance", "root_damping"},
      .family = Family::root,
      .speaks_for =
          "one pole more than the beam has, and with it one zero of the hub angle; above it the "
          "hub sensors show the rotor alone; unchanged zeros of the tip and the gauges",
      .refuted_by =
          "hub-angle zeros of the arm with a rigid drive, or responses that ask for all of the "
          "hub's inertia on one side of the spring (that is root compliance)"};
}

}  // namespace flexarm::effects
