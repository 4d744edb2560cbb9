#pragma once

#include "arm/arm.hpp"

#include <Eigen/Core>

#include <complex>
#include <functional>
#include <vector>

namespace flexarm::compare::paper {

/// The paper's formulas, as printed and put right. (22) writes lambda for the beta of (17):
/// beta^4 = -m s^2/EI. Everywhere else lambda = beta l.
enum class Form { printed, corrected };

/// S of (22) at beta [1/m]; columns: the coefficients of sin, cos, sinh and cosh of beta x.
/// Rows: y(0), hub moment, tip moment, tip force, the last three over EI and with the paper's
/// signs.
Eigen::Matrix4cd matrix_22(const arm::Arm& arm, std::complex<double> beta_per_m, Form form);

/// S put right, but with the tip force of (14) as printed: Mp d^2y/dx^2 in place of Mp d^2y/dt^2.
Eigen::Matrix4cd matrix_14_printed(const arm::Arm& arm, std::complex<double> beta_per_m);

/// |S|/(beta^7 exp(lambda)), real for real lambda: the determinant without its growth.
double scaled_determinant(const Eigen::Matrix4cd& s, double lambda, double length_m);

/// D of (38) without its common divisor EI beta, scaled by exp(-lambda). The printed form has
/// cos sin for cos sinh and, in the hub's term, sin cos for sinh cos.
double denominator_38(double lambda, double hub_inertia_ratio, double payload_mass_ratio,
                      Form form);

/// N of (39) without -2/(EI beta), scaled by exp(-lambda).
double numerator_39(double lambda, double payload_mass_ratio);

/// The `count` lowest sign changes of `f` above `kLowestLambda`, to the last digit or so. Two roots
/// closer than `kLambdaStep` are missed. Throws std::runtime_error beyond `kHighestLambda`.
std::vector<double> roots(const std::function<double(double)>& f, int count);
inline constexpr double kLowestLambda = 0.1;
inline constexpr double kHighestLambda = 200.0;
inline constexpr double kLambdaStep = 0.05;

/// Poles [rad/s] of the arm without payload by (9) and the hub's moment balance, with u in
/// `clamped_modes` clamped shapes:
///
///     Ih + m l^3/3 + 4 m l^3 sum_i w^2/(lambda_i^4 (w_i^2 - w^2)) = 0.
///
/// `hub_inertia_kg_m2` stands for Ih.
std::vector<double> poles_from_clamped_shapes(const arm::Arm& arm, double hub_inertia_kg_m2,
                                              int count, int clamped_modes = 60);

}  // namespace flexarm::compare::paper
