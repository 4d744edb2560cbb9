#pragma once

#include "measured/files/frequency_record.hpp"
#include "measured/files/record_constants.hpp"
#include "response/frequency/modal_response.hpp"
#include "tests/fit_cases/fit_cases.hpp"

#include <cmath>
#include <complex>
#include <numbers>

namespace flexarm::measured {

/// From 1 Hz on in equal ratios, each sensor on lines of its own.
inline FrequencyRecord responses(const FitCase& fit_case, const arm::ModalModel& model, int lines,
                                 double to_Hz = 80.0) {
  FrequencyRecord record;
  for (std::size_t j = 0; j < fit_case.sensors.size(); ++j) {
    FrequencyChannel channel{fit_case.sensors[j], {}, {}, {}};
    const int count = lines + 10 * static_cast<int>(j);
    for (int k = 0; k < count; ++k) {
      const double f = std::pow(to_Hz, static_cast<double>(k) / (count - 1));
      channel.frequency_Hz.push_back(f);
      channel.response.push_back(response::modal_response(
          model, fit_case.sensors, std::complex<double>(0.0, 2.0 * std::numbers::pi * f))[j]);
      channel.coherence.push_back(kUnknown);
    }
    record.channels.push_back(channel);
  }
  return record;
}

}  // namespace flexarm::measured
