#pragma once

#include "measured/checks/data_check_signal.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace flexarm::measured {

/// Samples after which the torque, in its standard deviations, jumps: it changes by half of one and
/// by eight times its median change, in the record and in the 12 changes on either side, as in a
/// series of pulses.
std::vector<Eigen::Index> torque_jumps(const Eigen::VectorXd& torque);

/// Samples about a stop, a start or a turn of the hub, where friction jumps; `reach` samples on
/// either side. The hub moves where its mean velocity over five samples, of a velocity also over
/// two, exceeds its noise.
std::vector<bool> samples_near_stops(std::span<const CheckedSignal> signals,
                                     const std::vector<bool>& usable, std::size_t reach);

/// None of these samples where they are more than a quarter of all: the residual of a prediction
/// knows what so many of them do.
std::vector<bool> none_if_many(std::vector<bool> shaken);

}  // namespace flexarm::measured
