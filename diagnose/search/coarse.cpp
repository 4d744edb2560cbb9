#include "diagnose/search/coarse.hpp"

#include "measured/files/decimation.hpp"

#include <algorithm>
#include <variant>

namespace flexarm::diagnose {

namespace {

void thin(measured::TimeRecord& record, std::size_t samples) {
  const std::size_t kept = std::min(record.time_s.size(), samples);
  record.time_s.resize(kept);
  record.torque_N_m.resize(kept);
  for (auto& channel : record.channels) {
    channel.values.resize(kept);
    std::erase_if(channel.left_out, [kept](std::size_t sample) { return sample >= kept; });
  }
  if (!record.reference.values.empty()) record.reference.values.resize(kept);
}

void thin(measured::FrequencyRecord& record, std::size_t /*samples*/) {
  for (auto& channel : record.channels) {
    const std::size_t step = std::max<std::size_t>(1, channel.frequency_Hz.size() / kCoarseLines);
    measured::FrequencyChannel kept{channel.sensor, {}, {}, {}};
    for (std::size_t k = 0; k < channel.frequency_Hz.size(); k += step) {
      kept.frequency_Hz.push_back(channel.frequency_Hz[k]);
      kept.response.push_back(channel.response[k]);
      kept.coherence.push_back(channel.coherence[k]);
    }
    channel = std::move(kept);
  }
}

void thin(measured::ModalTable& /*table*/, std::size_t /*samples*/) {}

Experiment estimation_part(const Experiment& experiment) {
  Experiment made;
  made.arm = experiment.arm;
  made.judges_torque = experiment.judges_torque;
  for (std::size_t r = 0; r < experiment.runs.size(); ++r) {
    if (experiment.runs[r].run.purpose != measured::Purpose::estimation) continue;
    made.runs.push_back(experiment.runs[r]);
    if (is_driven_by_motion(experiment)) made.motions.push_back(experiment.motions[r]);
  }
  return made;
}

}  // namespace

Experiment coarse(const Experiment& experiment, std::size_t samples) {
  Experiment made = estimation_part(experiment);
  for (auto& run : made.runs) {
    std::visit([&](auto& data) { thin(data, samples); }, run.data);
  }
  for (MeasuredMotion& measured : made.motions) {
    for (auto* motion : {&measured.motion, &measured.error}) {
      auto& accelerations = motion->acceleration_rad_per_s2;
      accelerations.resize(std::min(accelerations.size(), samples));
    }
  }
  return made;
}

Experiment decimated_whole(Experiment experiment, std::size_t samples) {
  for (auto& [run, data] : experiment.runs) {
    auto* record = std::get_if<measured::TimeRecord>(&data);
    if (record == nullptr) continue;
    const std::size_t factor = (record->time_s.size() + samples - 1) / samples;
    if (factor < 2 || record->time_s.size() < measured::fewest_samples(factor)) continue;
    *record = measured::decimated(*record, factor);
    run.torque_hold = measured::TorqueHold::first;
    run.initial = measured::InitialState::free;
  }
  return experiment;
}

}  // namespace flexarm::diagnose
