#include "tests/trials/dirt.hpp"

namespace flexarm::trials {

/// One run under random torque, which there is nothing to validate by.
Dirt single_run() {
  return {.name = "single_run", .plan = [](double size, std::vector<PlannedRun>& runs) {
            if (size == 0.0) return;
            runs = {runs.at(1)};
          }};
}

}  // namespace flexarm::trials
