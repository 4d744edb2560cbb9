#pragma once

#include <complex>
#include <functional>
#include <vector>

namespace flexarm::response {

/// The first `count` coefficients c_k of f(z) = sum c_k z^k, real, f analytic for |z| <= radius, by
/// Cauchy's integral on that circle: the mean of f(z_j)/z_j^k over `points` places (an even number)
/// z_j = radius exp(i pi (2 j + 1)/points), half of which conjugation spares; none is on the real
/// axis. With R the distance of the nearest singularity the mean also takes in
/// c_{k + points} radius^points + ..., of relative size (radius/R)^points.
std::vector<double> taylor_coefficients(
    const std::function<std::complex<double>(std::complex<double>)>& f, double radius, int points,
    int count);

/// The even number of points for which (radius/R)^points is 2^-54 or less.
int points_on_circle(double radius_ratio);

}  // namespace flexarm::response
