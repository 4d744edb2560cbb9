#pragma once

#include "measured/files/measurement.hpp"
#include "tests/trials/random.hpp"
#include "tests/trials/trial_arms.hpp"
#include "tests/trials/world.hpp"

#include <string>
#include <vector>

namespace flexarm::trials {

/// What is left to chance of a hidden cause, its size aside: drawn once a case.
struct Chance {
  double sign = 1.0;
  double place = 0.5;  ///< from 0 to 1: a position, a number of cycles, a frequency
  double ratio = 0.5;  ///< from 0 to 1
  double phase_rad = 0.0;
  std::string sensor = "tip_acceleration";
};
Chance draw_chance(Random& random);

/// A cause that can be hidden: an effect of the vocabulary, or one from outside.
struct Hideable {
  std::string name;
  bool outside = false;
  bool in_frequency = false;  ///< shows in frequency responses
  bool in_modes = false;      ///< and in poles and zeros
  /// Sizes from which nothing is seen to which it is still physical.
  double smallest = 1e-4;
  double largest = 1.0;

  bool shows_in(measured::RunKind kind) const;
};

/// The whole vocabulary in its order, then what is outside.
const std::vector<Hideable>& hideables();
/// The entry of that name; throws InputError where there is none.
const Hideable& find_hideable(const std::string& name);

/// `world` with the cause at this size. Sizes are ratios to what is natural to the arm: to the
/// beam's mass, EI/l, the torque; factors are exp(+-size).
World with_hidden(const World& world, const TrialArm& of, const Hideable& cause, double size,
                  const Chance& chance);

}  // namespace flexarm::trials
