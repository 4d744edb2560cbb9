#include "diagnose/search/coarse.hpp"

#include <algorithm>
#include <variant>

namespace flexarm::diagnose {

namespace {

void thin(measured::TimeRecord& record, std::size_t samples) {
  const std::size_t kept = std::min(record.time_s.size(), samples);
  record.time_s.resize(kept);
  record.torque_N_m.resize(kept);
  for (auto& channel : record.channels) channel.values.resize(kept);
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

}  // namespace

Experiment coarse(const Experiment& experiment, std::size_t samples) {
  Experiment made;
  made.arm = experiment.arm;
  for (const auto& run : experiment.runs) {
    if (run.run.purpose != measured::Purpose::estimation) continue;
    made.runs.push_back(run);
    std::visit([&](auto& data) { thin(data, samples); }, made.runs.back().data);
  }
  return made;
}

}  // namespace flexarm::diagnose
