#include "tests/trials/cause.hpp"

namespace flexarm::trials {

/// The beam is longer or shorter than the file says, by 1 to 10 %. Places are those of the file,
/// from the root.
Cause beam_length() {
  return {.name = "beam_length",
          .acts_on = ActsOn::number,
          .largest = 0.1,
          .smallest_part = 0.1,
          .parameters = changed_factor,
          .change = [](const Parameters& of, const arm::Sensor& /*sensor*/, TrueArm& arm) {
            arm.length_m *= of.at("factor");
          }};
}

}  // namespace flexarm::trials
