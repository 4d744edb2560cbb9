#include "response/excitation/excitation.hpp"

#include "arm/input_error.hpp"
#include "arm/range.hpp"
#include "response/excitation/line_spectrum.hpp"
#include "response/time/random_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>

namespace flexarm::response {

namespace {

using arm::InputError;

constexpr double kTwoPi = 2.0 * std::numbers::pi;

/// A time in samples, to the nearest.
std::size_t nearest_sample(double time_s, const SampleGrid& grid) {
  return static_cast<std::size_t>(std::llround(time_s / grid.period_s));
}

void require_time(const char* key, double time_s, const SampleGrid& grid) {
  arm::require_in_range(key, time_s, "s", arm::kNotNegative);
  if (time_s >= grid.duration_s()) {
    throw arm::out_of_range(key, time_s, "s",
                            fmt::format("less than the duration, {:.6g} s", grid.duration_s()));
  }
}

/// 0 or above <= from < to <= half the sampling frequency.
void require_band(const std::string& kind, double from_Hz, double to_Hz, const arm::Range& from,
                  const SampleGrid& grid) {
  arm::require_in_range(kind + ".from", from_Hz, "Hz", from);
  if (!(to_Hz > from_Hz && to_Hz <= grid.nyquist_Hz())) {
    throw arm::out_of_range(
        kind + ".to", to_Hz, "Hz",
        fmt::format("above {:.6g} Hz and at most the Nyquist frequency, {:.6g} Hz", from_Hz,
                    grid.nyquist_Hz()));
  }
}

/// Numbers of the lines k/(samples period) in a band, 1 to those below half the sampling frequency.
struct Lines {
  std::size_t first = 1;
  std::size_t last = 0;
};

Lines lines_between(double from_Hz, double to_Hz, const SampleGrid& period) {
  // A band edge that is a line to rounding holds the line.
  constexpr double kRounding = 1e-9;
  const double spacing_Hz = 1.0 / period.duration_s();
  Lines lines;
  lines.first =
      static_cast<std::size_t>(std::max(1.0, std::ceil(from_Hz / spacing_Hz * (1.0 - kRounding))));
  lines.last = std::min(static_cast<std::size_t>(to_Hz / spacing_Hz * (1.0 + kRounding)),
                        (period.samples - 1) / 2);
  return lines;
}

InputError no_line(const std::string& kind, double from_Hz, double to_Hz, double spacing_Hz) {
  return InputError(
      fmt::format("{}: no spectral line between {:.6g} Hz and {:.6g} Hz (line spacing {:.6g} Hz); "
                  "widen the band or increase the duration",
                  kind, from_Hz, to_Hz, spacing_Hz));
}

void scale_to_rms(std::vector<double>& torque_N_m, double wanted_N_m) {
  const double factor = wanted_N_m / rms_N_m(torque_N_m);
  for (auto& value : torque_N_m) value *= factor;
}

SampledTorque sampled(const BangBang& signal, const SampleGrid& grid) {
  arm::require_in_range("bang-bang.amplitude", signal.amplitude_N_m, "N m", arm::kAnyFinite);
  require_time("bang-bang.start", signal.start_s, grid);
  require_time("bang-bang.pulse", signal.pulse_s, grid);
  if (signal.pairs < 0) {
    throw arm::out_of_range("bang-bang.pairs", signal.pairs, "",
                            "0 (to the end of the run), or 1 or more");
  }
  const std::size_t start = nearest_sample(signal.start_s, grid);
  const std::size_t pulse = nearest_sample(signal.pulse_s, grid);
  if (pulse == 0) {
    throw arm::out_of_range("bang-bang.pulse", signal.pulse_s, "s",
                            fmt::format("a sampling period, {:.6g} s, or more", grid.period_s));
  }
  const std::size_t fit = (grid.samples - std::min(start, grid.samples)) / (2 * pulse);
  const auto pairs = signal.pairs == 0 ? fit : static_cast<std::size_t>(signal.pairs);
  if (pairs > fit || fit == 0) {
    throw InputError(fmt::format(
        "bang-bang: {} from {:.6g} s on, {:.6g} s each, must end within the duration, {:.6g} s",
        pairs > 1 ? fmt::format("{} pairs of pulses", pairs) : std::string("a pair of pulses"),
        signal.start_s, signal.pulse_s, grid.duration_s()));
  }
  SampledTorque result{std::vector<double>(grid.samples, 0.0), {}, {}};
  for (std::size_t k = 0; k < 2 * pulse * pairs; ++k) {
    result.torque_N_m[start + k] =
        k / pulse % 2 == 0 ? signal.amplitude_N_m : -signal.amplitude_N_m;
  }
  return result;
}

SampledTorque sampled(const Step& signal, const SampleGrid& grid) {
  arm::require_in_range("step.amplitude", signal.amplitude_N_m, "N m", arm::kAnyFinite);
  require_time("step.start", signal.start_s, grid);
  SampledTorque result{std::vector<double>(grid.samples, signal.amplitude_N_m), {}, {}};
  const std::size_t start = std::min(nearest_sample(signal.start_s, grid), grid.samples);
  std::fill_n(result.torque_N_m.begin(), start, 0.0);
  return result;
}

SampledTorque sampled(const RandomNoise& signal, const SampleGrid& grid) {
  arm::require_in_range("random.rms", signal.rms_N_m, "N m", arm::kNotNegative);
  require_band("random", signal.from_Hz, signal.to_Hz, arm::kNotNegative, grid);
  const SampleGrid period{next_smooth_number(grid.samples), grid.period_s};
  const Lines lines = lines_between(signal.from_Hz, signal.to_Hz, period);
  if (lines.first > lines.last) {
    throw no_line("random", signal.from_Hz, signal.to_Hz, 1.0 / period.duration_s());
  }
  RandomNumbers random(signal.seed);
  std::vector<std::complex<double>> amplitudes(lines.last + 1);
  for (std::size_t k = lines.first; k <= lines.last; ++k) {
    const double real = random.normal();
    amplitudes[k] = {real, random.normal()};
  }
  SampledTorque result{sum_of_lines(std::move(amplitudes), period.samples), {}, {}};
  result.torque_N_m.resize(grid.samples);
  scale_to_rms(result.torque_N_m, signal.rms_N_m);
  return result;
}

/// The period's samples; throws where it is too long, too short, or cannot be transformed.
std::size_t period_of(const Multisine& signal, const SampleGrid& grid) {
  if (signal.period_s == 0.0) return grid.samples;
  arm::require_in_range("multisine.period", signal.period_s, "s", arm::kPositive);
  if (signal.period_s > grid.duration_s() * (1.0 + 1e-9)) {
    throw arm::out_of_range("multisine.period", signal.period_s, "s",
                            fmt::format("at most the duration, {:.6g} s", grid.duration_s()));
  }
  const std::size_t samples = nearest_sample(signal.period_s, grid);
  if (samples < 2) {
    throw arm::out_of_range(
        "multisine.period", signal.period_s, "s",
        fmt::format("two sampling periods, {:.6g} s, or more", 2.0 * grid.period_s));
  }
  return samples;
}

SampledTorque sampled(const Multisine& signal, const SampleGrid& grid) {
  arm::require_in_range("multisine.rms", signal.rms_N_m, "N m", arm::kNotNegative);
  require_band("multisine", signal.from_Hz, signal.to_Hz, arm::kNotNegative, grid);
  if (signal.detection_group < 0 || signal.detection_group == 1) {
    throw arm::out_of_range("multisine.detection", signal.detection_group, "",
                            "0, or at least 2: one of so many odd lines is a detection line");
  }
  const SampleGrid period{period_of(signal, grid), grid.period_s};
  if (period.samples > kMostSamplesOfALargeFactor &&
      largest_prime_factor(period.samples) > kLargestFactorOfATransform) {
    throw InputError(
        fmt::format("multisine: a period of {} samples has a prime factor too large for the FFT; "
                    "use {} samples, {:.9g} s",
                    period.samples, next_smooth_number(period.samples),
                    static_cast<double>(next_smooth_number(period.samples)) * grid.period_s));
  }
  Lines lines = lines_between(signal.from_Hz, signal.to_Hz, period);
  if (lines.first % 2 == 0) ++lines.first;

  RandomNumbers random(signal.seed);
  SampledTorque result;
  std::vector<std::complex<double>> amplitudes(lines.last + 1);
  const auto group = static_cast<std::size_t>(signal.detection_group);
  std::size_t left_out = 0;
  for (std::size_t k = lines.first, i = 0; k <= lines.last; k += 2, ++i) {
    const double frequency_Hz = static_cast<double>(k) / period.duration_s();
    const double phase = kTwoPi * random.uniform();
    if (group != 0 && i % group == 0) left_out = random.below(group);
    if (group != 0 && i % group == left_out) {
      result.detection_Hz.push_back(frequency_Hz);
      continue;
    }
    amplitudes[k] = std::polar(1.0, phase);
    result.lines_Hz.push_back(frequency_Hz);
  }
  if (result.lines_Hz.empty()) {
    throw no_line("multisine", signal.from_Hz, signal.to_Hz, 2.0 / period.duration_s());
  }
  const double amplitude_N_m =
      signal.rms_N_m * std::sqrt(2.0 / static_cast<double>(result.lines_Hz.size()));
  const auto one_period = sum_of_lines(std::move(amplitudes), period.samples);
  result.torque_N_m.resize(grid.samples);
  for (std::size_t k = 0; k < grid.samples; ++k) {
    result.torque_N_m[k] = amplitude_N_m * one_period[k % period.samples];
  }
  return result;
}

SampledTorque sampled(const Chirp& signal, const SampleGrid& grid) {
  const bool is_linear = signal.sweep == Sweep::linear;
  arm::require_in_range("chirp.amplitude", signal.amplitude_N_m, "N m", arm::kAnyFinite);
  require_band("chirp", signal.from_Hz, signal.to_Hz,
               is_linear ? arm::kNotNegative : arm::kPositive, grid);
  const double duration_s = grid.duration_s();
  const double log_ratio = is_linear ? 0.0 : std::log(signal.to_Hz / signal.from_Hz);
  SampledTorque result{std::vector<double>(grid.samples), {}, {}};
  for (std::size_t k = 0; k < grid.samples; ++k) {
    const double t_s = static_cast<double>(k) * grid.period_s;
    const double cycles =
        is_linear
            ? t_s * (signal.from_Hz + (signal.to_Hz - signal.from_Hz) * t_s / duration_s / 2)
            : signal.from_Hz * duration_s / log_ratio * std::expm1(log_ratio * t_s / duration_s);
    result.torque_N_m[k] = signal.amplitude_N_m * std::sin(kTwoPi * (cycles - std::floor(cycles)));
  }
  return result;
}

SampledTorque sampled(const Staircase& signal, const SampleGrid& grid) {
  arm::require_in_range("staircase.amplitude", signal.amplitude_N_m, "N m", arm::kAnyFinite);
  arm::require_in_range("staircase.dwell", signal.dwell_s, "s", arm::kPositive);
  require_time("staircase.start", signal.start_s, grid);
  if (signal.levels < 1) {
    throw arm::out_of_range("staircase.levels", signal.levels, "", "1 or more");
  }
  const std::size_t start = nearest_sample(signal.start_s, grid);
  const std::size_t dwell = nearest_sample(signal.dwell_s, grid);
  if (dwell == 0) {
    throw arm::out_of_range("staircase.dwell", signal.dwell_s, "s",
                            fmt::format("a sampling period, {:.6g} s, or more", grid.period_s));
  }
  const auto levels = static_cast<std::size_t>(signal.levels);
  SampledTorque result{std::vector<double>(grid.samples), {}, {}};
  for (std::size_t k = start; k < grid.samples; ++k) {
    const std::size_t step = ((k - start) / dwell + 1) % (2 * levels);
    result.torque_N_m[k] =
        signal.amplitude_N_m * static_cast<double>(std::min(step, 2 * levels - step));
  }
  return result;
}

/// Taps of shift registers of 2 to kMostRegisterLength stages whose sequence has the greatest
/// period: bit k stands for stage k + 1.
constexpr std::array<std::uint32_t, kMostRegisterLength - 1> kTaps = {
    0x3,     0x6,     0xC,     0x14,     0x30,     0x60,     0xB8,    0x110,
    0x240,   0x500,   0x829,   0x100D,   0x2015,   0x6000,   0xD008,  0x12000,
    0x20400, 0x40023, 0x90000, 0x140000, 0x300000, 0x420000, 0xE10000};

SampledTorque sampled(const Prbs& signal, const SampleGrid& grid) {
  arm::require_in_range("prbs.amplitude", signal.amplitude_N_m, "N m", arm::kAnyFinite);
  arm::require_in_range("prbs.clock", signal.clock_s, "s", arm::kPositive);
  if (signal.register_length < 2 || signal.register_length > kMostRegisterLength) {
    throw arm::out_of_range("prbs.register", signal.register_length, "",
                            fmt::format("from 2 to {}", kMostRegisterLength));
  }
  require_time("prbs.clock", signal.clock_s, grid);
  const std::size_t clock = nearest_sample(signal.clock_s, grid);
  if (clock == 0) {
    throw arm::out_of_range("prbs.clock", signal.clock_s, "s",
                            fmt::format("a sampling period, {:.6g} s, or more", grid.period_s));
  }
  const auto length = static_cast<unsigned>(signal.register_length);
  const std::uint32_t taps = kTaps[length - 2];
  const std::uint32_t all = (1U << length) - 1U;
  auto stages = static_cast<std::uint32_t>(1 + RandomNumbers(signal.seed).below(all));
  SampledTorque result{std::vector<double>(grid.samples), {}, {}};
  for (std::size_t k = 0; k < grid.samples; ++k) {
    if (k > 0 && k % clock == 0) {
      const bool fed_back = std::popcount(stages & taps) % 2 == 1;
      stages = ((stages << 1U) | (fed_back ? 1U : 0U)) & all;
    }
    result.torque_N_m[k] =
        (stages >> (length - 1U)) != 0U ? signal.amplitude_N_m : -signal.amplitude_N_m;
  }
  return result;
}

SampledTorque sampled(const Sine& signal, const SampleGrid& grid) {
  arm::require_in_range("sine.amplitude", signal.amplitude_N_m, "N m", arm::kAnyFinite);
  arm::require_in_range("sine.offset", signal.offset_N_m, "N m", arm::kAnyFinite);
  arm::require_in_range("sine.phase", signal.phase_rad, "rad", arm::kAnyFinite);
  if (!(signal.frequency_Hz > 0.0 && signal.frequency_Hz <= grid.nyquist_Hz())) {
    throw arm::out_of_range(
        "sine.frequency", signal.frequency_Hz, "Hz",
        fmt::format("above 0 and at most the Nyquist frequency, {:.6g} Hz", grid.nyquist_Hz()));
  }
  require_time("sine.start", signal.start_s, grid);
  SampledTorque result{std::vector<double>(grid.samples), {}, {}};
  const std::size_t start = nearest_sample(signal.start_s, grid);
  for (std::size_t k = start; k < grid.samples; ++k) {
    const double cycles = signal.frequency_Hz * static_cast<double>(k - start) * grid.period_s;
    result.torque_N_m[k] =
        signal.offset_N_m +
        signal.amplitude_N_m * std::sin(kTwoPi * (cycles - std::floor(cycles)) + signal.phase_rad);
  }
  return result;
}

/// `time_s` moved to the nearest sample.
void round_to_samples(double& time_s, const SampleGrid& grid) {
  constexpr double kRounding_periods = 1e-6;
  const double rounded_s = grid.time_s(nearest_sample(time_s, grid));
  if (std::abs(rounded_s - time_s) > kRounding_periods * grid.period_s) time_s = rounded_s;
}

struct NameOf {
  std::string_view operator()(const BangBang&) const { return "bang-bang"; }
  std::string_view operator()(const Step&) const { return "step"; }
  std::string_view operator()(const RandomNoise&) const { return "random"; }
  std::string_view operator()(const Multisine&) const { return "multisine"; }
  std::string_view operator()(const Chirp&) const { return "chirp"; }
  std::string_view operator()(const Staircase&) const { return "staircase"; }
  std::string_view operator()(const Prbs&) const { return "prbs"; }
  std::string_view operator()(const Sine&) const { return "sine"; }
};

}  // namespace

std::string_view name(const Excitation& excitation) {
  return std::visit(NameOf{}, excitation);
}

double SampleGrid::time_s(std::size_t k) const {
  constexpr double kRounding = 1e-12;
  const auto count = static_cast<double>(k);
  const double rate_Hz = std::round(1.0 / period_s);
  const bool is_whole = rate_Hz > 0.0 && std::abs(rate_Hz * period_s - 1.0) < kRounding;
  return is_whole ? count / rate_Hz : count * period_s;
}

Excitation in_whole_samples(const Excitation& excitation, const SampleGrid& grid) {
  Excitation made = excitation;
  if (auto* pulses = std::get_if<BangBang>(&made)) {
    round_to_samples(pulses->pulse_s, grid);
    round_to_samples(pulses->start_s, grid);
  } else if (auto* step = std::get_if<Step>(&made)) {
    round_to_samples(step->start_s, grid);
  } else if (auto* multisine = std::get_if<Multisine>(&made)) {
    round_to_samples(multisine->period_s, grid);
  } else if (auto* staircase = std::get_if<Staircase>(&made)) {
    round_to_samples(staircase->dwell_s, grid);
    round_to_samples(staircase->start_s, grid);
  } else if (auto* prbs = std::get_if<Prbs>(&made)) {
    round_to_samples(prbs->clock_s, grid);
  } else if (auto* sine = std::get_if<Sine>(&made)) {
    round_to_samples(sine->start_s, grid);
  }
  return made;
}

SampledTorque sample(const Excitation& excitation, const SampleGrid& grid) {
  arm::require_in_range("sampling period", grid.period_s, "s", arm::kPositive);
  if (grid.samples < 2) {
    throw InputError(fmt::format("{} samples; must be two or more", grid.samples));
  }
  return std::visit([&](const auto& signal) { return sampled(signal, grid); }, excitation);
}

double peak_N_m(std::span<const double> torque_N_m) {
  double peak = 0.0;
  for (const double value : torque_N_m) peak = std::max(peak, std::abs(value));
  return peak;
}

double rms_N_m(std::span<const double> torque_N_m) {
  double sum = 0.0;
  for (const double value : torque_N_m) sum += value * value;
  const auto count = static_cast<double>(torque_N_m.size());
  if (std::isfinite(sum)) return std::sqrt(sum / count);
  // The squares are too large for a number, not what they give.
  const double peak = peak_N_m(torque_N_m);
  sum = 0.0;
  for (const double value : torque_N_m) sum += (value / peak) * (value / peak);
  return peak * std::sqrt(sum / count);
}

double crest_factor(std::span<const double> torque_N_m) {
  const double rms = rms_N_m(torque_N_m);
  return rms > 0.0 ? peak_N_m(torque_N_m) / rms : 0.0;
}

}  // namespace flexarm::response
