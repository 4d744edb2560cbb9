#pragma once

#include "diagnose/symptoms/hub_torque.hpp"
#include "report/page/page_document.hpp"

namespace flexarm::report::page {

/// Residual torque at the hub over hub velocity and over hub angle: samples, means with two
/// standard errors, what the significant terms make; a view a run, the clearest one first. No views
/// without residual torque.
ScatterBlock hub_torque_block(const diagnose::HubTorque& torque);
inline constexpr std::size_t kMostScattered = 2000;

}  // namespace flexarm::report::page
