#include "compare/paper/paper_measured_tables.hpp"

#include "compare/paper/paper_cells.hpp"
#include "compare/paper/paper_modal_sums.hpp"
#include "compare/paper/paper_tables.hpp"
#include "compare/paper/paper_topics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <stdexcept>
#include <utility>

namespace flexarm::compare::paper {

namespace {

std::vector<double> values(const std::array<PrintedNumber, 2>& printed) {
  return {printed[0].value, printed[1].value};
}

/// Squares f^2 of the frequencies, in the unit of `pole` squared, at which
///
///     rigid - sum_i gain_i phi_i'(0) f^2/(pole_i^2 - f^2) = 0,   two modes,
///
/// ascending; `share` holds gain_i phi_i'(0). These are the zeros of (48) and (49) without damping;
/// a negative square is a real pair.
std::array<double, 2> squared_zeros(double rigid, const std::vector<double>& share,
                                    const std::vector<double>& pole) {
  const double a = pole[0] * pole[0], b = pole[1] * pole[1];
  const double quadratic = rigid + share[0] + share[1];
  const double linear = -(rigid * (a + b) + share[0] * b + share[1] * a);
  const double constant = rigid * a * b;
  const double root = std::sqrt(linear * linear - 4.0 * quadratic * constant);
  std::array<double, 2> z{(-linear - root) / (2.0 * quadratic),
                          (-linear + root) / (2.0 * quadratic)};
  std::sort(z.begin(), z.end());
  return z;
}

/// What Table 3 gives for zero 2 at a location, by the transfer function.
const FrequencyCell& second_zero(const std::string& location) {
  const auto& cells = tables().frequencies;
  const auto cell = std::find_if(cells.begin(), cells.end(), [&](const FrequencyCell& c) {
    return c.table == 3 && c.method == "transfer function" && c.location == location &&
           c.feature == "zero" && c.order == 2;
  });
  if (cell == cells.end()) throw std::logic_error("data/paper/table_3.csv: no " + location);
  return *cell;
}

Check strain_zeros(const ThreeModels& bare) {
  Check check{.label = "Tables 3, 4: strain",
              .statement = "zeros of other sensors, compared with the zeros of the hub sensors",
              .verdict = Verdict::does_not_follow,
              .finding =
                  "The zeros of the hub sensors are not zeros of torque to strain. Torque to tip "
                  "acceleration has no zeros on the imaginary axis; its zeros are "
                  "non-minimum-phase. Table 3 contains true strain zeros.",
              .comparisons = {}};
  for (const auto& [location, position_m] :
       {std::pair{"location-1", 0.05}, std::pair{"location-2", 0.25}}) {
    const arm::Sensor gauge{arm::SensorKind::strain, position_m};
    const double exact = zero_Hz(bare.exact_tf, gauge, 1);
    const FrequencyCell& cell = second_zero(location);
    check.finding += fmt::format(
        " {} Hz at {} differs by {:.1f} % from the first zero of the gauge; the paper states an "
        "error of {} %.",
        cell.measured_Hz->value, location,
        100.0 * std::abs(cell.measured_Hz->value - exact) / exact, cell.error_percent->value);
    check.comparisons.push_back(comparison(
        std::string("strain zero 1, ") + location, "Hz", analytical_Hz("zero", 2).value, exact,
        bare.ask([&](const auto& m) { return zero_Hz(m, gauge, 1); }), kIntegralTolerance));
  }
  return check;
}

Check resolution() {
  constexpr double kSampling_s = 0.005;
  constexpr double kSpacing_Hz = 500.0 / 1024.0;  // the multiple of 1/1024 that prints as 0.488
  const auto grid = count_on_grid(kSpacing_Hz);
  const double block = 1.0 / (kSampling_s * kSpacing_Hz);
  const double power = std::exp2(std::round(std::log2(block)));
  const auto own = count_on_grid(1.0 / (kSampling_s * power));
  std::string off;
  for (const auto& name : grid.off_grid) off += (off.empty() ? "" : ". ") + name;
  return {.label = "resolution",
          .statement = "line spacing 0.488 Hz, sampling period 5 ms",
          .verdict = Verdict::does_not_follow,
          .finding =
              fmt::format("{} of {} frequencies of Tables 2 and 3 are multiples of 500/1024 Hz to "
                          "the printed digits. This needs segments of {:.1f} samples of 5 ms. With "
                          "{:.0f} samples the line spacing is {:.4f} Hz, and {} fit. 512 samples "
                          "of 4 ms, or 1024 of 2 ms, give 500/1024. Not multiples: {}.",
                          grid.on_grid, grid.cells, block, power, 1.0 / (kSampling_s * power),
                          own.on_grid, off),
          .comparisons = {}};
}

Check damping_law() {
  const auto& t = tables().hub_model;
  const auto w = values(t.pole_Hz);
  const double ratio = t.damping_ratio[1].value / t.damping_ratio[0].value;
  // 2 xi_i w_i = b0 + b1 w_i^2 for both modes.
  const auto term = [&](std::size_t i) {
    return 2.0 * t.damping_ratio[i].value * from_Hz(t.pole_Hz[i].value);
  };
  const double w0 = from_Hz(w[0]), w1 = from_Hz(w[1]);
  const double b1 = (term(1) - term(0)) / (w1 * w1 - w0 * w0);
  const double b0 = term(0) - b1 * w0 * w0;
  return {
      .label = "Tables 5, 6: damping",
      .statement = "damping ratios and the law below (31)",
      .verdict = Verdict::does_not_follow,
      .finding = fmt::format("xi = b0/(2 omega) + b1 omega/2 for both modes gives b0 = {:.3g} 1/s, "
                             "a negative damping. With b0 >= 0 the ratio of the two is at most "
                             "omega_2/omega_1. An arm with xi_2 = {} is not \"lightly damped\".",
                             b0, t.damping_ratio[1].value),
      .comparisons = {comparison("xi_2/xi_1, at most", "1", ratio, w[1] / w[0], {}, 0.01)}};
}

/// phi_i'(0) by (50) from (47) at that resonance, with the damping ratios of the table; I_T
/// cancels.
double slope_with_damping(const ModelTable& t, std::size_t mode) {
  const std::complex<double> s{0.0, t.pole_Hz[mode].value};
  std::complex<double> g = 1.0 / (s * s);
  for (std::size_t i = 0; i < t.pole_Hz.size(); ++i) {
    const double w = t.pole_Hz[i].value, z = t.zero_Hz[i].value, xi = t.damping_ratio[i].value;
    g *= (s * s / (z * z) + 2.0 * xi * s / z + 1.0) / (s * s / (w * w) + 2.0 * xi * s / w + 1.0);
  }
  return std::sqrt(2.0 * t.damping_ratio[mode].value * std::norm(s) * std::abs(g));
}

Check hub_slopes(const ThreeModels& bare) {
  const auto& t = tables().hub_model;
  const auto poles = values(t.pole_Hz), zeros = values(t.zero_Hz), slopes = values(t.gain);
  const auto squares = squared_slopes(poles, zeros);
  const double first = std::sqrt(squares[0]), second = std::sqrt(squares[1]);
  const auto implied = squared_zeros(1.0, {slopes[0] * slopes[0], slopes[1] * slopes[1]}, poles);
  Check check{
      .label = "Table 6",
      .statement = "hub modal slopes from (47), (48) and Table 4",
      .verdict = Verdict::does_not_follow,
      .finding = fmt::format(
          "(47) and (48) with two modes determine both slopes for any I_T: they are the residues. "
          "With the damping of the table, (50) gives {:.3f} and {:.3f}. The printed {} of mode 2 "
          "equals the quotient of the two, {:.3f}. The printed {} of mode 1 is close to the value "
          "for a single mode, {:.3f}.",
          slope_with_damping(t, 0), slope_with_damping(t, 1), t.gain[1].value, second / first,
          t.gain[0].value, std::sqrt(squared_slopes({poles[0]}, {zeros[0]})[0])),
      .comparisons = {
          against_print("phi_1'(0) from the roots of Table 6", "1", t.gain[0], first, {}),
          against_print("phi_2'(0) from the roots of Table 6", "1", t.gain[1], second, {}),
          against_print("hub zero 1 from slopes and poles", "Hz", t.zero_Hz[0],
                        std::sqrt(implied[0]), {}),
          against_print("hub zero 2 from slopes and poles", "Hz", t.zero_Hz[1],
                        std::sqrt(implied[1]), {})}};
  for (const int order : {1, 2}) {
    const double slope = mode(bare.exact_tf, order).hub_slope;
    check.comparisons.push_back(
        against_print(fmt::format("phi_{}'(0) of Table 1's arm", order), "1",
                      t.gain[static_cast<std::size_t>(order) - 1], slope,
                      bare.ask([order](const auto& m) { return mode(m, order).hub_slope; })));
  }
  return check;
}

Check accelerometer_gains(const ThreeModels& bare) {
  const auto& t = tables().accelerometer_model;
  const auto slopes = values(tables().hub_model.gain), gains = values(t.gain);
  const double l = bare.exact_tf.arm().beam.length_m;
  const auto tip = modal_data(bare.exact_tf, 2).tip_m;
  const auto zeros = squared_zeros(l, {slopes[0] * gains[0], slopes[1] * gains[1]},
                                   {from_Hz(t.pole_Hz[0].value), from_Hz(t.pole_Hz[1].value)});
  Check check{
      .label = "Table 7",
      .statement = "accelerometer's modal gains by (52)",
      .verdict = Verdict::does_not_follow,
      .finding = fmt::format(
          "The signs alternate as those of phi_i(l), so the minus sign missing in (52) was used. "
          "The magnitudes are {:.1f} and {:.1f} times phi_i(l), whose limit for zero hub inertia "
          "is 2 l/3^(1/2) = {:.3f} m in every mode. As phi_i''(l) they would be 0.",
          gains[0] / tip[0], gains[1] / tip[1], 2.0 * l / std::sqrt(3.0)),
      .comparisons = {}};
  for (const int order : {1, 2}) {
    check.comparisons.push_back(against_print(
        fmt::format("phi_{}(l) of Table 1's arm", order), "m",
        t.gain[static_cast<std::size_t>(order) - 1], tip[static_cast<std::size_t>(order) - 1],
        bare.ask([order](const auto& m) { return mode_value(m, order, kTipDisplacement); })));
  }
  check.comparisons.push_back(
      comparison("real zero 1 of (49), Tables 6 and 7 (non-minimum phase)", "rad/s",
                 std::sqrt(-zeros[1]), from_Hz(zero_Hz(bare.exact_tf, kTipAcceleration, 1)),
                 bare.ask([](const auto& m) { return from_Hz(zero_Hz(m, kTipAcceleration, 1)); }),
                 kIntegralTolerance));
  return check;
}

}  // namespace

std::vector<Check> check_measured_tables(const ThreeModels& bare) {
  return {strain_zeros(bare), resolution(), damping_law(), hub_slopes(bare),
          accelerometer_gains(bare)};
}

}  // namespace flexarm::compare::paper
