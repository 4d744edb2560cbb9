#include "measured/spectra/estimator_choice.hpp"

#include "arm/input_error.hpp"
#include "measured/spectra/segment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace flexarm::measured {

namespace {

bool varies(const Signal& signal) {
  if (signal.values.empty()) return false;
  const auto [least, most] = std::ranges::minmax(signal.values);
  return least < most;
}

RecordedSignal chosen_input(const TimeRecord& record, const EstimatorEvidence& evidence) {
  if (evidence.input) return *evidence.input;
  if (evidence.torque_fault.empty()) return RecordedSignal::torque;
  const bool has_other = std::ranges::any_of(record.channels, [](const Channel& channel) {
    return channel.sensor.kind != arm::SensorKind::hub_angle &&
           channel.sensor.kind != arm::SensorKind::hub_velocity;
  });
  const bool moves = varies(signal_of(record, RecordedSignal::hub_angle));
  return has_other && moves ? RecordedSignal::hub_angle : RecordedSignal::torque;
}

/// Best first.
std::vector<RecordedSignal> possible_instruments(const TimeRecord& record, RecordedSignal input,
                                                 bool torque_is_usable) {
  std::vector<RecordedSignal> possible = {RecordedSignal::reference};
  if (input != RecordedSignal::torque) {
    if (torque_is_usable) possible.push_back(RecordedSignal::torque);
    possible.push_back(input == RecordedSignal::hub_angle ? RecordedSignal::hub_velocity
                                                          : RecordedSignal::hub_angle);
  }
  std::erase_if(possible,
                [&](RecordedSignal signal) { return signal_of(record, signal).values.empty(); });
  return possible;
}

/// (sum p)^2/sum p^2 over the powers of a signal's segments.
double segments_with_power(const Signal& signal, const SegmentPlan& plan) {
  std::vector<double> values(plan.segment_samples);
  const auto lost = static_cast<std::size_t>(signal.differences);
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t first = lost; first + values.size() <= signal.values.size();
       first += plan.shift_samples) {
    copy_differenced(signal, first, values);
    take_off(Detrend::mean, values);
    double power = 0.0;
    for (const double value : values) power += value * value;
    sum += power;
    squares += power * power;
  }
  return squares > 0.0 ? sum * sum / squares : 0.0;
}

/// How many lines are excited, and between which.
struct ExcitedLines {
  std::size_t count = 0;
  double from_Hz = 0.0;
  double to_Hz = 0.0;
};

ExcitedLines excited_lines(const FrequencyResponseEstimate& estimate) {
  ExcitedLines found;
  for (std::size_t k = 0; k < estimate.frequency_Hz.size(); ++k) {
    if (estimate.frequency_Hz[k] == 0.0 || !is_excited(estimate, k)) continue;
    if (found.count++ == 0) found.from_Hz = estimate.frequency_Hz[k];
    found.to_Hz = estimate.frequency_Hz[k];
  }
  return found;
}

/// Why an estimate with this instrument is not to be used; empty where it is.
std::string objection(const TimeRecord& record, const FrequencyResponseEstimate& estimate) {
  const RecordedSignal instrument = *estimate.settings.estimator.instrument;
  const auto lines = excited_lines(estimate);
  if (lines.count < kLeastExcitedLines) {
    return fmt::format("the {} excites {} lines, fewer than {}", to_string(instrument), lines.count,
                       kLeastExcitedLines);
  }
  if (estimate.settings.periodic) return "";
  const auto& plan = estimate.settings.plan;
  const Signal signal = signal_of(record, instrument);
  const std::size_t segments =
      1 + (signal.values.size() - plan.segment_samples) / plan.shift_samples;
  const double with_power = segments_with_power(signal, plan);
  if (with_power >= 0.5 * static_cast<double>(segments)) return "";
  return fmt::format("the {} has its power in {:.2g} of {} segments", to_string(instrument),
                     with_power, segments);
}

/// What speaks for the input, and against the instruments that were tried.
std::string reason_for(RecordedSignal input, const EstimatorEvidence& evidence,
                       const std::vector<std::string>& objections, bool closed_loop) {
  std::string reason;
  if (input != RecordedSignal::torque) {
    reason = evidence.input ? "input given" : "torque not used: " + evidence.torque_fault;
    reason += "; poles are those with the hub held";
    if (input == RecordedSignal::hub_velocity) {
      reason += ", moved by the aliases of a velocity under torque steps: prefer hub_angle";
    }
  } else {
    reason = closed_loop ? "closed loop" : "no reference stated: open loop assumed";
  }
  for (const auto& text : objections) reason += "; " + text;
  return reason;
}

}  // namespace

FrequencyResponseEstimate estimate_by_evidence(const TimeRecord& record,
                                               const SpectrumSettings& settings,
                                               const EstimatorEvidence& evidence) {
  const RecordedSignal input = chosen_input(record, evidence);
  if (input == RecordedSignal::torque && !evidence.torque_fault.empty()) {
    throw arm::InputError(evidence.torque_fault);
  }
  const bool closed_loop = !record.reference.values.empty();
  std::vector<std::string> objections;
  SpectrumSettings own = settings;
  for (const auto instrument : possible_instruments(record, input, evidence.torque_fault.empty())) {
    if (!varies(signal_of(record, instrument))) {
      objections.push_back(fmt::format("the {} is constant", to_string(instrument)));
      continue;
    }
    own.estimator = {input, instrument, "by evidence"};
    auto made = estimate_frequency_response(record, own);
    const std::string against = objection(record, made);
    if (!against.empty()) {
      objections.push_back(against);
      continue;
    }
    const auto lines = excited_lines(made);
    const std::string reason = fmt::format(
        "{}; noise and unrecorded forces bias a ratio to the {} itself; the {} is independent of "
        "them and excites {} lines, {:.3g} to {:.3g} Hz",
        reason_for(input, evidence, objections, closed_loop), to_string(input),
        to_string(instrument), lines.count, lines.from_Hz, lines.to_Hz);
    made.settings.estimator.reason = reason;
    std::ranges::find(made.settings.reports, "estimator", &SettingReport::name)->reason = reason;
    return made;
  }
  own.estimator = {input, std::nullopt, "by evidence"};
  auto made = estimate_frequency_response(record, own);
  std::string reason = reason_for(input, evidence, objections, closed_loop);
  if (made.settings.periodic) {
    reason +=
        fmt::format("; noise of the recorded {} averages out over the periods", to_string(input));
  } else if (input != RecordedSignal::torque) {
    reason += "; biased where the noise-to-signal ratios of hub and sensor differ";
  } else if (closed_loop) {
    reason += "; biased towards -1/(controller) where noise or unrecorded forces make the torque";
  } else {
    reason += "; torque noise that does not reach the hub biases it low by 1/(1 + S_nn/S_uu)";
  }
  made.settings.estimator.reason = reason;
  std::ranges::find(made.settings.reports, "estimator", &SettingReport::name)->reason = reason;
  return made;
}

}  // namespace flexarm::measured
