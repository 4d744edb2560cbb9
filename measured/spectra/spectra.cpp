#include "measured/spectra/spectra.hpp"

#include "arm/input_error.hpp"
#include "measured/files/record_constants.hpp"
#include "measured/spectra/fourier.hpp"
#include "measured/spectra/segment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flexarm::measured {

namespace {

using Complex = std::complex<double>;

std::size_t most_differences(const Signal& input, std::span<const Signal> outputs) {
  int most = input.differences;
  for (const auto& output : outputs) most = std::max(most, output.differences);
  return static_cast<std::size_t>(most);
}

void require_plan(const SegmentPlan& plan, std::size_t samples, std::size_t lost) {
  if (plan.segment_samples < 4) {
    throw arm::InputError(
        fmt::format("segment = {} samples: must be 4 or more", plan.segment_samples));
  }
  if (plan.segment_samples + lost > samples) {
    throw arm::InputError(fmt::format(
        "segment = {} samples: the record has {}{}; must be at most {}", plan.segment_samples,
        samples, lost == 0 ? "" : ", minus those lost by differencing",
        samples > lost ? samples - lost : 0));
  }
  if (plan.shift_samples < 1 || plan.shift_samples > plan.segment_samples) {
    throw arm::InputError(fmt::format("shift = {} samples: must be from 1 to a segment, {}",
                                      plan.shift_samples, plan.segment_samples));
  }
}

/// The windowed transform of a signal's segment.
class SegmentTransform {
 public:
  SegmentTransform(const SegmentPlan& plan, std::span<const double> window)
      : plan_(plan),
        window_(window),
        transform_(plan.segment_samples),
        values_(plan.segment_samples) {}

  std::size_t lines() const { return transform_.lines(); }

  void operator()(const Signal& signal, std::size_t first, std::span<Complex> spectrum) {
    copy_differenced(signal, first, values_);
    take_off(plan_.detrend, values_);
    for (std::size_t j = 0; j < values_.size(); ++j) values_[j] *= window_[j];
    transform_(values_, spectrum);
  }

 private:
  const SegmentPlan& plan_;
  std::span<const double> window_;
  RealTransform transform_;
  std::vector<double> values_;
};

void add_powers(std::span<const Complex> x, std::vector<double>& powers) {
  for (std::size_t k = 0; k < x.size(); ++k) powers[k] += std::norm(x[k]);
}

/// conj(x) y, by parts: the standard's product looks for infinities.
void add_products(std::span<const Complex> x, std::span<const Complex> y,
                  std::vector<Complex>& products) {
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double re = x[k].real() * y[k].real() + x[k].imag() * y[k].imag();
    const double im = x[k].real() * y[k].imag() - x[k].imag() * y[k].real();
    products[k] += Complex(re, im);
  }
}

}  // namespace

std::string_view to_string(Detrend detrend) {
  switch (detrend) {
    case Detrend::none:
      return "none";
    case Detrend::mean:
      return "mean";
    case Detrend::line:
      return "line";
  }
  return "";
}

std::complex<double> difference_response(double frequency_Hz, double period_s, int differences) {
  // 1 - exp(-i a) = 2 i sin(a/2) exp(-i a/2), without cancellation at small a.
  const double half = std::numbers::pi * frequency_Hz * period_s;
  const Complex once = 2.0 * std::sin(half) * Complex(std::sin(half), std::cos(half));
  Complex response = 1.0;
  for (int i = 0; i < differences; ++i) response *= once;
  return response;
}

int differences_until_steady(const arm::Sensor& sensor) {
  switch (sensor.kind) {
    case arm::SensorKind::hub_angle:
    case arm::SensorKind::tip_displacement:
      return 2;
    case arm::SensorKind::hub_velocity:
      return 1;
    case arm::SensorKind::tip_acceleration:
    case arm::SensorKind::tip_deflection:
    case arm::SensorKind::strain:
      return 0;
  }
  return 0;
}

CrossSpectra cross_spectra(const Signal& input, std::span<const Signal> outputs, double period_s,
                           const SegmentPlan& plan) {
  const std::size_t samples = input.values.size();
  const std::size_t lost = most_differences(input, outputs);
  require_plan(plan, samples, lost);
  const std::size_t length = plan.segment_samples;
  const auto window = window_values(plan.window, length);
  SegmentTransform transform(plan, window);
  const std::size_t lines = transform.lines();

  CrossSpectra made;
  made.input.resize(lines);
  made.outputs.assign(outputs.size(), std::vector<double>(lines));
  made.cross.assign(outputs.size(), std::vector<Complex>(lines));
  std::vector<Complex> x(lines);
  std::vector<Complex> y(lines);
  for (std::size_t first = lost; first + length <= samples; first += plan.shift_samples) {
    transform(input, first, x);
    add_powers(x, made.input);
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      transform(outputs[i], first, y);
      add_powers(y, made.outputs[i]);
      add_products(x, y, made.cross[i]);
    }
    ++made.segments;
  }

  made.spacing_Hz = 1.0 / (static_cast<double>(length) * period_s);
  made.noise_bandwidth_Hz = noise_bandwidth_lines(window) * made.spacing_Hz;
  made.effective_averages = effective_averages(window, made.segments, plan.shift_samples);
  made.input_differences = input.differences;
  for (const auto& output : outputs) made.differences.push_back(output.differences);

  // One-sided density: 2/(fs sum w^2), once where a line is its own mirror image.
  double squares = 0.0;
  for (const double w : window) squares += w * w;
  const double density = period_s / (squares * static_cast<double>(made.segments));
  made.frequency_Hz.resize(lines);
  for (std::size_t k = 0; k < lines; ++k) {
    made.frequency_Hz[k] = static_cast<double>(k) * made.spacing_Hz;
    const double scale = k == 0 || 2 * k == length ? density : 2.0 * density;
    const auto removed = [&](int differences) {
      return k == 0 && differences > 0
                 ? Complex(kUnknown, kUnknown)
                 : difference_response(made.frequency_Hz[k], period_s, differences);
    };
    const Complex of_input = removed(input.differences);
    made.input[k] *= scale / std::norm(of_input);
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      const Complex of_output = removed(outputs[i].differences);
      made.outputs[i][k] *= scale / std::norm(of_output);
      made.cross[i][k] *= scale / (std::conj(of_input) * of_output);
    }
  }
  return made;
}

double relative_autopower_std(double effective_averages, bool is_real) {
  return std::sqrt((is_real ? 2.0 : 1.0) / effective_averages);
}

double sine_amplitude(double power_spectral_density, double noise_bandwidth_Hz) {
  return std::sqrt(2.0 * power_spectral_density * noise_bandwidth_Hz);
}

}  // namespace flexarm::measured
