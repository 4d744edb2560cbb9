#include "experiment/mode_choice.hpp"

#include "arm/deadline.hpp"
#include "arm/input_error.hpp"
#include "response/formulation_maker.hpp"
#include "response/time/arm_simulator.hpp"
#include "response/time/single_modes.hpp"
#include "response/time/time_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace flexarm::experiment {

namespace {

using response::ArmParts;

constexpr int kAlwaysAffordable = 40;  // modes, for records of any length

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

/// Whether modes beyond the first kCoupledModes may be stepped one by one in all runs: nothing but
/// the torque on the hub, which goes straight between samples, acts on them, and damping hardly
/// couples them.
bool are_further_modes_single(const arm::Arm& arm, const ArmParts& parts,
                              const std::vector<PlannedRun>& runs,
                              const ExperimentOptions& options) {
  constexpr int kTried = 4 * kCoupledModes;
  const bool is_plain = options.formulation.name == response::FormulationChoice{}.name &&
                        !options.static_correction && response::is_linear(parts) &&
                        parts.actuator.delay_s == 0.0 && parts.actuator.lag_s == 0.0 &&
                        parts.sensor_chains.empty();
  const bool are_open = std::ranges::none_of(
      runs, [](const PlannedRun& run) { return run.controller || run.stepped_sine; });
  return is_plain && are_open &&
         response::are_single(
             response::modal_model(response::formulation_of_fit(arm), kTried, {}, {}),
             static_cast<std::size_t>(kCoupledModes) + 1);
}

/// The most modes that are chosen for runs of so many samples in all.
int most_modes(const ArmParts& parts, std::size_t samples, bool single,
               const ExperimentOptions& options) {
  constexpr double kStepsOfModes = 1e9;  // some ten seconds
  const int coupled = response::affordable_modes(
      parts, samples, kAlwaysAffordable, response::most_chosen_modes(options.formulation.name));
  if (!single) return coupled;
  const double affordable = kStepsOfModes / std::max(1.0, static_cast<double>(samples));
  return std::max(coupled,
                  static_cast<int>(std::min(affordable, static_cast<double>(kMostSingleModes))));
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
  const bool single = are_further_modes_single(arm, parts, runs, options);
  if (!options.modes) {
    std::size_t samples = 0;
    for (const PlannedRun& run : runs) samples += run.time_s.size();
    judge({.most = most_modes(parts, samples, single, options)});
  }
  if (options.modes || runs.size() > 1) {
    all.errors.assign(sensors.size(), 0.0);
    judge({.given = all.modes});
  }
  const int coupled = single ? std::min(all.modes, kCoupledModes) : all.modes;
  return {std::move(all), coupled};
}

}  // namespace flexarm::experiment
