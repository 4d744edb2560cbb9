#include "measured/spectra/spectrum_settings.hpp"

#include "arm/input_error.hpp"
#include "measured/modal/peaks.hpp"
#include "measured/spectra/fourier.hpp"
#include "measured/spectra/frequency_response.hpp"
#include "measured/spectra/periodic_spectra.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace flexarm::measured {

namespace {

constexpr std::size_t kFewestSamples = 128;
constexpr std::size_t kShortestSegment = 64;
constexpr double kFewestAverages = 10.0;
constexpr double kPilotAverages = 6.0;
constexpr std::size_t kPilotSamples = std::size_t{1} << 20;
/// Lines within the half-power width of the sharpest resonance.
constexpr double kLinesAcrossPeak = 6.0;

std::size_t shift_of(std::size_t segment, double overlap) {
  const double shift = static_cast<double>(segment) * (1.0 - overlap);
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::llround(shift)));
}

/// The longest fast length whose segments give so many effective averages of `samples`.
std::size_t longest_segment(std::size_t samples, Window window, double overlap, double averages) {
  constexpr std::size_t kShape = 240;
  const auto values = window_values(window, kShape);
  std::size_t least = kShortestSegment;
  std::size_t most = samples;
  const auto enough = [&](std::size_t segment) {
    const std::size_t count = 1 + (samples - segment) / shift_of(segment, overlap);
    return effective_averages(values, count, shift_of(kShape, overlap)) >= averages;
  };
  while (most - least > 1) {
    const std::size_t middle = least + (most - least) / 2;
    (enough(middle) ? least : most) = middle;
  }
  std::size_t fast = least;
  while (fast > kShortestSegment && fast_length(fast) != fast) --fast;
  return fast;
}

/// The sharpest peak of all channels.
struct Sharpest {
  double frequency_Hz = 0.0;
  double width_Hz = 0.0;    ///< between half-power points
  double spacing_Hz = 0.0;  ///< of the lines it was seen with
};

/// Half-power width at a line: out to half the peak's power on both sides, between lines by the
/// straight line.
double half_power_width_Hz(const std::vector<double>& frequency_Hz,
                           const std::vector<double>& power, std::size_t peak) {
  const double half = 0.5 * power[peak];
  const auto edge = [&](int step) {
    std::size_t k = peak;
    for (;;) {
      if (k == 0 || k + 1 == power.size()) return frequency_Hz[k];
      const std::size_t next = step > 0 ? k + 1 : k - 1;
      if (power[next] <= half) {
        const double part = (power[k] - half) / (power[k] - power[next]);
        return frequency_Hz[k] + part * (frequency_Hz[next] - frequency_Hz[k]);
      }
      k = next;
    }
  };
  return edge(1) - edge(-1);
}

std::optional<Sharpest> sharpest_resonance(const TimeRecord& record, const ChosenSettings& chosen) {
  const Window window = chosen.plan.window;
  const std::size_t samples = std::min(record.torque_N_m.size() - 2, kPilotSamples);
  const double overlap = sufficient_overlap(window);
  SegmentPlan plan;
  plan.segment_samples = longest_segment(samples, window, overlap, kPilotAverages);
  plan.shift_samples = shift_of(plan.segment_samples, overlap);
  plan.window = window;
  plan.detrend = chosen.plan.detrend;
  const std::size_t first = record.torque_N_m.size() - samples - 2;
  auto outputs = output_signals(record, chosen);
  for (auto& output : outputs) output.values = output.values.subspan(first);
  Signal input = signal_of(record, chosen.estimator.input);
  input.values = input.values.subspan(first);
  const auto spectra = cross_spectra(input, outputs, sampling_period_s(record), plan);
  std::optional<Sharpest> sharpest;
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const auto found = estimate(spectra, i);
    std::vector<double> power(found.h1.size());
    std::vector<double> deviation(found.h1.size());
    for (std::size_t k = 0; k < power.size(); ++k) {
      power[k] = std::norm(found.h1[k]);
      deviation[k] = 2.0 * relative_response_std(found.coherence[k], spectra.effective_averages);
      // Without coherence there is nothing to see.
      constexpr double kUnseen = 0.5;
      if (!(deviation[k] < kUnseen)) power[k] = 0.0;
    }
    constexpr double kLeastProminence_dB = 6.0;
    for (const auto& peak : peaks_and_valleys(spectra.frequency_Hz, power, deviation,
                                              {.place = PeakPlace::on_line,
                                              .noise = PowerNoise::additive,
                                              .least_prominence_dB = kLeastProminence_dB})) {
      if (peak.feature != Feature::pole) continue;
      const auto line = static_cast<std::size_t>(std::llround(peak.line_Hz / spectra.spacing_Hz));
      const double width_Hz = half_power_width_Hz(spectra.frequency_Hz, power, line);
      if (sharpest && width_Hz >= sharpest->width_Hz) continue;
      sharpest = {peak.line_Hz, width_Hz, spectra.spacing_Hz};
    }
  }
  return sharpest;
}

std::string in_samples(std::size_t samples, double period_s) {
  return fmt::format("{} samples, {:.6g} s", samples, static_cast<double>(samples) * period_s);
}

/// What the window adds to the width of a peak, in lines: that of Hann's main lobe at half power.
constexpr double kWindowWidth_lines = 1.44;

void choose_segment(const TimeRecord& record, const SpectrumSettings& settings,
                    ChosenSettings& chosen, double overlap) {
  const double period_s = sampling_period_s(record);
  const std::size_t samples = record.torque_N_m.size() - 2;
  SegmentPlan& plan = chosen.plan;
  if (settings.resolution_Hz) {
    const double wanted = 1.0 / (*settings.resolution_Hz * period_s);
    if (!(wanted >= 4.0 && wanted <= static_cast<double>(samples))) {
      throw arm::out_of_range(
          "resolution", *settings.resolution_Hz, "Hz",
          fmt::format("from {:.4g} to {:.4g} Hz: at least one segment of 4 samples in the record",
                      1.0 / (static_cast<double>(samples) * period_s), 0.25 / period_s));
    }
    plan.segment_samples = static_cast<std::size_t>(std::llround(wanted));
  }
  if (settings.segment_samples) plan.segment_samples = *settings.segment_samples;
  if (settings.segment_samples || settings.resolution_Hz) {
    chosen.reports.push_back({"segment", in_samples(plan.segment_samples, period_s), "given"});
    return;
  }
  const std::size_t most = longest_segment(samples, plan.window, overlap, kFewestAverages);
  const auto sharpest = sharpest_resonance(record, chosen);
  std::string reason;
  if (!sharpest) {
    plan.segment_samples = most;
    reason = "no resonance detected: longest segment with 10 effective averages";
  } else {
    const double seen = sharpest->width_Hz;
    const double blur = kWindowWidth_lines * sharpest->spacing_Hz;
    const bool resolved = seen > 1.5 * blur;
    const double width_Hz = std::sqrt(std::max(seen * seen - blur * blur, 0.0));
    const auto wanted =
        resolved ? fast_length(static_cast<std::size_t>(kLinesAcrossPeak / (width_Hz * period_s)))
                 : most;
    plan.segment_samples = std::clamp(wanted, kShortestSegment, most);
    if (!resolved) {
      reason = fmt::format(
          "resonance at {:.5g} Hz narrower than the line spacing {:.3g} Hz: longest segment with "
          "10 effective averages; peak biased low and wide",
          sharpest->frequency_Hz, sharpest->spacing_Hz);
    } else if (wanted <= most) {
      reason = fmt::format(
          "{:.0f} lines in the half-power bandwidth of the narrowest resonance ({:.3g} Hz at "
          "{:.5g} Hz): peak power bias -2 %",
          kLinesAcrossPeak, width_Hz, sharpest->frequency_Hz);
    } else {
      reason = fmt::format(
          "longest segment with 10 effective averages; the narrowest resonance ({:.3g} Hz at "
          "{:.5g} Hz) would need {:.4g} s, so its peak is biased low",
          width_Hz, sharpest->frequency_Hz, static_cast<double>(wanted) * period_s);
    }
  }
  chosen.reports.push_back({"segment", in_samples(plan.segment_samples, period_s), reason});
}

void choose_segments(const TimeRecord& record, const SpectrumSettings& settings,
                     ChosenSettings& chosen) {
  SegmentPlan& plan = chosen.plan;
  plan.window = settings.window.value_or(Window::hann);
  chosen.reports.push_back(
      {"window", std::string(to_string(plan.window)),
       settings.window ? "given" : "low leakage for its main-lobe width; used in the paper"});
  plan.detrend = settings.detrend.value_or(Detrend::mean);
  chosen.reports.push_back(
      {"detrend", std::string(to_string(plan.detrend)),
       settings.detrend ? "given" : "mean of each segment removed: an offset is not a response"});
  const double overlap = settings.overlap.value_or(sufficient_overlap(plan.window));
  if (!(overlap >= 0.0 && overlap < 1.0)) {
    throw arm::out_of_range("overlap", overlap, "", "0 or more and below 1");
  }
  choose_segment(record, settings, chosen, overlap);
  plan.shift_samples = shift_of(plan.segment_samples, overlap);
  chosen.reports.push_back(
      {"overlap", fmt::format("{:.4g} %", 100.0 * overlap),
       settings.overlap ? "given" : "more overlap adds less than 3 % effective averages"});
}

/// How the responses are estimated.
std::string words_of(const ChosenSettings& chosen) {
  const Estimator& estimator = chosen.estimator;
  const std::string from = fmt::format("{} to sensors, ", to_string(estimator.input));
  if (estimator.instrument) {
    return fmt::format("{}{} as instrument", from, to_string(*estimator.instrument));
  }
  if (chosen.periodic) return from + "ratio of period means";
  return from + (estimator.hub_held() ? "Hv" : "H1");
}

bool choose_period(const TimeRecord& record, const SpectrumSettings& settings,
                   ChosenSettings& chosen) {
  if (settings.periodic == false) {
    chosen.reports.push_back({"periodic", "no", "given"});
    return false;
  }
  const double period_s = sampling_period_s(record);
  const auto excitation = signal_of(record, chosen.estimator.excitation()).values;
  const auto name = to_string(chosen.estimator.excitation());
  if (settings.period_samples) {
    chosen.period = periods_of(excitation, *settings.period_samples);
    if (chosen.period.periods == 0) {
      throw arm::InputError(fmt::format("period = {} samples: must be from 4 to the record's, {}",
                                        *settings.period_samples, record.torque_N_m.size()));
    }
  } else if (const auto found = find_period(excitation)) {
    chosen.period = *found;
  } else if (settings.periodic == true) {
    throw arm::InputError(fmt::format(
        "periodic: {} not periodic in this record; give its period, or treat it as random", name));
  } else {
    chosen.reports.push_back({"periodic", "no", fmt::format("{} not periodic", name)});
    return false;
  }
  chosen.reports.push_back(
      {"periodic",
       fmt::format("{} periods of {}", chosen.period.periods,
                   in_samples(chosen.period.samples, period_s)),
       settings.period_samples
           ? "period given"
           : fmt::format("periodic {} (deviation {:.1e} of its power): no window, no leakage", name,
                         chosen.period.mismatch)});
  const auto outputs = output_signals(record, chosen);
  chosen.left_out_periods =
      settings.leave_out_periods
          ? *settings.leave_out_periods
          : unsettled_periods(outputs, chosen.period.samples, chosen.period.periods);
  if (chosen.left_out_periods >= chosen.period.periods) {
    throw arm::InputError(fmt::format("discard {} periods: the record has {}",
                                      chosen.left_out_periods, chosen.period.periods));
  }
  chosen.reports.push_back({"periods discarded", fmt::format("{}", chosen.left_out_periods),
                            settings.leave_out_periods ? "given"
                            : chosen.left_out_periods == 0
                                ? "no transient: first periods vary no more than later ones"
                                : "transient: deviation from the next period more than four times "
                                  "that of later periods"});
  return true;
}

}  // namespace

std::vector<Signal> output_signals(const TimeRecord& record, const ChosenSettings& chosen) {
  std::vector<Signal> signals;
  for (std::size_t i = 0; i < chosen.outputs.size(); ++i) {
    signals.push_back({record.channels[chosen.outputs[i]].values, chosen.differences[i]});
  }
  return signals;
}

ChosenSettings choose_settings(const TimeRecord& record, const SpectrumSettings& settings) {
  if (record.torque_N_m.size() < kFewestSamples) {
    throw arm::InputError(fmt::format("{} samples: a spectrum needs at least {}",
                                      record.torque_N_m.size(), kFewestSamples));
  }
  ChosenSettings chosen;
  chosen.estimator = settings.estimator;
  const bool hub_held = chosen.estimator.hub_held();
  const auto input = signal_of(record, chosen.estimator.input).values;
  const auto name = to_string(chosen.estimator.input);
  if (input.empty()) {
    throw arm::InputError(fmt::format("{}: not recorded; it is to be the input", name));
  }
  const auto [least, most] = std::ranges::minmax(input);
  if (least == most) {
    throw arm::InputError(fmt::format(
        "{} = {} {} at all samples: a frequency response needs a varying {}", name, least,
        hub_held ? arm::unit(arm::parse_sensor(std::string(name))) : "N m", name));
  }
  chosen.hold = settings.hold;
  chosen.hold_corrected = settings.correct_hold && !hub_held;
  bool any = false;
  for (std::size_t i = 0; i < record.channels.size(); ++i) {
    const auto& channel = record.channels[i];
    if (hub_held && (channel.sensor.kind == arm::SensorKind::hub_angle ||
                     channel.sensor.kind == arm::SensorKind::hub_velocity)) {
      continue;
    }
    chosen.outputs.push_back(i);
    const int needed =
        settings.difference.value_or(true) ? differences_until_steady(channel.sensor) : 0;
    chosen.differences.push_back(needed);
    any = any || needed > 0;
  }
  if (chosen.outputs.empty()) {
    throw arm::InputError(
        fmt::format("no sensor beside the hub's: responses to {} need one", name));
  }
  chosen.reports.push_back(
      {"differences", any ? "of angle and displacement twice, of velocity once" : "none",
       settings.difference ? "given"
       : any ? "drift of the free arm; spectra divided by the response of the difference filter"
             : "no drifting channel"});
  chosen.periodic = choose_period(record, settings, chosen);
  if (!chosen.periodic) choose_segments(record, settings, chosen);
  if (!chosen.estimator.reason.empty()) {
    chosen.reports.push_back({"estimator", words_of(chosen), chosen.estimator.reason});
  }
  if (hub_held) return chosen;
  chosen.reports.push_back({"hold", std::string(to_string(settings.hold)),
                            settings.correct_hold
                                ? "hold response removed; aliases are not"
                                : "hold response not removed: sampled-data response"});
  return chosen;
}

}  // namespace flexarm::measured
