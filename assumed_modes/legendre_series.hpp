#pragma once

#include "assumed_modes/real.hpp"

namespace flexarm::assumed_modes {

/// Legendre series on an interval of the beam, one function a row: column k is the coefficient of
/// P_k(t), t = -1 and 1 the ends. Every operation below is exact but for rounding.

/// Coefficients of the integral from the start of an interval of the given length:
/// int_{-1}^{t} P_k = (P_{k+1} - P_{k-1})/(2k + 1), and P_1 + P_0 for k = 0. The last column of
/// `series` must be zero.
Matrix integrated(const Matrix& series, Real length);

/// t times each function. One column more than `series`.
Matrix times_t(const Matrix& series);

/// Values at t.
Vector evaluated(const Matrix& series, Real t);

/// Values at the end of the interval, t = 1.
Vector at_end(const Matrix& series);

/// int f_i g_j over an interval of the given length; int_{-1}^{1} P_k^2 dt = 2/(2k + 1).
Matrix products(const Matrix& f, const Matrix& g, Real length);

}  // namespace flexarm::assumed_modes
