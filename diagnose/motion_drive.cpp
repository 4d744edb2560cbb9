#include "diagnose/motion_drive.hpp"

#include "arm/input_error.hpp"
#include "arm/rigid_hub.hpp"
#include "response/arm_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <variant>

namespace flexarm::diagnose {

namespace {

/// Error that the motion adds to a signal, over it, above which a simulation by it tells little.
constexpr double kUselessMotion = 0.5;

bool is_of_hub(const measured::Channel& channel) {
  return arm::is_collocated(channel.sensor);
}

/// Of a run, by its angle before its velocity.
MeasuredMotion measured_motion(const measured::TimeRecord& record, const measured::Run& run,
                               const arm::Arm& arm, std::string_view predictor) {
  auto seen = std::ranges::find_if(record.channels, [](const measured::Channel& channel) {
    return channel.sensor.kind == arm::SensorKind::hub_angle;
  });
  if (seen == record.channels.end()) seen = std::ranges::find_if(record.channels, is_of_hub);
  const auto chain = response::chain_of(response::take_apart(arm).sensor_chains, seen->sensor);
  if (chain.delay_s != 0.0 || chain.lag_s != 0.0) {
    throw arm::InputError(fmt::format(
        "predictor {}: the arm file has {} with a delay or a lag; its readings must be those of "
        "their instants",
        predictor, arm::to_string(seen->sensor)));
  }
  measured::Channel read = *seen;
  for (double& value : read.values) value = (value - chain.offset) / chain.gain;
  return motion_of_hub(read, measured::sampling_period_s(record),
                       run.initial == measured::InitialState::rest);
}

/// Returns the experiment with the hub's motion as input, for a predictor of that name.
Experiment with_motions(const Experiment& experiment, std::string_view predictor) {
  Experiment made = without_controllers(experiment);
  for (auto& [run, data] : made.runs) {
    const auto refused = [&run = run, predictor](std::string_view why) {
      return arm::InputError(fmt::format("predictor {}: run {}: {}", predictor, run.id, why));
    };
    auto* record = std::get_if<measured::TimeRecord>(&data);
    if (record == nullptr) {
      throw refused(fmt::format("needs time runs; its kind is {}", measured::to_string(run.kind)));
    }
    const auto of_hub = std::ranges::count_if(record->channels, is_of_hub);
    if (of_hub == 0) throw refused("needs hub_angle or hub_velocity");
    made.motions.push_back(measured_motion(*record, run, arm_in(experiment, run), predictor));
    std::erase_if(record->channels, is_of_hub);
  }
  return made;
}

}  // namespace

Experiment driven_by_motion(const Experiment& experiment) {
  arm::require_beam(experiment.arm, "predictor driven_by_motion");
  Experiment made = with_motions(experiment, "driven_by_motion");
  for (const auto& [run, data] : made.runs) {
    if (!std::get<measured::TimeRecord>(data).channels.empty()) continue;
    throw arm::InputError(fmt::format(
        "predictor driven_by_motion: run {}: needs a sensor beside those of the hub", run.id));
  }
  return made;
}

Experiment balanced_at_hub(const Experiment& experiment) {
  Experiment made = with_motions(experiment, "torque_balance");
  made.judges_torque = true;
  return made;
}

bool acts_beside_motion(const Hypothesis& hypothesis) {
  if (!hypothesis.sensor.empty()) {
    return !arm::is_collocated(arm::parse_sensor(hypothesis.sensor));
  }
  return !arm::acts_without_beam(*hypothesis.entry->definition);
}

std::string motion_notice(const Experiment& experiment, const Observations& observations) {
  const auto noisiest = std::ranges::max_element(experiment.motions, {}, &MeasuredMotion::noise);
  const auto most =
      std::ranges::max_element(observations.channels, {}, &ObservedChannel::numerical_error);
  std::string notice = fmt::format(
      "the measured motion of the hub drives the beam: {}, with noise of up to {:.2g} {}, is "
      "smoothed; its error adds up to {:.2g} % of the signal to the noise ({} of run {})",
      arm::to_string(noisiest->sensor), noisiest->noise, arm::unit(noisiest->sensor),
      100.0 * most->numerical_error, most->sensor, experiment.runs[most->run].run.id);
  if (most->numerical_error > kUselessMotion) {
    notice +=
        "; responses average that noise: flexarm identify --input hub_angle writes them, and "
        "flexarm import reads them as a measurement";
  }
  return notice;
}

}  // namespace flexarm::diagnose
