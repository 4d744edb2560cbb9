#include "report/page/payload_sweep.hpp"

#include "arm/input_error.hpp"
#include "arm/linear_arm.hpp"
#include "compare/sweeps/sweep_result.hpp"
#include "report/page/sweep_blocks.hpp"

#include <algorithm>

namespace flexarm::report::page {

namespace {

constexpr double kOfLargestPayload = 2.0;
constexpr double kOfBeam = 0.5;

}  // namespace

std::vector<SweepBlock> payload_sweep(const arm::Arm& arm, const std::vector<double>& masses_kg,
                                      const std::vector<arm::Sensor>& sensors) {
  try {
    const arm::LinearArm linear = arm::linear_arm(arm);
    double to_kg = kOfBeam * linear.linear_density_kg_per_m * linear.length_m;
    for (const double mass_kg : masses_kg) to_kg = std::max(to_kg, kOfLargestPayload * mass_kg);
    compare::SweepTask task;
    task.arm = arm;
    task.questions.sensors = sensors;
    compare::SweepAxis axis;
    axis.parameter = compare::sweep_parameter("payload.mass");
    for (std::size_t i = 0; i < kPayloadValues; ++i) {
      axis.values.push_back(to_kg * static_cast<double>(i) /
                            static_cast<double>(kPayloadValues - 1));
    }
    task.axes = {std::move(axis)};
    int roots = task.questions.poles;
    for (const auto& sensor : sensors) {
      roots = std::max(roots, compare::zeros_asked(sensor, task.questions));
    }
    task.models = compare::standard_models(roots);
    task.models.resize(1);
    const compare::SweepRun run;
    return sweep_maps(compare::assemble(task, compare::evaluate(task, run), run, {}));
  } catch (const arm::InputError&) {
    return {};
  }
}

}  // namespace flexarm::report::page
