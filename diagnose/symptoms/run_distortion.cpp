#include "diagnose/symptoms/run_distortion.hpp"

#include "arm/input_error.hpp"
#include "measured/spectra/response_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

namespace flexarm::diagnose {

namespace {

using measured::ChannelDistortion;
using measured::DistortionTest;

/// The channel that shows most of one parity, "strain@0.05 −41 dB of the driven lines".
std::string largest(const RunDistortion& run, DistortionTest ChannelDistortion::*parity,
                    std::size_t tests) {
  std::string text;
  double highest_dB = -INFINITY;
  for (std::size_t c = 0; c < run.sensors.size(); ++c) {
    const DistortionTest& test = run.distortion.channels[c].*parity;
    const bool found = symptom(SymptomKind::distortion, "", test.probability, tests).is_significant;
    if (!found || !(test.level_dB > highest_dB)) continue;
    highest_dB = test.level_dB;
    text = fmt::format("{:.0f} dB relative to the excited lines in {}", test.level_dB,
                       arm::to_string(run.sensors[c]));
  }
  return text;
}

std::string distortion_text(const RunDistortion& run, std::size_t tests) {
  const std::string odd = largest(run, &ChannelDistortion::odd, tests);
  const std::string even = largest(run, &ChannelDistortion::even, tests);
  if (odd.empty() && even.empty()) {
    return fmt::format(
        "run {}: no significant distortion at the detection lines; no evidence of a nonlinearity.",
        run.run);
  }
  if (even.empty()) {
    return fmt::format(
        "run {}: odd distortion up to {}, no even distortion. Odd nonlinearity: friction, dead "
        "zone or saturation.",
        run.run, odd);
  }
  if (odd.empty()) {
    return fmt::format(
        "run {}: even distortion up to {}. The nonlinearity depends on the direction.", run.run,
        even);
  }
  return fmt::format(
      "run {}: odd distortion up to {}, even distortion up to {}. The nonlinearity depends on the "
      "direction: friction with bias, or ripple.",
      run.run, odd, even);
}

}  // namespace

std::vector<RunDistortion> run_distortions(const Experiment& experiment) {
  std::vector<RunDistortion> made;
  for (const auto& [run, data] : experiment.runs) {
    const auto* record = std::get_if<measured::TimeRecord>(&data);
    if (record == nullptr || !measured::find_period(record->torque_N_m)) continue;
    try {
      const auto estimate = measured::estimate_frequency_response(*record);
      if (!estimate.periodic) continue;
      RunDistortion one{run.id, {}, measured::distortion(*estimate.periodic)};
      for (const auto& channel : estimate.channels) one.sensors.push_back(channel.sensor);
      if (one.distortion.testable) made.push_back(std::move(one));
    } catch (const arm::InputError&) {
      continue;  // too short to be transformed: nothing to be told
    }
  }
  return made;
}

std::vector<Symptom> distortion_symptoms(const std::vector<RunDistortion>& runs) {
  std::size_t tests = 0;
  for (const RunDistortion& run : runs) tests += 2 * run.sensors.size();
  std::vector<Symptom> made;
  for (const RunDistortion& run : runs) {
    double least_probability = 1.0;
    for (const ChannelDistortion& channel : run.distortion.channels) {
      least_probability =
          std::min({least_probability, channel.odd.probability, channel.even.probability});
    }
    Symptom one =
        symptom(SymptomKind::distortion, distortion_text(run, tests), least_probability, tests);
    one.run = run.run;
    made.push_back(std::move(one));
  }
  return made;
}

}  // namespace flexarm::diagnose
