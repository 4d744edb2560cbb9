#include "diagnose/predictors/response_runs.hpp"

#include "arm/input_error.hpp"
#include "measured/spectra/response_estimate.hpp"

#include <algorithm>
#include <utility>
#include <variant>

namespace flexarm::diagnose {

namespace {

using measured::Purpose;

bool is_rich(const measured::FrequencyResponseEstimate& estimate,
             const measured::ChannelEstimate& channel) {
  int lines = 0;
  double lowest_Hz = 0.0;
  double highest_Hz = 0.0;
  for (std::size_t k = 0; k < channel.relative_std.size(); ++k) {
    // A line without a value is none.
    const double frequency_Hz = estimate.frequency_Hz[k];
    if (!(channel.relative_std[k] <= kLargestLineError) || frequency_Hz == 0.0) continue;
    if (lines == 0) lowest_Hz = frequency_Hz;
    highest_Hz = frequency_Hz;
    ++lines;
  }
  return lines >= kLeastLines && highest_Hz >= kLeastSpan * lowest_Hz;
}

/// Empty where no channel of the run is rich.
std::optional<measured::MeasuredRun> as_response(const measured::Run& run,
                                                 const measured::TimeRecord& record) {
  measured::FrequencyResponseEstimate estimate;
  try {
    estimate = measured::estimate_frequency_response(record, {.hold = run.torque_hold});
  } catch (const arm::InputError&) {
    return std::nullopt;  // too short, or a constant torque
  }
  std::erase_if(estimate.channels,
                [&](const auto& channel) { return !is_rich(estimate, channel); });
  if (estimate.channels.empty()) return std::nullopt;
  return measured::MeasuredRun{{.id = run.id,
                                .kind = measured::RunKind::frf,
                                .file = run.file,
                                .purpose = run.purpose,
                                .torque_hold = run.torque_hold,
                                .payload = run.payload},
                               measured::to_frequency_record(estimate)};
}

}  // namespace

std::optional<Experiment> as_responses(const Experiment& experiment) {
  Experiment made = experiment;
  made.runs.clear();
  for (const measured::MeasuredRun& run : experiment.runs) {
    const auto* record = std::get_if<measured::TimeRecord>(&run.data);
    if (record == nullptr) {
      made.runs.push_back(run);
    } else if (auto response = as_response(run.run, *record)) {
      made.runs.push_back(*std::move(response));
    }
  }
  if (!has_runs(made, Purpose::estimation, measured::RunKind::frf)) return std::nullopt;
  const bool loses_validation =
      has_runs(experiment, Purpose::validation, measured::RunKind::time) &&
      !has_runs(made, Purpose::validation, measured::RunKind::frf);
  if (loses_validation) return std::nullopt;
  return made;
}

}  // namespace flexarm::diagnose
