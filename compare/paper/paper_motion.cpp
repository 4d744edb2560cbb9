#include "compare/paper/paper_forms.hpp"
#include "compare/paper/paper_models.hpp"
#include "compare/paper/paper_topics.hpp"

#include <cmath>

namespace flexarm::compare::paper {

namespace {

/// Pole `order` [Hz] from the roots of a determinant in lambda.
double determinant_pole_Hz(const arm::Arm& arm, int order,
                           Eigen::Matrix4cd (*matrix)(const arm::Arm&, std::complex<double>)) {
  const double l = arm.beam.length_m;
  const auto lambda =
      roots([&](double x) { return scaled_determinant(matrix(arm, x / l), x, l); }, order);
  const double last = lambda.back();
  return in_Hz(last * last * arm::omega_scale_rad_per_s(arm));
}

Eigen::Matrix4cd corrected_matrix(const arm::Arm& arm, std::complex<double> beta) {
  return matrix_22(arm, beta, Form::corrected);
}

Check net_displacement(const ThreeModels& bare) {
  const auto exact = mode(bare.exact_tf, 1, kTipDisplacement);
  const double deflection =
      exact.sensor_values[0] - bare.exact_tf.arm().beam.length_m * exact.hub_slope;
  return {.label = "(1)-(2)",
          .statement = "y = x theta + u, and its velocity",
          .verdict = Verdict::holds,
          .finding =
              "u is the deflection from the tangent at the hub; at the tip it is the sensor "
              "tip_deflection.",
          .comparisons = {
              comparison("u(l)/q_1 of mode 1", "m", deflection, deflection,
                         bare.ask([](const auto& m) { return mode_value(m, 1, kTipDeflection); }),
                         kIntegralTolerance)}};
}

Check kinetic_energy() {
  const ThreeModels loaded(arm_with_payload());
  const arm::Arm& arm = loaded.exact_tf.arm();
  const double total = arm::total_inertia_kg_m2(arm);
  return {.label = "(3)-(4)",
          .statement = "kinetic energy",
          .verdict = Verdict::slip_of_algebra,
          .finding =
              "The term of the rotary inertia of the payload, Ip (y'_t(l))^2/2, is missing, "
              "although Ip is in (10), (14), (22) and (24). Hamilton's principle cannot produce it "
              "from (3)-(4).",
          .comparisons = {comparison(
              "inertia of the rigid arm, payload", "kg m^2", total - arm.payload.inertia_kg_m2,
              total, loaded.ask([](const auto& m) { return low_frequency_inertia_kg_m2(m); }),
              kLowFrequencyTolerance)}};
}

Check potential_energy(const ThreeModels& bare) {
  const double omega = bare.exact_tf.poles(1).omega_rad_per_s[0];
  return {.label = "(5)",
          .statement = "potential energy of bending",
          .verdict = Verdict::holds,
          .finding = "2 E_p of a mode over its modal inertia is the square of its frequency.",
          .comparisons = {comparison(
              "2 E_p/(I_T q_1^2) of mode 1", "rad^2/s^2", stiffness_product(bare.exact_tf, 1, 1),
              omega * omega, bare.ask([](const auto& m) { return stiffness_product(m, 1, 1); }),
              kIntegralTolerance)}};
}

Check dissipation() {
  const ThreeModels rubbed(arm_with_hub_friction());
  const arm::Arm& arm = rubbed.exact_tf.arm();
  const auto first = mode(rubbed.exact_tf, 1);
  const double damping = arm.hub.viscous_friction_N_m_s_per_rad * first.hub_slope *
                         first.hub_slope /
                         (2.0 * arm::total_inertia_kg_m2(arm) * first.omega_rad_per_s);
  return {
      .label = "(6)",
      .statement = "dissipated energy",
      .verdict = Verdict::slip_of_algebra,
      .finding =
          "The hub term has the rate of u'(0), which is zero by the condition below (11). It must "
          "have that of y'(0) = theta, and the air term that of y. The text calls the integrands "
          "forces, writes du du instead of dx dt, and multiplies the mass per length by the "
          "cross-section again in D(x).",
      .comparisons = {comparison("damping ratio 1, hub friction", "1", 0.0, damping,
                                 rubbed.ask([](const auto& m) { return mode(m, 1).damping_ratio; }),
                                 kIntegralTolerance)}};
}

Check equation_of_motion(const ThreeModels& bare) {
  const arm::Arm& arm = bare.exact_tf.arm();
  const auto poles = poles_from_clamped_shapes(arm, arm.hub.inertia_kg_m2, 2);
  Check check{.label = "(9)",
              .statement = "equation of motion of u, driven by the hub's acceleration",
              .verdict = Verdict::holds,
              .finding =
                  "With the moment balance of the hub it gives the same poles; evaluated by "
                  "expansion in clamped shapes.",
              .comparisons = {}};
  for (const int order : {1, 2}) {
    const double pole = in_Hz(poles.at(static_cast<std::size_t>(order) - 1));
    check.comparisons.push_back(
        comparison("pole " + std::to_string(order), "Hz", pole, pole,
                   bare.ask([order](const auto& m) { return pole_Hz(m, order); }), kRootTolerance));
  }
  return check;
}

Check conditions_of_u(const ThreeModels& bare) {
  const arm::Arm& arm = bare.exact_tf.arm();
  const auto printed = poles_from_clamped_shapes(arm, 0.0, 2);
  const auto corrected = poles_from_clamped_shapes(arm, arm.hub.inertia_kg_m2, 2);
  Check check{.label = "(10)",
              .statement = "boundary conditions of u",
              .verdict = Verdict::slip_of_algebra,
              .finding =
                  "u'(0) = 0, so u'_tt(0) is not the angular acceleration. As printed the hub "
                  "inertia has no effect. The hub term must be Ih theta_tt; the tip terms lack l "
                  "theta_tt and theta_tt; the payload mass has d^2/dx^2 instead of d^2/dt^2.",
              .comparisons = {}};
  for (const int order : {1, 2}) {
    const auto i = static_cast<std::size_t>(order) - 1;
    check.comparisons.push_back(
        comparison("pole " + std::to_string(order), "Hz", in_Hz(printed[i]), in_Hz(corrected[i]),
                   bare.ask([order](const auto& m) { return pole_Hz(m, order); }), kRootTolerance));
  }
  return check;
}

Check initial_conditions() {
  return {.label = "(8), (11)",
          .statement = "limits of Hamilton's integral; initial conditions",
          .verdict = Verdict::harmless_misprint,
          .finding =
              "The limits are exchanged, the variations vanish at t1 and t2 (not \"to\"), and the "
              "damping of (6) does no virtual work in (8). The second initial condition in (11) "
              "and below (14) follows from the first; the velocity at t = 0 is intended. Nothing "
              "to evaluate.",
          .comparisons = {}};
}

Check net_equation(const ThreeModels& bare) {
  const arm::Arm& arm = bare.exact_tf.arm();
  const double pole = determinant_pole_Hz(arm, 1, corrected_matrix);
  return {.label = "(7), (12)-(13)",
          .statement = "work of the torque; theta = y'(0); equation of motion of y",
          .verdict = Verdict::holds,
          .finding =
              "(13) with the corrected conditions (14) gives the poles of all three formulations.",
          .comparisons = {comparison("pole 1", "Hz", pole, pole,
                                     bare.ask([](const auto& m) { return pole_Hz(m, 1); }),
                                     kRootTolerance)}};
}

Check conditions_of_y() {
  const ThreeModels loaded(arm_with_payload());
  const arm::Arm& arm = loaded.exact_tf.arm();
  Check check{.label = "(14)",
              .statement = "boundary conditions of y",
              .verdict = Verdict::slip_of_print,
              .finding =
                  "The payload mass multiplies d^2y/dx^2 instead of d^2y/dt^2. As printed the "
                  "units do not match. Since the moment at the tip is nearly zero, the payload "
                  "mass has almost no influence on the poles.",
              .comparisons = {}};
  for (const int order : {1, 2}) {
    check.comparisons.push_back(comparison(
        "pole " + std::to_string(order) + ", payload", "Hz",
        determinant_pole_Hz(arm, order, matrix_14_printed),
        determinant_pole_Hz(arm, order, corrected_matrix),
        loaded.ask([order](const auto& m) { return pole_Hz(m, order); }), kRootTolerance));
  }
  return check;
}

}  // namespace

Topic check_motion() {
  const ThreeModels bare(arm::paper_arm());
  return {.name = "motion",
          .title = "Energies, equation of motion, boundary conditions: (1)-(14)",
          .checks = {net_displacement(bare), kinetic_energy(), potential_energy(bare),
                     dissipation(), initial_conditions(), equation_of_motion(bare),
                     conditions_of_u(bare), net_equation(bare), conditions_of_y()}};
}

}  // namespace flexarm::compare::paper
