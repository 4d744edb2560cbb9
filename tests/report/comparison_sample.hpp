#pragma once

#include "compare/comparison.hpp"
#include "report/json/comparison_json.hpp"

#include <complex>
#include <limits>
#include <numbers>
#include <optional>

namespace flexarm::report {

/// A comparison made by hand, small and with everything that may be missing: the second model has
/// no second pole and no zero, a response that is not a number, and a refinement without its root.
inline ComparedArm sample_comparison() {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  using Complex = std::complex<double>;
  const arm::Sensor hub{arm::SensorKind::hub_angle, 0.0};
  const arm::Sensor tip{arm::SensorKind::tip_acceleration, 0.0};
  const arm::Sensor gauge{arm::SensorKind::strain, 0.25};
  const compare::FeatureFamily poles{std::nullopt, 2};
  const compare::FeatureFamily hub_zeros{hub, 1};
  const compare::FeatureFamily tip_zeros{tip, 1};
  const compare::FeatureFamily gauge_zeros{gauge, 2};

  compare::Comparison c;
  c.arm = arm::paper_arm();
  c.subjects = {"exact_tf", "fem"};
  c.settings = {"", "1 elements of degree 3"};
  c.degrees_of_freedom = {0, 3};
  c.wanted_accuracy = 1e-9;
  c.roots = {
      {poles, 1, {Complex(0, 0.1 + 0.2), Complex(0, 75)}, {0.0, 1e-2}},
      {poles, 2, {Complex(0, 200), std::nullopt}, {0.0, kNaN}},
      {hub_zeros, 1, {Complex(0, 18), Complex(0, 18)}, {0.0, 0.0}},
      {tip_zeros, 1, {Complex(57, 0), std::nullopt}, {0.0, kNaN}},
      {gauge_zeros, 1, {Complex(0, 128), std::nullopt}, {0.0, kNaN}},
      {gauge_zeros, 2, {Complex(300, 40), std::nullopt}, {0.0, kNaN}},
  };
  for (const auto& family : {poles, hub_zeros, tip_zeros, gauge_zeros}) {
    c.notes.push_back({"exact_tf", family, family.count, {}, 0, {2, 2, "Wittrick-Williams"}});
    c.notes.push_back({"fem", family, 1, {{Complex(1, 2), kNaN, "moves"}}, 3, {1, -1, ""}});
  }
  c.stations_m = {0.0, 0.48, 0.96};
  const arm::Mode mode{75.0, 3.2, 0.0, {}, {0.0, 0.5, -1.0}};
  c.modes = {{mode, mode}, {mode}};
  c.shapes = {{"fem", 1, 1e-12, 1e-6, 3.2, 1e-7}};
  for (const auto& sensor : {hub, tip, gauge}) {
    compare::ResponseComparison response;
    response.sensor = sensor;
    response.frequency_Hz = {1.0, 10.0, 100.0};
    response.values = {{1.0, Complex(0, 2), 3.0}, {1.0, Complex(kNaN, kNaN), 3.0}};
    response.relative_error = {{0, 0, 0}, {0, kNaN, 0}};
    response.one_minus_coherence = {0, kNaN, 0};
    response.largest_error = {0.0, kNaN};
    response.largest_error_frequency_Hz = {kNaN, 10.0};
    c.responses.push_back(response);
  }
  const auto curve = [](const compare::FeatureFamily& family, int order,
                        std::vector<compare::RefinementPoint> points) {
    compare::RefinementCurve made{"fem, cubic elements",
                                  "fem",
                                  "elements",
                                  compare::Decay::algebraic,
                                  false,
                                  family,
                                  order,
                                  points,
                                  {}};
    made.convergence = compare::observe_convergence(points, made.decay, 1e-9);
    return made;
  };
  c.refinements = {curve(poles, 1, {{2, 4, 1e-3}, {4, 8, 1e-3 / 16}, {8, 16, 1e-3 / 256}}),
                   curve(poles, 2, {{2, 4, kNaN}, {4, 8, 1e-2}, {8, 16, 1e-3}}),
                   curve(tip_zeros, 1, {{2, 4, kNaN}, {4, 8, kNaN}, {8, 16, kNaN}})};
  c.basis_notes = {"legendre: a note"};
  c.findings = {{"pole 1", "exact_tf", "fem", 1e-2, 1e-9},
                {"pole 2", "exact_tf", "fem", kNaN, 1e-9}};
  c.verdict = compare::judge(c.findings);

  measured::ModalEntry pole;
  pole.frequency_Hz = 12.0;
  measured::ModalEntry zero;
  zero.sensor = tip;
  zero.feature = measured::Feature::zero;
  pole.frequency_std_Hz = 0.1;
  pole.damping_ratio = 0.02;
  compare::MeasuredComparison measured;
  measured.rows.resize(2);
  measured.rows[0].measured = pole;
  measured.rows[0].order = 1;
  measured.rows[0].model_frequency_Hz = 11.86;
  measured.rows[0].error_percent = 1.2;
  measured.rows[0].frequencies_Hz = {11.86, std::nullopt};
  measured.rows[0].deviations = {1.4, kNaN};
  measured.rows[0].combined_deviation = 1.4;
  measured.rows[1].measured = zero;
  measured.rows[1].frequencies_Hz = {std::nullopt, std::nullopt};
  measured.rows[1].deviations = {kNaN, kNaN};
  measured.responses = {{"sine",
                         {hub, {1.0, 10.0}, {Complex(1, 0), Complex(0, 2)}, {0.9, kNaN}},
                         {"exact_tf", "fem"},
                         {{Complex(1.1, 0), Complex(0, 2)}, {Complex(1, 0), Complex(kNaN, kNaN)}},
                         {4.5, 0.0},
                         {10.0, 0.0}}};
  measured.shapes = {{{{1, 12.0, {hub, gauge}, {1.0, Complex(0, 1)}}},
                      {11.86, 32.0},
                      {"exact_tf", "fem"},
                      {{{0.98, 0.02}}, {{0.97, kNaN}}},
                      0.3}};
  return {c, measured};
}

}  // namespace flexarm::report
