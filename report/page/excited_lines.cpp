#include "report/page/excited_lines.hpp"

#include "measured/modal/start_spectra.hpp"

namespace flexarm::report::page {

std::vector<std::size_t> excited_lines(const measured::TimeRecord& record,
                                       const std::vector<double>& frequency_Hz) {
  const measured::FitBand band = measured::excited_band(record);
  std::vector<std::size_t> lines;
  for (std::size_t k = 0; k < frequency_Hz.size(); ++k) {
    if (frequency_Hz[k] > 0.0 && band.contains(frequency_Hz[k])) lines.push_back(k);
  }
  return lines;
}

MeasuredResponse picked(const MeasuredResponse& response, const std::vector<std::size_t>& lines) {
  MeasuredResponse made = response;
  made.frequency_Hz = picked(response.frequency_Hz, lines);
  made.response = picked(response.response, lines);
  made.relative_std = picked(response.relative_std, lines);
  made.coherence = picked(response.coherence, lines);
  return made;
}

}  // namespace flexarm::report::page
