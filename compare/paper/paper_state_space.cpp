#include "compare/paper/paper_forms.hpp"
#include "compare/paper/paper_modal_sums.hpp"
#include "compare/paper/paper_models.hpp"
#include "compare/paper/paper_topics.hpp"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <cmath>

namespace flexarm::compare::paper {

namespace {

/// A of (34) for X = (q0, q0', q1, q1', ...); as printed, the last omega^2 has no minus sign.
Eigen::MatrixXd state_matrix(const std::vector<double>& omega, double kelvin_voigt_s, Form form) {
  const auto states = static_cast<Eigen::Index>(2 * (omega.size() + 1));
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(states, states);
  a(0, 1) = 1.0;
  for (std::size_t i = 0; i < omega.size(); ++i) {
    const auto q = static_cast<Eigen::Index>(2 * (i + 1));
    const double squared = omega[i] * omega[i];
    a(q, q + 1) = 1.0;
    a(q + 1, q) = -squared;
    a(q + 1, q + 1) = -kelvin_voigt_s * squared;
  }
  if (form == Form::printed) a(states - 1, states - 2) *= -1.0;
  return a;
}

/// Real part of the flexible eigenvalue furthest to the right.
double rightmost(const Eigen::MatrixXd& a) {
  const auto flexible = a.bottomRightCorner(a.rows() - 2, a.cols() - 2);
  return flexible.eigenvalues().real().maxCoeff();
}

/// C (sI - A)^-1 B for an output row over X.
std::complex<double> state_space_response(const ModalData& data, const Eigen::RowVectorXd& row,
                                          std::complex<double> s) {
  const Eigen::MatrixXd a =
      state_matrix(data.omega_rad_per_s, data.kelvin_voigt_s, Form::corrected);
  Eigen::VectorXcd b = Eigen::VectorXcd::Zero(a.rows());
  b(1) = 1.0 / data.total_inertia_kg_m2;
  for (std::size_t i = 0; i < data.modes(); ++i) {
    b(static_cast<Eigen::Index>(2 * i + 3)) = data.hub_slope[i] / data.total_inertia_kg_m2;
  }
  const Eigen::MatrixXcd pencil =
      s * Eigen::MatrixXcd::Identity(a.rows(), a.cols()) - a.cast<std::complex<double>>();
  const Eigen::VectorXcd states = pencil.partialPivLu().solve(b);
  return (row.cast<std::complex<double>>() * states).value();
}

/// Row of C: `rigid` and `gains` at the positions q (`offset` 0) or the rates q' (`offset` 1).
Eigen::RowVectorXd output_row(double rigid, const std::vector<double>& gains, int offset) {
  Eigen::RowVectorXd row =
      Eigen::RowVectorXd::Zero(static_cast<Eigen::Index>(2 * (gains.size() + 1)));
  row(offset) = rigid;
  for (std::size_t i = 0; i < gains.size(); ++i) {
    row(static_cast<Eigen::Index>(2 * i + 2) + offset) = gains[i];
  }
  return row;
}

/// Row of C and feedthrough D of the tip's acceleration: q_i'' from (33) put right.
std::complex<double> tip_acceleration_response(const ModalData& data, std::complex<double> s) {
  Eigen::RowVectorXd row =
      Eigen::RowVectorXd::Zero(static_cast<Eigen::Index>(2 * data.modes() + 2));
  double feedthrough = data.length_m;
  for (std::size_t i = 0; i < data.modes(); ++i) {
    const auto q = static_cast<Eigen::Index>(2 * i + 2);
    row(q) = -data.omega_rad_per_s[i] * data.omega_rad_per_s[i] * data.tip_m[i];
    row(q + 1) = -data.damping_term(i) * data.tip_m[i];
    feedthrough += data.tip_m[i] * data.hub_slope[i];
  }
  return state_space_response(data, row, s) + feedthrough / data.total_inertia_kg_m2;
}

Check free_vibration(const ThreeModels& bare) {
  const arm::Arm& arm = bare.exact_tf.arm();
  const double clamped = roots([](double x) { return numerator_39(x, 0.0); }, 1).back();
  const double pole = poles_from_clamped_shapes(arm, arm.hub.inertia_kg_m2, 1).back();
  return {.label = "(26)",
          .statement = "free vibration of u",
          .verdict = Verdict::slip_of_algebra,
          .finding =
              "Zero torque does not imply zero acceleration: the term -rho x theta_tt of (9) "
              "remains. Without it, and with u'(0) = 0, the result is the clamped arm: the zeros "
              "of the hub sensors, not the poles. The following equations hold for y instead of u.",
          .comparisons = {comparison(
              "pole 1", "Hz", in_Hz(clamped * clamped * arm::omega_scale_rad_per_s(arm)),
              in_Hz(pole), bare.ask([](const auto& m) { return pole_Hz(m, 1); }), kRootTolerance)}};
}

Check expansion(const ThreeModels& bare) {
  const auto first = mode(bare.exact_tf, 1, kTipDisplacement);
  return {.label = "(27)",
          .statement = "u as a sum of the mode shapes",
          .verdict = Verdict::slip_of_algebra,
          .finding =
              "The shapes of section 3 are those of y, with a slope at the hub; that of u is zero. "
              "The expansion is y = sum from 0, as in (15), with phi_0 = x. theta is then sum "
              "phi_i'(0) q_i and not q_0.",
          .comparisons = {comparison(
              "u(l)/q_1 of mode 1", "m", first.sensor_values[0],
              first.sensor_values[0] - bare.exact_tf.arm().beam.length_m * first.hub_slope,
              bare.ask([](const auto& m) { return mode_value(m, 1, kTipDeflection); }),
              kIntegralTolerance)}};
}

Check modal_energies(const ThreeModels& bare) {
  const arm::Arm& arm = bare.exact_tf.arm();
  const double density = arm.beam.linear_density_kg_per_m();
  const double total = arm::total_inertia_kg_m2(arm);
  return {.label = "(28)",
          .statement = "kinetic energy in modes",
          .verdict = Verdict::slip_of_algebra,
          .finding =
              "By (24) the modal mass is I_T, with hub and payload, not I_b. The sum starts at the "
              "rigid mode and contains no delta_ij.",
          .comparisons = {comparison(
              "2 E_K/(dq_1/dt)^2", "kg m^2", density * std::pow(arm.beam.length_m, 3) / 3.0, total,
              bare.ask([=](const auto& m) { return total * inertia_product(m, 1, 1, density); }),
              kIntegralTolerance)}};
}

Check modal_potential(const ThreeModels& bare) {
  const double total = arm::total_inertia_kg_m2(bare.exact_tf.arm());
  const double omega = bare.exact_tf.poles(1).omega_rad_per_s[0];
  return {.label = "(29)",
          .statement = "potential energy in modes",
          .verdict = Verdict::harmless_misprint,
          .finding = "I_t is I_T, and the delta_ij after the sum is superfluous.",
          .comparisons = {comparison(
              "2 E_P/q_1^2", "N m", total * omega * omega, total * omega * omega,
              bare.ask([total](const auto& m) { return total * stiffness_product(m, 1, 1); }),
              kIntegralTolerance)}};
}

Check modal_dissipation(const ThreeModels& damped) {
  const double omega = damped.exact_tf.poles(1).omega_rad_per_s[0];
  return {.label = "(30)",
          .statement = "dissipated energy in modes",
          .verdict = Verdict::slip_of_algebra,
          .finding =
              "The dissipation function must contain rates: 1/2 I_T sum 2 xi_i omega_i "
              "(dq_i/dt)^2. As printed it has omega_i^2 q_i^2, whose derivative with respect to "
              "dq_i/dt is zero: no damping in (33). The sum is missing, and Ih + I_b is I_T only "
              "without payload. The law xi = b0/(2 omega) + b1 omega/2 itself holds. But b0 also "
              "damps the rigid mode, which the first of (33) omits.",
          .comparisons = {comparison("2 xi_1 omega_1, damped", "1/s", 0.0,
                                     damped.exact_tf.arm().damping.kelvin_voigt_s * omega * omega,
                                     damped.ask([](const auto& m) {
                                       const auto first = mode(m, 1);
                                       return 2.0 * first.damping_ratio * first.omega_rad_per_s;
                                     }),
                                     kIntegralTolerance)}};
}

Check generalised_force(const ThreeModels& bare) {
  // The slope from poles and zeros alone, through the residue of (47).
  std::vector<double> poles = bare.exact_tf.poles(kTerms).omega_rad_per_s;
  std::vector<double> zeros;
  for (const auto& s : bare.exact_tf.zeros(kHubAngle, kTerms).s_rad_per_s) {
    zeros.push_back(s.imag());
  }
  const double slope = std::sqrt(squared_slopes(poles, zeros)[0]);
  return {.label = "(31)-(32)",
          .statement = "work of the torque; Lagrange's equations",
          .verdict = Verdict::harmless_misprint,
          .finding =
              "phi' lacks its index i, and W_i is the derivative of W with respect to q_i, a force "
              "and not work.",
          .comparisons = {comparison(
              "force on q_1 per torque", "1", bare.exact_tf.modes(1, {}, {})[0].hub_slope, slope,
              bare.ask([](const auto& m) { return mode(m, 1).hub_slope; }), kSeriesTolerance)}};
}

Check decoupled_equations(const ThreeModels& damped, const ModalData& data) {
  const double omega = data.omega_rad_per_s[0];
  std::vector<double> printed = damping_terms(data);
  for (std::size_t i = 0; i < printed.size(); ++i) printed[i] /= data.omega_rad_per_s[i];
  const std::complex<double> s{0.0, omega};
  const auto peak = [&](const std::vector<double>& terms) {
    return std::abs(partial_fractions(data, 1.0, data.hub_slope, terms, 0, s));
  };
  return {.label = "(33)",
          .statement = "decoupled equations",
          .verdict = Verdict::slip_of_print,
          .finding = "2 xi_i dq_i/dt must be 2 xi_i omega_i dq_i/dt, as in A of (34).",
          .comparisons = {comparison(
              "|theta/tau|, omega_1, damped", "rad/(N m)", peak(printed), peak(damping_terms(data)),
              damped.ask([omega](const auto& m) { return magnitude(m, kHubAngle, omega); }),
              kSeriesTolerance)}};
}

Check state_equation(const ThreeModels& damped) {
  constexpr int kModes = 3;
  const double kv = damped.exact_tf.arm().damping.kelvin_voigt_s;
  const auto omega = damped.exact_tf.poles(kModes).omega_rad_per_s;
  return {.label = "(34)",
          .statement = "state equation",
          .verdict = Verdict::slip_of_print,
          .finding = "The last row of A has +omega_n^2: as printed the highest mode is unstable.",
          .comparisons = {comparison("largest real part of A, n = 3, damped", "1/s",
                                     rightmost(state_matrix(omega, kv, Form::printed)),
                                     rightmost(state_matrix(omega, kv, Form::corrected)),
                                     damped.ask([](const auto& m) {
                                       const auto first = mode(m, 1);
                                       return -first.damping_ratio * first.omega_rad_per_s;
                                     }),
                                     kIntegralTolerance)}};
}

Check output_equation(const ThreeModels& damped, const ModalData& data) {
  const double omega = from_Hz(kTestFrequency_Hz);
  const std::complex<double> s{0.0, omega};
  const auto response = [&](const Eigen::RowVectorXd& row) {
    return std::abs(state_space_response(data, row, s));
  };
  return {
      .label = "(35)",
      .statement = "output equation: end-point acceleration, hub velocity, hub angle",
      .verdict = Verdict::slip_of_algebra,
      .finding =
          "Row 1 gives a displacement instead of an acceleration, with d^2/dx^2 instead of "
          "d^2/dt^2: phi_i''(l) is zero at a free tip, and 1 should be l. Correct is -omega_i^2 "
          "phi_i(l) for q_i and -2 xi_i omega_i phi_i(l) for dq_i/dt. The feedthrough D = (l + sum "
          "phi_i(l) phi_i'(0))/I_T is missing in G = C (sI - A)^-1 B. Rows 2 and 3 are hub angle "
          "and hub velocity, in the opposite order of the text.",
      .comparisons = {
          comparison("gain of q_1 at the tip", "m", data.tip_curvature_per_m[0], data.tip_m[0],
                     damped.ask([](const auto& m) { return mode_value(m, 1, kTipDisplacement); }),
                     kIntegralTolerance),
          comparison(
              "|acceleration/tau|, 5 Hz, damped", "m/s^2/(N m)",
              response(output_row(1.0, data.tip_curvature_per_m, 0)),
              std::abs(tip_acceleration_response(data, s)),
              damped.ask([omega](const auto& m) { return magnitude(m, kTipAcceleration, omega); }),
              kSeriesTolerance),
          comparison(
              "|velocity/tau|, 5 Hz, damped", "rad/s/(N m)",
              response(output_row(1.0, data.hub_slope, 0)),
              response(output_row(1.0, data.hub_slope, 1)),
              damped.ask([omega](const auto& m) { return magnitude(m, kHubVelocity, omega); }),
              kSeriesTolerance)}};
}

}  // namespace

Topic check_state_space() {
  const ThreeModels bare(arm::paper_arm());
  const ThreeModels damped(arm_with_damping());
  const ModalData data = modal_data(damped.exact_tf, kTerms);
  return {.name = "state_space",
          .title = "State space: (26)-(35)",
          .checks = {free_vibration(bare), expansion(bare), modal_energies(bare),
                     modal_potential(bare), modal_dissipation(damped), generalised_force(bare),
                     decoupled_equations(damped, data), state_equation(damped),
                     output_equation(damped, data)}};
}

}  // namespace flexarm::compare::paper
