#pragma once

#include "tests/trials/random.hpp"

#include <string>

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

}  // namespace flexarm::trials
