#include "compare/paper/paper_modal_sums.hpp"
#include "compare/paper/paper_models.hpp"
#include "compare/paper/paper_topics.hpp"

#include <cmath>
#include <numbers>

namespace flexarm::compare::paper {

namespace {

/// At a resonance the modes and the rigid motion that (50)-(52) leave out are smaller than what is
/// kept by 2 xi_1 over a number of the order of phi_1'(0)^2.
constexpr double kResonanceTolerance = 0.02;

/// gamma^2 = H1/H2 of (45)-(46) from `records` records of an input of size 1 through H = 1 with
/// noise of size 1 on the output, its phase spread evenly over the records.
double coherence(int records) {
  std::complex<double> cross = 0.0;
  double input = 0.0, output = 0.0;
  for (int k = 0; k < records; ++k) {
    const std::complex<double> x = 1.0;
    const auto y = x + std::polar(1.0, 1.0 + 2.0 * std::numbers::pi * k / records);
    cross += std::conj(x) * y;
    input += std::norm(x);
    output += std::norm(y);
  }
  const auto h1 = cross / input;
  const auto h2 = output / std::conj(cross);
  return (h1 / h2).real();
}

Check spectra() {
  // Noise as large as the signal: half of the output's power is due to the input.
  constexpr int kRecords = 16;
  return {.label = "(43)-(46)",
          .statement = "spectra, frequency response and coherence",
          .verdict = Verdict::slip_of_print,
          .finding =
              "(44)-(46) hold for spectra averaged over records, as stated later in the text. (43) "
              "as printed is for one record, and with one record the coherence is 1 for any noise. "
              "gamma^2 is not an error between H1 and H2 but their ratio.",
          .comparisons = {{.quantity = "gamma^2, noise = signal",
                           .unit = "1",
                           .printed = coherence(1),
                           .corrected = coherence(kRecords),
                           .formulations = {},
                           .tolerance = 1e-12}}};
}

/// (47) on s = j omega, with the damping of a zero by the zero's own frequency or, as printed, by
/// the damping ratio of the pole beside it.
std::complex<double> product_47(const ThreeModels& damped, double omega, bool own_damping) {
  const arm::Arm& arm = damped.exact_tf.arm();
  const double kv = arm.damping.kelvin_voigt_s;
  const auto poles = damped.exact_tf.poles(kTerms).omega_rad_per_s;
  const auto zeros = damped.exact_tf.zeros(kHubAngle, kTerms).s_rad_per_s;
  const std::complex<double> s{0.0, omega};
  std::complex<double> g = 1.0 / (arm::total_inertia_kg_m2(arm) * s * s);
  for (std::size_t i = 0; i < poles.size(); ++i) {
    const double w = poles[i], z = zeros.at(i).imag();
    // 2 xi/w = kv for Kelvin-Voigt damping.
    const double zero_term = own_damping ? kv : kv * w / z;
    g *= (s * s / (z * z) + zero_term * s + 1.0) / (s * s / (w * w) + kv * s + 1.0);
  }
  return g;
}

Check poles_and_zeros(const ThreeModels& damped) {
  const double zero = damped.exact_tf.zeros(kHubAngle, 1).s_rad_per_s[0].imag();
  const double test = from_Hz(kTestFrequency_Hz);
  const auto row = [&](const std::string& where, double omega) {
    return comparison("|theta/tau|, " + where + ", damped", "rad/(N m)",
                      std::abs(product_47(damped, omega, false)),
                      std::abs(product_47(damped, omega, true)),
                      damped.ask([omega](const auto& m) { return magnitude(m, kHubAngle, omega); }),
                      kSeriesTolerance);
  };
  return {.label = "(47)",
          .statement = "torque to hub angle from measured poles and zeros",
          .verdict = Verdict::slip_of_algebra,
          .finding =
              "A zero has its own damping ratio. With Kelvin-Voigt damping it is kv omega/2 for "
              "each root, so that of zero i is smaller than that of pole i by the factor "
              "Omega_i/omega_i. With the damping ratio of the pole the antiresonance at Omega_i is "
              "too shallow by the inverse factor.",
          .comparisons = {row("hub zero 1", zero), row("5 Hz", test)}};
}

Check hub_angle_sum(const ThreeModels& damped, const ModalData& data) {
  const double omega = from_Hz(kTestFrequency_Hz);
  const double sum =
      std::abs(partial_fractions(data, 1.0, data.hub_slope, damping_terms(data), 0, {0.0, omega}));
  return {.label = "(48)",
          .statement = "torque to hub angle as a sum over modes",
          .verdict = Verdict::holds,
          .finding = "Exact for Kelvin-Voigt damping as n grows.",
          .comparisons = {comparison(
              "|theta/tau|, 5 Hz, damped", "rad/(N m)", sum, sum,
              damped.ask([omega](const auto& m) { return magnitude(m, kHubAngle, omega); }),
              kSeriesTolerance)}};
}

Check tip_acceleration_sum(const ThreeModels& damped, const ModalData& data) {
  const double omega = from_Hz(kTestFrequency_Hz);
  const auto sum = [&](const std::vector<double>& gain) {
    return std::abs(
        partial_fractions(data, data.length_m, gain, damping_terms(data), 2, {0.0, omega}));
  };
  return {
      .label = "(49)",
      .statement = "torque to end-point acceleration as a sum over modes",
      .verdict = Verdict::slip_of_algebra,
      .finding =
          "phi_i''(l) must be phi_i(l): two primes are printed instead of the two dots of the "
          "acceleration. As printed the sum is zero at a free tip, and only the rigid arm remains.",
      .comparisons = {comparison(
          "|acceleration/tau|, 5 Hz, damped", "m/s^2/(N m)", sum(data.tip_curvature_per_m),
          sum(data.tip_m),
          damped.ask([omega](const auto& m) { return magnitude(m, kTipAcceleration, omega); }),
          kSeriesTolerance)}};
}

Check resonances(const ThreeModels& damped, const ModalData& data) {
  const double w = data.omega_rad_per_s[0];
  const double slope = data.hub_slope[0];
  // 2 xi_1 omega_1^2 I_T
  const double scale = data.damping_term(0) * w * data.total_inertia_kg_m2;
  const double angle = slope * slope / scale;
  const auto acceleration = [&](double gain) { return std::abs(gain) * slope * w * w / scale; };
  return {
      .label = "(50)-(51)",
      .statement = "hub angle and end-point acceleration at a resonance",
      .verdict = Verdict::slip_of_algebra,
      .finding =
          "Accurate to a few parts in a thousand at this damping, as only the resonant mode is "
          "included. (51) has phi''(l) instead of phi(l), from (49). Its sign is correct.",
      .comparisons = {
          comparison("|theta/tau|, omega_1, damped", "rad/(N m)", angle, angle,
                     damped.ask([w](const auto& m) { return magnitude(m, kHubAngle, w); }),
                     kResonanceTolerance),
          comparison("|acceleration/tau|, omega_1, damped", "m/s^2/(N m)",
                     acceleration(data.tip_curvature_per_m[0]), acceleration(data.tip_m[0]),
                     damped.ask([w](const auto& m) { return magnitude(m, kTipAcceleration, w); }),
                     kResonanceTolerance)}};
}

Check gain_from_resonance(const ThreeModels& damped, const ModalData& data) {
  const std::complex<double> s{0.0, data.omega_rad_per_s[0]};
  const auto& exact = damped.exact_tf;
  const auto quotient =
      exact.transfer_function(kTipAcceleration, s) / exact.transfer_function(kHubAngle, s);
  const double by_52 = quotient.real() * data.hub_slope[0] / std::norm(s);
  return {.label = "(52)",
          .statement = "modal gain of the accelerometer from a measured ratio",
          .verdict = Verdict::slip_of_algebra,
          .finding =
              "(51) over (50) is -omega_i^2 phi_i(l)/phi_i'(0). The minus sign is missing, so the "
              "sign rule is reversed. It gives phi_i(l), not phi_i''(l), which is zero.",
          .comparisons = {comparison(
              "phi_1(l) from alpha/theta, damped", "m", by_52, -by_52,
              damped.ask([](const auto& m) { return mode_value(m, 1, kTipDisplacement); }),
              kResonanceTolerance)}};
}

}  // namespace

Topic check_identification() {
  const ThreeModels damped(arm_with_damping());
  const ModalData data = modal_data(damped.exact_tf, kTerms);
  return {.name = "identification",
          .title = "Spectra and identification: (43)-(52)",
          .checks = {spectra(), poles_and_zeros(damped), hub_angle_sum(damped, data),
                     tip_acceleration_sum(damped, data), resonances(damped, data),
                     gain_from_resonance(damped, data)}};
}

}  // namespace flexarm::compare::paper
