#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace flexarm::measured {

/// Kinds of changes that a name makes of the quantity that it names.
enum class ChangeKind {
  factor,      ///< "Angle*100", "tau/10", a power, "theta^2"
  number,      ///< "1/tau", "180-theta", "theta+90"
  sign,        ///< "-Torque"
  function,    ///< "|tau|", "abs(tau)", a difference or a second derivative
  derivative,  ///< "theta'", "d(theta)/dt", a dot above
  reference    ///< "theta*"
};

/// A change that a name makes of its quantity, and the name without it.
struct NameChange {
  ChangeKind kind = ChangeKind::factor;
  std::string mark;  ///< "*100"
  std::string rest;  ///< "Angle"
};

/// The factor in a name, "Angle*100", "deg x 10", "tau/10", "1e3*t", or a power, "theta^2"; nothing
/// in a name without. Whether the numbers were multiplied by it, or are to be, the name leaves
/// open.
std::optional<NameChange> factor_in(std::string_view name);

/// The first change in a name, a factor or any other. A single digit behind a hyphen tells columns
/// apart: "Torque-1" has none, nor has "hub-angle".
std::optional<NameChange> change_in(std::string_view name);

}  // namespace flexarm::measured
