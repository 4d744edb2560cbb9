#pragma once

#include "response/any_formulation.hpp"
#include "response/arm_parts.hpp"

#include <span>

namespace flexarm::response {

/// The model that `simulate` steps in time: the lowest mode of `formulation` and `count` flexible
/// ones, with values at `sensors` and, where `parts` have forces along the beam, at their stations;
/// with the residual mode (response/residual_mode.hpp) behind them where `static_correction` asks
/// for it.
///
/// `formulation` is made of `parts.linear`. Throws InputError as `modal_model` does.
arm::ModalModel time_model(const AnyFormulation& formulation, const ArmParts& parts, int count,
                           std::span<const arm::Sensor> sensors, bool static_correction = false);

}  // namespace flexarm::response
