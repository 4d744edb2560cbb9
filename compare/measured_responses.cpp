#include "compare/measured_responses.hpp"

#include "response/arm_parts.hpp"
#include "response/frequency/response_study.hpp"
#include "response/linear_chain.hpp"
#include "response/settings.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace flexarm::compare {

namespace {

bool is_finite(std::complex<double> value) {
  return std::isfinite(value.real()) && std::isfinite(value.imag());
}

/// Without the lines that tell of noise alone; unknown coherences are none.
measured::FrequencyChannel coherent_lines(const measured::FrequencyChannel& channel) {
  measured::FrequencyChannel kept{channel.sensor, {}, {}, {}};
  for (std::size_t k = 0; k < channel.frequency_Hz.size(); ++k) {
    if (channel.coherence[k] < kLeastCoherence) continue;
    kept.frequency_Hz.push_back(channel.frequency_Hz[k]);
    kept.response.push_back(channel.response[k]);
    kept.coherence.push_back(channel.coherence[k]);
  }
  return kept.frequency_Hz.empty() ? channel : kept;
}

constexpr int kCurvePoints = 800;

std::vector<double> curve_frequencies_Hz(const measured::FrequencyChannel& channel) {
  std::vector<double> frequency_Hz = channel.frequency_Hz;
  std::erase_if(frequency_Hz, [](double f) { return !(f > 0.0); });
  if (frequency_Hz.size() < 2) return {};
  const auto grid =
      response::logarithmic_frequencies({frequency_Hz.front(), frequency_Hz.back(), kCurvePoints});
  frequency_Hz.insert(frequency_Hz.end(), grid.begin(), grid.end());
  std::ranges::sort(frequency_Hz);
  const auto repeated = std::ranges::unique(frequency_Hz);
  frequency_Hz.erase(repeated.begin(), repeated.end());
  return frequency_Hz;
}

void add_errors(const std::vector<std::complex<double>>& model, MeasuredResponse& compared) {
  double error = 0.0;
  double power = 0.0;
  std::vector<double> relative;
  const auto& measured = compared.measured.response;
  for (std::size_t k = 0; k < model.size(); ++k) {
    if (!is_finite(model[k]) || !is_finite(measured[k]) || measured[k] == 0.0) continue;
    error += std::norm(measured[k] - model[k]);
    power += std::norm(measured[k]);
    relative.push_back(std::abs(measured[k] - model[k]) / std::abs(measured[k]));
  }
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  compared.relative_error_percent.push_back(power > 0.0 ? 100.0 * std::sqrt(error / power) : kNone);
  if (relative.empty()) {
    compared.median_error_percent.push_back(kNone);
    return;
  }
  const auto middle = relative.begin() + static_cast<std::ptrdiff_t>(relative.size() / 2);
  std::ranges::nth_element(relative, middle);
  compared.median_error_percent.push_back(100.0 * *middle);
}

}  // namespace

std::vector<MeasuredResponse> responses_beside_models(const arm::Arm& arm, const std::string& run,
                                                      const measured::FrequencyRecord& record) {
  const auto parts = response::take_apart(arm);
  const auto chain = response::linear_chain(parts);
  response::ResponseOptions range;
  range.to_Hz = 0.0;
  std::vector<MeasuredResponse> compared;
  for (const auto& channel : record.channels) {
    MeasuredResponse each;
    each.run = run;
    each.input = record.input;
    each.measured = coherent_lines(channel);
    each.left_out = channel.frequency_Hz.size() - each.measured.frequency_Hz.size();
    each.curve_frequency_Hz = curve_frequencies_Hz(each.measured);
    range.to_Hz = std::fmax(*range.to_Hz, each.measured.frequency_Hz.back());
    compared.push_back(std::move(each));
  }
  const int roots = std::min(response::roots_needed(parts.linear, range), response::kMostRoots);
  for (const auto& subject : standard_subjects(parts.linear, roots)) {
    for (auto& each : compared) {
      std::vector<arm::Sensor> sensors = {each.measured.sensor};
      if (record.input) sensors.push_back(*record.input);
      const auto response_at = [&](const std::vector<double>& frequency_Hz) {
        auto made = response::frequency_response(subject.formulation, chain, sensors, frequency_Hz);
        if (record.input) made = response::per_last_sensor(std::move(made));
        return std::move(made.values.front());
      };
      auto response = response_at(each.measured.frequency_Hz);
      add_errors(response, each);
      if (!each.curve_frequency_Hz.empty()) {
        each.curves.push_back(response_at(each.curve_frequency_Hz));
      }
      each.models.push_back(subject.name);
      each.values.push_back(std::move(response));
    }
  }
  return compared;
}

}  // namespace flexarm::compare
