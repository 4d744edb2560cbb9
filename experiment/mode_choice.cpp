#include "experiment/mode_choice.hpp"

#include "arm/deadline.hpp"
#include "arm/input_error.hpp"
#include "arm/rigid_hub.hpp"
#include "response/formulation_maker.hpp"
#include "response/time/arm_simulator.hpp"
#include "response/time/single_modes.hpp"
#include "response/time/time_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace flexarm::experiment {

namespace {

using response::ArmParts;

/// The torque of a closed loop, which depends on the model, by a model of few modes.
std::vector<double> torque_in_loop(const PlannedRun& plan, const arm::Arm& loaded,
                                   const std::vector<arm::Sensor>& sensors, double period_s) {
  constexpr int kModes = 10;
  const ArmParts parts = response::take_apart(loaded);
  const auto model =
      response::time_model(response::formulation_of_fit(loaded), parts, kModes, sensors);
  return response::ArmSimulator(model, parts, sensors,
                                response::options_of_fit(period_s, response::TorqueHold::zero))
      .closed_loop_readings({*plan.controller, plan.reference.values})
      .torque_N_m;
}

/// Truncation of one run with that number of modes, or a chosen one.
response::Truncation truncation_of(const PlannedRun& plan, const arm::Arm& loaded,
                                   const std::vector<arm::Sensor>& sensors,
                                   const ExperimentOptions& options,
                                   const response::ModeCount& count) {
  if (plan.stepped_sine) {
    return response::truncation_in_frequency(response::formulation_of_fit(loaded), sensors,
                                             frequencies_Hz(*plan.stepped_sine),
                                             options.static_correction, count);
  }
  if (plan.time_s.size() < 2) return {count.given.value_or(1), std::vector<double>(sensors.size())};
  const double period_s =
      (plan.time_s.back() - plan.time_s.front()) / static_cast<double>(plan.time_s.size() - 1);
  const auto torque_N_m =
      plan.controller ? torque_in_loop(plan, loaded, sensors, period_s) : plan.torque.torque_N_m;
  return response::truncation_in_time(loaded, sensors, torque_N_m, period_s, options.hold, count);
}

/// Forces that vary with the state take inner steps that resolve the fastest mode.
bool have_inner_steps(const ArmParts& parts) {
  return !parts.hub.smooth.empty() || !parts.beam_forces.empty() ||
         std::isfinite(parts.hub.friction_scale_rad_per_s());
}

/// The most modes that are stepped together, so that all runs take some seconds.
int most_coupled(const arm::Arm& arm, const ArmParts& parts, const std::vector<PlannedRun>& runs,
                 const ExperimentOptions& options) {
  constexpr int kAlwaysAffordable = 40;
  constexpr int kLeastWithInnerSteps = 6;
  constexpr double kInnerStepsPerRadian = 2.0;
  constexpr double kProducts = 2e8;
  std::size_t samples = 0;
  for (const PlannedRun& run : runs) samples += run.time_s.size();
  const int most = response::most_chosen_modes(options.formulation.name);
  if (!have_inner_steps(parts)) {
    return response::affordable_modes(parts, samples, kAlwaysAffordable, most);
  }
  const auto model = response::modal_model(response::formulation_of_fit(arm), most, {}, {});
  const auto products = [&](std::size_t mode) {
    const double rate = std::max(model.modes[mode].omega_rad_per_s,
                                 model.damping_rad_per_s[mode * (model.modes.size() + 1)]);
    double steps = 0.0;
    for (const PlannedRun& run : runs) {
      if (run.time_s.size() < 2) continue;
      const double period_s = run.time_s[1] - run.time_s[0];
      steps += static_cast<double>(run.time_s.size()) *
               std::max(1.0, kInnerStepsPerRadian * rate * period_s);
    }
    return steps * std::pow(2.0 * static_cast<double>(mode), 2);
  };
  auto modes = static_cast<std::size_t>(kLeastWithInnerSteps);
  while (modes + 1 < model.modes.size() && products(modes + 1) <= kProducts) ++modes;
  return static_cast<int>(modes);
}

/// Whether modes beyond the first `coupled` may be stepped one by one in all runs: damping hardly
/// couples them, nothing but the torque on the hub acts on them that changes fast, and that goes
/// straight between samples. Dry friction jumps, and holds the hub.
bool are_further_modes_single(const arm::Arm& arm, const ArmParts& parts,
                              const std::vector<PlannedRun>& runs, const ExperimentOptions& options,
                              int coupled) {
  const bool is_plain = options.formulation.name == response::FormulationChoice{}.name &&
                        !options.static_correction && parts.hub.friction.empty() &&
                        parts.actuator.delay_s == 0.0 && parts.actuator.lag_s == 0.0 &&
                        parts.sensor_chains.empty();
  const bool are_open = std::ranges::none_of(
      runs, [](const PlannedRun& run) { return run.controller || run.stepped_sine; });
  return is_plain && are_open && arm::has_beam(parts.linear) &&
         response::are_single(
             response::modal_model(response::formulation_of_fit(arm), 4 * coupled, {}, {}),
             static_cast<std::size_t>(coupled) + 1);
}

/// The most modes that are chosen where those beyond the coupled ones are stepped one by one.
int most_single(const std::vector<PlannedRun>& runs) {
  constexpr double kSteps = 1e9;  // of one mode by one sample: some ten seconds
  double samples = 1.0;
  for (const PlannedRun& run : runs) samples += static_cast<double>(run.time_s.size());
  return static_cast<int>(std::min(kSteps / samples, static_cast<double>(kMostSingleModes)));
}

}  // namespace

ModeChoice choose_modes(const arm::Arm& arm, const std::vector<PlannedRun>& runs,
                        const std::vector<arm::Sensor>& sensors, const ExperimentOptions& options,
                        const ProgressOf& progress_of) {
  response::Truncation all{options.modes.value_or(0), std::vector<double>(sensors.size(), 0.0),
                           !options.modes};
  const auto judge = [&](const response::ModeCount& count) {
    const auto progress = progress_of("truncation, runs", runs.size());
    for (std::size_t r = 0; r < runs.size(); ++r) {
      arm::Arm loaded = arm;
      loaded.payload = runs[r].payload.value_or(arm.payload);
      response::formulation_of_fit(loaded);  // throws for a payload that is none
      try {
        const auto one = truncation_of(runs[r], loaded, sensors, options, count);
        all.modes = std::max(all.modes, one.modes);
        all.visible_Hz = std::max(all.visible_Hz, one.visible_Hz);
        for (std::size_t k = 0; k < sensors.size(); ++k) {
          all.errors[k] = std::max(all.errors[k], one.errors[k]);
        }
      } catch (const arm::InputError& error) {
        throw arm::InputError(fmt::format("{}: {}", runs[r].id, error.what()), error.key());
      }
      if (!progress(static_cast<double>(r + 1) / static_cast<double>(runs.size()))) {
        throw arm::Cancelled{};
      }
    }
  };
  const ArmParts parts = response::take_apart(arm);
  const int most = most_coupled(arm, parts, runs, options);
  int coupled = options.modes ? kCoupledModes : std::min(most, kCoupledModes);
  const bool single = are_further_modes_single(arm, parts, runs, options, coupled);
  if (!options.modes) {
    judge({.most = single ? std::max(most, most_single(runs)) : most});
  }
  if (options.modes || runs.size() > 1) {
    all.errors.assign(sensors.size(), 0.0);
    judge({.given = all.modes});
  }
  coupled = single ? std::min(all.modes, coupled) : all.modes;
  return {std::move(all), coupled};
}

}  // namespace flexarm::experiment
