#include "measured/spectra/segment.hpp"

namespace flexarm::measured {

void copy_differenced(const Signal& signal, std::size_t first, std::span<double> to) {
  const double* x = signal.values.data() + first;
  switch (signal.differences) {
    case 0:
      for (std::size_t j = 0; j < to.size(); ++j) to[j] = x[j];
      break;
    case 1:
      for (std::size_t j = 0; j < to.size(); ++j) to[j] = x[j] - *(x + j - 1);
      break;
    default:
      for (std::size_t j = 0; j < to.size(); ++j) {
        to[j] = (x[j] - *(x + j - 1)) - (*(x + j - 1) - *(x + j - 2));
      }
  }
}

void take_off(Detrend detrend, std::span<double> values) {
  if (detrend == Detrend::none) return;
  const auto count = static_cast<double>(values.size());
  double sum = 0.0;
  for (const double value : values) sum += value;
  const double mean = sum / count;
  if (detrend == Detrend::mean) {
    for (double& value : values) value -= mean;
    return;
  }
  // With u_j = j - (n - 1)/2, sum u = 0 and sum u^2 = n (n^2 - 1)/12.
  const double middle = 0.5 * (count - 1.0);
  double moment = 0.0;
  for (std::size_t j = 0; j < values.size(); ++j) {
    moment += (static_cast<double>(j) - middle) * (values[j] - mean);
  }
  const double slope = moment * 12.0 / (count * (count * count - 1.0));
  for (std::size_t j = 0; j < values.size(); ++j) {
    values[j] -= mean + slope * (static_cast<double>(j) - middle);
  }
}

}  // namespace flexarm::measured
