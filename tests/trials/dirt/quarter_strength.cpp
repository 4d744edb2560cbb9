#include "tests/trials/dirt.hpp"

namespace flexarm::trials {

/// Nothing is added; hidden causes make a quarter of the error.
Dirt quarter_strength() {
  return {.name = "quarter_strength", .strength = 0.25};
}

}  // namespace flexarm::trials
