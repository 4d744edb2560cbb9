#pragma once

#include "arm/formulation.hpp"
#include "assumed_modes/assumed_modes_arm.hpp"
#include "exact_tf/exact_arm.hpp"
#include "fem/fem_arm.hpp"
#include "response/rigid_hub.hpp"

#include <complex>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

namespace flexarm::response {

static_assert(arm::Formulation<exact_tf::ExactArm>);
static_assert(arm::Formulation<fem::FemArm>);
static_assert(arm::Formulation<assumed_modes::AssumedModesArm>);
static_assert(arm::Formulation<RigidHub>);

/// A formulation chosen at run time; an arm without a beam has its own. The functions below are
/// the concept's, on whichever it is.
using AnyFormulation =
    std::variant<exact_tf::ExactArm, fem::FemArm, assumed_modes::AssumedModesArm, RigidHub>;

std::string_view name(const AnyFormulation& formulation);
const arm::Arm& arm_of(const AnyFormulation& formulation);
int degrees_of_freedom(const AnyFormulation& formulation);
arm::PoleSet poles(const AnyFormulation& formulation, int count);
arm::DampedPoleSet damped_poles(const AnyFormulation& formulation, int count);
arm::ZeroSet zeros(const AnyFormulation& formulation, const arm::Sensor& sensor, int count);
std::vector<arm::Mode> modes(const AnyFormulation& formulation, int count,
                             std::span<const arm::Sensor> sensors,
                             std::span<const double> stations_m);
arm::ModalModel modal_model(const AnyFormulation& formulation, int count,
                            std::span<const arm::Sensor> sensors,
                            std::span<const double> stations_m);
std::complex<double> transfer_function(const AnyFormulation& formulation, const arm::Sensor& sensor,
                                       std::complex<double> s_rad_per_s);
/// Of several sensors, at once where the formulation can.
std::vector<std::complex<double>> transfer_functions(const AnyFormulation& formulation,
                                                     std::span<const arm::Sensor> sensors,
                                                     std::complex<double> s_rad_per_s);

}  // namespace flexarm::response
