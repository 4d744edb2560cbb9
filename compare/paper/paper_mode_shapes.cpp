#include "compare/paper/paper_forms.hpp"
#include "compare/paper/paper_models.hpp"
#include "compare/paper/paper_topics.hpp"

#include <cmath>

namespace flexarm::compare::paper {

namespace {

/// Pole `order` [Hz] by (38) put right, from the ratios that (20) defines.
double ratio_pole_Hz(const arm::Arm& arm, int order, double epsilon, double eta) {
  const auto f = [=](double x) { return denominator_38(x, epsilon, eta, Form::corrected); };
  return lambda_to_Hz(arm, roots(f, order).back());
}

Check separation(const ThreeModels& bare) {
  const arm::Arm& arm = bare.exact_tf.arm();
  const double l = arm.beam.length_m;
  const double lambda =
      roots(
          [&](double x) {
            return scaled_determinant(matrix_22(arm, x / l, Form::corrected), x, l);
          },
          1)
          .back();
  const double beta = lambda / l;
  const double omega =
      beta * beta *
      std::sqrt(arm.beam.flexural_rigidity_N_m2() / arm.beam.linear_density_kg_per_m());
  return {.label = "(15)-(19)",
          .statement = "expansion in modes, separation of variables, omega = beta^2 (EI/rho)^(1/2)",
          .verdict = Verdict::holds,
          .finding = "(16) applies term by term; the sum (15) itself does not separate.",
          .comparisons = {comparison("pole 1 from beta_1 by (19)", "Hz", in_Hz(omega), in_Hz(omega),
                                     bare.ask([](const auto& m) { return pole_Hz(m, 1); }),
                                     kRootTolerance)}};
}

Check ratios(const ThreeModels& bare) {
  const arm::Arm& arm = bare.exact_tf.arm();
  const double l = arm.beam.length_m;
  const double beam = arm.beam.linear_density_kg_per_m() * std::pow(l, 3) / 3.0;  // I_b
  const double epsilon = arm::hub_inertia_ratio(arm);
  const double printed_epsilon = 3.0 * arm.hub.inertia_kg_m2 / beam;
  const ThreeModels heavy(arm_with_payload_mass());
  const arm::Arm& loaded = heavy.exact_tf.arm();
  const double eta = arm::payload_mass_ratio(loaded);
  const double printed_eta = 3.0 * loaded.payload.mass_kg * l * l / beam;
  return {.label = "(20)",
          .statement = "dimensionless hub inertia and payload mass",
          .verdict = Verdict::slip_of_algebra,
          .finding =
              "I_b = M l^2/3, so Ih/(M l^2) = Ih/(3 I_b) and Mp/M = Mp l^2/(3 I_b). The second "
              "expressions are 9 times too large. The poles follow from the first.",
          .comparisons = {
              comparison("epsilon = 3 Ih/I_b", "1", printed_epsilon, epsilon, {}, kRootTolerance),
              comparison("pole 1, epsilon = 3 Ih/I_b", "Hz",
                         ratio_pole_Hz(arm, 1, printed_epsilon, 0.0),
                         ratio_pole_Hz(arm, 1, epsilon, 0.0),
                         bare.ask([](const auto& m) { return pole_Hz(m, 1); }), kRootTolerance),
              comparison("pole 2, epsilon = 3 Ih/I_b", "Hz",
                         ratio_pole_Hz(arm, 2, printed_epsilon, 0.0),
                         ratio_pole_Hz(arm, 2, epsilon, 0.0),
                         bare.ask([](const auto& m) { return pole_Hz(m, 2); }), kRootTolerance),
              comparison("pole 1, eta = 3 Mp l^2/I_b", "Hz",
                         ratio_pole_Hz(arm, 1, epsilon, printed_eta),
                         ratio_pole_Hz(arm, 1, epsilon, eta),
                         heavy.ask([](const auto& m) { return pole_Hz(m, 1); }), kRootTolerance),
          }};
}

Check boundary_matrix(const ThreeModels& bare) {
  const arm::Arm& arm = bare.exact_tf.arm();
  const double l = arm.beam.length_m;
  const auto determinant = [&arm, l](double lambda, Form form) {
    return scaled_determinant(matrix_22(arm, lambda / l, form), lambda, l);
  };
  const double true_lambda = bare.exact_tf.pole_lambdas(1)[0];
  Check check{
      .label = "(21)-(23)",
      .statement = "general solution, matrix of the boundary conditions, characteristic equation",
      .verdict = Verdict::slip_of_print,
      .finding =
          "Row 1 must be (0, 1, 0, 1), which is y(0) = 0. Row 2 must not have the two terms "
          "lambda^3: a pinned root has no additional force. The columns are for sin, cos, sinh, "
          "cosh, but the vector has the order of (21): sin, sinh, cos, cosh. lambda here is the "
          "beta of (17), not the lambda of (20). Rows 3 and 4 hold, with the payload mass as in "
          "the corrected (14).",
      .comparisons = {}};
  check.comparisons.push_back({.quantity = "|S|/(beta^7 e^lambda) at lambda_1",
                               .unit = "1",
                               .printed = determinant(true_lambda, Form::printed),
                               .corrected = determinant(true_lambda, Form::corrected),
                               .formulations = {},
                               .tolerance = 1e-12});
  const auto printed = roots([&](double x) { return determinant(x, Form::printed); }, 2);
  const auto corrected = roots([&](double x) { return determinant(x, Form::corrected); }, 2);
  for (const int order : {1, 2}) {
    const auto i = static_cast<std::size_t>(order) - 1;
    check.comparisons.push_back(
        comparison("pole " + std::to_string(order) + " from |S| = 0", "Hz",
                   lambda_to_Hz(arm, printed[i]), lambda_to_Hz(arm, corrected[i]),
                   bare.ask([order](const auto& m) { return pole_Hz(m, order); }), kRootTolerance));
  }
  return check;
}

Check inertia_orthogonality() {
  const ThreeModels heavy(arm_with_payload_mass());
  const arm::Arm& arm = heavy.exact_tf.arm();
  const double density = arm.beam.linear_density_kg_per_m();
  const double mass_kg = density * arm.beam.length_m;
  const auto product = [density](int i, int j) {
    return [=](const auto& m) { return inertia_product(m, i, j, density); };
  };
  return {.label = "(24)",
          .statement = "orthogonality in inertia",
          .verdict = Verdict::slip_of_print,
          .finding =
              "The integral needs the mass per length rho, not the mass M = rho l, as the units "
              "show; with M the modes are not orthogonal. The roots of (23) do not depend on it.",
          .comparisons = {
              {.quantity = "(24)/I_T, i = j = 1, payload mass",
               .unit = "1",
               .printed = inertia_product(heavy.exact_tf, 1, 1, mass_kg),
               .corrected = 1.0,
               .formulations = heavy.ask(product(1, 1)),
               .tolerance = kIntegralTolerance},
              {.quantity = "(24)/I_T, i = 1, j = 2, payload mass",
               .unit = "1",
               .printed = inertia_product(heavy.exact_tf, 1, 2, mass_kg),
               .corrected = 0.0,
               .formulations = heavy.ask(product(1, 2)),
               .tolerance = kIntegralTolerance},
          }};
}

Check stiffness_orthogonality(const ThreeModels& bare) {
  const auto w = bare.exact_tf.poles(2).omega_rad_per_s;
  return {.label = "(25)",
          .statement = "orthogonality in stiffness",
          .verdict = Verdict::holds,
          .finding = "",
          .comparisons = {
              comparison("(25)/I_T, i = j = 1", "rad^2/s^2", stiffness_product(bare.exact_tf, 1, 1),
                         w[0] * w[0],
                         bare.ask([](const auto& m) { return stiffness_product(m, 1, 1); }),
                         kIntegralTolerance),
              {.quantity = "(25)/I_T, i = 1, j = 2",
               .unit = "rad^2/s^2",
               .printed = stiffness_product(bare.exact_tf, 1, 2),
               .corrected = 0.0,
               .formulations = bare.ask([](const auto& m) { return stiffness_product(m, 1, 2); }),
               .tolerance = kIntegralTolerance * w[0] * w[1]},
          }};
}

Check small_epsilon(const ThreeModels& bare) {
  const arm::Arm& arm = bare.exact_tf.arm();
  const ThreeModels light(arm_with_hub_inertia(0.0));
  const double free_pole = ratio_pole_Hz(arm, 1, 0.0, 0.0);
  const double pole = ratio_pole_Hz(arm, 1, arm::hub_inertia_ratio(arm), 0.0);
  const auto rise = [&](const auto& with, const auto& without) {
    return pole_Hz(with, 1) > pole_Hz(without, 1) ? 1.0 : -1.0;
  };
  const auto first_pole = [](const auto& m) { return pole_Hz(m, 1); };
  return {.label = "small epsilon",
          .statement =
              "\"a small epsilon corresponds to the manipulator having lower vibration "
              "frequencies\"",
          .verdict = Verdict::slip_of_algebra,
          .finding =
              "Reversed: additional inertia never raises a natural frequency. Without hub inertia "
              "the arm is pinned-free and its poles are highest.",
          .comparisons = {
              comparison("sign of d(pole 1)/d(epsilon)", "1", 1.0, pole > free_pole ? 1.0 : -1.0,
                         {rise(bare.exact_tf, light.exact_tf), rise(bare.fem, light.fem),
                          rise(bare.assumed_modes, light.assumed_modes)},
                         0.0),
              comparison("pole 1, pinned-free", "Hz", std::nullopt, free_pole,
                         light.ask(first_pole), kRootTolerance),
              comparison("pole 1, Table 1", "Hz", std::nullopt, pole, bare.ask(first_pole),
                         kRootTolerance)}};
}

Check large_epsilon(const ThreeModels& bare) {
  const arm::Arm& arm = bare.exact_tf.arm();
  // The difference from the limit falls as 1/epsilon.
  constexpr double kLargeRatio = 1e6;
  const ThreeModels heavy(
      arm_with_hub_inertia(kLargeRatio * arm.hub.inertia_kg_m2 / arm::hub_inertia_ratio(arm)));
  const double cantilever =
      lambda_to_Hz(arm, roots([](double x) { return numerator_39(x, 0.0); }, 1).back());
  return {
      .label = "large epsilon",
      .statement = "for a very large epsilon the frequencies are those of a cantilever",
      .verdict = Verdict::holds,
      .finding = "They are also the zeros of (39).",
      .comparisons = {comparison("pole 1, epsilon = 1e6", "Hz", cantilever, cantilever,
                                 heavy.ask([](const auto& m) { return pole_Hz(m, 1); }), 1e-5)}};
}

}  // namespace

Topic check_mode_shapes() {
  const ThreeModels bare(arm::paper_arm());
  return {.name = "mode_shapes",
          .title = "Mode shapes: (15)-(25)",
          .checks = {separation(bare), ratios(bare), boundary_matrix(bare), inertia_orthogonality(),
                     stiffness_orthogonality(bare), small_epsilon(bare), large_epsilon(bare)}};
}

}  // namespace flexarm::compare::paper
