#pragma once

#include "arm/sensor.hpp"
#include "exact_tf/transfer_chain.hpp"

#include <optional>

namespace flexarm::exact_tf {

/// The arm's motion under the tip's conditions and y(0) = a theta, which is unique up to a factor;
/// scaled so that at s = 0 of a free arm it is y = a + x; the D of every suspended mass is a factor
/// (see CarriedMass). Values are analytic functions of s (those
/// of the undamped arm entire functions of s^2) in units of the beam, times exp(-log_scale):
/// response per unit of torque is value/torque.
template <class T>
struct RootValues {
  T hub_angle{};    ///< theta; its roots are the poles with the hub held
  T motor_angle{};  ///< theta_m; its roots are the poles with the rotor held
  T torque{};       ///< tau; its roots are the poles
  RealOf<T> log_scale = 0;
  RealOf<T> size = 1;  ///< of what the values are made of, continuous in s
};

template <class T>
RootValues<T> root_values(const TransferChain<T>& chain, const Bivector<T>& root_plane,
                          RealOf<T> log_scale);
template <class T>
RootValues<T> root_values(const TransferChain<T>& chain);

template <class T>
struct SensorValue {
  T value{};
  RealOf<T> log_scale = 0;
  RealOf<T> size = 1;
};

/// What a sensor shows before time derivatives, in units of the beam: theta_m, y(l),
/// y(l) - (a + l) theta or psi'(X), X in units of l. The deflection keeps its digits where it is
/// small beside both of its terms. `root` saves its computation where it is known.
template <class T>
SensorValue<T> sensor_value(const TransferChain<T>& chain, arm::SensorKind kind, RealOf<T> position,
                            const std::optional<RootValues<T>>& root = std::nullopt);

/// The link that holds x, the one towards the tip where two meet.
template <class T>
std::size_t link_at(const TransferChain<T>& chain, RealOf<T> x);

}  // namespace flexarm::exact_tf
