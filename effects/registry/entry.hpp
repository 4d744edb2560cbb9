#pragma once

#include "arm/arm.hpp"
#include "arm/effects.hpp"
#include "effects/registry/search.hpp"

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace flexarm::effects {

/// The kinds of data in which an effect shows.
enum class Shows {
  in_time,                ///< alone: it is not linear, or shifts the working point
  in_time_and_frequency,  ///< not in poles and zeros
  in_all,
};

/// How likely an arm in a laboratory has an effect that its file does not state, before the data.
enum class Likely {
  common,    ///< most arms: friction, damping, a number that is off, a late or scaled signal
  possible,  ///< some arms
  rare,      ///< a fault, or a device that whoever wrote the file would have known
};

/// Returns the probability of an effect with this prior.
constexpr double probability_of(Likely prior) {
  switch (prior) {
    case Likely::common:
      return 0.2;
    case Likely::possible:
      return 0.04;
    case Likely::rare:
      return 0.008;
  }
  return 0.0;
}

/// Physical causes of which several effects are forms: data cannot easily tell these apart.
enum class Family {
  stated_law,        ///< a torque law that the arm file states
  dry_friction,      ///< a dead zone of the drive included
  viscous_loss,      ///< back-EMF included
  beam_dissipation,  ///< in the beam or in the air around it
  beam_stiffness,    ///< sizes of the beam included, all of which shift its poles
  beam_mass,         ///< along the beam or at a place of it
  root,              ///< springs between rotor, hub and beam
  hub_inertia,
  payload_inertia,  ///< mass and place of the payload included
  torque_scale,     ///< its gain and its limit
  timing,           ///< delays and lags of the torque or of one sensor
  sensor,           ///< the values of one sensor
  constant_torque,  ///< or one that varies with the hub angle: gravity, a tilt, a ripple
  hub_spring,       ///< between hub and ground
  disturbance,      ///< a torque that varies with time alone
};

/// The name of a family in words: "dry friction of the hub".
constexpr std::string_view to_string(Family family) {
  switch (family) {
    case Family::stated_law:
      return "law that the arm file states";
    case Family::dry_friction:
      return "dry friction of the hub";
    case Family::viscous_loss:
      return "viscous loss of the hub";
    case Family::beam_dissipation:
      return "dissipation of the beam";
    case Family::beam_stiffness:
      return "stiffness of the beam";
    case Family::beam_mass:
      return "mass of the beam";
    case Family::root:
      return "root";
    case Family::hub_inertia:
      return "inertia of the hub";
    case Family::payload_inertia:
      return "inertia of the payload";
    case Family::torque_scale:
      return "gain and limits of the torque";
    case Family::timing:
      return "timing";
    case Family::sensor:
      return "sensor";
    case Family::constant_torque:
      return "gravity and constant torques";
    case Family::hub_spring:
      return "spring of the hub";
    case Family::disturbance:
      return "disturbance";
  }
  return {};
}

/// All that the product knows of an effect. Each file `effects/NAME.cpp` defines one function
/// `Entry NAME()`, which the build finds by the name of the file.
struct Entry {
  std::shared_ptr<const arm::EffectDefinition> definition;
  Shows shows = Shows::in_all;
  /// Where its parameters are looked for, in the definition's order. Of an effect on one sensor the
  /// scales are those of that sensor, here and in `applies`.
  std::function<std::vector<SearchedParameter>(const Scales&)> search;
  /// Whether an experiment with these scales can have it; always, unless given.
  std::function<bool(const Scales&)> applies = {};
  /// Effects that this one becomes at a limit of its parameters.
  std::vector<std::string> contains = {};
  /// Effects that are the same model by another name: no data distinguish them from this one. They
  /// have as many parameters, each with the same meaning to the model.
  std::vector<std::string> same_as = {};
  /// How likely an arm has it before anything is measured.
  Likely prior = Likely::possible;
  /// For a factor of a number of the arm file that states no uncertainty: the standard deviation of
  /// its logarithm that such numbers usually have. 0 where that is unknown.
  double usual_deviation = 0.0;
  /// Stated by each file effects/NAME.cpp.
  Family family = Family::stated_law;
  std::string speaks_for;  ///< what the data show where it is the cause
  std::string refuted_by;  ///< what would show that it is not
};

inline std::shared_ptr<const arm::EffectDefinition> define(arm::EffectDefinition definition) {
  return std::make_shared<const arm::EffectDefinition>(std::move(definition));
}

}  // namespace flexarm::effects
