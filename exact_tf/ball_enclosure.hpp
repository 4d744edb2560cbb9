#pragma once

// Private to exact_tf: enclosures of roots and winding numbers in ball arithmetic. Not installed.

#include "exact_tf/ball.hpp"

#include <functional>
#include <optional>

namespace flexarm::exact_tf::ball {

/// An interval of half-width `reach` about the limit of Newton's iteration from `start` > 0, at
/// whose ends `value` has opposite signs for certain; empty where the iteration or the signs fail
/// at the working precision.
std::optional<RealBall> enclose_sign_change(const std::function<RealBall(const RealBall&)>& value,
                                            const RealBall& start, double reach);

/// A square of half-width `reach` about the limit of Newton's iteration from `start`, in whose
/// inscribed circle the analytic `value` has exactly one zero.
std::optional<ComplexBall> enclose_complex_zero(
    const std::function<ComplexBall(const ComplexBall&)>& value, const ComplexBall& start,
    double reach);

/// Change of arg value(path(t)) as t goes from 0 to 1, from arcs whose images in balls exclude
/// zero; empty where the path runs too close to a zero for the working precision, or where it needs
/// more than `values_left` values, from which those used are taken.
std::optional<RealBall> argument_change(const std::function<ComplexBall(const ComplexBall&)>& value,
                                        const std::function<ComplexBall(const RealBall&)>& path,
                                        long& values_left);

}  // namespace flexarm::exact_tf::ball
