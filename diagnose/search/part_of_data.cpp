#include "diagnose/search/part_of_data.hpp"

#include "diagnose/search/coarse.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace flexarm::diagnose {

namespace {

/// Gives the `time` channels of a part the standard deviations of the whole.
void take_noise(const Problem& whole, const Experiment& part, Observations& observations) {
  for (ObservedChannel& channel : observations.channels) {
    const measured::Run& run = part.runs[channel.run].run;
    if (run.kind != measured::RunKind::time) continue;
    const auto own =
        std::ranges::find_if(whole.observations().channels, [&](const ObservedChannel& other) {
          return other.sensor == channel.sensor &&
                 whole.experiment().runs[other.run].run.id == run.id;
        });
    if (own == whole.observations().channels.end()) continue;
    const double deviation = whole.observations().deviations(own->first);
    auto deviations = observations.deviations.segment(channel.first, channel.count);
    channel.noise *= deviation / deviations(0);
    deviations.setConstant(deviation);
  }
}

Problem first_part_of(const Problem& whole, std::size_t samples, int most_modes) {
  auto part = std::make_shared<const Experiment>(coarse(whole.experiment(), samples));
  Observations observations = observe(*part);
  take_noise(whole, *part, observations);
  const int modes = std::min(most_modes, whole.predictor().flexible_modes());
  return {std::move(part),
          std::move(observations),
          {.flexible_modes = modes,
           .policy = whole.policy(),
           .deadline = whole.predictor().deadline()}};
}

}  // namespace

PartOfData::PartOfData(const Problem& whole, std::size_t samples, int most_modes)
    : problem_(first_part_of(whole, samples, most_modes)),
      likelihood_(problem_, problem_.estimation_runs(), whole.predictor().flexible_modes()) {}

}  // namespace flexarm::diagnose
