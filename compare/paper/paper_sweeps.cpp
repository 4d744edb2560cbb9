#include "compare/paper/paper_sweeps.hpp"

#include "arm/input_error.hpp"
#include "compare/paper/paper_tables.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace flexarm::compare {

namespace {

constexpr int kShown = 2;              // poles or zeros in the figures
constexpr double kWithoutBound = 1e8;  // payload mass over m l: frequencies are off by its inverse
constexpr double kNearZero_Hz = 1e-2;  // below what a picture shows

std::vector<SweepMark> limits_of(const Model& model, const arm::Arm& arm,
                                 const SweepQuestions& questions, bool zeros) {
  arm::Arm heavy = arm;
  sweep_parameter("payload_mass_ratio").set(heavy, kWithoutBound);
  const SweepPoint point = evaluate_point(model, heavy, questions);
  std::vector<SweepMark> limits;
  for (int k = 0; k < kShown; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double omega =
        zeros ? std::abs(point.zeros_rad_per_s.front()[i]) : point.omega_rad_per_s[i];
    const double frequency_Hz = omega / (2.0 * std::numbers::pi);
    if (frequency_Hz > kNearZero_Hz) {
      limits.push_back({"infinite payload", 0.0, frequency_Hz});
    }
  }
  return limits;
}

}  // namespace

PaperSweep paper_sweep(int figure, const arm::Arm& arm) {
  if (figure != 18 && figure != 19) {
    throw arm::out_of_range("--figure", figure, "", "18 (poles) or 19 (zeros)");
  }
  PaperSweep sweep;
  sweep.zeros = figure == 19;
  sweep.title = fmt::format("Figure {}: variation of system {} with payload", figure,
                            sweep.zeros ? "zeros" : "poles");
  sweep.task.arm = arm;
  sweep.task.axes = {parse_axis("payload.mass=0:0.5:201")};
  sweep.task.models = standard_models(kShown);
  sweep.task.questions.poles = kShown;
  sweep.task.questions.modes = false;
  sweep.task.questions.sensors.clear();
  if (sweep.zeros) sweep.task.questions.sensors = {{arm::SensorKind::hub_angle, 0.0}};
  require_valid(sweep.task);
  sweep.limits = limits_of(sweep.task.models.front(), arm, sweep.task.questions, sweep.zeros);
  if (arm == arm::paper_arm()) {
    const auto& table = paper::tables().hub_model;
    for (const auto& printed : sweep.zeros ? table.zero_Hz : table.pole_Hz) {
      sweep.measured.push_back({"measured (Table 6)", 0.0, printed.value});
    }
  }
  return sweep;
}

}  // namespace flexarm::compare
