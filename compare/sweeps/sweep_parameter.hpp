#pragma once

#include "arm/arm.hpp"
#include "arm/range.hpp"

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::compare {

/// A number of an arm that a sweep may vary: any number of the arm file (`payload.mass`), any
/// parameter of a linear effect (`effects.root_compliance.stiffness`), or one of the ratios of
/// arm/arm.hpp.
struct SweepParameter {
  std::string name;
  std::string unit;  ///< "1" for a ratio
  arm::Range range;
  /// Parameters are set in ascending stage: the ratios follow from the beam that was set before.
  int stage = 0;
  /// Throws InputError where no such value can be reached.
  std::function<void(arm::Arm&, double)> set;
};

/// The parameter of that name; `eta` and `epsilon` of equation (20), put right, stand for
/// `payload_mass_ratio` and `hub_inertia_ratio`. Throws InputError for an unknown name, with the
/// one that was probably meant, and for an effect on which poles and zeros do not depend.
///
/// What an arm gives twice, a section beside a rigidity or a density beside a mass per length,
/// would contradict itself once one of the two varies: what follows from the number that is set is
/// left out, or what it follows from.
SweepParameter sweep_parameter(std::string_view name);

/// Every name that `sweep_parameter` knows.
std::vector<std::string> sweep_parameter_names();

/// A parameter and its values along one axis of the grid.
struct SweepAxis {
  SweepParameter parameter;
  std::vector<double> values;  ///< ascending or descending
  bool logarithmic = false;    ///< at equal ratios
  std::string typed;           ///< as it was asked for: "payload.mass=0:0.5:200"

  /// The value at a place between two grid points, 0 <= place <= values.size() - 1: on a straight
  /// line between them, or at equal ratios.
  double at(double place) const;
};

/// The most values that one axis, and the most points that a grid, may have.
inline constexpr int kMostGridPoints = 200'000;

/// Reads "KEY=START:END:COUNT" (equal steps), "KEY=log:START:END:COUNT" (equal ratios), or
/// "KEY=A,B,C". Throws InputError for anything else, for values out of the parameter's range, and
/// for a list that neither rises nor falls.
SweepAxis parse_axis(std::string_view text);

/// The arm with each axis' parameter at its place, one place an axis. Throws InputError where the
/// two together make no arm.
arm::Arm arm_at(const arm::Arm& base, std::span<const SweepAxis> axes,
                std::span<const double> places);

}  // namespace flexarm::compare
