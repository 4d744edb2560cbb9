#include "diagnose/symptoms/band_errors.hpp"

#include "diagnose/search/misfit.hpp"
#include "measured/spectra/tail_probability.hpp"
#include "measured/spectra/window.hpp"
#include "response/excitation/excitation.hpp"

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
  error.before = channel.floor() * std::sqrt(before);
  error.after = channel.floor() * std::sqrt(after);
  error.noise = channel.floor() * std::sqrt(noise_power);
  error.power_ratio = before / noise_power;
  error.power_ratio_after = after / noise_power;
  error.probability = noise_probability(error.power_ratio, error.freedom);
}

/// Mean square that the window leaves out: of what drifts away towards the end of a run. 0 or more.
double window_misses(std::span<const double> residuals, const std::vector<BandPower>& powers) {
  double missing = 0.0;
  for (const double residual : residuals) missing += residual * residual;
  missing /= static_cast<double>(residuals.size());
  for (const BandPower& power : powers) missing -= power.mean_square;
  return std::max(0.0, missing);
}

void add_time(const SymptomsInput& input, const ObservedChannel& channel,
              const measured::TimeRecord& record, std::vector<BandError>& errors) {
  const double period_s = measured::sampling_period_s(record);
  const arm::Arm arm =
      arm_in(input.problem.experiment(), input.problem.experiment().runs[channel.run].run);
  const auto bands = frequency_bands(arm, 0.5 / period_s);
  const auto before = band_powers(part_of(input.before, channel), period_s, bands);
  const auto after = band_powers(part_of(input.after, channel), period_s, bands);
  const double grown = window_misses(part_of(input.before, channel), before);
  const double grown_after = window_misses(part_of(input.after, channel), after);
  const double lines = 0.5 * static_cast<double>(channel.count);
  for (std::size_t b = 0; b < bands.size(); ++b) {
    if (!(before[b].lines > 0.0)) continue;
    BandError error = begun(input, channel, bands[b]);
    error.torque_rms_N_m = response::rms_N_m(record.torque_N_m);
    const double noise = before[b].lines / lines;
    error.freedom = 2.0 * before[b].lines / measured::shared_line_variance(measured::Window::hann);
    put_powers(error, channel, before[b].mean_square, after[b].mean_square, noise);
    if (b == 0) {
      if (grown > noise)
        error.before = std::hypot(error.before, channel.floor() * std::sqrt(grown));
      if (grown_after > noise) {
        error.after = std::hypot(error.after, channel.floor() * std::sqrt(grown_after));
      }
    }
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

/// "37 to 503 %"
std::string range(double least, double most) {
  const std::string low = percent(least);
  const std::string high = percent(most);
  return low == high ? high : fmt::format("{} to {}", low.substr(0, low.size() - 2), high);
}

std::string error_text(const std::string& sensor, const std::vector<const BandError*>& errors,
                       bool has_causes) {
  const std::vector<RunError> runs = run_errors(errors);
  const auto [least, most] = std::ranges::minmax(runs, {}, &RunError::before);
  const double noise = std::ranges::max(runs, {}, &RunError::noise).noise;
  const double after = std::ranges::max(runs, {}, &RunError::after).after;
  const BandError& worst = **std::ranges::max_element(
      errors, {}, [](const BandError* error) { return error->power_ratio; });
  std::string text =
      fmt::format("{}: NRMSE {}, noise floor {}; largest excess {}, {:.3g} to {:.3g} Hz", sensor,
                  range(least.before, most.before), percent(noise), worst.band.name,
                  worst.band.from_Hz, worst.band.to_Hz);
  if (has_causes) text += fmt::format("; extended arm {}", percent(after));
  return text + ".";
}

/// What a run's error is beyond the noise, at most, relative to the signal.
double beyond_noise(const std::vector<const BandError*>& errors) {
  double most = 0.0;
  for (const RunError& run : run_errors(errors)) {
    most = std::max(most, run.before * run.before - run.noise * run.noise);
  }
  return std::sqrt(most);
}

}  // namespace

double noise_probability(double power_ratio, double freedom) {
  return measured::f_tail(power_ratio, freedom, 2.0 / (kNoiseKnown * kNoiseKnown));
}

std::vector<BandError> band_errors(const SymptomsInput& input) {
  std::vector<BandError> errors;
  for (const ObservedChannel& channel : input.problem.observations().channels) {
    const auto& data = input.problem.experiment().runs[channel.run].data;
    if (const auto* record = std::get_if<measured::TimeRecord>(&data)) {
      add_time(input, channel, *record, errors);
    } else if (const auto* responses = std::get_if<measured::FrequencyRecord>(&data)) {
      add_frequency(input, channel, response_of(*responses, channel), errors);
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
  std::vector<std::string> negligible;
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
    const bool is_simulated = own.front()->torque_rms_N_m.has_value();
    if (found.is_significant && is_simulated && !input.has_causes() &&
        beyond_noise(own) < kNegligibleError) {
      negligible.push_back(sensor);
    } else if (found.is_significant) {
      made.push_back(std::move(found));
    } else {
      noise_alone.push_back(sensor);
    }
  }
  const auto add_rest = [&](const std::vector<std::string>& rest, const std::string& text) {
    if (rest.empty()) return;
    made.push_back(symptom(SymptomKind::error, fmt::format("{}: {}", fmt::join(rest, ", "), text),
                           1.0, errors.size()));
  };
  add_rest(noise_alone, "residual level consistent with the noise floor in all runs and bands.");
  add_rest(negligible, fmt::format("excess residual below {} of the signal; not interpreted, since "
                                   "integration step and sampling clock cause errors of this size.",
                                   percent(kNegligibleError)));
  return made;
}

}  // namespace flexarm::diagnose
