#pragma once

#include "arm/arm.hpp"
#include "arm/sensor.hpp"
#include "report/page/page_document.hpp"

#include <vector>

namespace flexarm::report::page {

/// Poles and zeros over the payload's mass by exact_tf, a block a sensor: from 0 to twice the
/// largest of `masses_kg`, or to half the beam's mass if that is more, in `kPayloadValues` values.
/// None for an arm that cannot be swept.
std::vector<SweepBlock> payload_sweep(const arm::Arm& arm, const std::vector<double>& masses_kg,
                                      const std::vector<arm::Sensor>& sensors);
inline constexpr std::size_t kPayloadValues = 41;

}  // namespace flexarm::report::page
