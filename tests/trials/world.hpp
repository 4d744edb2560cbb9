#pragma once

#include "tests/trials/cause.hpp"

#include <string>
#include <vector>

namespace flexarm::trials {

/// A cause that acts on an arm.
struct HiddenCause {
  std::string name;
  Parameters parameters;
  std::string sensor = {};  ///< that it acts on, where it acts on one
};

/// An arm as it really is: what its file says, and what is hidden.
struct World {
  arm::Arm arm;
  std::vector<HiddenCause> hidden = {};

  /// The hidden cause of that name, or null.
  const HiddenCause* find(const std::string& name) const;
  /// Something hidden is outside the vocabulary.
  bool has_outside() const;
};

/// The arm with its causes, in the simulator's terms.
TrueArm true_arm(const World& world);

/// `world` with the cause at this size.
World with_hidden(const World& world, const TrialArm& of, const Cause& cause, double size,
                  const Chance& chance);

}  // namespace flexarm::trials
