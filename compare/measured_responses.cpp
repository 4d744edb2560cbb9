#include "compare/measured_responses.hpp"

#include "response/arm_parts.hpp"
#include "response/frequency/response_study.hpp"
#include "response/linear_chain.hpp"
#include "response/settings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace flexarm::compare {

namespace {

bool is_finite(std::complex<double> value) {
  return std::isfinite(value.real()) && std::isfinite(value.imag());
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
    range.to_Hz = std::fmax(*range.to_Hz, channel.frequency_Hz.back());
    compared.push_back({run, channel, {}, {}, {}, {}, curve_frequencies_Hz(channel), {}});
  }
  const int roots = std::min(response::roots_needed(parts.linear, range), response::kMostRoots);
  for (const auto& subject : standard_subjects(parts.linear, roots)) {
    for (auto& each : compared) {
      const std::array sensors = {each.measured.sensor};
      auto response = response::frequency_response(subject.formulation, chain, sensors,
                                                   each.measured.frequency_Hz);
      add_errors(response.values.front(), each);
      if (!each.curve_frequency_Hz.empty()) {
        each.curves.push_back(response::frequency_response(subject.formulation, chain, sensors,
                                                           each.curve_frequency_Hz)
                                  .values.front());
      }
      each.models.push_back(subject.name);
      each.values.push_back(std::move(response.values.front()));
    }
  }
  return compared;
}

}  // namespace flexarm::compare
