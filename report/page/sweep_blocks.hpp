#pragma once

#include "compare/sweeps/sweep_result.hpp"
#include "report/page/page_document.hpp"

#include <string>
#include <vector>

namespace flexarm::report::page {

/// Poles and zeros in the s plane over the last parameter, by the first model, a block a sensor; of
/// two parameters also a block for each of `kMostRows` values of the first one. Poles are the
/// damped ones where the arm has damping. Upper half plane.
std::vector<SweepBlock> sweep_maps(const compare::SweepResult& result);
inline constexpr std::size_t kMostRows = 4;

/// Frequencies of poles and zeros, hub slopes and end-point values over the last parameter by the
/// first model, and below them the largest relative difference of the others from it. A view for
/// each kind of number, of two parameters for each of `kMostRows` values of the first one too.
CurvesBlock sweep_curves(const compare::SweepResult& result);

}  // namespace flexarm::report::page
