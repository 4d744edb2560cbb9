#include "tests/report/reference_figures.hpp"

#include "compare/comparison.hpp"
#include "compare/paper/paper_sweeps.hpp"
#include "diagnose/planning/plan.hpp"
#include "measured/modal/nyquist_circle.hpp"
#include "report/figures/autopower_figure.hpp"
#include "report/figures/comparison_plots.hpp"
#include "report/figures/diagnosis_figures.hpp"
#include "report/figures/distortion_figure.hpp"
#include "report/figures/frequency_response_figure.hpp"
#include "report/figures/hub_law_figure.hpp"
#include "report/figures/missing_force_figure.hpp"
#include "report/figures/nyquist_circle_figure.hpp"
#include "report/figures/overlay_figure.hpp"
#include "report/figures/response_plots.hpp"
#include "report/figures/separation_figure.hpp"
#include "report/figures/stabilisation_figure.hpp"
#include "report/figures/sweep_figures.hpp"
#include "report/figures/time_figure.hpp"
#include "tests/report/comparison_sample.hpp"
#include "tests/report/measured_sample.hpp"
#include "tests/report/response_sample.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace flexarm::report {
namespace {

const NamedFigure& named(const std::vector<NamedFigure>& figures, const std::string& name) {
  return *std::ranges::find(figures, name, &NamedFigure::name);
}

/// Pole-zero map, Bode diagram and mode shapes of a damped arm, and orders of convergence.
void add_comparison(std::vector<NamedFigure>& all) {
  compare::Options options;
  options.poles = 3;
  options.non_collocated_zeros = 2;
  options.sensors = {arm::parse_sensor("hub_angle"), arm::parse_sensor("tip_acceleration")};
  options.refinements = false;
  options.response_points = 150;
  const auto plots = comparison_plots(compare::compare(measured::damped_paper_arm(), options));
  all.push_back(named(plots, "pole-zero-tip_acceleration"));
  all.push_back(named(plots, "bode-hub_angle"));
  all.push_back(named(plots, "mode-shapes"));
  all.push_back(named(comparison_plots(sample_comparison().comparison), "convergence-poles"));
}

void add_sweeps(std::vector<NamedFigure>& all) {
  const auto paper = compare::paper_sweep(18, arm::paper_arm());
  const auto values = compare::assemble(paper.task, compare::evaluate(paper.task, {}), {}, {});
  all.push_back({"figure-18", paper_sweep_figure(paper, values)});
  compare::SweepTask task;
  task.arm = measured::damped_paper_arm();
  task.models = compare::standard_models(4);
  task.questions.poles = 3;
  task.questions.sensors = {arm::parse_sensor("hub_angle")};
  task.axes = {compare::parse_axis("payload.mass=0:0.5:12")};
  auto over_one = sweep_plots(compare::assemble(task, compare::evaluate(task, {}), {}, {}));
  all.push_back({"sweep-modes", named(over_one, "modes").figure});
  task.axes = {compare::parse_axis("payload_mass_ratio=0,0.3,1"),
               compare::parse_axis("hub.inertia=log:1e-5:1e-1:9")};
  auto over_two = sweep_plots(compare::assemble(task, compare::evaluate(task, {}), {}, {}));
  all.push_back({"sweep-poles-over-two", named(over_two, "poles").figure});
}

/// Spectra, response with fit, stabilisation chart and circles of a short record.
void add_identification(std::vector<NamedFigure>& all) {
  auto arm_case = sample_case();
  arm_case.sensors = measured::sensors_named({"hub_angle", "tip_acceleration"});
  arm_case.duration_s = 20.0;
  const std::array records = {measured::record_of(arm_case)};
  const auto estimate = measured::estimate_frequency_response(records[0]);
  const auto features = measured::spectral_features(estimate);
  const auto fit = measured::fit_modes(records, {.modes = 3});
  const auto poles_Hz = exact_poles_Hz(arm_case.arm, 3);
  all.push_back({"autopower", autopower_figure(estimate, features,
                                               {.title = "random: autopower spectra",
                                                .analytical_poles_Hz = poles_Hz})});
  const auto stepped = stepped_sine(arm_case.arm, arm_case.sensors[1], 2, 201, 0.01);
  all.push_back({"frequency-response",
                 frequency_response_figure(measured_response(estimate, 1),
                                           {.title = "random: torque to tip acceleration",
                                            .fit = fit.transfers[1],
                                            .features = features[1].response,
                                            .analytical_poles_Hz = poles_Hz})});
  all.push_back({"frequency-response-bands",
                 frequency_response_figure(
                     measured_response(stepped),
                     {.title = "sine: torque to tip acceleration", .fit = fit.transfers[1]})});
  StabilisationPlot plot{.title = "random: stabilisation chart",
                         .background = mean_response(measured::to_frequency_record(estimate))};
  for (const auto& pole : fit.poles) plot.fitted_poles_Hz.push_back(pole.frequency_Hz);
  all.push_back({"stabilisation", stabilisation_figure(fit.chart, plot)});
  const arm::Sensor hub = arm::parse_sensor("hub_angle");
  const auto circles = measured::nyquist_circles(stepped_sine(arm_case.arm, hub, 2)).circles;
  all.push_back({"circles", nyquist_circle_figure(hub, circles, "sine: torque to hub angle")});
  measured::ChannelDistortion distortion;
  using measured::LineKind;
  distortion.lines = {{0.1, LineKind::driven, 1.0, 1e-4, 1.0},
                      {0.2, LineKind::even, 1e-4, 1e-4, 0.5},
                      {0.3, LineKind::odd, 1e-2, 1e-4, 1e-9},
                      {0.5, LineKind::driven, 1.0, 1e-4, 1.0}};
  distortion.odd = {1, 1e-9, true, -40.04, -80.0};
  all.push_back({"distortion", distortion_figure(hub, distortion, "multisine: hub angle")});
}

/// A run with a friction torque that the baseline lacks, and an outlier of a sensor.
void add_overlay(std::vector<NamedFigure>& all) {
  diagnose::Experiment experiment;
  diagnose::Diagnosis diagnosis;
  measured::TimeRecord record;
  std::vector<double> measured;
  std::vector<double> before;
  std::vector<double> after;
  for (int k = 0; k < 200; ++k) {
    const double t = 0.01 * k;
    record.time_s.push_back(t);
    record.torque_N_m.push_back(0.01);
    measured.push_back(k == 125 ? 9.0 : std::sin(7.0 * t));
    before.push_back(1.3 * std::sin(7.0 * t + 0.2));
    after.push_back(std::sin(7.0 * t) + 2e-4 * std::cos(40.0 * t));
  }
  for (const auto& [sensor, error] :
       {std::pair("hub_angle", 0.4), std::pair("tip_acceleration", 0.3)}) {
    record.channels.push_back({arm::parse_sensor(sensor), measured});
    diagnosis.overlays.push_back({0, sensor, measured, before, after});
    diagnosis.channels.push_back({"random", sensor, {error, 2e-4, 1e-4}});
  }
  diagnosis.causes.emplace_back();
  measured::MeasuredRun run;
  run.run.id = "random";
  run.data = record;
  experiment.runs.push_back(run);
  all.push_back({"overlay", *overlay_figure(experiment, diagnosis, 0)});
}

/// Residual hub torque of Coulomb friction, an empirical law and a missing force.
void add_residual_torque(std::vector<NamedFigure>& all) {
  diagnose::HubTorque torque;
  torque.terms.push_back({.kind = diagnose::HubTorqueKind::coulomb_friction,
                          .unit = "N m",
                          .coefficient = 0.01,
                          .std_error = 1e-4});
  diagnose::HubTorqueTrace trace{"bang-bang", {}, {}, {}, {}};
  for (int k = 0; k < 150; ++k) {
    const double velocity = std::sin(0.05 * k);
    trace.time_s.push_back(0.01 * k);
    trace.velocity_rad_per_s.push_back(velocity);
    trace.angle_rad.push_back(-std::cos(0.05 * k));
    trace.torque_N_m.push_back(
        k == 100 ? 0.4 : -0.01 * (velocity > 0.0 ? 1.0 : -1.0) + 1e-3 * std::sin(1.7 * k));
  }
  all.push_back({"hub-torque", hub_torque_figure(torque, trace)});
  all.push_back({"hub-law", hub_law_figure({.table = {.velocity_rad_per_s = {-1.0, 0.0, 0.0, 1.0},
                                                      .torque_N_m = {0.3, 0.2, -0.2, -0.3}},
                                            .std_error_N_m = 0.01,
                                            .std_errors_N_m = {0.01, 0.01, 0.01, 0.02},
                                            .means = {{{-0.9, 0.31, 0.02}, {0.8, -0.28, 0.01}}}})});
  diagnose::MissingForce force;
  force.ports = {{.port = diagnose::ForcePort::hub,
                  .place = "torque on the hub",
                  .share = 0.9,
                  .std_error = 0.02},
                 {.port = diagnose::ForcePort::sensor,
                  .sensors = {"hub_angle"},
                  .place = "error of hub_angle",
                  .share = 0.3,
                  .std_error = 0.04}};
  force.stated = 1;
  force.lines = 200;
  force.size = {.unit = "N m", .rms = 0.013, .std_error = 0.001, .from_Hz = 1.0, .to_Hz = 8.0};
  force.size->spectrum = {
      {1.0, 1.25, 1e-4, 1.25e-5}, {1.25, 1.6, 6.4e-5, 4e-5}, {4.0, 5.0, 0.0, 0.0}};
  all.push_back({"missing-force", missing_force_figure(force)});
}

void add_plan(std::vector<NamedFigure>& all) {
  diagnose::Plan plan;
  for (const char* effect : {"coulomb_friction", "hub_viscous_friction", "back_emf"}) {
    plan.effects.emplace_back();
    plan.effects.back().hypothesis.effect = effect;
  }
  plan.separations.assign(3, std::vector<std::optional<diagnose::Separation>>(3));
  const auto put = [&](std::size_t truth, std::size_t rival, double lead) {
    plan.separations[truth][rival].emplace();
    plan.separations[truth][rival]->lead = lead;
  };
  put(0, 1, 1e3);
  put(0, 2, 1e3);
  put(1, 0, 1e3);
  put(1, 2, 0.0);
  put(2, 1, 0.0);
  put(2, 0, 1e3);
  all.push_back({"separations", separation_figure(plan)});
}

void add_simulation(std::vector<NamedFigure>& all) {
  TimePlot plot{"rig: bang-bang", {}, {}};
  TimePanel torque{"torque", "N m", {{"commanded", {}}, {"at the hub", {}}}};
  TimePanel strain{"strain at 0.05 m", "", {{"", {}}}, true};
  for (int k = 0; k < 200; ++k) {
    const double t = 0.01 * k;
    plot.time_s.push_back(t);
    torque.curves[0].values.push_back(t < 0.5 ? 0.3 : (t < 1.0 ? -0.3 : 0.0));
    torque.curves[1].values.push_back(t < 0.5 ? 0.25 : (t < 1.0 ? -0.25 : 0.0));
    strain.curves[0].values.push_back(4e-4 * std::sin(9.0 * t));
  }
  plot.panels = {torque, strain};
  all.push_back({"simulation", time_figure(plot)});
}

}  // namespace

std::vector<NamedFigure> reference_figures() {
  std::vector<NamedFigure> all;
  add_comparison(all);
  add_sweeps(all);
  for (const auto& plot : response_plots("exact_tf", sample_study())) {
    if (plot.name == "bode-tip_acceleration") all.push_back({"response-bode", plot.figure});
    if (plot.name == "nyquist-hub_angle") all.push_back({"response-nyquist", plot.figure});
  }
  add_identification(all);
  add_overlay(all);
  add_residual_torque(all);
  add_plan(all);
  add_simulation(all);
  return all;
}

}  // namespace flexarm::report
