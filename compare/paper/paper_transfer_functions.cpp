#include "compare/paper/paper_forms.hpp"
#include "compare/paper/paper_models.hpp"
#include "compare/paper/paper_topics.hpp"

#include <Eigen/LU>

#include <cmath>
#include <numbers>

namespace flexarm::compare::paper {

namespace {

double lambda_at(const arm::Arm& arm, double omega) {
  return std::sqrt(omega / arm::omega_scale_rad_per_s(arm));
}

/// theta/tau from S (A1, B1, C1, D1) = (0, row_2, 0, 0): theta = beta (A1 + C1).
std::complex<double> solve_37(const Eigen::Matrix4cd& s, std::complex<double> beta,
                              std::complex<double> row_2) {
  const Eigen::Vector4cd right(0.0, row_2, 0.0, 0.0);
  const Eigen::Vector4cd c = s.partialPivLu().solve(right);
  return beta * (c(0) + c(2));
}

Check boundary_value_problem(const ThreeModels& bare) {
  const arm::Arm& arm = bare.exact_tf.arm();
  const double ei = arm.beam.flexural_rigidity_N_m2();
  const double omega = from_Hz(kTestFrequency_Hz);
  const std::complex<double> beta = lambda_at(arm, omega) / arm.beam.length_m;
  // beta^4 = +rho s^2/EI puts beta on a diagonal of the plane.
  const std::complex<double> printed_beta = beta * std::polar(1.0, 0.25 * std::numbers::pi);
  const auto right = matrix_22(arm, beta, Form::corrected);
  const double corrected = std::abs(solve_37(right, beta, -1.0 / ei));
  const auto responses =
      bare.ask([omega](const auto& m) { return magnitude(m, kHubAngle, omega); });
  const auto row = [&](std::string what, double printed) {
    return comparison("|theta/tau|, 5 Hz, " + std::move(what), "rad/(N m)", printed, corrected,
                      responses, kRootTolerance);
  };
  return {.label = "(36)-(37)",
          .statement = "transformed problem and its solution",
          .verdict = Verdict::slip_of_print,
          .finding =
              "(36) holds for an arm at rest at t = 0. With S as in (22) the right-hand side is "
              "-tau/EI; the division by beta^2 needs an S whose row 2 is divided by it too. beta^4 "
              "is -rho s^2/EI, as stated below (39). The third transformed condition lacks s^2, "
              "the fourth has I_m instead of Ip. Rows 2 and 3 below contain only that misprint.",
          .comparisons = {
              row("all as printed",
                  std::abs(solve_37(matrix_22(arm, printed_beta, Form::printed), printed_beta,
                                    -1.0 / (ei * printed_beta * printed_beta)))),
              row("1/(EI beta^2)", std::abs(solve_37(right, beta, -1.0 / (ei * beta * beta)))),
              row("beta^4 = rho s^2/EI",
                  std::abs(solve_37(matrix_22(arm, printed_beta, Form::corrected), printed_beta,
                                    -1.0 / ei))),
          }};
}

Check denominator(const ThreeModels& bare) {
  const ThreeModels heavy(arm_with_payload_mass());
  Check check{
      .label = "(38)",
      .statement = "denominator of all transfer functions",
      .verdict = Verdict::slip_of_print,
      .finding =
          "cos sin must be cos sinh in the first bracket, and sin cos must be sinh cos in the "
          "second. The divisor EI beta belongs only to (39): with it theta/tau = N/D is too large "
          "by a factor EI beta. D is -|S|/beta^7, not |S|. Payload inertia is omitted.",
      .comparisons = {}};
  const auto add_poles = [&check](const ThreeModels& models, const std::string& with) {
    const arm::Arm& arm = models.exact_tf.arm();
    const double epsilon = arm::hub_inertia_ratio(arm), eta = arm::payload_mass_ratio(arm);
    for (const int order : {1, 2}) {
      const auto root = [&](Form form) {
        const auto d = [=](double x) { return denominator_38(x, epsilon, eta, form); };
        return lambda_to_Hz(arm, roots(d, order).back());
      };
      check.comparisons.push_back(comparison(
          "pole " + std::to_string(order) + with, "Hz", root(Form::printed), root(Form::corrected),
          models.ask([order](const auto& m) { return pole_Hz(m, order); }), kRootTolerance));
    }
  };
  add_poles(bare, "");
  add_poles(heavy, ", payload mass");

  const arm::Arm& arm = bare.exact_tf.arm();
  const double omega = from_Hz(kTestFrequency_Hz);
  const double lambda = lambda_at(arm, omega);
  const double ei_beta = arm.beam.flexural_rigidity_N_m2() * lambda / arm.beam.length_m;
  const double quotient =
      std::abs(2.0 * numerator_39(lambda, 0.0) /
               denominator_38(lambda, arm::hub_inertia_ratio(arm), 0.0, Form::corrected));
  check.comparisons.push_back(comparison(
      "|N/D|, 5 Hz, D over EI beta", "rad/(N m)", quotient, quotient / ei_beta,
      bare.ask([omega](const auto& m) { return magnitude(m, kHubAngle, omega); }), kRootTolerance));
  return check;
}

Check numerator(const ThreeModels& bare) {
  const ThreeModels heavy(arm_with_payload_mass());
  Check check{.label = "(39)",
              .statement = "numerator of torque to hub angle; its zeros do not depend on the hub",
              .verdict = Verdict::holds,
              .finding = "Ih and hub friction do not enter. Payload inertia is omitted.",
              .comparisons = {}};
  const auto add_zeros = [&check](const ThreeModels& models, const std::string& with) {
    const arm::Arm& arm = models.exact_tf.arm();
    const double eta = arm::payload_mass_ratio(arm);
    for (const int order : {1, 2}) {
      const double zero =
          lambda_to_Hz(arm, roots([eta](double x) { return numerator_39(x, eta); }, order).back());
      check.comparisons.push_back(
          comparison("hub zero " + std::to_string(order) + with, "Hz", zero, zero,
                     models.ask([order](const auto& m) { return zero_Hz(m, kHubAngle, order); }),
                     kRootTolerance));
    }
  };
  add_zeros(bare, "");
  add_zeros(heavy, ", payload mass");
  add_zeros(ThreeModels(arm_with_hub_inertia(10.0 * bare.exact_tf.arm().hub.inertia_kg_m2)),
            ", hub inertia x 10");
  return check;
}

Check large_payload(const ThreeModels& bare) {
  // The difference from the limit falls as 1/eta.
  constexpr double kLargeRatio = 1e6;
  arm::Arm loaded = arm::paper_arm();
  loaded.payload.mass_kg =
      kLargeRatio * loaded.beam.linear_density_kg_per_m() * loaded.beam.length_m;
  const ThreeModels heavy(loaded);
  // Clamped-pinned: tan lambda = tanh lambda.
  const auto supported =
      roots([](double x) { return std::sin(x) - std::tanh(x) * std::cos(x); }, 1);
  const double limit = lambda_to_Hz(bare.exact_tf.arm(), supported.back());
  return {.label = "large payload",
          .statement =
              "with increasing payload the zeros change from the frequencies of a cantilever to "
              "those of a clamped beam",
          .verdict = Verdict::holds,
          .finding =
              "The limit is clamped at the hub and pinned at the tip, with shifted order: zero 1 "
              "tends to 0, and zero i + 1 to frequency i of the clamped-pinned beam.",
          .comparisons = {
              comparison("hub zero 2, eta = 1e6", "Hz", limit, limit,
                         heavy.ask([](const auto& m) { return zero_Hz(m, kHubAngle, 2); }), 1e-5)}};
}

/// prod (1 + s^2/z^2)/(1 + s^2/p^2) or, as printed in (40)-(42), the sum of these; on s = j omega.
/// A real zero enters as 1 - s^2/z^2.
double factors(const ThreeModels& models, const arm::Sensor& sensor, double omega, Form form) {
  const auto poles = models.exact_tf.poles(kTerms).omega_rad_per_s;
  const auto zeros = models.exact_tf.zeros(sensor, kTerms).s_rad_per_s;
  double product = 1.0, sum = 0.0;
  for (std::size_t i = 0; i < poles.size(); ++i) {
    // s^2/s_z^2, with s_z^2 negative for a zero on the imaginary axis.
    const double zero_factor = 1.0 + omega * omega / (zeros.at(i) * zeros.at(i)).real();
    const double factor = zero_factor / (1.0 - omega * omega / (poles[i] * poles[i]));
    product *= factor;
    sum += factor;
  }
  return form == Form::printed ? sum : product;
}

Check products(const ThreeModels& bare) {
  const arm::Arm& arm = bare.exact_tf.arm();
  const double total = arm::total_inertia_kg_m2(arm);
  const double omega = from_Hz(kTestFrequency_Hz);
  const double angle = 1.0 / (total * omega * omega);
  const auto response = [&](const arm::Sensor& sensor) {
    return bare.ask([&](const auto& m) { return magnitude(m, sensor, omega); });
  };
  const auto hub = [&](Form form) { return std::abs(factors(bare, kHubAngle, omega, form)); };
  const auto tip = [&](Form form) {
    return std::abs(factors(bare, kTipAcceleration, omega, form));
  };
  return {
      .label = "(40)-(42)",
      .statement = "transfer functions as factors of poles and zeros",
      .verdict = Verdict::slip_of_print,
      .finding =
          "Products, not sums, as in the expansions of D and N above (40), whose factors begin at "
          "i = 1. A sum of factors tends to the number of terms as s goes to 0. (42) lacks the "
          "factor l of the rigid arm, which (49) has. The omega_alpha,i mentioned below it do not "
          "occur. Printed values: 30 terms.",
      .comparisons = {
          comparison("|theta/tau|, 5 Hz, (40)", "rad/(N m)", angle * hub(Form::printed),
                     angle * hub(Form::corrected), response(kHubAngle), kSeriesTolerance),
          comparison("|velocity/tau|, 5 Hz, (41)", "rad/s/(N m)",
                     angle * omega * hub(Form::printed), angle * omega * hub(Form::corrected),
                     response(kHubVelocity), kSeriesTolerance),
          comparison("|acceleration/tau|, 5 Hz, (42)", "m/s^2/(N m)", tip(Form::printed) / total,
                     arm.beam.length_m * tip(Form::corrected) / total, response(kTipAcceleration),
                     kSeriesTolerance),
          comparison("the same, product without l", "m/s^2/(N m)", tip(Form::corrected) / total,
                     arm.beam.length_m * tip(Form::corrected) / total, response(kTipAcceleration),
                     kSeriesTolerance)}};
}

}  // namespace

Topic check_transfer_functions() {
  const ThreeModels bare(arm::paper_arm());
  return {.name = "transfer_functions",
          .title = "Transfer functions: (36)-(42)",
          .checks = {boundary_value_problem(bare), denominator(bare), numerator(bare),
                     large_payload(bare), products(bare)}};
}

}  // namespace flexarm::compare::paper
