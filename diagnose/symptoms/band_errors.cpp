#include "diagnose/symptoms/band_errors.hpp"

#include "diagnose/misfit.hpp"
#include "measured/window.hpp"
#include "response/excitation.hpp"

#include <boost/math/distributions/complement.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <variant>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;

std::span<const double> part_of(const Eigen::VectorXd& values, const ObservedChannel& channel) {
  return {values.data() + channel.first, static_cast<std::size_t>(channel.count)};
}

BandError begun(const SymptomsInput& input, const ObservedChannel& channel,
                const FrequencyBand& band) {
  const Experiment& experiment = input.problem.experiment();
  const measured::Run& run = experiment.runs[channel.run].run;
  BandError error;
  error.run = channel.run;
  error.run_id = run.id;
  error.sensor = channel.sensor;
  error.band = band;
  error.payload_kg = arm_in(experiment, run).payload.mass_kg;
  return error;
}

/// `noise_power` is the part of the channel's noise in the band, of 1; `before` and `after` are
/// what the residuals have in its place.
void put_powers(BandError& error, const ObservedChannel& channel, double before, double after,
                double noise_power) {
  error.before = channel.noise * std::sqrt(before);
  error.after = channel.noise * std::sqrt(after);
  error.noise = channel.noise * std::sqrt(noise_power);
  error.power_ratio = before / noise_power;
  error.probability = noise_probability(error.power_ratio, error.freedom);
}

void add_time(const SymptomsInput& input, const ObservedChannel& channel,
              const measured::TimeRecord& record, std::vector<BandError>& errors) {
  const double period_s = measured::sampling_period_s(record);
  const arm::Arm arm =
      arm_in(input.problem.experiment(), input.problem.experiment().runs[channel.run].run);
  const auto bands = frequency_bands(arm, 0.5 / period_s);
  const auto before = band_powers(part_of(input.before, channel), period_s, bands);
  const auto after = band_powers(part_of(input.after, channel), period_s, bands);
  const auto torque = band_powers(record.torque_N_m, period_s, bands);
  const double lines = 0.5 * static_cast<double>(channel.count);
  const double deviation = input.problem.observations().deviations(channel.first);
  for (std::size_t b = 0; b < bands.size(); ++b) {
    if (!(before[b].lines > 0.0)) continue;
    BandError error = begun(input, channel, bands[b]);
    error.torque_rms_N_m = response::rms_N_m(record.torque_N_m);
    error.band_torque_rms_N_m = std::sqrt(torque[b].mean_square);
    const double noise = before[b].lines / lines;
    error.freedom =
        2.0 * before[b].lines / measured::shared_line_variance(measured::Window::hann);
    put_powers(error, channel, before[b].mean_square, after[b].mean_square, noise);
    error.error_rms = deviation * std::sqrt(std::max(0.0, before[b].mean_square - noise));
    errors.push_back(error);
  }
}

void add_frequency(const SymptomsInput& input, const ObservedChannel& channel,
                   const measured::FrequencyChannel& response, std::vector<BandError>& errors) {
  const arm::Arm arm =
      arm_in(input.problem.experiment(), input.problem.experiment().runs[channel.run].run);
  const auto& frequency_Hz = response.frequency_Hz;
  const double top_Hz = frequency_Hz.back() * (1.0 + 1e-12);  // the last belongs to the last band
  for (const FrequencyBand& band : frequency_bands(arm, top_Hz)) {
    const auto from = std::ranges::lower_bound(frequency_Hz, band.from_Hz) - frequency_Hz.begin();
    const auto to = std::ranges::lower_bound(frequency_Hz, band.to_Hz) - frequency_Hz.begin();
    if (from == to) continue;
    const Index first = channel.first + 2 * from;  // real and imaginary parts
    const Index count = 2 * (to - from);
    const auto n = static_cast<double>(channel.count);
    BandError error = begun(input, channel, band);
    error.freedom = static_cast<double>(count);
    put_powers(error, channel, input.before.segment(first, count).squaredNorm() / n,
               input.after.segment(first, count).squaredNorm() / n, error.freedom / n);
    errors.push_back(error);
  }
}

/// "41 %"
std::string percent(double part) { return fmt::format("{:.2g} %", 100.0 * part); }

/// A sensor's error in one run, all bands together.
struct RunError {
  std::string run;
  double before = 0.0;
  double after = 0.0;
  double noise = 0.0;
};

std::vector<RunError> run_errors(const std::vector<const BandError*>& errors) {
  std::vector<RunError> runs;
  for (const BandError* error : errors) {
    auto at = std::ranges::find(runs, error->run_id, &RunError::run);
    if (at == runs.end()) at = runs.insert(at, {error->run_id});
    at->before = std::hypot(at->before, error->before);
    at->after = std::hypot(at->after, error->after);
    at->noise = std::hypot(at->noise, error->noise);
  }
  return runs;
}

std::string error_text(const std::string& sensor, const std::vector<const BandError*>& errors,
                       bool has_causes) {
  const std::vector<RunError> runs = run_errors(errors);
  const auto [least, most] = std::ranges::minmax_element(runs, {}, &RunError::before);
  double noise = 0.0;
  double after = 0.0;
  for (const RunError& run : runs) {
    noise = std::max(noise, run.noise);
    after = std::max(after, run.after);
  }
  const BandError& worst = **std::ranges::max_element(
      errors, {}, [](const BandError* error) { return error->power_ratio; });
  std::string text =
      runs.size() == 1
          ? fmt::format("{}: the simulation misses {} of the signal", sensor, percent(most->before))
          : fmt::format("{}: the simulation misses {} (run {}) to {} (run {}) of the signal", sensor,
                        percent(least->before), least->run, percent(most->before), most->run);
  text += fmt::format(
      ", noise is {}; furthest beyond noise {} ({:.3g} to {:.3g} Hz, run {}: {:.3g} times)",
      percent(noise), worst.band.name, worst.band.from_Hz, worst.band.to_Hz, worst.run_id,
      std::sqrt(worst.power_ratio));
  if (has_causes) text += fmt::format("; with the causes {} or less", percent(after));
  return text + ".";
}

}  // namespace

double noise_probability(double power_ratio, double freedom) {
  const boost::math::fisher_f power(freedom, 2.0 / (kNoiseKnown * kNoiseKnown));
  return boost::math::cdf(boost::math::complement(power, power_ratio));
}

std::vector<BandError> band_errors(const SymptomsInput& input) {
  std::vector<BandError> errors;
  for (const ObservedChannel& channel : input.problem.observations().channels) {
    const auto& data = input.problem.experiment().runs[channel.run].data;
    if (const auto* record = std::get_if<measured::TimeRecord>(&data)) {
      add_time(input, channel, *record, errors);
    } else if (const auto* responses = std::get_if<measured::FrequencyRecord>(&data)) {
      const auto own = std::ranges::find_if(responses->channels, [&](const auto& one) {
        return arm::to_string(one.sensor) == channel.sensor;
      });
      add_frequency(input, channel, *own, errors);
    }
  }
  return errors;
}

std::vector<Symptom> error_symptoms(const SymptomsInput& input,
                                    const std::vector<BandError>& errors) {
  std::vector<std::string> sensors;
  for (const BandError& error : errors) {
    if (std::ranges::find(sensors, error.sensor) == sensors.end()) sensors.push_back(error.sensor);
  }
  std::vector<Symptom> made;
  std::vector<std::string> noise_alone;
  double least_probability = 1.0;
  for (const std::string& sensor : sensors) {
    std::vector<const BandError*> own;
    double probability = 1.0;
    for (const BandError& error : errors) {
      if (error.sensor != sensor) continue;
      own.push_back(&error);
      probability = std::min(probability, error.probability);
    }
    Symptom found = symptom(SymptomKind::error, error_text(sensor, own, input.has_causes()),
                            probability, errors.size());
    found.sensor = sensor;
    if (found.is_significant) {
      made.push_back(std::move(found));
    } else {
      noise_alone.push_back(sensor);
      least_probability = std::min(least_probability, probability);
    }
  }
  if (!noise_alone.empty()) {
    made.push_back(symptom(SymptomKind::error,
                           fmt::format("{}: nothing beyond noise in any run and band.",
                                       fmt::join(noise_alone, ", ")),
                           least_probability, errors.size()));
  }
  return made;
}

}  // namespace flexarm::diagnose
